// Converts a deck to other units: header, blocks, functions, parameters, notes.
#include <algorithm>

#include "deck/edit/convert.hpp"
#include "deck/text/number.hpp"
#include "edit/convert/units/unit_system_state.hpp"
#include "text/shared/columns.hpp"

namespace deck {

using detail::UnitConversion;
using detail::UnitFactor;

namespace {

void add_notes(UnitConversion& c) {
  const auto text = [](const UnitFactor& f) {
    const auto value = format_real(static_cast<double>(f.value), 24);
    return f.power ? "1e" + std::to_string(*f.power) : (value ? value->text : std::string("?"));
  };
  const auto code = [](const std::string& name, double factor) {
    const auto value = format_real(factor, 24);
    return !name.empty() ? name : value ? value->text : std::string("?");
  };
  const UnitSystem &from = c.deck.begin.input, &to = c.target;
  auto& notes = c.out.notes;
  notes.push_back("mass " + code(from.mass_code, from.mass) + " -> " + code(to.mass_code, to.mass) +
                  ": factor " + text(c.factors.mass()));
  notes.push_back("length " + code(from.length_code, from.length) + " -> " +
                  code(to.length_code, to.length) + ": factor " + text(c.factors.length()));
  notes.push_back("time " + code(from.time_code, from.time) + " -> " + code(to.time_code, to.time) +
                  ": factor " + text(c.factors.time()));
  for (const auto& [dimension, factor] : c.used_factors)
    if (dimension != "mass" && dimension != "length" && dimension != "time")
      notes.push_back(dimension + ": factor " + factor);
  notes.push_back(std::to_string(c.changed_cells) + " values converted");
  if (c.own_unit_blocks > 0)
    notes.push_back(std::to_string(c.own_unit_blocks) +
                    " blocks have units of their own and keep their values");
  if (c.working_changes)
    notes.push_back(
        "the working units change with the input units: the times of Engine files and all results "
        "are in the new units");
  else
    notes.push_back("the working units stay: results and Engine files keep their units");
}

}  // namespace

Result<UnitSystem> parse_unit_system(std::string_view text) {
  UnitSystem units;
  double* const factors[3] = {&units.mass, &units.length, &units.time};
  std::string* const codes[3] = {&units.mass_code, &units.length_code, &units.time_code};
  constexpr char bases[3] = {'g', 'm', 's'};
  constexpr const char* names[3] = {"mass", "length", "time"};
  for (int i = 0; i < 3; ++i) {
    const auto comma = i < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos)
      return Error{Error::Code::config, "expected mass,length,time, for example kg,mm,ms"};
    const std::string_view code = detail::trim(text.substr(0, comma));
    const auto factor = unit_factor(code, bases[i]);
    if (!factor || code.size() > 20)
      return Error{Error::Code::config, "'" + std::string(code.substr(0, 40)) + "' is not a " +
                                            names[i] + " unit; expected a prefix and '" + bases[i] +
                                            "', or a positive number"};
    *factors[i] = *factor;
    *codes[i] = std::string(code);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return units;
}

Rewrite to_units(const LoadedDeck& context, const UnitSystem& target, const UnitsOptions& options) {
  UnitConversion c(context, target, options);
  c.out.refusals = detail::unread_files(context.deck());
  if (!c.out.refusals.empty()) return std::move(c.out);
  if (!detail::convert_begin(c)) return std::move(c.out);
  if (context.deck().begin.input == target && !c.working_changes) {
    c.out.edits.clear();
    c.out.notes.push_back("the deck is in these units already");
    return std::move(c.out);
  }
  detail::convert_blocks(c);
  detail::convert_functions(c);
  detail::convert_parameters(c);
  c.leave_blocks();
  for (std::string& why : detail::contradicting_copies(context.deck().sources, c.out.edits))
    c.out.refusals.push_back(std::move(why));
  add_notes(c);
  if (!c.out.refusals.empty()) c.out.edits.clear();
  return std::move(c.out);
}

}  // namespace deck
