// What the strategies share: scenes in which no node is moved at start-up, counting, reading the
// deck again with proposed text, and setting single fields of a card. Private to the stage.
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

/// The deck as a rewrite makes it. Error: it cannot be read whole any more.
Result<LoadedDeck> read_again(const LoadedDeck& context, const Rewrite& rewrite);

/// The scene as the solver's own treatment would see it, or (`as_written` false) with Inacti 0
/// everywhere, so that every node stands where the deck puts it.
Scene fix_scene(const LoadedDeck& loaded, const FixOptions& options, bool as_written,
                std::vector<WhatIf> what_if = {}, std::vector<std::int64_t> only = {});
Scene fix_scene(const Model& model, const Interfaces& interfaces, const Limits& limits,
                const FixOptions& options, bool as_written, std::vector<WhatIf> what_if = {},
                std::vector<std::int64_t> only = {});

/// The scene of a deck with a rewrite: that of before where it changes nothing.
class AfterRewrite {
 public:
  /// `before` must outlive it. Error: the deck cannot be read whole any more.
  static Result<AfterRewrite> read(const LoadedDeck& context, const Rewrite& rewrite,
                                   const FixOptions& options, bool as_written, const Scene& before);
  const Scene& scene() const { return own_ ? *own_ : *before_; }

 private:
  std::optional<LoadedDeck> deck_;
  std::optional<Scene> own_;
  const Scene* before_ = nullptr;
};

/// Notes what a strategy does not treat; `next`: see FixRefusal.
void add_refusal(PenetrationFix& fix, std::int64_t interface_id, std::string reason,
                 std::string next = {}, double depth = 0);

/// Why nothing can be said about a wanted interface; nothing: all were evaluated. TYPE24 and TYPE25
/// are told by note_unevaluated: what is known of them is treated.
std::optional<Error> unevaluated(const Scene& scene, const FixOptions& options);
/// Adds the wanted TYPE24 and TYPE25 that were not evaluated in full to what is not treated.
void note_unevaluated(PenetrationFix& fix, const Scene& scene, const FixOptions& options);

/// True if the options ask for an interface.
bool asks_for(const FixOptions& options, std::int64_t interface_id);

/// True if the options ask for the interface of a contact; for a tie only with FixOptions::ties.
bool is_wanted(const FixOptions& options, const Contact& contact);

/// True if the solver does nothing about the pair, or stops at it.
bool is_untreated(const PenetrationRow& row);

/// Counts of every interface with penetrations; `wanted` ones only.
std::map<std::int64_t, FixCount> count_interfaces(const Scene& scene, const FixOptions& options);

/// Forms PenetrationFix::interfaces from two scenes.
void set_interfaces(PenetrationFix& fix, const Interfaces& interfaces, const FixOptions& options,
                    const Scene& before, const Scene& after);
/// The entry of an interface, made if absent.
FixedInterface& interface_entry(PenetrationFix& fix, const InterBase& inter);

/// The deepest penetration of every secondary node or edge of a contact, by its position.
std::map<std::uint32_t, const PenetrationRow*> deepest_rows(const Contact& contact);

/// Node ids of the secondary node or edge of a row, or of its main segment or edge.
std::vector<std::int64_t> node_ids(const Model& model, const Contact& contact,
                                   const PenetrationRow& row, bool main);

/// A cell of an interface card that can be set.
struct FieldPlace : CellPlace {
  std::string_view text;  ///< what it holds
  double factor = 1;      ///< deck units to working units
  int width() const { return std::min(last - first + 1, room()); }
};
/// Error: the card of this input version has no such cell, or its line is missing.
Result<FieldPlace> find_field(const Deck& deck, const Block& block, std::string_view name);

/// The largest number of at most `digits` significant digits that is <= `bound` (> 0) and fits
/// `width` columns; with `below`, also smaller than that. nullopt: none.
struct RoundedText {
  std::string text;
  double value = 0;  ///< what reading the text gives
};
std::optional<RoundedText> round_down(double bound, int digits, int width,
                                      std::optional<double> below = {});
/// The smallest one that is >= `bound`.
std::optional<RoundedText> round_up(double bound, int digits, int width);

/// "/INTER/TYPE7/12"
std::string name_of(const InterBase& inter);

/// The fields of a type; an empty name: it has none of the kind.
struct TypeRules {
  int type = 7;
  std::string_view scale;                ///< of the gap that follows the thickness
  std::array<std::string_view, 2> caps;  ///< of that gap: of pairs, or of each of the two sides
  bool with_igap_2 = false;              ///< scale and caps count with Igap 2 and 3 only
  int usual_inacti = 6;
  bool fpenmax = false;
};
const TypeRules& rules_of(int type);

/// Why the solver cannot use this Inacti for the type; empty if it can.
std::string why_not_inacti(int type, int value);

/// False for pairs that a tie holds: they stand in the list and are never in contact.
inline bool is_penetration(const PenetrationRow& row) {
  return row.action != PenetrationAction::removed_tied;
}
/// The gap below which a pair is free; not above 0: no gap leaves it free. TYPE24 and TYPE25 give
/// the depth by the rules of their borders and solids, which the distance does not say.
inline double free_gap(const Contact& contact, const PenetrationRow& row) {
  return is_type24_or_25(contact.type) ? row.gap - row.depth : row.distance;
}

}  // namespace deck::detail
