// What each type of contact offers to the strategies that change its card. Private to the stage.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "deck/contact/scene.hpp"

namespace deck::detail {

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
  return is_modern(contact.type) ? row.gap - row.depth : row.distance;
}

}  // namespace deck::detail
