// Data of materials and properties for time steps: sound speeds per law, formulations, damping,
// spring stiffness.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>

#include "deck/keyword.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "model/mesh/mesh_parts.hpp"
#include "model/model_build.hpp"

namespace deck::detail {
namespace {

/// Steepest positive slope of a curve; 0: none.
double steepest(const Model& model, std::int64_t id) {
  const auto it = model.curves.find(id);
  if (it == model.curves.end()) return 0;
  const Curve& f = it->second;
  double most = 0;
  for (std::size_t i = 1; i < f.x.size(); ++i)
    if (f.x[i] > f.x[i - 1]) most = std::max(most, (f.y[i] - f.y[i - 1]) / (f.x[i] - f.x[i - 1]));
  return most;
}

/// Largest entry of the stiffness matrix of an orthotropic solid.
double orthotropic_largest(const BlockCells& c) {
  const auto ratio = [&](const char* low, const char* high) {
    return c.has(low) ? c.real(low) : c.real(high);
  };
  const double e1 = c.real("E11"), e2 = c.real("E22"), e3 = c.real("E33");
  const double n12 = ratio("nu12", "NU12"), n23 = ratio("nu23", "NU23"),
               n31 = ratio("nu31", "NU31");
  const double n21 = n12 * e2 / e1, n32 = n23 * e3 / e2, n13 = n31 * e1 / e3;
  const double det = 1 - n12 * n21 - n23 * n32 - n31 * n13 - n12 * n23 * n31 - n21 * n32 * n13;
  return std::max({e1 * (1 - n23 * n32) / det, e2 * (1 - n31 * n13) / det,
                   e3 * (1 - n12 * n21) / det, c.real("G12"), c.real("G23"), c.real("G31")});
}

/// The equation of state of a material; nullptr: none.
const Block* state_equation(const Model& model, std::int64_t id) {
  for (const Block& b : model.deck->blocks)
    if (b.header.starts_with("/EOS/") && b.id.value + model.deck->offset_of(b, "mat") == id)
      return &b;
  return nullptr;
}

class MaterialFiller {
 public:
  MaterialFiller(const Model& model, const Material& from, MaterialFigures& to)
      : model_(model), from_(from), m_(to), c_(*model.deck, *from.block) {}

  void fill() {
    m_.law = from_.law;
    m_.density = from_.density;
    // For mixtures it depends on the shares of others.
    if (one_of(m_.law, {37, 51, 151}) || !detail::has_field(*from_.block, "Rho_I"))
      m_.density = not_known;
    m_.reference_density = std::max(c_.real_or("Rho_0", m_.density), 1e-20);
    m_.young = c_.real("E");
    m_.poisson = c_.real("Nu");
    if ((m_.law == 1 || m_.law == 62) && m_.poisson >= 0.5) m_.poisson = 0.499;
    special_moduli();
    m_.shear = shear_ != 0 ? shear_ : m_.young / (2 * (1 + m_.poisson));
    m_.stored_speed = std::sqrt(m_.young / m_.reference_density);
    shells();
    solids();
  }

 private:
  void special_moduli() {
    if (m_.law == 34) {
      const double b = c_.real("K"), g = c_.real("G0");
      m_.young = 9 * b * g / (3 * b + g);
      m_.poisson = (3 * b - 2 * g) / (6 * b + 2 * g);
      shear_ = g;
    } else if (one_of(m_.law, {42, 69})) {
      shear_ = 0.5 * ogden_sum(c_);
      m_.young = 2 * shear_ * (1 + m_.poisson);
    } else if (one_of(m_.law, {62, 131})) {
      m_.young = from_.young;
    } else if (m_.law == 58) {
      m_.young = c_.largest({"E1", "E2"});
    } else if (m_.law == 70) {
      m_.young = std::max({m_.young, steepest_of("funcID_id", "Fscale_load"),
                           steepest_of("funcID_id_2", "Fscale_unload")});
    }
  }

  /// Steepest slope of the functions in cells `id`, times their scales.
  double steepest_of(std::string_view id, std::string_view scale) const {
    std::vector<double> factors;
    c_.for_each(scale, [&](const Cell&, double v) { factors.push_back(v != 0 ? v : 1); });
    double slope = 0;
    std::size_t i = 0;
    c_.for_each(id, [&](const Cell& cell, double) {
      const double f = i < factors.size() ? factors[i] : 1.0;
      const std::int64_t curve = cell.integer + model_.deck->offset_of(*from_.block, "funct");
      slope = std::max(slope, f * steepest(model_, curve));
      ++i;
    });
    return slope;
  }

