// Plausibility of the model: units of materials, folded solids, duplicate elements, nodes with
// stiffness or contact and without mass.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/shared/words.hpp"
#include "deck/point3.hpp"
#include "deck/text.hpp"
#include "lint/check.hpp"
#include "model/shared/faces.hpp"
#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"

namespace deck::detail {
namespace {

/// True if the node follows another entity, whatever its mass.
bool follows(const LintContext& c, NodeIndex n) {
  constexpr ConditionType carriers[] = {
      ConditionType::rbody, ConditionType::rbe2,   ConditionType::rbe3,    ConditionType::rlink,
      ConditionType::tied,  ConditionType::lagmul, ConditionType::imposed, ConditionType::bcs};
  const unsigned types = c.loaded->kinematics().types[n];
  return std::any_of(std::begin(carriers), std::end(carriers), [&](ConditionType t) {
    return (types & 1u << static_cast<unsigned>(t)) != 0;
  });
}

struct KnownMaterial {
  const char* name;
  double least_density, most_density;  ///< kg/m3
  double least_young, most_young;      ///< Pa
};
constexpr KnownMaterial known_materials[] = {
    {"steel", 7700, 8050, 1.95e11, 2.15e11},
    {"aluminium", 2600, 2850, 6.7e10, 7.6e10},
    {"titanium", 4400, 4560, 1.05e11, 1.2e11},
    {"magnesium", 1730, 1850, 4.3e10, 4.6e10},
};

/// n so that value / 1000^n is between the limits: wrong units change values by powers of 1000.
std::optional<int> thousands(double value, double least, double most) {
  const int n = static_cast<int>(std::lround(std::log10(value / std::sqrt(least * most)) / 3.0));
  const double v = value / std::pow(1000.0, n);
  if (v < least || v > most) return std::nullopt;
  return n;
}

std::string off_by(int n) {
  return n == 0 ? "right"
                : fmt::format("1e{} times {}", 3 * std::abs(n), n > 0 ? "too large" : "too small");
}

void check_units(const LintContext& c, const Rule& rule, Reporter& r) {
  const UnitSystem& working = c.deck.begin.working;
  if (!c.deck.begin.has_working) return;
  // A numeric code does not tell the unit.
  for (const std::string* code : {&working.mass_code, &working.length_code, &working.time_code})
    if (code->empty() || read_real(*code).status == NumberStatus::ok) return;
  UnitSystem si;
  si.mass = unit_factor("kg", 'g').value_or(1.0);
  si.length = unit_factor("m", 'm').value_or(1.0);
  si.time = unit_factor("s", 's').value_or(1.0);
  const double to_density = conversion_factor(working, si, {1, -3, 0, 0});
  const double to_modulus = conversion_factor(working, si, {1, -1, -2, 0});
  std::string weight;
  for (const Material& m : c.model->materials) {
    if (m.block == nullptr || m.block->opaque || !(m.density > 0.0) || !(m.young > 0.0)) continue;
    const double density = m.density * to_density, young = m.young * to_modulus;
    for (const KnownMaterial& known : known_materials) {
      const auto d = thousands(density, known.least_density, known.most_density);
      const auto e = thousands(young, known.least_young, known.most_young);
      if (!d || !e || (*d == 0 && *e == 0)) continue;
      const DecodedBlock card = decode(c.deck, *m.block);
      const Cell* cell = card.find(*d != 0 ? "Rho_I" : "E");
      if (weight.empty()) {
        const double mass = c.loaded->mesh().total.mass;
        weight = std::isnan(mass)
                     ? " "
                     : fmt::format("; the whole model weighs {:.4g} kg",
                                   mass * conversion_factor(working, si, {1, 0, 0, 0}));
      }
      r.report(rule, *m.block, place_of(card, cell),
               fmt::format("{} {} looks like {} in other units: its density is {} ({:.4g} kg/m3), "
                           "its Young's modulus {} ({:.4g} Pa) with {}, {}, {}{}",
                           m.type, m.id, known.name, off_by(*d), density, off_by(*e), young,
                           working.mass_code, working.length_code, working.time_code,
                           weight == " " ? "" : weight));
      break;
    }
  }
}

/// Elements of one family with equal nodes, by pair of parts.
class SameNodes {
 public:
  explicit SameNodes(const Model& m) : m_(m) {}

  struct Pair {
    std::uint64_t count = 0;
    std::uint32_t first = no_index, other = no_index;  ///< elements
  };
  using Pairs = std::map<std::pair<std::uint32_t, std::uint32_t>, Pair>;

  Pairs of(const Elements& family) {
    Pairs out;
    // Lists of elements: the latest element, and for each the previous one.
    const std::size_t size = family.size();
    std::vector<std::uint32_t> latest(size, no_index), before(size, no_index);
    for (std::size_t e = 0; e < size; ++e) {
      if (!counts(family, e)) continue;
      const NodeIndex *const n = family.of(e), *const end = n + family.width;
      std::uint32_t& list = latest[detail::list_of(n, family.width, size)];
      std::uint32_t other = list;
      while (other != no_index && !std::is_permutation(n, end, family.of(other)))
        other = before[other];
      if (other != no_index) {
        add(family, other, static_cast<std::uint32_t>(e), out);  // also of a third one
        continue;
      }
      before[e] = list;
      list = static_cast<std::uint32_t>(e);
    }
    return out;
  }

