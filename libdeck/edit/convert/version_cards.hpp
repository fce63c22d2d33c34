// Line by line: what a block's data lines become in another layout of the same keyword, which lines
// it has there, and which old line and cells they come from. Private to the edit stage.
#pragma once
#include <string_view>
#include <vector>

#include "deck/keyword/decode.hpp"

namespace deck::detail {

/// True if some card or cell of `schema` is in one of the versions only.
bool layout_differs(const Schema& schema, int a, int b);
/// One name for a cell that was renamed between versions.
std::string_view canonical_name(std::string_view field);
/// Only zeros, points and signs, or nothing.
bool is_zero_text(std::string_view text);

/// A line of the new layout and the old line it comes from.
struct NewLine {
  const CardSchema* card = nullptr;
  const DecodedCard* old = nullptr;
  int round = 0;  ///< as in DecodedCard
};

/// The cards of a block in version `target`, with the conditions evaluated on its old values. A
/// field that the new version does not have counts as 0.
class TargetLayout {
 public:
  TargetLayout(const Block& block, const DecodedBlock& decoded, int target)
      : block_(block), decoded_(decoded), target_(target) {}

  /// Lines in order, as far as the old block has rounds for them. Old lines are used once.
  std::vector<NewLine> lines() const;
  /// Cells that the line has.
  std::vector<const Field*> fields(const CardSchema& card, int round) const;
  /// The old cell of that name in the same round, on another line than `not_here`.
  const Cell* elsewhere(std::string_view field, int round, const DecodedCard* not_here) const;
  /// True if the number of lines of the block decides what the lines are.
  bool counts_lines() const;

 private:
  using Group = std::vector<const CardSchema*>;
  bool holds(const CardSchema& card, int round) const;
  bool holds(const std::vector<Condition>& when, int round) const;
  std::int64_t value(std::string_view field, int round) const;
  bool has_field(std::string_view field) const;
  int rounds(const CardSchema& card) const;
  const DecodedCard* take(const CardSchema& card, int round, std::vector<bool>& used) const;

  const Block& block_;
  const DecodedBlock& decoded_;
  int target_;
};

/// Cell of that name on a line; nullptr if it has none.
const Cell* cell_of(const DecodedCard& card, std::string_view field);

}  // namespace deck::detail
