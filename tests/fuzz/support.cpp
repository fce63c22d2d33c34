// A model of sheets that inputs add to, and effective values of interfaces as text, for properties
// of the kind "this edit changes nothing".
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

std::string head_of_sheets(int version) {
  return "#RADIOSS STARTER\n/BEGIN\nfuzz\n      " + std::to_string(version) + R"(         0
                  kg                  mm                  ms
                  kg                  mm                  ms
/PROP/SHELL/1
sheet
        24         0         0         0
                 0.0                 0.0                 0.0                 0.0                 0.0
         5                           1.0                 0.0                   0         0
/MAT/ELAST/1
steel
             7.8e-06
               210.0                 0.3
)";
}

std::unique_ptr<Whole> read_blocks(int version, std::string_view model, const std::uint8_t* data,
                                   std::size_t size) {
  if (size > 8192) return nullptr;
  return read_text(head_of_sheets(version) + std::string(model) + text_of(data, size) + "\n/END\n");
}

std::string effective_values(const Interfaces& interfaces, bool only_used) {
  std::string out;
  add(out, interfaces.type7, only_used);
  add(out, interfaces.type10, only_used);
  add(out, interfaces.type11, only_used);
  add(out, interfaces.type19, only_used);
  return out;
}

}  // namespace deck::fuzz