 private:
  /// Void skins are meant to be on elements.
  bool counts(const Elements& family, std::size_t e) const {
    const std::uint32_t part = family.part[e];
    if (part == no_index || m_.parts[part].mat == no_index) return false;
    const NodeIndex* n = family.of(e);
    if (std::find(n, n + family.width, no_index) != n + family.width) return false;
    return m_.materials[m_.parts[part].mat].law > 0;
  }
  static void add(const Elements& family, std::uint32_t a, std::uint32_t b, Pairs& out) {
    const auto [low, high] = std::minmax(family.part[a], family.part[b]);
    Pair& p = out[{low, high}];
    if (p.count++ == 0 || b < p.other) p.first = a, p.other = b;
  }
  const Model& m_;
};

void check_same_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  const Model& m = *c.model;
  SameNodes same(m);
  const std::pair<const Elements*, const char*> families[] = {{&m.shell4, "shell"},
                                                              {&m.shell3, "triangular shell"},
                                                              {&m.solid8, "solid"},
                                                              {&m.quad, "plane element"}};
  for (const auto& [family, what] : families)
    for (const auto& [parts, pair] : same.of(*family)) {
      const bool one = parts.first == parts.second;
      Finding& d =
          r.report(rule, m.element_span(family->kind, pair.other),
                   fmt::format("{} on the same nodes as another{}; the first pair is {} and {}",
                               count(pair.count, what, std::string(what) + "s"),
                               one ? fmt::format(" of part {}", m.parts[parts.first].id)
                                   : fmt::format(", parts {} and {}", m.parts[parts.first].id,
                                                 m.parts[parts.second].id),
                               family->id[pair.first], family->id[pair.other]));
      d.notes.emplace_back(m.element_span(family->kind, pair.first), "the other element");
      if (!one) d.severity = Severity::info;
    }
}

/// Nodes of springs without mass; all other elements with stiffness have a density.
std::vector<char> ends_of_massless_springs(const LintContext& c) {
  const Model& m = *c.model;
  std::vector<char> light(m.properties.size(), 0), out;
  bool any = false;
  for (std::size_t p = 0; p < light.size(); ++p) {
    const Property& property = m.properties[p];
    const int type = property.number;
    if (property.block == nullptr || property.block->opaque) continue;
    if (type != 4 && type != 8 && type != 12 && type != 13 && type != 25) continue;
    const DecodedBlock card = decode(c.deck, *property.block);
    const Cell* mass = card.find("Mass");
    light[p] = mass == nullptr || (mass->real == 0.0 && !mass->parameter) ? 1 : 0;
    any = any || light[p] != 0;
  }
  if (!any) return out;
  out.assign(m.nodes.size(), 0);
  for (std::size_t e = 0; e < m.spring.size(); ++e) {
    const std::uint32_t part = m.spring.part[e];
    if (part == no_index || m.parts[part].prop == no_index || light[m.parts[part].prop] == 0)
      continue;
    for (int i = 0; i < 2; ++i)
      if (const NodeIndex n = m.spring.of(e)[i]; n < out.size()) out[n] = 1;
  }
  return out;
}

void check_massless(const LintContext& c, const Rule& rule, Reporter& r) {
  const std::vector<char> ends = ends_of_massless_springs(c);
  if (ends.empty()) return;
  const NodeFigures& nodes = c.loaded->mesh().nodes;
  std::uint64_t found = 0;
  NodeIndex first = no_index;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto n = static_cast<NodeIndex>(i);
    if (ends[i] == 0 || nodes.mass[i] != 0.0 || !(nodes.stiffness[i] > 1e-20) || follows(c, n))
      continue;
    if (found++ == 0) first = n;
  }
  if (found == 0) return;
  r.report(rule, c.model->node_span(first),
           fmt::format("{} stiffness, but no mass; first is node {}",
                       count(found, "node has", "nodes have"), c.model->node_id(first)));
}

/// Nodes of elements.
std::vector<char> nodes_of_elements(const Model& m) {
  std::vector<char> out(m.nodes.size(), 0);
  for (const ElementKind kind : all_families)
    for (const auto* nodes : {&m.family(kind).nodes, &m.family(kind).extra_nodes})
      for (const NodeIndex n : *nodes)
        if (n < out.size()) out[n] = 1;
  return out;
}

void check_free_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.contacts.empty() || has_block(c, "/SPHCEL", "/XELEM")) return;
  const std::vector<char> used = nodes_of_elements(*c.model);
  if (std::find(used.begin(), used.end(), 0) == used.end()) return;
  for (const ContactCard& card : c.contacts) {
    const Cell* cell = card.decoded.find("grnd_IDs");
    if (cell == nullptr || cell->integer <= 0) continue;
    const NodeSet* set = c.selections->node_group(c.resolved(*card.block, "grnod", cell->integer));
    if (set == nullptr) continue;
    std::uint64_t found = 0;
    NodeIndex first = no_index;
    for (const NodeIndex n : set->nodes) {
      if (n >= used.size() || used[n] != 0) continue;
      if (c.loaded->mesh().nodes.mass[n] != 0.0 || follows(c, n)) continue;
      if (found++ == 0) first = n;
    }
    if (found > 0)
      report_at(r, rule, card, "grnd_IDs",
                fmt::format("{}: {} neither element nor mass; the first is node {}", name_of(card),
                            count(found, "secondary node has", "secondary nodes have"),
                            c.model->node_id(first)));
  }
}

}  // namespace

std::vector<Checked> sense_checks() {
  return {{RuleId::DK614, check_units},
          {RuleId::DK615, check_massless},
          {RuleId::DK617, check_same_nodes},
          {RuleId::DK618, check_free_nodes}};
}

}  // namespace deck::detail
