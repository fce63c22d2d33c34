// Materials: density and the moduli for contact stiffness, E for shells and lines, B for solids;
// their cells depend on the law (table below). Properties: thickness, section area, spring
// stiffness.
#include <algorithm>
#include <cmath>
#include <vector>

#include "keyword/shared/solver_order.hpp"
#include "model/model_build.hpp"

namespace deck::detail {
namespace {

/// Computes E and B from the cells of a law.
using Moduli = void(const BlockCells& c, Material& m);

double isotropic_bulk(double e, double nu) { return e / (3 * (1 - 2 * nu)); }

void isotropic(const BlockCells& c, Material& m) {
  double nu = c.real("Nu");
  if (m.law == 1 && nu == 0.5) nu = 0.499;
  m.young = c.real("E");
  m.bulk = isotropic_bulk(m.young, nu);
  // Without this cell in the schema the stiffness is unknown.
  if (!c.has("E") && m.law != 0) m.stiffness_known = false, m.young = m.bulk = 1;
}

void modulus_twice(const BlockCells& c, Material& m) { m.young = m.bulk = c.real("E"); }

/// Foams and connections. LAW117 of Xu and Needleman: stiffness from strength and energy.
void third(const BlockCells& c, Material& m) {
  m.young = c.largest({"E", "G", "EN", "ES"});
  if (c.integer("EVOSHAPE") == 3)
    m.young = std::exp(2.0) * std::pow(c.largest({"TN", "TS"}), 2) / c.real("GIC");
  m.bulk = m.young / 3;
}

void given_bulk(const BlockCells& c, Material& m) {
  m.young = c.real("E");
  m.bulk = c.real("K");
}

void direct_strain(const BlockCells& c, Material& m) {
  const double e11 = c.real("E11");
  const double e22 = c.real("E22");
  const double nu12 = c.real("Nu12");
  const double nu21 = e11 != 0 ? nu12 * e22 / e11 : 0;
  m.young = m.bulk = std::max(e11, e22) / (1 - nu12 * nu21);
  if (c.has("Nu12")) m.stiffness_known = true;
}

/// Largest of all directions.
double largest_modulus(const BlockCells& c) {
  return c.largest({"E", "E1", "E2", "E3", "E11", "E22", "E33", "G12", "G23", "G31"});
}

void largest(const BlockCells& c, Material& m) { m.young = m.bulk = largest_modulus(c); }
/// Honeycomb.
void largest_bulk(const BlockCells& c, Material& m) { m.bulk = largest_modulus(c); }
void foam(const BlockCells& c, Material& m) { m.bulk = c.real("E"); }

/// From B and the short-term shear modulus.
void boltzmann(const BlockCells& c, Material& m) {
  m.bulk = c.real("K");
  const double g = c.real("G0");
  m.young = g > 0 ? 9 * m.bulk * g / (3 * m.bulk + g) : 0;
  if (!c.has("G0")) m.stiffness_known = false;
}

void ogden(const BlockCells& c, Material& m) {
  const double nu = c.real("Nu"), twice_shear = ogden_sum(c);
  m.young = twice_shear * (1 + nu);
  // With viscous terms the solver stores the true bulk modulus.
  m.bulk = c.integer("M") > 0 ? m.young / (3 * (1 - 2 * nu)) : twice_shear;
  // The default of a blank Poisson ratio is unknown.
  if (nu == 0) m.stiffness_known = false;
}

/// Sum of mu_i.
void hyperfoam(const BlockCells& c, Material& m) {
  double nu = c.real("Nu");
  if (nu >= 0.5) nu = 0.499;
  double twice = 0;
  c.for_each("mu_i", [&](const Cell&, double mu) { twice += 2 * mu; });
  m.young = twice * (1 + nu);
  m.bulk = twice * (1.0 / 3.0 + nu / (1 - 2 * nu));
  // Viscous terms change the shear modulus in E.
  if (c.integer("M") > 0) m.stiffness_known = false;
}

/// Reinforced concrete: density includes the steel of its most reinforced direction.
void concrete(const BlockCells& c, Material& m) {
  isotropic(c, m);
  m.density += c.largest({"OMEGA_X_INF", "OMEGA_Y_INF", "OMEGA_X_SUP", "OMEGA_Y_SUP"}) *
               (c.real("RHOS") - m.density);
}

/// From the elastic clause of LAW131.
void elastic_clause(const BlockCells& c, Material& m) {
  if (c.has("C11")) {
    const double normal = c.real("C11") + c.real("C22") + c.real("C33");
    const double across = c.real("C12") + c.real("C13") + c.real("C23");
    const double shear = c.real("C44") + c.real("C55") + c.real("C66");
    const double g = (normal - across + 3 * shear) / 15;
    m.bulk = (normal + 2 * across) / 9;
    m.young = 9 * m.bulk * g / (3 * m.bulk + g);
  } else if (c.has("E1")) {
    m.young = c.largest({"E1", "E2", "E3"});
    m.bulk =
        1 / ((1 - 2 * c.real("NU12")) / c.real("E1") + (1 - 2 * c.real("NU23")) / c.real("E2") +
             (1 - 2 * c.real("NU31")) / c.real("E3"));
  } else {
    m.young = c.largest({"E", "ET", "EC"});
    m.bulk = isotropic_bulk(m.young, c.real("Nu"));
  }
  m.stiffness_known = c.has("C11") || c.has("E1") || c.has("Nu");
}

/// No stiffness cell is read. Unknown is not zero: segments take part in the search.
void no_moduli(const BlockCells&, Material& m) { m.young = m.bulk = 1; }

struct Law {
  Moduli* moduli;
  bool known;  ///< false: the result is a guess and must not be reported
  std::vector<int> numbers;
};

const Law& law_of(int number) {
  static const Law laws[] = {
      {isotropic, true, {0,  1,  2,  13, 22, 23, 24, 27, 32, 36, 43, 44, 48, 52,
                         57, 60, 63, 64, 65, 66, 71, 73, 74, 76, 78, 84, 87}},
      // Hydrodynamic laws without an equation of state.
      {isotropic, true, {3, 4}},
      // C1 of the card or slopes of curves would change B or E; they are not read.
      {isotropic, false, {10, 70, 90}},
      {direct_strain, false, {15, 25}},
      {direct_strain, true, {19}},
      {given_bulk, true, {21}},
      {modulus_twice, true, {35, 38, 54}},
      {third, true, {59, 83, 101, 117}},
      {foam, true, {33}},
      {boltzmann, true, {34}},
      {ogden, true, {42}},
      {hyperfoam, true, {62}},
      {largest, true, {53}},
      {concrete, true, {136}},
      {elastic_clause, true, {131}},
      {no_moduli, true, {135}},
      {largest_bulk, true, {28}},
      {largest_bulk, false, {50}},
      {largest, true, {68, 93, 107, 112, 122}},
      {largest, false, {12, 14, 58, 116}},
      {no_moduli, false, {5, 6, 11, 18, 20, 37, 46, 51, 69, 82, 88, 92, 94, 95, 97, 100, 151}},
  };
  static const Law other{isotropic, false, {}};
  for (const Law& law : laws)
    if (std::find(law.numbers.begin(), law.numbers.end(), number) != law.numbers.end()) return law;
  return other;
}

/// LAWn of a keyword; -1: gases, user laws, unknown names.
int law_number(const Schema& schema) {
  // Names with other cards than the numbered law.
  if (schema.keyword == "/MAT/PLAS_ZERIL") return 2;
  if (schema.keyword == "/MAT/K-EPS") return 6;
  if (schema.keyword == "/MAT/B-K-EPS") return 11;
  constexpr std::string_view prefix = "/MAT/LAW";
  const std::string_view keyword = schema.keyword;
  return keyword.starts_with(prefix) ? number_of_digits(keyword.substr(prefix.size())) : -1;
}

/// Calls f(material, block) for blocks of a keyword that extend a material.
template <class F>
void for_each_addition(BuildContext& c, std::string_view keyword, const char* fix, F&& f) {
  for (const Block& block : c.deck.blocks) {
    if (!header_starts(block, keyword)) continue;
    const std::int64_t id = c.own_id(block, "mat");
    const auto it = c.model.material_of_id.find(id);
    if (it != c.model.material_of_id.end()) {
      f(c.model.materials[it->second], block);
      continue;
    }
    report(c.findings, {RuleId::DK118,
                        block.header_span,
                        std::string(block.keyword) + " belongs to material " + std::to_string(id) +
                            ", which does not exist",
                        std::string(block.keyword),
                        id,
                        {.fix = fix}});
  }
}

/// /EOS replaces the bulk modulus of its material.
void apply_equations_of_state(BuildContext& c) {
  for_each_addition(c, "/EOS", "give the equation of state the id of its material",
                    [&](Material& m, const Block& block) {
                      const DecodedBlock d = decode(c.deck, block);
                      const Cell* bulk = d.find("C1");
                      if (bulk == nullptr) bulk = d.find("Bulk");
                      m.stiffness_known = bulk != nullptr;
                      // Energy term; only TILLOTSON has cell b.
                      if (bulk != nullptr)
                        m.bulk =
                            working_value(c.deck, d, *bulk) + c.value(d, "b") * c.value(d, "E0");
                    });
}

void apply_heat(BuildContext& c) {
  for_each_addition(c, "/HEAT/MAT", "give the heat data the id of their material",
                    [&](Material& m, const Block&) {
                      m.thermal = true;
                      c.model.has_thermal_material = true;
                    });
}

// ---- properties ---------------------------------------------------------------------------------

/// TYPEn from the keyword or its aliases.
int type_number(const Schema& schema) {
  constexpr std::string_view prefix = "/PROP/TYPE";
  if (schema.keyword == "/PROP/FLUID") return 14;  // its cards differ from TYPE14
  if (schema.keyword.starts_with(prefix))
    return number_of_digits(std::string_view(schema.keyword).substr(prefix.size()));
  for (const std::string& alias : schema.aliases)
    if (alias.starts_with(prefix))
      return number_of_digits(std::string_view(alias).substr(prefix.size()));
  return -1;
}

/// Spring stiffness K / A of a direction; A 0 means 1.
double spring_stiffness(const BuildContext& c, const DecodedBlock& d,
                        const std::string& direction) {
  const double a = c.value(d, "A" + direction);
  return c.value(d, "K" + direction) / (a == 0 ? 1 : a);
}

/// Sum of the areas of the integration points of an integrated beam.
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
  // A stack without a thickness has that of its plies, which are not read.
  p.known = !d.block->opaque && !d.block->schema->cards.empty() && p.number != 23 &&
            p.number != 32 && p.number != 45 && (p.number != 17 || p.thickness != 0);
  // Type 25: tension, then shear.
  const int directions = p.number == 8 || p.number == 13 ? 3 : p.number == 25 ? 2 : 0;
  if (directions == 0) p.stiffness[0] = spring_stiffness(c, d, "");
  for (int i = 0; i < directions; ++i)
    p.stiffness[static_cast<std::size_t>(i)] = spring_stiffness(c, d, std::to_string(i + 1));
}

}  // namespace

