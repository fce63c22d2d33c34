// Properties: thickness, section area and spring stiffness, the cells of /PROP that contact needs.
#include <cmath>

#include "keyword/shared/solver_order.hpp"
#include "model/model_build.hpp"

namespace deck::detail {
namespace {

int to_number(std::string_view digits) {
  if (digits.empty() || digits.size() > 4) return -1;
  int value = 0;
  for (const char ch : digits) {
    if (ch < '0' || ch > '9') return -1;
    value = value * 10 + (ch - '0');
  }
  return value;
}

/// TYPEn of a schema: from its keyword or, where that is a name, from its aliases.
int type_number(const Schema& schema) {
  constexpr std::string_view prefix = "/PROP/TYPE";
  if (schema.keyword == "/PROP/FLUID") return 14;  // its cards are not those of TYPE14
  if (schema.keyword.starts_with(prefix)) return to_number(schema.keyword.substr(prefix.size()));
  for (const std::string& alias : schema.aliases)
    if (alias.starts_with(prefix)) return to_number(std::string_view(alias).substr(prefix.size()));
  return -1;
}

/// Spring stiffness K divided by its scale coefficient A, where 0 stands for 1.
double spring_stiffness(const BuildContext& c, const DecodedBlock& d, const char* stiffness,
                        const char* scale) {
  const double a = c.value(d, scale);
  return c.value(d, stiffness) / (a == 0 ? 1 : a);
}

/// Sum of the section areas of the integration points of an integrated beam.
double integrated_area(const BuildContext& c, const DecodedBlock& d) {
  double sum = 0;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->name == "Area") sum += working_value(c.deck, d, cell);
  return sum;
}

void fill(const BuildContext& c, const DecodedBlock& d, Property& p) {
  p.thickness = c.value(d, "Thick");
  p.area = p.number == 18 ? integrated_area(c, d) : c.value(d, "Area");
  p.icontrol = static_cast<int>(d.integer("Icontrol"));
  switch (p.number) {
    case 4:
    case 12:
      p.stiffness[0] = spring_stiffness(c, d, "K", "A");
      break;
    case 8:
    case 13:
      p.stiffness = {spring_stiffness(c, d, "K1", "A1"), spring_stiffness(c, d, "K2", "A2"),
                     spring_stiffness(c, d, "K3", "A3")};
      break;
    case 25:
      // Tension, then shear.
      p.stiffness[0] = spring_stiffness(c, d, "K1", "A1");
      p.stiffness[1] = spring_stiffness(c, d, "K2", "A2");
      break;
    default:
      if (d.find("K") != nullptr) p.stiffness[0] = spring_stiffness(c, d, "K", "A");
      break;
  }
}

}  // namespace

void read_properties(BuildContext& c) {
  Model& m = c.model;
  for (const Block* const at : in_solver_order(c.deck, "/PROP")) {
    const Block& block = *at;
    if (block.schema == nullptr) continue;
    const DecodedBlock d = decode(c.deck, block);
    Property p;
    p.id = c.own_id(block, "prop");
    p.title = d.title;
    p.type = block.schema->keyword;
    p.number = type_number(*block.schema);
    p.span = block.header_span;
    p.block = &block;
    fill(c, d, p);
    const auto index = static_cast<std::uint32_t>(m.properties.size());
    const auto known = m.property_of_id.find(p.id);
    register_id(c, m.property_of_id, p.id, index, block,
                known == m.property_of_id.end() ? Span{} : m.properties[known->second].span);
    m.properties.push_back(std::move(p));
  }
}

}  // namespace deck::detail
