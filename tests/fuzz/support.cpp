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
void add(std::string& out, const std::vector<Inter>& all) {
  for (const Inter& inter : all) {
    out += "/INTER/TYPE" + std::to_string(inter.type) + "/" + std::to_string(inter.id) + ":";
    inter.for_each([&](std::string_view name, const auto& field) {
      out += " " + std::string(name) + "=" + shown(field.value);
    });
    out += "\n";
  }
}

}  // namespace

std::string effective_values(const Interfaces& interfaces) {
  std::string out;
  add(out, interfaces.type7);
  add(out, interfaces.type10);
  add(out, interfaces.type11);
  add(out, interfaces.type19);
  return out;
}

}  // namespace deck::fuzz
