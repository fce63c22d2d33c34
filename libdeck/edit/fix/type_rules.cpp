// The table of types for the strategies.
#include "edit/fix/type_rules.hpp"

#include <algorithm>

namespace deck::detail {
namespace {

constexpr TypeRules table[] = {
    {7, "Fscalegap", {"Gapmax", ""}, true, 6, true},
    {10, "", {"", ""}, false, 6, false},
    {11, "", {"", ""}, false, 6, false},
    {19, "Fscalegap", {"Gapmax", ""}, true, 6, false},
    {24, "", {"Gap_max_s", "Gap_max_m"}, false, 5, false},
    {25, "Gap_scale", {"Gap_max_s", "Gap_max_m"}, false, 5, false},
};

}  // namespace

const TypeRules& rules_of(int type) {
  const auto it = std::find_if(std::begin(table), std::end(table),
                               [&](const TypeRules& r) { return r.type == type; });
  return it == std::end(table) ? table[0] : *it;
}

std::string why_not_inacti(int type, int value) {
  const std::string name = "TYPE" + std::to_string(type);
  if (is_modern(type)) {
    if (value == -1 || value == 0 || value == 5) return {};
    return name + " knows Inacti -1, 0 and 5 only: the solver would take " + std::to_string(value) +
           " as 5 (warning " + (type == 24 ? "1031" : "1559") + ")";
  }
  if (value == -1) return name + " has no Inacti -1: only TYPE24 and TYPE25 do";
  if (type == 10)
    return value == 5 ? "TYPE10 with Inacti 5 stops the solver (error 1162)"
                      : "TYPE10 runs with Inacti 0 whatever the card says; move the nodes or "
                        "reduce the gap";
  if (type == 11 && value == 3)
    return "TYPE11 does nothing for Inacti 3; use 5 or 6, or move the nodes";
  return {};
}

}  // namespace deck::detail