double ogden_sum(const BlockCells& c) {
  double sum = 0;
  for (int i = 1; i <= 10; ++i)
    sum += c.real("mu_" + std::to_string(i)) * c.real("alpha_" + std::to_string(i));
  return sum;
}

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
    add_object(c, m.properties, m.property_of_id, block, std::move(p));
  }
}

void read_materials(BuildContext& c) {
  Model& m = c.model;
  for (const Block* const at : in_solver_order(c.deck, "/MAT")) {
    const Block& block = *at;
    if (block.schema == nullptr) continue;
    const DecodedBlock d = decode(c.deck, block);
    Material material;
    material.id = c.own_id(block, "mat");
    material.title = d.title;
    material.type = block.schema->keyword;
    material.law = law_number(*block.schema);
    material.density = c.value(d, "Rho_I");
    material.span = block.header_span;
    material.block = &block;
    material.stiffness_known = false;
    if (!block.opaque) {
      const Law& law = law_of(material.law);
      material.stiffness_known = law.known;
      law.moduli(BlockCells(c.deck, block), material);
      if (!std::isfinite(material.young) || !std::isfinite(material.bulk))
        material.stiffness_known = false;
    }
    add_object(c, m.materials, m.material_of_id, block, std::move(material));
  }
  apply_equations_of_state(c);
  apply_heat(c);
}

}  // namespace deck::detail