  /// max(E11, E22) / (1 - nu12 nu21)
  double plane_modulus() const {
    const double e1 = c_.real("E11"), e2 = c_.real("E22");
    const double n12 = c_.has("Nu12") ? c_.real("Nu12") : c_.real("NU12");
    return std::max(e1, e2) / (1 - n12 * n12 * e2 / e1);
  }

  void shells() {
    const double rho = m_.reference_density, e = m_.young, nu = m_.poisson;
    const double plate = e / (1 - nu * nu);
    m_.shell_speed = std::sqrt(plate / rho);
    m_.plate_modulus = plate;
    if (m_.law == 15 && !c_.has("Nu12") && !c_.has("NU12")) {
      m_.shell_speed = m_.plate_modulus = m_.stored_speed = not_known;
    } else if (one_of(m_.law, {15, 19, 25})) {
      m_.plate_modulus = plane_modulus();
      m_.shell_speed = m_.stored_speed = std::sqrt(m_.plate_modulus / rho);
      m_.shear = c_.real("G12");
    } else if (one_of(m_.law, {42, 69})) {
      m_.shell_speed = std::sqrt(m_.shear * (1 + nu) / (1 - nu * nu) / rho);
    } else if (one_of(m_.law, {34, 38, 62})) {
      m_.plate_modulus = e;
    } else if (m_.law <= 28 || m_.law == 65) {
      m_.shell_speed = m_.stored_speed;
    }
    if (e == 0 && !one_of(m_.law, {0, 13, 15, 19, 25}))
      m_.shell_speed = m_.plate_modulus = not_known;
  }

  double bulk_of_card() const {
    double c1 = 0;
    for (const char* name : {"C1", "C_1"})
      if (c_.real(name) != 0) c1 = c_.real(name);
    if (c1 != 0) return std::abs(c1);
    return bulk_of_state();
  }

  /// Bulk modulus of an equation of state without initial energy; otherwise unknown.
  double bulk_of_state() const {
    const Block* block = state_equation(model_, from_.id);
    if (block == nullptr || block->schema == nullptr) return not_known;
    const BlockCells c(*model_.deck, *block);
    if (block->schema->keyword == "/EOS/POLYNOMIAL" && c.real("C1") != 0 &&
        (c.real("E0") == 0 || (c.real("C4") == 0 && c.real("C5") == 0)))
      return std::abs(c.real("C1"));
    return not_known;
  }

  void solids() {
    const double e = m_.young, nu = m_.poisson, rho = m_.reference_density;
    double b = e / (3 * (1 - 2 * nu)), g = m_.shear, f = 4.0 / 3.0;
    double c = not_known;
    if (one_of(m_.law, {3, 4, 21, 23})) f = 1.333;
    if (one_of(m_.law, {6, 28, 33, 50, 68})) g = 0;
    // The stored shear modulus of these laws is twice the ground modulus.
    if (one_of(m_.law, {42, 62, 69})) g = 2 * m_.shear;
    if (one_of(m_.law, {3, 4, 6})) {
      b = bulk_of_card();
    } else if (m_.law == 21) {
      b = c_.largest({"K", "B"});
    } else if (one_of(m_.law, {28, 50, 68})) {
      b = c_.largest({"E11", "E22", "E33", "G12", "G23", "G31", "G_12", "G_23", "G_31"});
    } else if (one_of(m_.law, {33, 35})) {
      b = e;
    } else if (m_.law == 34) {
      b = e * g / (9 * g - 3 * e);
    } else if (one_of(m_.law, {42, 62, 69})) {
      b = g * (1 + nu) / (3 * (1 - 2 * nu));
    } else if (one_of(m_.law, {12, 14})) {
      c = std::sqrt(orthotropic_largest(c_) / rho);
    } else if (one_of(m_.law, {15, 25})) {
      c = m_.stored_speed;
      if (std::isnan(c)) b = not_known;
    } else if (m_.law == 11) {
      m_.fixed_step = 1000;
    } else if (one_of(m_.law, {59, 83, 116, 117})) {
      m_.fixed_step = 1e20;
    } else if (m_.law == 51) {
      if (c_.integer("Iform") == 6) m_.fixed_step = 1e20;
      b = not_known;
    } else if (m_.law != 23 &&
               // Laws with cells that are not read, or with unknown rules.
               (e == 0 ||
                one_of(m_.law, {5, 10, 16, 17, 18, 20, 24, 37, 46, 88, 97, 102, 105, 120}))) {
      b = not_known;
    }
    if (!one_of(m_.law, {3, 4, 6}) && state_equation(model_, from_.id) != nullptr)
      b = bulk_of_state();
    m_.solid_speed = std::isnan(c) ? std::sqrt((b + f * g) / rho) : c;
    m_.tetra_ratio = 2 * m_.shear / (b + 4.0 / 3.0 * m_.shear);
  }

