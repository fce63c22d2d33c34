// Parts with property, material and subset; missing ones, and elements against their parts.
#include <algorithm>
#include <mutex>

#include "base/shared/parallel.hpp"
#include "keyword/shared/solver_order.hpp"
#include "model/model_build.hpp"
#include "model/shared/families.hpp"

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

/// Adds the tallies of other elements.
void add(std::vector<PartTally>& all, const std::vector<PartTally>& others) {
  for (std::size_t p = 0; p < all.size(); ++p) {
    all[p].count += others[p].count;
    all[p].first = std::min(all[p].first, others[p].first);
  }
}

std::string plural(std::uint32_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// Thickness of shell `e` for contacts and elements, without the part thickness.
double own_thickness(const Elements& shells, std::size_t e) {
  return e < shells.thickness.size() ? shells.thickness[e] : 0;
}

/// True if a node is repeated among neighbours, except third and fourth. Another rule reports equal
/// opposite corners (no area).
bool names_node_twice(const NodeIndex* n) {
  return n[0] != no_index && n[1] != no_index && (n[0] == n[1] || n[1] == n[2] || n[0] == n[3]);
}

/// "3 shells of part 2 have ...; the first is element 7", at this element.
FindingDraft about_elements(const BuildContext& c, const Elements& family, const char* what,
                            std::int64_t part, const PartTally& found, RuleId rule,
                            const std::string& one, const std::string& many,
                            Overrides overrides = {}) {
  return {rule,
          c.model.element_span(family.kind, found.first),
          plural(found.count, what) + " of part " + std::to_string(part) + " " +
              (found.count == 1 ? one : many) + "; the first is element " +
              std::to_string(family.id[found.first]),
          "/PART",
          part,
          std::move(overrides)};
}

void report_node_twice(BuildContext& c, const Elements& family, const char* what, std::int64_t part,
                       const PartTally& found, int message) {
  report(c.findings,
         about_elements(c, family, what, part, found, RuleId::DK136, "names a node twice",
                        "name a node twice", {.message = message}));
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
  std::vector<char> needs_own(m.parts.size(), 0);  // 1: only elements can have a thickness
  for (std::size_t p = 0; p < m.parts.size(); ++p) {
    if (m.parts[p].prop == no_index) continue;
    const Property& prop = m.properties[m.parts[p].prop];
    // Stacks add up their plies, void shells may do without.
    needs_own[p] = prop.thickness == 0 && prop.number != 0 && prop.known;
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
    if (thin[p].count > 0 && c.findings.wants(RuleId::DK106)) {
      const std::string lack =
          " no thickness: neither on the element nor in property " + std::to_string(part.prop_id);
      Finding d = finding_from(about_elements(c, shells, what, part.id, thin[p], RuleId::DK106,
                                              "has" + lack, "have" + lack));
      d.notes.emplace_back(m.properties[part.prop].span, "the property");
      c.findings.add(std::move(d));
    }
    if (twice[p].count > 0) report_node_twice(c, shells, what, part.id, twice[p], 22);
    if (collapsed[p].count > 0)
      report(c.findings, about_elements(c, shells, what, part.id, collapsed[p], RuleId::DK107,
                                        "has the same third and fourth node",
                                        "have the same third and fourth node"));
  }
}

/// Elements whose header names a missing part: one finding per id.
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
    report(c.findings, {RuleId::DK104, entry.second->header_span,
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
    add_object(c, m.parts, m.part_of_id, block, std::move(part));
  }
}

void link_parts(BuildContext& c) {
  Model& m = c.model;
  std::vector<bool> used(m.parts.size());  // has elements
  for (const ElementKind kind : all_families)
    for (const std::uint32_t p : m.family(kind).part)
      if (p != no_index) used[p] = true;
  for (const Block& block : c.deck.blocks)
    if (header_starts(block, "/SPHCEL") || header_starts(block, "/XELEM"))
      if (const auto it = m.part_of_id.find(c.own_id(block, "part")); it != m.part_of_id.end())
        used[it->second] = true;
  if (m.parts.empty() && !m.nodes.id.empty())
    report(c.findings, {RuleId::DK111, c.deck.begin.span, "the deck has no part"});
  for (std::size_t i = 0; i < m.parts.size(); ++i) {
    Part& part = m.parts[i];
    const auto say = [&](RuleId rule, const std::string& what, Overrides overrides = {}) {
      report(c.findings, {rule, part.span, "part " + std::to_string(part.id) + what, "/PART",
                          part.id, std::move(overrides)});
    };
    const auto absent = [](std::int64_t id) {
      return std::to_string(id) + ", which does not exist";
    };
    if (const auto it = m.property_of_id.find(part.prop_id); it != m.property_of_id.end())
      part.prop = it->second;
    else
      say(RuleId::DK102, " refers to property " + absent(part.prop_id));
    if (const auto it = m.material_of_id.find(part.mat_id); it != m.material_of_id.end())
      part.mat = it->second;
    if (part.mat == no_index && part.mat_id != 0)
      say(RuleId::DK103, " refers to material " + absent(part.mat_id),
          used[i] ? Overrides{}
                  : Overrides{.severity = Severity::warning,
                              .message = 0,
                              .solver = "It reports no error, because the part has no elements."});
    else if (part.mat == no_index && used[i] && part.prop != no_index &&
             one_of(m.properties[part.prop].number,
                    {0, 1, 2, 3, 6, 9, 10, 11, 14, 16, 17, 18, 20, 21, 22, 23, 34, 43, 51, 52}))
      say(RuleId::DK103, " has elements but names no material");
    if (part.subset_id > 0 && m.subset_children.count(part.subset_id) == 0)
      say(RuleId::DK108, " names subset " + absent(part.subset_id),
          {.fix = "define the subset or leave the cell blank"});
  }
}

void check_elements(BuildContext& c) {
  const Model& m = c.model;
  constexpr const char* names[] = {
      "shell",          "triangular shell", "solid", "plane quadrangle",
      "plane triangle", "truss element",    "beam",  "spring"};
  for (const ElementKind kind : all_families)
    check_orphans(c, m.family(kind), names[static_cast<std::size_t>(kind)]);
  check_shells(c, m.shell4, "shell");
  check_shells(c, m.shell3, "triangular shell");
  check_springs(c);
}

}  // namespace deck::detail
