// The interfaces of a deck and their contacts as lines of text, by ids: what a conversion must not
// change can be compared line by line.
#pragma once
#include <fmt/format.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "deck/contact/scene.hpp"
#include "edit/units_support.hpp"

namespace deck::edit_test {

/// Renames ids, for comparisons after renumbering: (kind, id) -> id.
using IdOf = std::function<std::int64_t(std::string_view, std::int64_t)>;

struct ContactText {
  const Whole& w;
  IdOf id_of = [](std::string_view, std::int64_t id) { return id; };
  std::vector<std::string> lines{};

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
        "max {:a} side {:a} candidates {} removed {} dropped {}",
        id_of("inter", c.inter->id), to_string(c.kind), to_string(c.role), c.type, c.igap, c.istf,
        c.inacti, c.factor, c.gapmin, c.gapmax, c.max_gap, c.shortest_side, c.candidates,
        c.removed_pairs, c.dropped));
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
      lines.push_back(fmt::format("penetration {} {} depth {:a} gap {:a} p0 {:a} {}", p.secondary,
                                  p.main, p.depth, p.gap, p.p0, to_string(p.action)));
  }
  template <class T>
  static std::string shown(const T& value) {
    if constexpr (std::is_floating_point_v<T>)
      return fmt::format("{:a}", value);
    else
      return fmt::format("{}", value);
  }
  /// The effective values, where they came from included.
  void parameters(const std::set<std::int64_t>& only) {
    const auto add = [&](const auto& list) {
      for (const auto& inter : list) {
        if (!only.empty() && !only.contains(inter.id)) continue;
        lines.push_back(fmt::format("interface {} type {} '{}'", id_of("inter", inter.id),
                                    inter.type, inter.title));
        inter.for_each([&](std::string_view name, const auto& field) {
          lines.push_back(
              fmt::format("  {} = {} ({})", name, shown(field.value), to_string(field.origin)));
        });
      }
    };
    add(w.interfaces.type7);
    add(w.interfaces.type10);
    add(w.interfaces.type11);
    add(w.interfaces.type19);
  }
  void scene(const std::set<std::int64_t>& only) {
    Diagnostics diagnostics;
    const Scene s = build_scene(w.model, w.interfaces, diagnostics);
    for (const Contact& c : s.contacts)
      if (only.empty() || only.contains(c.inter->id)) contact(c);
  }
};

/// Effective values and contacts of these interfaces (all of them if none are named).
inline std::vector<std::string> contact_text(const Whole& w,
                                             const std::set<std::int64_t>& only = {}) {
  ContactText text{w};
  text.parameters(only);
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