  const Model& model_;
  const Material& from_;
  MaterialFigures& m_;
  BlockCells c_;
  double shear_ = 0;
};

/// /DEF_SHELL and /DEF_SOLID: values for blank formulations.
struct Formulations {
  int ishell = 0, ish3n = 2, isolid = 0, itetra10 = 0;
};
Formulations default_formulations(const Deck& deck) {
  Formulations out;
  for (const Block& b : deck.blocks) {
    if (b.schema == nullptr) continue;
    if (b.schema->keyword == "/DEF_SHELL") {
      const BlockCells c(deck, b);
      out.ishell = c.integer("Ishell");
      if (const int i = c.integer("Ish3n"); i != 0) out.ish3n = i;
    } else if (b.schema->keyword == "/DEF_SOLID") {
      const BlockCells c(deck, b);
      out.isolid = c.integer("Isolid");
      out.itetra10 = c.integer("Itetra10");
    }
  }
  return out;
}

class PropertyFiller {
 public:
  PropertyFiller(const Model& model, const Formulations& blank, const Property& from,
                 PropertyFigures& to)
      : model_(model), blank_(blank), from_(from), p_(to), c_(*model.deck, *from.block) {}

  void fill() {
    p_.type = from_.number;
    p_.thickness = from_.thickness;
    p_.area = from_.area;
    if (p_.type == 3 || p_.type == 18) {
      p_.iyy = c_.real("Iyy");
      p_.izz = c_.real("Izz");
      p_.ixx = c_.real("Ixx");
      p_.beam_membrane = c_.real("dm");
      p_.beam_bending = c_.real_or("df", 0.01);
    } else if (p_.type == 6 || p_.type == 14 || (p_.type >= 20 && p_.type <= 22)) {
      solid();
    } else if (p_.type == 4 || p_.type == 8 || p_.type == 12 || p_.type == 13 || p_.type == 25) {
      spring();
    } else {
      shell();
    }
  }

 private:
  void shell() {
    p_.ishell = c_.integer("Ishell") != 0 ? c_.integer("Ishell") : blank_.ishell;
    if (p_.ishell == 22 || p_.ishell == 23) p_.ishell = 24;
    p_.ish3n = c_.integer("Ish3n") != 0 ? c_.integer("Ish3n") : blank_.ish3n;
    p_.membrane = c_.has("dm") ? c_.real("dm") : c_.real("Dm");
    p_.numeric = c_.has("dn") ? c_.real("dn") : c_.real("Dn");
    for (const char* name : {"mat_ID", "mat_IDi"})
      c_.for_each(name, [&](const Cell& cell, double) {
        const auto it =
            model_.material_of_id.find(cell.integer + model_.deck->offset_of(*from_.block, "mat"));
        if (cell.integer > 0 && it != model_.material_of_id.end()) p_.layers.push_back(it->second);
      });
  }

  void solid() {
    p_.isolid = c_.integer("Isolid") != 0 ? c_.integer("Isolid") : blank_.isolid;
    p_.itetra10 = c_.integer("Itetra10") != 0 ? c_.integer("Itetra10") : blank_.itetra10;
    p_.inpts = c_.integer("Inpts");
    p_.icstr = c_.integer("Icstr");
    p_.qb = c_.real_or("qb", 0.05);
    p_.viscosity_blank = c_.real("qa") == 0 && c_.real("qb") == 0;
    p_.lambda = c_.real("Lambda_V");
    p_.mu = c_.real("Mu_V");
  }

  /// Stiffness and damping of direction `n`; "" for the only one.
  SpringFreedom freedom(const std::string& n) const {
    SpringFreedom f;
    f.k = c_.real("K" + n);
    f.c = p_.type == 12 ? c_.real("C1") : c_.real("C" + n);
    const std::string one = n.empty() ? "1" : n;
    const std::string scale = (p_.type == 4 || p_.type == 12 ? "AScale" : "Ascale") + one;
    if (const std::int64_t id = c_.id("fct_ID1" + one, "funct"); id != 0) {
      f.k = std::max(f.k, steepest(model_, id) * c_.real_or(scale, 1.0));
      f.known = model_.curves.contains(id);
    }
    for (const char* speed : {"fct_ID2", "fct_ID4"})
      if (c_.integer(speed + one) != 0) f.known = false;
    f.k *= c_.real_or("A" + n, 1.0);
    return f;
  }

