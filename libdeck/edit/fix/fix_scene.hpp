// Shared by the strategies: scenes without moves at start-up, counts of penetrations, reading a
// deck again with proposed text, setting fields of a card.
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit.hpp"
#include "edit/cells.hpp"

namespace deck::detail {

/// The deck with the edits of `rewrite`. Error: it can no longer be read whole.
Result<LoadedDeck> read_again(const LoadedDeck& context, const Rewrite& rewrite);

/// Scene with the solver's own treatment, or (`as_written` false) with Inacti 0 everywhere, which
/// keeps every node at its written position.
Scene fix_scene(const LoadedDeck& loaded, const FixOptions& options, bool as_written,
                std::vector<WhatIf> what_if = {}, std::vector<std::int64_t> only = {});
Scene fix_scene(const Model& model, const Interfaces& interfaces, const Limits& limits,
                const FixOptions& options, bool as_written, std::vector<WhatIf> what_if = {},
                std::vector<std::int64_t> only = {});

/// Scene of a deck with a rewrite; `before` itself if the rewrite does not change it.
class AfterRewrite {
 public:
  /// `before` must outlive the result. Error: the deck can no longer be read whole.
  static Result<AfterRewrite> read(const LoadedDeck& context, const Rewrite& rewrite,
                                   const FixOptions& options, bool as_written, const Scene& before);
  const Scene& scene() const { return own_ ? *own_ : *before_; }

 private:
  std::optional<LoadedDeck> deck_;
  std::optional<Scene> own_;
  const Scene* before_ = nullptr;
};

/// Notes a pair or interface that a strategy does not treat; `next`: see FixRefusal.
void add_refusal(PenetrationFix& fix, std::int64_t interface_id, std::string reason,
                 std::string next = {}, double depth = 0);

/// Reason why a wanted interface cannot be judged; none if all were evaluated. Does not cover
/// TYPE24 and TYPE25, see note_unevaluated.
std::optional<Error> unevaluated(const Scene& scene, const FixOptions& options);
/// Notes the wanted TYPE24 and TYPE25 that were evaluated in part only.
void note_unevaluated(PenetrationFix& fix, const Scene& scene, const FixOptions& options);

bool asks_for(const FixOptions& options, std::int64_t interface_id);

/// True if the options include the contact's interface; for ties only with FixOptions::ties.
bool is_wanted(const FixOptions& options, const Contact& contact);

/// True if the solver ignores the pair or stops at it.
bool is_untreated(const PenetrationRow& row);

/// Counts of every wanted interface with penetrations.
std::map<std::int64_t, FixCount> count_interfaces(const Scene& scene, const FixOptions& options);

void set_interfaces(PenetrationFix& fix, const Interfaces& interfaces, const FixOptions& options,
                    const Scene& before, const Scene& after);
/// Entry of an interface; makes it if absent.
FixedInterface& interface_entry(PenetrationFix& fix, const InterBase& inter);

/// Deepest penetration of each secondary node or edge, by its position.
std::map<std::uint32_t, const PenetrationRow*> deepest_rows(const Contact& contact);

/// Node ids of the secondary item of a row, or of its main segment or edge.
std::vector<std::int64_t> node_ids(const Model& model, const Contact& contact,
                                   const PenetrationRow& row, bool main);

struct FieldPlace : CellPlace {
  std::string_view text;  ///< present content
  double factor = 1;      ///< deck units to working units
  int width() const { return std::min(last - first + 1, room()); }
};
/// Error: this input version has no such cell, or its line is missing.
Result<FieldPlace> find_field(const Deck& deck, const Block& block, std::string_view name);

/// Largest number of at most `digits` significant digits that is <= `bound` (> 0; `below`: also <
/// it) and fits `width` columns; nullopt if none.
struct RoundedText {
  std::string text;
  double value = 0;  ///< value that the text reads as
};
std::optional<RoundedText> round_down(double bound, int digits, int width,
                                      std::optional<double> below = {});
/// Smallest such number >= `bound`.
std::optional<RoundedText> round_up(double bound, int digits, int width);

/// "/INTER/TYPE7/12"
std::string name_of(const InterBase& inter);

/// Fields of a type; an empty name: the type has no such field.
struct TypeRules {
  int type = 7;
  std::string_view scale;                ///< scales the gap from thickness
  std::array<std::string_view, 2> caps;  ///< limits of that gap: of pairs, or per side
  bool with_igap_2 = false;              ///< scale and caps act with Igap 2 and 3 only
  int usual_inacti = 6;
  bool fpenmax = false;
};
const TypeRules& rules_of(int type);

/// Reason why the type cannot use this Inacti; empty if it can.
std::string why_not_inacti(int type, int value);

/// False for pairs of tied nodes: they are listed but never in contact.
inline bool is_penetration(const PenetrationRow& row) {
  return row.action != PenetrationAction::removed_tied;
}
/// The pair is free below this gap; <= 0: free with no gap. For TYPE24 and TYPE25 it comes from the
/// depth: their rules of borders and solids are not in the distance.
inline double free_gap(const Contact& contact, const PenetrationRow& row) {
  return is_type24_or_25(contact.type) ? row.gap - row.depth : row.distance;
}

}  // namespace deck::detail
