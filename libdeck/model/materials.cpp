// Materials: density and the two moduli that enter contact stiffness, E for shells and lines, B for
// solids. Which cells they come from depends on the law; the table below is per law on purpose.
#include <algorithm>
#include <cmath>
#include <vector>

#include "keyword/shared/solver_order.hpp"
#include "model/model_build.hpp"

namespace deck::detail {
namespace {

/// How a law's E and B follow from its cells.
enum class Rule {
  isotropic,      ///< E, B = E / (3 (1 - 2 nu))
  modulus_twice,  ///< E, B = E
  third,          ///< E, B = E / 3
  given_bulk,     ///< E, B = K of the card
  direct_strain,  ///< E = max(E11, E22) / (1 - nu12 nu21) = B
  largest,        ///< largest directional modulus, both
  largest_bulk,   ///< honeycomb: no E, B = largest modulus
  foam,           ///< no E, B = E
  boltzmann,      ///< from B and the instantaneous shear modulus
  ogden,          ///< sum of mu alpha
  hyperfoam,      ///< sum of mu
  connection,     ///< max(E, G), B a third
  none,           ///< no stiffness cell is read
};

struct Law {
  Rule rule = Rule::none;
  bool known = false;  ///< false: what comes out is a guess and must not be reported as a value
};

Law law_of(int number) {
  struct Group {
    Law law;
    std::vector<int> numbers;
  };
  static const Group groups[] = {
      {{Rule::isotropic, true}, {0,  1,  2,  13, 22, 23, 24, 27, 32, 36, 43, 44, 48, 52,
                                 57, 60, 63, 64, 65, 66, 71, 73, 74, 76, 78, 84, 87}},
      // Hydrodynamic laws without an equation of state.
      {{Rule::isotropic, true}, {3, 4}},
      // C1 of the card, or curve slopes, would change B or E and are not read.
      {{Rule::isotropic, false}, {10, 70, 90}},
      {{Rule::direct_strain, false}, {15, 25}},
      {{Rule::direct_strain, true}, {19}},
      {{Rule::given_bulk, true}, {21}},
      {{Rule::modulus_twice, true}, {35, 38, 54}},
      {{Rule::third, true}, {83, 101}},
      {{Rule::foam, true}, {33}},
      {{Rule::boltzmann, true}, {34}},
      {{Rule::ogden, true}, {42}},
      {{Rule::hyperfoam, true}, {62}},
      {{Rule::largest, true}, {53}},
      {{Rule::connection, true}, {59}},
      {{Rule::largest_bulk, false}, {28, 50}},
      {{Rule::largest, false}, {12, 14, 58, 68, 93, 107, 112, 116, 117, 122}},
      {{Rule::none, false}, {5, 6, 11, 18, 20, 37, 46, 51, 69, 82, 88, 92, 94, 95, 97, 100, 151}},
  };
  for (const Group& g : groups)
    if (std::find(g.numbers.begin(), g.numbers.end(), number) != g.numbers.end()) return g.law;
  return {Rule::isotropic, false};
}

double isotropic_bulk(double e, double nu) { return e / (3 * (1 - 2 * nu)); }

/// LAWn of a schema keyword; gases, user laws and unknown names give -1.
int law_number(const Schema& schema) {
  // Names whose cards are not those of the number.
  if (schema.keyword == "/MAT/PLAS_ZERIL") return 2;
  if (schema.keyword == "/MAT/K-EPS") return 6;
  if (schema.keyword == "/MAT/B-K-EPS") return 11;
  constexpr std::string_view prefix = "/MAT/LAW";
  const std::string_view keyword = schema.keyword;
  if (!keyword.starts_with(prefix)) return -1;
  int value = 0;
  for (const char ch : keyword.substr(prefix.size())) {
    if (ch < '0' || ch > '9') return -1;
    value = value * 10 + (ch - '0');
  }
  return value;
}

class MaterialReader {
 public:
  MaterialReader(const BuildContext& c, const DecodedBlock& d) : c_(c), d_(d) {}

  void moduli(Material& m) const {
    const Law law = law_of(m.law);
    m.stiffness_known = law.known;
    switch (law.rule) {
      case Rule::isotropic:
        isotropic(m);
        break;
      case Rule::modulus_twice:
        m.young = m.bulk = value("E");
        break;
      case Rule::third:
        m.young = value("E");
        m.bulk = m.young / 3;
        break;
      case Rule::given_bulk:
        m.young = value("E");
        m.bulk = value("K");
        break;
      case Rule::direct_strain:
        direct_strain(m);
        break;
      case Rule::largest:
        m.young = m.bulk = largest();
        break;
      case Rule::largest_bulk:
        m.bulk = largest();
        break;
      case Rule::foam:
        m.bulk = value("E");
        break;
      case Rule::boltzmann:
        boltzmann(m);
        break;
      case Rule::ogden:
        ogden(m);
        break;
      case Rule::hyperfoam:
        hyperfoam(m);
        break;
      case Rule::connection:
        m.young = std::max(value("E"), value("G"));
        m.bulk = m.young / 3;
        break;
      case Rule::none:
        break;
    }
    if (!std::isfinite(m.young) || !std::isfinite(m.bulk)) m.stiffness_known = false;
  }