  void spring() {
    p_.spring_mass = c_.real("Mass");
    p_.spring_inertia = c_.real("Inertia");
    p_.per_length = c_.integer("Ileng") == 1;
    if (p_.type == 4 || p_.type == 12) {
      p_.freedom[0] = freedom("");
      return;
    }
    const int count = p_.type == 25 ? 4 : 6;
    for (int i = 0; i < count; ++i)
      p_.freedom[static_cast<std::size_t>(i)] = freedom(std::to_string(i + 1));
  }

  const Model& model_;
  const Formulations& blank_;
  const Property& from_;
  PropertyFigures& p_;
  BlockCells c_;
};

/// True if the file named by /REFSTA exists; without it there is no reference geometry.
bool reads(const Deck& deck, const Block& block) {
  LineCursor lines(deck.sources, block);
  const Line line = lines.next();
  if (!line.valid()) return false;
  const std::string_view name = trim(line.text);
  std::error_code failed;
  const std::filesystem::path beside =
      std::filesystem::path(deck.sources[0].path()).parent_path() / std::string(name);
  return !name.empty() && std::filesystem::exists(beside, failed);
}

/// Reason why steps of a part's elements are unknown; nullptr: known.
const char* part_reason(const Model& model, const Part& part, const PartRow& row, bool reference,
                        bool rigid_law) {
  if (part.prop == no_index) return "the part has no property";
  const int type = row.property.type;
  const bool spring = one_of(type, {4, 8, 12, 13, 25, 26, 27, 32, 33, 34, 35, 36, 44, 45, 46});
  if (part.mat == no_index) return spring ? nullptr : "the part has no material";
  const int law = row.material.law;
  // Elements of law 13 have no step, as those of law 0. In the one known listing those of other
  // parts had none either, for unknown reasons.
  if (rigid_law && law != 13) return "a material of law 13 is in the deck";
  if (model.materials[part.mat].block->opaque) return "the material is encrypted";
  if (reference && one_of(law, {19, 35, 38, 42, 58, 70})) return "a reference geometry enters";
  return nullptr;
}

}  // namespace

std::vector<MaterialFigures> material_figures(const Model& model) {
  std::vector<MaterialFigures> out(model.materials.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (model.materials[i].block == nullptr || model.materials[i].block->opaque) continue;
    MaterialFiller(model, model.materials[i], out[i]).fill();
  }
  return out;
}

std::vector<PropertyFigures> property_figures(const Model& model) {
  const Formulations blank = default_formulations(*model.deck);
  std::vector<PropertyFigures> out(model.properties.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (model.properties[i].block == nullptr || model.properties[i].block->opaque) continue;
    PropertyFiller(model, blank, model.properties[i], out[i]).fill();
  }
  return out;
}

std::vector<PartRow> part_rows(const Model& model) {
  const std::vector<MaterialFigures> materials = material_figures(model);
  const std::vector<PropertyFigures> properties = property_figures(model);
  bool whole_reference = false, rigid_law = false;
  std::set<std::int64_t> reference;
  for (const Block& b : model.deck->blocks) {
    if (b.header.starts_with("/EREF")) whole_reference = true;
    if (b.header.starts_with("/REFSTA")) whole_reference = whole_reference || reads(*model.deck, b);
    if (b.header.starts_with("/XREF/"))
      reference.insert(b.id.value + model.deck->offset_of(b, "part"));
  }
  for (const Part& part : model.parts)
    rigid_law = rigid_law || (part.mat != no_index && materials[part.mat].law == 13);
  std::vector<PartRow> out(model.parts.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Part& part = model.parts[i];
    PartRow& row = out[i];
    if (part.mat != no_index) row.material = materials[part.mat];
    if (part.prop != no_index) row.property = properties[part.prop];
    for (const std::uint32_t layer : row.property.layers)
      row.material.shell_speed = std::max(row.material.shell_speed, materials[layer].shell_speed);
    row.thickness = row.property.thickness;  // the thickness of the part is for contacts only
    row.rigid = row.material.law == 0 || row.material.law == 13 || row.property.type == 0;
    row.why =
        part_reason(model, part, row, whole_reference || reference.contains(part.id), rigid_law);
  }
  return out;
}

}  // namespace deck::detail
