// Effective values of interfaces as text, for properties of the kind "this edit changes nothing".
#include "support.hpp"

#include <cstring>
#include <string>

namespace deck::fuzz {
namespace {

std::string shown(std::int64_t v) { return std::to_string(v); }
std::string shown(const std::string& v) { return v; }
/// All bits, so that the last one counts.
std::string shown(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", v);
  return text;
}

template <class Inter>
void add(std::string& out, const std::vector<Inter>& all, bool only_used) {
  for (const Inter& inter : all) {
    out += "/INTER/TYPE" + std::to_string(inter.type) + "/" + std::to_string(inter.id) + ":";
    inter.for_each([&](std::string_view name, const auto& field) {
      if (only_used && (inter.type == 10 ? name == "Inacti" : name == "Iedge")) return;
      // 1000 is what old manuals write for 0.
      if constexpr (std::is_integral_v<std::decay_t<decltype(field.value)>>) {
        out += " " + std::string(name) + "=" +
               shown(only_used && field.value == 1000 ? 0 : field.value);
      } else {
        out += " " + std::string(name) + "=" + shown(field.value);
      }
    });
    out += "\n";
  }
}

}  // namespace

std::string effective_values(const Interfaces& interfaces, bool only_used) {
  std::string out;
  add(out, interfaces.type7, only_used);
  add(out, interfaces.type10, only_used);
  add(out, interfaces.type11, only_used);
  add(out, interfaces.type19, only_used);
  return out;
}

}  // namespace deck::fuzz