 private:
  double value(const char* field) const { return c_.value(d_, field); }

  void isotropic(Material& m) const {
    double nu = value("Nu");
    if (m.law == 1 && nu == 0.5) nu = 0.499;
    m.young = value("E");
    m.bulk = isotropic_bulk(m.young, nu);
    // A cell that the schema does not have leaves nothing to compute from.
    if (d_.find("E") == nullptr && m.law != 0) m.stiffness_known = false;
  }

  void direct_strain(Material& m) const {
    const double e11 = value("E11");
    const double e22 = value("E22");
    const double nu12 = value("Nu12");
    const double nu21 = e11 != 0 ? nu12 * e22 / e11 : 0;
    m.young = m.bulk = std::max(e11, e22) / (1 - nu12 * nu21);
    if (d_.find("Nu12") != nullptr) m.stiffness_known = true;
  }

  double largest() const {
    double most = 0;
    for (const char* field : {"E", "E1", "E2", "E3", "E11", "E22", "E33", "G12", "G23", "G31"})
      most = std::max(most, value(field));
    return most;
  }

  void boltzmann(Material& m) const {
    m.bulk = value("K");
    const double g = value("G0");
    m.young = g > 0 ? 9 * m.bulk * g / (3 * m.bulk + g) : 0;
    if (d_.find("G0") == nullptr) m.stiffness_known = false;
  }

  /// Sum over the terms i = 1..5 of f(mu_i, alpha_i).
  template <class F>
  double sum_terms(F f) const {
    double sum = 0;
    for (char i = '1'; i <= '5'; ++i) {
      const std::string mu = std::string("mu_") + i;
      const std::string alpha = std::string("alpha_") + i;
      sum += f(value(mu.c_str()), value(alpha.c_str()));
    }
    return sum;
  }

  void ogden(Material& m) const {
    const double nu = value("Nu");
    const double twice_shear = sum_terms([](double mu, double alpha) { return mu * alpha; });
    m.young = twice_shear * (1 + nu);
    // With viscous terms the reference solver stores the true bulk modulus.
    m.bulk = d_.integer("M") > 0 ? m.young / (3 * (1 - 2 * nu)) : twice_shear;
    // A blank Poisson ratio has a default that is not established.
    if (nu == 0) m.stiffness_known = false;
  }

  void hyperfoam(Material& m) const {
    double nu = value("Nu");
    if (nu >= 0.5) nu = 0.499;
    double twice = 0;
    for (const DecodedCard& card : d_.cards)
      for (const Cell& cell : card.cells)
        if (cell.field->name == "mu_i") twice += 2 * working_value(c_.deck, d_, cell);
    m.young = twice * (1 + nu);
    m.bulk = twice * (1.0 / 3.0 + nu / (1 - 2 * nu));
    // Viscous terms change the shear modulus that E is formed with.
    if (d_.integer("M") > 0) m.stiffness_known = false;
  }

  const BuildContext& c_;
  const DecodedBlock& d_;
};

/// /EOS replaces the bulk modulus of its material.
void apply_equations_of_state(BuildContext& c) {
  for (const Block& block : c.deck.blocks) {
    if (!header_starts(block, "/EOS")) continue;
    const std::int64_t id = c.own_id(block, "mat");
    const auto it = c.model.material_of_id.find(id);
    if (it == c.model.material_of_id.end()) {
      report(c.diagnostics, {RuleId::DK118,
                             block.header_span,
                             std::string(block.keyword) + " belongs to material " +
                                 std::to_string(id) + ", which does not exist",
                             std::string(block.keyword),
                             id,
                             {.fix = "give the equation of state the id of its material"}});
      continue;
    }
    Material& m = c.model.materials[it->second];
    const DecodedBlock d = decode(c.deck, block);
    const Cell* bulk = d.find("C1");
    if (bulk == nullptr) bulk = d.find("Bulk");
    m.stiffness_known = bulk != nullptr;
    if (bulk != nullptr) m.bulk = working_value(c.deck, d, *bulk);
  }
}

void apply_heat(BuildContext& c) {
  for (const Block& block : c.deck.blocks) {
    if (!header_starts(block, "/HEAT/MAT")) continue;
    const std::int64_t id = c.own_id(block, "mat");
    const auto it = c.model.material_of_id.find(id);
    if (it == c.model.material_of_id.end()) {
      report(c.diagnostics,
             {RuleId::DK118,
              block.header_span,
              "/HEAT/MAT belongs to material " + std::to_string(id) + ", which does not exist",
              "/HEAT/MAT",
              id,
              {.fix = "give the heat data the id of their material"}});
      continue;
    }
    c.model.materials[it->second].thermal = true;
    c.model.has_thermal_material = true;
  }
}

}  // namespace

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
    if (block.opaque)
      material.stiffness_known = false;
    else
      MaterialReader(c, d).moduli(material);
    const auto index = static_cast<std::uint32_t>(m.materials.size());
    const auto known = m.material_of_id.find(material.id);
    register_id(c, m.material_of_id, material.id, index, block,
                known == m.material_of_id.end() ? Span{} : m.materials[known->second].span);
    m.materials.push_back(std::move(material));
  }
  apply_equations_of_state(c);
  apply_heat(c);
}

}  // namespace deck::detail
