// What the steps of unit conversion share. Private to unit conversion.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "deck/edit/convert.hpp"
#include "edit/convert/units/unit_system_decimal.hpp"

namespace deck::detail {

/// The working units follow the input units: everything that is in working units gets new numbers.
inline bool working_units_change(const Deck& deck, const UnitSystem& target,
                                 const UnitsOptions& options) {
  return !options.keep_working && deck.begin.input == deck.begin.working &&
         !(deck.begin.working == target);
}

struct UnitConversion {
  UnitConversion(const LoadedDeck& c, const UnitSystem& t, const UnitsOptions& o)
      : context(c),
        deck(c.deck()),
        target(t),
        options(o),
        factors(c.deck().begin.input, t),
        working_changes(working_units_change(c.deck(), t, o)) {}

  const LoadedDeck& context;
  const Deck& deck;
  const UnitSystem& target;
  const UnitsOptions& options;
  UnitFactors factors;
  bool working_changes;
  Rewrite out;

  /// Something that cannot be converted: a refusal, or with `partial` an undecided loss; the block
  /// then stays as it is as a whole.
  void undecided(const Block& block, Span place, std::string field, std::string why);
  /// New text for the cell in columns first..last of a fixed-column line.
  void convert_fixed(const Block& block, const Line& line, int first, int last,
                     std::string_view field, const UnitFactor& factor);
  /// New text for a cell of a free-format line.
  void convert_free(const Block& block, const Line& line, Span cell, std::string_view field,
                    const UnitFactor& factor);
  /// Puts `text` into the columns, as far right as the old text stood.
  void replace_fixed(const Line& line, int first, int last, std::string_view text);

  /// Where a cell stands and how to write into it.
  struct Place {
    const Block* block = nullptr;
    Span span;
    std::string field;
    Line line;
    int first = 0, last = 0;  ///< columns, unless
    bool free_format = false;
  };
  static Place place_of(const Block& block, const DecodedCard& card, const Cell& cell);
  /// Other text for the cell; false: its line has no room for it.
  bool put(const Place& place, const std::string& text);

  struct ParameterUse : Place {
    Dimension dimension;
    double value = 0;
  };
  std::map<std::string, std::vector<ParameterUse>, std::less<>> parameter_uses;

  /// An id of a function or table in a block.
  struct FunctionUse : Place {
    std::int64_t id = 0;
    std::vector<Dimension> points;  ///< dimension that the points themselves carry, axis by axis
  };
  std::vector<FunctionUse> function_uses;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::string>
      copies;                  ///< of functions, by place
  std::int64_t last_copy = 0;  ///< id of the last one

  /// What a block added to `out`, and with `partial` the blocks that stay as they are.
  struct Share {
    std::size_t edits = 0, edits_end = 0, losses = 0, losses_end = 0;
  };
  std::multimap<const Block*, Share> shares;
  /// The share of a block that begins here; the destructor closes it.
  class OpenShare {
   public:
    OpenShare(UnitConversion& c, const Block& block);
    OpenShare(const OpenShare&) = delete;
    OpenShare& operator=(const OpenShare&) = delete;
    ~OpenShare();

   private:
    UnitConversion& c_;
    const Block& block_;
    Share share_;
  };
  std::set<const Block*> left;
  /// Takes the edits of the blocks in `left` out again.
  void leave_blocks();

  std::uint64_t changed_cells = 0, own_unit_blocks = 0;
  std::map<std::string, std::string> used_factors;  ///< dimension -> factor, for the notes
  void note_dimension(const Dimension& dimension, const UnitFactor& factor);

 private:
  void changed(const Block& block, Span place, std::string_view field, std::string_view before,
               const ScaledText& after, int width);
  std::unordered_map<std::uint64_t, int> spare_;  // columns left on free-format lines
};

/// /BEGIN, or the /UNIT/LENGTH ... of old versions. False: refused.
bool convert_begin(UnitConversion& conversion);
/// The cells of all blocks.
void convert_blocks(UnitConversion& conversion);
/// The definitions of the parameters that converted cells use; where a parameter stands for more
/// than one thing, the cells get numbers.
void convert_parameters(UnitConversion& conversion);

/// The points of functions whose axes have no scale; a function that is read in several units gets
/// a copy for each.
void convert_functions(UnitConversion& conversion);

/// Refusals for includes that could not be read: a rewrite of half a deck is none.
std::vector<std::string> unread_files(const Deck& deck);

/// Refusals for files that the deck includes more than once and whose copies would get different
/// edits.
std::vector<std::string> contradicting_copies(const SourceSet& sources,
                                              const std::vector<TextEdit>& edits);

}  // namespace deck::detail
