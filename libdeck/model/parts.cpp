// Parts and what they refer to: property, material, subset; findings where one of them is missing,
// and the checks of elements against their parts.
#include <algorithm>
#include <mutex>

#include "base/shared/parallel.hpp"
#include "keyword/shared/solver_order.hpp"
#include "model/model_build.hpp"

namespace deck::detail {
namespace {

struct PartTally {
  std::uint32_t count = 0;
  std::uint32_t first = no_index;
};

void tally(std::vector<PartTally>& all, std::uint32_t part, std::uint32_t element) {
  PartTally& t = all[part];
  if (t.count++ == 0) t.first = element;
}

/// Tallies of other elements.
void add(std::vector<PartTally>& all, const std::vector<PartTally>& others) {
  for (std::size_t p = 0; p < all.size(); ++p) {
    all[p].count += others[p].count;
    all[p].first = std::min(all[p].first, others[p].first);
  }
}

std::string plural(std::uint32_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

bool is_spring_property(int number) {
  constexpr int springs[] = {4, 8, 12, 13, 23, 25, 26, 27, 28, 32, 33, 35, 36, 44, 45, 46};
  return std::find(std::begin(springs), std::end(springs), number) != std::end(springs);
}

/// Thickness that contact and element routines find for shell `e` without the part thickness.
double own_thickness(const Elements& shells, std::size_t e) {
  return e < shells.thickness.size() ? shells.thickness[e] : 0;
}

/// A node twice among neighbours, other than third and fourth. Opposite corners that are one node
/// leave no area, which another rule says.
bool names_node_twice(const NodeIndex* n) { return n[0] == n[1] || n[1] == n[2] || n[0] == n[3]; }

void report_node_twice(BuildContext& c, const Elements& family, const char* what, std::int64_t part,
                       const PartTally& found, int message) {
  report(c.diagnostics,
         {RuleId::DK136,
          c.model.element_span(family.kind, found.first),
          plural(found.count, what) + " of part " + std::to_string(part) +
              (found.count == 1 ? " names" : " name") + " a node twice; the first is element " +
              std::to_string(family.id[found.first]),
          "/PART",
          part,
          {.message = message}});
}

void check_springs(BuildContext& c) {
  const Model& m = c.model;
  std::vector<PartTally> twice(m.parts.size());
  for (std::size_t e = 0; e < m.spring.size(); ++e) {
    const NodeIndex* n = m.spring.of(e);
    if (n[0] == n[1] && n[0] != no_index && m.spring.part[e] != no_index)
      tally(twice, m.spring.part[e], static_cast<std::uint32_t>(e));
  }
  for (std::size_t p = 0; p < m.parts.size(); ++p)
    if (twice[p].count > 0) report_node_twice(c, m.spring, "spring", m.parts[p].id, twice[p], 681);
}

void check_shells(BuildContext& c, const Elements& shells, const char* what) {
  const Model& m = c.model;
  std::vector<PartTally> thin(m.parts.size()), collapsed(m.parts.size()), twice(m.parts.size());
  std::vector<char> needs_own(m.parts.size(), 0);  // no thickness but that of the element
  for (std::size_t p = 0; p < m.parts.size(); ++p) {
    if (m.parts[p].prop == no_index) continue;
    const Property& prop = m.properties[m.parts[p].prop];
    // Stacks add up their plies, void shells may do without, an encrypted property hides it.
    const bool free =
        prop.number == 17 || prop.number == 51 || prop.number == 52 || prop.number == 0;
    needs_own[p] = prop.thickness == 0 && !free && prop.block != nullptr && !prop.block->opaque;
  }
  std::mutex mutex;
  parallel_pieces(c.threads, shells.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<PartTally> own_thin(m.parts.size()), own_collapsed(m.parts.size()),
        own_twice(m.parts.size());
    for (std::size_t e = begin; e < end; ++e) {
      const std::uint32_t p = shells.part[e];
      if (p == no_index) continue;
      const auto index = static_cast<std::uint32_t>(e);
      const NodeIndex* n = shells.of(e);
      if (shells.width == 4 && n[2] == n[3]) tally(own_collapsed, p, index);
      if (shells.width == 4 && names_node_twice(n)) tally(own_twice, p, index);
      if (needs_own[p] != 0 && own_thickness(shells, e) == 0) tally(own_thin, p, index);
    }
    const std::lock_guard lock(mutex);
    add(thin, own_thin);
    add(collapsed, own_collapsed);
    add(twice, own_twice);
  });
  for (std::size_t p = 0; p < m.parts.size(); ++p) {
    const Part& part = m.parts[p];
    if (thin[p].count > 0 && c.diagnostics.wants(RuleId::DK106)) {
      Diagnostic d =
          make_diagnostic({RuleId::DK106, m.element_span(shells.kind, thin[p].first),
                           plural(thin[p].count, what) + " of part " + std::to_string(part.id) +
                               (thin[p].count == 1 ? " has" : " have") +
                               " no thickness: neither on the element nor in property " +
                               std::to_string(part.prop_id) + "; the first is element " +
                               std::to_string(shells.id[thin[p].first]),
                           "/PART", part.id});
      d.notes.emplace_back(m.properties[part.prop].span, "the property");
      c.diagnostics.add(std::move(d));
    }
    if (twice[p].count > 0) report_node_twice(c, shells, what, part.id, twice[p], 22);
    if (collapsed[p].count > 0)
      report(c.diagnostics,
             {RuleId::DK107, m.element_span(shells.kind, collapsed[p].first),
              plural(collapsed[p].count, what) + " of part " + std::to_string(part.id) +
                  (collapsed[p].count == 1 ? " has" : " have") +
                  " the same third and fourth node; the first is element " +
                  std::to_string(shells.id[collapsed[p].first]),
              "/PART", part.id});
  }
}

/// Elements whose block header names a part that does not exist, one finding per block header id.
void check_orphans(BuildContext& c, const Elements& family, const char* what) {
  std::map<std::int64_t, std::pair<std::uint32_t, const Block*>> missing;
  for (auto at = family.part.begin();; ++at) {
    at = std::find(at, family.part.end(), no_index);
    if (at == family.part.end()) break;
    const auto e = static_cast<std::size_t>(at - family.part.begin());
    const Block* block = c.model.element_blocks[family.block[e]].block;
    auto& entry = missing[c.own_id(*block, "part")];
    if (entry.first++ == 0) entry.second = block;
  }
  for (const auto& [id, entry] : missing)
    report(c.diagnostics, {RuleId::DK104, entry.second->header_span,
                           plural(entry.first, what) + (entry.first == 1 ? " belongs" : " belong") +
                               " to part " + std::to_string(id) + ", which does not exist",
                           std::string(entry.second->keyword), id});
}

}  // namespace

void read_parts(BuildContext& c) {
  Model& m = c.model;
  for (const Block* const at : in_solver_order(c.deck, "/PART")) {
    const Block& block = *at;
    const DecodedBlock d = decode(c.deck, block);
    Part part;
    part.id = c.own_id(block, "part");
    part.title = d.title;
    part.prop_id = c.reference(d, "prop_ID", "prop");
    part.mat_id = c.reference(d, "mat_ID", "mat");
    part.subset_id = c.reference(d, "subset_ID", "subset");
    part.thickness = c.value(d, "Thick");
    part.submodel = block.submodel;
    part.span = block.header_span;
    const auto index = static_cast<std::uint32_t>(m.parts.size());
    const auto known = m.part_of_id.find(part.id);
    register_id(c, m.part_of_id, part.id, index, block,
                known == m.part_of_id.end() ? Span{} : m.parts[known->second].span);
    m.parts.push_back(std::move(part));
  }
}

void link_parts(BuildContext& c) {
  Model& m = c.model;
  std::vector<std::uint8_t> used(m.parts.size());  // bit 0: any element, bit 1: other than springs
  for (const Elements* f :
       {&m.shell4, &m.shell3, &m.solid8, &m.quad, &m.tria, &m.truss, &m.beam, &m.spring}) {
    std::uint32_t last = no_index;  // elements of a part mostly follow each other
    for (const std::uint32_t p : f->part) {
      if (p == last || p == no_index) continue;
      used[p] |= f->kind == ElementKind::spring ? 1 : 3;
      last = p;
    }
  }
  if (m.parts.empty() && !m.nodes.id.empty())
    report(c.diagnostics, {RuleId::DK111, c.deck.begin.span, "the deck has no part"});
  for (std::size_t i = 0; i < m.parts.size(); ++i) {
    Part& part = m.parts[i];
    if (const auto it = m.property_of_id.find(part.prop_id); it != m.property_of_id.end())
      part.prop = it->second;
    else
      report(c.diagnostics, {RuleId::DK102, part.span,
                             "part " + std::to_string(part.id) + " refers to property " +
                                 std::to_string(part.prop_id) + ", which does not exist",
                             "/PART", part.id});
    if (const auto it = m.material_of_id.find(part.mat_id); it != m.material_of_id.end())
      part.mat = it->second;
    const bool spring = part.prop != no_index && is_spring_property(m.properties[part.prop].number);
    // Without elements a part may do without a material; one that a shell, solid or beam part names
    // has to exist all the same.
    const bool named =
        part.mat_id != 0 && part.prop != no_index && !spring && m.properties[part.prop].number != 0;
    if (part.mat == no_index && ((used[i] & 2) != 0 || named) && !(spring && part.mat_id == 0))
      report(c.diagnostics,
             {RuleId::DK103, part.span,
              "part " + std::to_string(part.id) +
                  (part.mat_id == 0 ? " has elements but names no material"
                                    : " refers to material " + std::to_string(part.mat_id) +
                                          ", which does not exist"),
              "/PART", part.id});
    if (part.subset_id > 0 && m.subset_children.count(part.subset_id) == 0)
      report(c.diagnostics, {RuleId::DK108,
                             part.span,
                             "part " + std::to_string(part.id) + " names subset " +
                                 std::to_string(part.subset_id) + ", which does not exist",
                             "/PART",
                             part.id,
                             {.fix = "define the subset or leave the cell blank"}});
  }
}

void check_elements(BuildContext& c) {
  const Model& m = c.model;
  check_orphans(c, m.shell4, "shell");
  check_orphans(c, m.shell3, "triangular shell");
  check_orphans(c, m.solid8, "solid");
  check_orphans(c, m.quad, "plane quadrangle");
  check_orphans(c, m.tria, "plane triangle");
  check_orphans(c, m.truss, "truss element");
  check_orphans(c, m.beam, "beam");
  check_orphans(c, m.spring, "spring");
  check_shells(c, m.shell4, "shell");
  check_shells(c, m.shell3, "triangular shell");
  check_springs(c);
}

}  // namespace deck::detail
