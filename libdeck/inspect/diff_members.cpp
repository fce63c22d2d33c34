// Members of groups, surfaces, lines and sets of two decks.
#include "inspect/differ.hpp"

#include <algorithm>
#include <iterator>

#include "contact/shared/node_elements.hpp"
#include "deck/model.hpp"

namespace deck::detail {

NodeIndex Differ::to_b(NodeIndex n) const { return n == no_index ? no_index : pairs_.node_to_b[n]; }

/// Members of a list of items with nodes and an element; in_order(nodes) normalises their order.
template <class Items, class F>
auto Differ::by_nodes(const DiffSide& side, const Items& list, F&& in_order) const
    -> std::vector<Member> {
  std::vector<Member> out;
  for (const auto& s : list) {
    Tuple t(s.nodes.begin(), s.nodes.end());
    if (&side == &a_)
      std::transform(t.begin(), t.end(), t.begin(), [&](NodeIndex n) { return to_b(n); });
    in_order(t);
    const Elements* elements = elements_of(side.loaded.model(), s.carrier);
    const bool known = elements != nullptr && s.element < elements->size();
    out.push_back({std::move(t), known ? elements->id[s.element] : 0});
  }
  return out;
}

/// Segments keep their sense of rotation; the first node does not matter.
auto Differ::segments(const DiffSide& side, const std::vector<Segment>& list) const
    -> std::vector<Member> {
  return by_nodes(side, list, [](Tuple& t) {
    if (t.size() == 4 && t[3] == t[2]) t.pop_back();
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  });
}

auto Differ::edges(const DiffSide& side, const std::vector<Edge>& list) const
    -> std::vector<Member> {
  return by_nodes(side, list, [](Tuple& t) { std::sort(t.begin(), t.end()); });
}

auto Differ::nodes(const DiffSide& side, const std::vector<NodeIndex>& list) const
    -> std::vector<Member> {
  std::vector<Member> out;
  for (const NodeIndex n : list)
    out.push_back({{&side == &a_ ? to_b(n) : n}, side.loaded.model().node_id(n)});
  return out;
}

auto Differ::items(const DiffSide& side, ElementKind kind,
                   const std::vector<std::uint32_t>& list) const -> std::vector<Member> {
  std::vector<Member> out;
  for (const std::uint32_t e : list)
    out.push_back({{&side == &a_ ? pairs_.element_to_b[static_cast<std::size_t>(kind)][e] : e},
                   side.loaded.model().family(kind).id[e]});
  return out;
}

auto Differ::parts(const DiffSide& side, const std::vector<std::uint32_t>& list) const
    -> std::vector<Member> {
  std::vector<Member> out;
  for (const std::uint32_t p : list) {
    const std::int64_t id = side.loaded.model().parts[p].id;
    const std::int64_t to = &side == &a_ ? pairs_.mapped(a_, b_, "part", id) : id;
    const auto it = b_.loaded.model().part_of_id.find(to);
    out.push_back({{it == b_.loaded.model().part_of_id.end() ? no_index : it->second}, id});
  }
  return out;
}

auto Differ::lists_of(const DiffSide& side, const DeckItem& item, std::string_view kind) const
    -> std::vector<std::pair<std::string, std::vector<Member>>> {
  Selections& s = *side.loaded.model().selections;
  using Lists = std::vector<std::pair<std::string, std::vector<Member>>>;
  const auto one = [](const char* name, const auto* group, auto&& members) -> Lists {
    return {{name, group == nullptr ? std::vector<Member>() : members(*group)}};
  };
  if (kind == "grnod")
    return one("nodes", s.node_group(item.id),
               [&](const NodeSet& g) { return nodes(side, g.nodes); });
  if (kind == "surf")
    return one("segments", s.surface(item.id),
               [&](const Surface& g) { return segments(side, g.segments); });
  if (kind == "line")
    return one("edges", s.line(item.id), [&](const LineSet& g) { return edges(side, g.edges); });
  if (kind == "grpart")
    return one("parts", s.part_group(item.id), [&](const auto& g) { return parts(side, g); });
  if (kind == "set") {
    const SetGeneral* g = s.set(item.id);
    if (g == nullptr) return {};
    return {{"nodes", nodes(side, g->nodes)},
            {"segments", segments(side, g->segments)},
            {"edges", edges(side, g->edges)},
            {"parts", parts(side, g->parts)}};
  }
  if (const auto family = family_of_group(kind))
    return one("elements", s.element_group(kind, item.id),
               [&](const auto& g) { return items(side, *family, g); });
  return {};
}

void Differ::members(const DeckItem& a, const DeckItem& b, std::string_view kind) {
  auto la = lists_of(a_, a, kind), lb = lists_of(b_, b, kind);
  for (std::size_t i = 0; i < std::max(la.size(), lb.size()); ++i) {
    const std::string name = i < la.size() ? la[i].first : lb[i].first;
    std::vector<Member> none;
    auto& x = i < la.size() ? la[i].second : none;
    auto& y = i < lb.size() ? lb[i].second : none;
    const auto nx = static_cast<std::int64_t>(x.size()), ny = static_cast<std::int64_t>(y.size());
    std::sort(x.begin(), x.end());
    std::sort(y.begin(), y.end());
    std::vector<Member> lost, gained;
    std::set_difference(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(lost));
    std::set_difference(y.begin(), y.end(), x.begin(), x.end(), std::back_inserter(gained));
    if (lost.empty() && gained.empty()) continue;
    Change& c = add(ChangeKind::changed, a, &b, name);
    c.old_value = nx;
    c.new_value = ny;
    const auto ids = [](const std::vector<Member>& list) {
      std::vector<std::int64_t> out;
      for (const Member& m : list) out.push_back(m.id);
      std::sort(out.begin(), out.end());
      return out;
    };
    c.lost = ids(lost);
    c.gained = ids(gained);
  }
}

}  // namespace deck::detail
