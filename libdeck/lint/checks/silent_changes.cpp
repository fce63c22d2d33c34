// Settings that the solver changes or does not find, reported only in its listing: integration
// points of shells, formulations of triangles, vent holes, Engine options, reference state.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/shared/paths.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Per part: true if it has shells.
std::vector<bool> parts_with_shells(const Model& m) {
  std::vector<bool> out(m.parts.size(), false);
  for (const Elements* family : {&m.shell4, &m.shell3}) {
    std::uint32_t last = no_index;  // elements of a part are consecutive
    for (const std::uint32_t part : family->part) {
      if (part == last) continue;
      last = part;
      if (part != no_index) out[part] = true;
    }
  }
  return out;
}

/// Calls f(property, material, decoded property) for every pair of shells whose property has
/// integration points, not layers.
template <class F>
void for_each_shell_pair(const LintContext& c, F&& f) {
  const Model& m = *c.model;
  const std::vector<bool> has_shells = parts_with_shells(m);
  std::map<std::uint32_t, std::set<std::uint32_t>> pairs;
  for (std::size_t i = 0; i < m.parts.size(); ++i) {
    const Part& p = m.parts[i];
    if (has_shells[i] && p.prop != no_index && p.mat != no_index) pairs[p.prop].insert(p.mat);
  }
  for (const auto& [prop, materials] : pairs) {
    const Property& p = m.properties[prop];
    if ((p.number != 1 && p.number != 9) || p.block == nullptr || p.block->opaque) continue;
    const DecodedBlock d = decode(c.deck, *p.block);
    for (const std::uint32_t mat : materials) f(p, m.materials[mat], d);
  }
}

void check_global_integration(const LintContext& c, const Rule& rule, Reporter& r) {
  std::set<std::pair<const Property*, int>> seen;  // one finding per property and law
  for_each_shell_pair(c, [&](const Property& p, const Material& mat, const DecodedBlock& d) {
    const bool has_it = mat.law <= 1 || mat.law == 91 || mat.law == 136;
    if (has_it || d.integer("N") != 0 || !seen.emplace(&p, mat.law).second) return;
    Finding& found = r.report(rule, *p.block, place_of(d, "N"),
                              fmt::format("{} {} has N = 0, which law {} of material {} does "
                                          "not support; three integration points are used",
                                          p.type, p.id, mat.law, mat.id));
    found.notes.emplace_back(mat.span, "the material");
  });
}

void check_elastic_shells(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_shell_pair(c, [&](const Property& p, const Material& mat, const DecodedBlock& d) {
    if (mat.law != 1 || d.integer("N") <= 1) return;
    r.report(rule, *p.block, place_of(d, "N"),
             fmt::format("{} {} has N = {} and the elastic material {}: it is integrated globally",
                         p.type, p.id, d.integer("N"), mat.id));
  });
}

void check_plain_triangles(const LintContext& c, const Rule& rule, Reporter& r) {
  std::int64_t shell = 0, triangle = 0;
  Span defaults;
  for_each_block(c, "/DEF_SHELL", [&](const Block& b) {
    const DecodedBlock d = decode(c.deck, b);
    shell = d.integer("Ishell");
    triangle = d.integer("Ish3n");
    defaults = place_of(d, "Ish3n");
  });
  if (triangle != 1) return;
  static constexpr int numbers[] = {1, 9, 10, 11, 16, 17, 51};
  for (const Property& p : c.model->properties) {
    if (std::find(std::begin(numbers), std::end(numbers), p.number) == std::end(numbers) ||
        p.block == nullptr || p.block->opaque || p.block->schema->find_field("Ishell") == nullptr)
      continue;
    const DecodedBlock d = decode(c.deck, *p.block);
    const std::int64_t own = d.integer("Ishell");
    const std::int64_t used = own == 0 && p.number != 51 ? shell : own;
    if (used != 4 || d.integer("Ish3n") != 0) continue;
    Finding& found = r.report(rule, *p.block, place_of(d, "Ish3n"),
                              fmt::format("{} {} has Ishell = 4 and no Ish3n: its triangles are "
                                          "plain C0 triangles",
                                          p.type, p.id));
    found.notes.emplace_back(defaults, "the default of the triangles");
  }
}

/// Vent holes and porous surfaces are repetitions in their block, each with a surface or area.
void check_vents(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr || b.opaque || !b.schema->keyword.starts_with("/MONVOL/")) continue;
    if (b.schema->find_field("Avent") == nullptr) continue;
    const DecodedBlock d = decode(c.deck, b);
    int place = 0;
    for (const DecodedCard& card : d.cards) {
      const Cell *surface = cell_named(card, "surf_IDv"), *area = cell_named(card, "Avent");
      if (surface == nullptr || area == nullptr) continue;
      ++place;
      if (surface->integer != 0 || surface->parameter || area->real != 0) continue;
      r.report(rule, b, place_of(d, area),
               fmt::format("vent hole {} of {} has no surface and the area 0", place,
                           clipped(b.header)));
    }
  }
}

/// True if the Starter finds no Engine file. A deck not named *_0000.rad is not run.
bool engine_file_missing(const LintContext& c) {
  return !c.engine->run.empty() && c.engine->files.empty() && c.engine->unread.empty();
}

void check_engine_file(const LintContext& c, const Rule& rule, Reporter& r) {
  if (!engine_file_missing(c)) return;
  const auto report = [&](Span place, int message, const std::string& what) {
    Finding& d =
        r.report(rule, place, fmt::format("there is no {}_0001.rad: {}", c.engine->run, what));
    d.reference = rule.message(message);
  };
  const auto shapes = [&](SolidShape shape) {
    const Elements& solids = c.model->solid8;
    const auto it = std::find(solids.shape.begin(), solids.shape.end(), shape);
    if (it == solids.shape.end()) return Span();
    return c.model->element_span(
        ElementKind::solid8, static_cast<std::uint32_t>(std::distance(solids.shape.begin(), it)));
  };
  if (const Span at = shapes(SolidShape::tetra4); at.valid())
    report(at, 1589, "the time steps of 4-node tetrahedra are listed without /DT1/BRICK");
  if (const Span at = shapes(SolidShape::tetra10); at.valid())
    report(at, 1606, "the time steps of 10-node tetrahedra are listed without /DT1TET10");
  for_each_block(c, "/AMS", [&](const Block& b) {
    if (decode(c.deck, b).integer("grpart_ID") == 0)
      report(b.header_span, 1570, "/AMS scales the masses of all parts");
  });
}

void check_reference_file(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_block(c, "/REFSTA", [&](const Block& b) {
    const DecodedBlock d = decode(c.deck, b);
    const Cell* name = d.find("RSFILE");
    if (name == nullptr || name->blank()) return;
    const std::string file(name->text);
    const std::string folder(parent_path(absolute_path(c.deck.sources[0].path())));
    std::error_code ec;
    if (std::filesystem::exists(file.starts_with('/') ? file : folder + "/" + file, ec)) return;
    r.report(rule, b, name->span,
             fmt::format("the reference state file '{}' does not exist", clipped(file)));
  });
}

}  // namespace

std::vector<Checked> silent_change_checks() {
  return {{RuleId::DK600, check_global_integration}, {RuleId::DK601, check_elastic_shells},
          {RuleId::DK602, check_plain_triangles},    {RuleId::DK603, check_vents},
          {RuleId::DK604, check_engine_file},        {RuleId::DK605, check_reference_file}};
}

}  // namespace deck::detail
