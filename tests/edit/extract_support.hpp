// The interfaces of a deck and their contacts as lines of text, by ids: what a conversion must not
// change can be compared line by line.
#pragma once
#include <fmt/format.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "deck/contacts.hpp"
#include "edit/units_support.hpp"

namespace deck::edit_test {

/// Renames ids, for comparisons after renumbering: (kind, id) -> id.
using IdOf = std::function<std::int64_t(std::string_view, std::int64_t)>;

struct ContactText {
  const Whole& w;
  IdOf id_of = [](std::string_view, std::int64_t id) { return id; };
  std::vector<std::string> lines{};
  bool with_role = true;

  std::int64_t node(NodeIndex n) const { return id_of("node", w.model.node_id(n)); }
  std::string element(Carrier carrier, std::uint32_t e) const {
    if (e == no_index) return "none";
    const Model& m = w.model;
    switch (carrier) {
      case Carrier::solid:
        return fmt::format("solid {}", id_of("brick", m.solid8.id[e]));
      case Carrier::shell4:
        return fmt::format("shell {}", id_of("shell", m.shell4.id[e]));
      case Carrier::shell3:
        return fmt::format("sh3n {}", id_of("sh3n", m.shell3.id[e]));
      case Carrier::truss:
        return fmt::format("truss {}", id_of("truss", m.truss.id[e]));
      case Carrier::beam:
        return fmt::format("beam {}", id_of("beam", m.beam.id[e]));
      case Carrier::spring:
        return fmt::format("spring {}", id_of("spring", m.spring.id[e]));
      default:
        return "other";
    }
  }
  void edges(const char* side, const std::vector<ContactEdge>& list) {
    for (const ContactEdge& e : list)
      lines.push_back(fmt::format("{} edge {} {} {} k {:a} gap {:a} length {:a} off {} p {:a}",
                                  side, node(e.nodes[0]), node(e.nodes[1]),
                                  element(e.carrier, e.element), e.stiffness, e.gap, e.length,
                                  e.off, e.stored_penetration));
  }
  void contact(const Contact& c) {
    lines.push_back(fmt::format(
        "contact {} {} {} type {} igap {} istf {} inacti {} factor {:a} gapmin {:a} gapmax {:a} "
        "max {:a} side {:a} candidates {} removed {} scale {:a} mesh {:a} drad {:a}",
        id_of("inter", c.inter->id), to_string(c.kind), with_role ? to_string(c.role) : "", c.type,
        c.igap, c.istf, c.inacti, c.factor, c.gapmin, c.gapmax, c.max_gap, c.shortest_side,
        c.candidates, c.removed_pairs, c.gap_scale, c.mesh_fraction, c.drad));
    for (const SecondaryNode& s : c.secondary)
      lines.push_back(fmt::format("node {} gap {:a} length {:a} k {:a} x {:a} off {}", node(s.node),
                                  s.gap, s.length, s.nodal_stiffness, s.multiplier, s.off));
    for (const MainSegment& m : c.main)
      lines.push_back(fmt::format("segment {} {} {} {} {} k {:a} gap {:a} t {:a} l {:a} off {}",
                                  node(m.nodes[0]), node(m.nodes[1]), node(m.nodes[2]),
                                  node(m.nodes[3]), element(m.carrier, m.element), m.stiffness,
                                  m.gap, m.thickness, m.length, m.off));
    edges("secondary", c.secondary_edges);
    edges("main", c.main_edges);
    for (const PenetrationRow& p : c.penetrations)
      lines.push_back(fmt::format(
          "penetration {} {} depth {:a} gap {:a} p0 {:a} {} normal {:a} {:a} {:a} moved {:a} {:a} "
          "{:a}",
          p.secondary, p.main, p.depth, p.gap, p.p0, to_string(p.action), p.normal[0], p.normal[1],
          p.normal[2], p.moved_by[0], p.moved_by[1], p.moved_by[2]));
  }
  void scene(const std::set<std::int64_t>& only) {
    Diagnostics diagnostics;
    SceneOptions options;
    options.nodal_stiffness = true;
    const Scene s = build_scene(w.model, w.interfaces, diagnostics, options);
    for (const Contact& c : s.contacts)
      if (!c.dropped && (only.empty() || only.contains(c.inter->id))) contact(c);
  }
};

/// Effective values and contacts of these interfaces (all of them if none are named).
inline std::vector<std::string> contact_text(const Whole& w,
                                             const std::set<std::int64_t>& only = {}) {
  ContactText text{w};
  for (const auto& [name, value] : effective_values(w, true, only))
    text.lines.push_back(name + " " + value);
  text.scene(only);
  return std::move(text.lines);
}

/// Fails with the first difference only: the lists are long.
inline void expect_same(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const std::size_t n = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(a[i], b[i]) << "line " << i;
  ASSERT_EQ(a.size(), b.size());
}

}  // namespace deck::edit_test
