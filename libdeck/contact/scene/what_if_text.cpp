// Reads "3:Gapmin=2,Inacti=6" and checks it against the card of the interface.
#include "contact/shared/reported.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "deck/text.hpp"

namespace deck {
namespace {

bool is_flag(std::string_view name) {
  return name == "Igap" || name == "Inacti" || name == "Irem_gap";
}

/// Name on the card: TYPE24 and TYPE25 have a largest gap per side, TYPE25 has its own scale.
std::string_view name_on_card(std::string_view name, const InterBase& inter) {
  if (name == "Gapmin" && !is_type24_or_25(inter.type)) return traits_of(inter).gap;
  if (is_type24_or_25(inter.type) && name == "Fscalegap") return "Gap_scale";
  if (is_type24_or_25(inter.type) && name == "Gapmax") return "Gap_max_s";
  return name;
}

}  // namespace

Result<WhatIf> parse_what_if(const std::string& text) {
  const auto bad = [&](const std::string& why) {
    return Error{Error::Code::config,
                 "--what-if " + text + ": " + why +
                     "; expected ID:FIELD=VALUE[,FIELD=VALUE...] with FIELD one "
                     "of Gapmin Fscalegap (or Gap_scale) Gapmax Fpenmax %mesh_size Igap "
                     "Inacti Irem_gap"};
  };
  WhatIf w;
  const auto colon = text.find(':');
  if (colon == std::string::npos) return bad("there is no ':'");
  const IntegerCell id = read_integer(std::string_view(text).substr(0, colon));
  if (id.status != NumberStatus::ok) return bad("the interface id is not a number");
  w.interface_id = id.value;
  for (std::size_t at = colon + 1; at <= text.size();) {
    const auto comma = std::min(text.find(',', at), text.size());
    const std::string item = text.substr(at, comma - at);
    at = comma + 1;
    const auto equal = item.find('=');
    if (equal == std::string::npos) return bad("'" + item + "' has no '='");
    const std::string name = item.substr(0, equal);
    const RealCell v = read_real(std::string_view(item).substr(equal + 1));
    if (v.status != NumberStatus::ok) return bad("the value of '" + name + "' is not a number");
    const IntegerCell whole = read_integer(std::string_view(item).substr(equal + 1));
    if (is_flag(name) && (whole.status != NumberStatus::ok || std::abs(whole.value) > 1000))
      return bad("'" + name + "' is a flag, a whole number of at most 1000");
    if (!is_flag(name) && !(std::abs(v.value) <= 1e30))
      return bad("the value of '" + name + "' is out of range");
    const int flag = static_cast<int>(whole.value);
    if (name == "Gapmin")
      w.Gapmin = v.value;
    else if (name == "Fscalegap" || name == "Gap_scale")
      w.Fscalegap = v.value;
    else if (name == "Gapmax")
      w.Gapmax = v.value;
    else if (name == "Fpenmax")
      w.Fpenmax = v.value;
    else if (name == "%mesh_size")
      w.mesh_size = v.value;
    else if (name == "Igap")
      w.Igap = flag;
    else if (name == "Inacti")
      w.Inacti = flag;
    else if (name == "Irem_gap")
      w.Irem_gap = flag;
    else
      return bad("there is no field '" + name + "'");
  }
  return w;
}

Result<void> check_what_if(const WhatIf& w, const InterBase& inter) {
  const Schema* schema = inter.block->schema;
  if (schema == nullptr) return {};
  const auto check = [&](std::string_view name, double value) -> Result<void> {
    const auto refuse = [&](const std::string& why) {
      return Error{Error::Code::config,
                   "--what-if " + std::to_string(w.interface_id) + ":" + std::string(name) + "=" +
                       (is_flag(name) ? std::to_string(static_cast<int>(value)) : shortest(value)) +
                       ": " + why};
    };
    const std::string_view on_card = name_on_card(name, inter);
    const Field* field = schema->find_field(on_card);
    // The node parts of a TYPE19 use it, although its card lacks it.
    if (field == nullptr && inter.type == 19 && name == "Fpenmax") return {};
    if (field == nullptr)
      return refuse("TYPE" + std::to_string(inter.type) + " has no field " +
                    std::string(is_type24_or_25(inter.type) ? on_card : name));
    if (!std::isfinite(value)) return refuse("the value is not finite");
    if (!field->values.empty() &&
        std::none_of(field->values.begin(), field->values.end(),
                     [&](std::int64_t v) { return static_cast<double>(v) == value; })) {
      std::string legal;
      for (const std::int64_t v : field->values)
        legal += (legal.empty() ? "" : ", ") + std::to_string(v);
      return refuse("the field takes " + legal);
    }
    if ((field->min && value < *field->min) || (field->max && value > *field->max))
      return refuse("the field takes " + (field->min ? "at least " + shortest(*field->min) : "") +
                    (field->max ? " at most " + shortest(*field->max) : ""));
    return {};
  };
  const std::pair<std::string_view, std::optional<double>> fields[] = {
      {"Gapmin", w.Gapmin},   {"Fscalegap", w.Fscalegap},  {"Gapmax", w.Gapmax},
      {"Fpenmax", w.Fpenmax}, {"%mesh_size", w.mesh_size}, {"Igap", w.Igap},
      {"Inacti", w.Inacti},   {"Irem_gap", w.Irem_gap}};
  for (const auto& [name, value] : fields)
    if (value)
      if (auto fits = check(name, *value); !fits) return fits;
  return {};
}

}  // namespace deck
