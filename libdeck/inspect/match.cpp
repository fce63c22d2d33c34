// Matches the blocks, nodes and elements of two decks by id, title or position.
// Passes, each over the items still unmatched: equal key (kind and id, or kind and title), the
// first with the first; then untitled blocks by rank of their ids. Nodes match by id or by
// coordinates, elements by id or by matched nodes; a moved node matches by its elements. Cost: n
// log n.
#include "inspect/match.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "deck/keyword.hpp"
#include "keyword/shared/references.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {
namespace {

/// False for blocks that only control reading, or have no effect: their effect is in the rest.
bool compared(const Block& b) {
  constexpr std::string_view list[] = {"/BEGIN",     "/END",       "/TITLE",  "/UNIT",
                                       "/PARAMETER", "//SUBMODEL", "//ENDSUB"};
  for (const std::string_view k : list)
    if (is_below(b.header, k)) return false;
  return b.schema == nullptr ||
         (!b.schema->bulk && b.schema->kind != "engine" && b.schema->kind != "parameter");
}

std::vector<DeckItem> items_of(const Deck& deck) {
  std::vector<DeckItem> out;
  for (const Block& b : deck.blocks) {
    if (!compared(b)) continue;
    DeckItem item;
    item.block = &b;
    if (b.schema == nullptr) {
      // Ids of keywords without schema may be anywhere in the header.
      item.space = b.id.present ? std::string(b.keyword) : std::string(b.header);
      item.id = b.id.value;
    } else {
      const std::string& kind = b.schema->kind;
      item.space = kind.empty() || kind == "other" ? b.schema->keyword : kind;
      item.id = id_of(deck, b);
      if (b.schema->has_title) item.title = decode(deck, b).title;
    }
    out.push_back(std::move(item));
  }
  return out;
}

class ItemMatcher {
 public:
  ItemMatcher(const DiffSide& a, const DiffSide& b, MatchBy match, double length)
      : a_(a.loaded.model()), b_(b.loaded.model()), match_(match), length_(length) {
    out_.items_a = items_of(a.loaded.deck());
    out_.items_b = items_of(b.loaded.deck());
  }

  Counterparts run() {
    blocks();
    out_.node_to_b.assign(a_.nodes.size(), no_index);
    used_node_.assign(b_.nodes.size(), 0);
    for (const ElementKind k : all_families)
      out_.element_to_b[at(k)].assign(a_.family(k).size(), no_index);
    if (match_ != MatchBy::position) {
      by_id(a_.nodes.id, b_.nodes.id, [&](NodeIndex n, NodeIndex m) { pair_nodes(n, m); });
      for (const ElementKind k : all_families)
        by_id(a_.family(k).id, b_.family(k).id,
              [&](std::uint32_t e, std::uint32_t f) { out_.element_to_b[at(k)][e] = f; });
    } else {
      nodes_by_position();
      for (int round = 0; round < 100 && nodes_by_elements(); ++round) {
      }
      elements_by_nodes();
    }
    return std::move(out_);
  }

 private:
  static std::size_t at(ElementKind k) { return static_cast<std::size_t>(k); }

  void pair_nodes(NodeIndex a, NodeIndex b) {
    out_.node_to_b[a] = b;
    used_node_[b] = 1;
  }

  // ---- blocks ---------------------------------------------------------------------------------

  /// Pairs items with equal keys, the first with the first and so on.
  template <class Key>
  void pass(Key&& key) {
    using K = std::decay_t<decltype(key(out_.items_a[0]))>;
    std::map<K, std::vector<std::uint32_t>> waiting;
    for (std::uint32_t i = 0; i < out_.items_b.size(); ++i)
      if (used_[i] == 0) waiting[key(out_.items_b[i])].push_back(i);
    std::map<K, std::size_t> next;
    for (std::uint32_t i = 0; i < out_.items_a.size(); ++i) {
      if (out_.block_to_b[i] != no_index) continue;
      const K k = key(out_.items_a[i]);
      const auto it = waiting.find(k);
      if (it == waiting.end() || next[k] >= it->second.size()) continue;
      const std::uint32_t j = it->second[next[k]++];
      out_.block_to_b[i] = j;
      used_[j] = 1;
    }
  }

  void blocks() {
    out_.block_to_b.assign(out_.items_a.size(), no_index);
    used_.assign(out_.items_b.size(), 0);
    if (match_ != MatchBy::id) {
      // If several have a title, the id decides first.
      int untitled = 0;
      pass([&](const DeckItem& i) {
        return std::tuple(i.space, i.title, i.id, i.title.empty() ? ++untitled : 0);
      });
      pass([&](const DeckItem& i) {
        return std::tuple(i.space, i.title, i.title.empty() ? ++untitled : 0);
      });
    }
    pass([](const DeckItem& i) { return std::tuple(i.space, i.id); });
    if (match_ == MatchBy::position) {
      // Renumbered without title: by rank of the ids, if the numbers agree.
      std::map<std::string, std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>> left;
      for (std::uint32_t i = 0; i < out_.items_a.size(); ++i)
        if (out_.block_to_b[i] == no_index) left[out_.items_a[i].space].first.push_back(i);
      for (std::uint32_t i = 0; i < out_.items_b.size(); ++i)
        if (used_[i] == 0) left[out_.items_b[i].space].second.push_back(i);
      for (auto& [space, lists] : left) {
        auto& [la, lb] = lists;
        if (la.size() != lb.size()) continue;
        const auto sort = [](std::vector<std::uint32_t>& list, const std::vector<DeckItem>& items) {
          std::stable_sort(list.begin(), list.end(), [&](std::uint32_t x, std::uint32_t y) {
            return items[x].id < items[y].id;
          });
        };
        sort(la, out_.items_a);
        sort(lb, out_.items_b);
        for (std::size_t i = 0; i < la.size(); ++i) {
          out_.block_to_b[la[i]] = lb[i];
          used_[lb[i]] = 1;
        }
      }
    }
    for (std::uint32_t i = 0; i < out_.items_a.size(); ++i)
      if (out_.block_to_b[i] != no_index)
        out_.id_to_b.emplace(std::pair{out_.items_a[i].space, out_.items_a[i].id},
                             out_.items_b[out_.block_to_b[i]].id);
  }

  // ---- nodes and elements ---------------------------------------------------------------------

  /// Calls pair(index, index) for equal ids; repeated ids in their order.
  template <class F>
  static void by_id(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b,
                    F&& pair) {
    const auto sorted = [](const std::vector<std::int64_t>& ids) {
      std::vector<std::uint32_t> order(ids.size());
      for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
      std::stable_sort(order.begin(), order.end(),
                       [&](std::uint32_t x, std::uint32_t y) { return ids[x] < ids[y]; });
      return order;
    };
    const auto oa = sorted(a), ob = sorted(b);
    for (std::size_t i = 0, j = 0; i < oa.size() && j < ob.size();) {
      if (a[oa[i]] < b[ob[j]])
        ++i;
      else if (b[ob[j]] < a[oa[i]])
        ++j;
      else
        pair(oa[i++], ob[j++]);
    }
  }

  /// Coincident nodes in the order of their ids.
  void nodes_by_position() {
    using Key = std::tuple<double, double, double, std::int64_t, NodeIndex>;
    const auto sorted = [](const Nodes& nodes, double factor) {
      std::vector<Key> keys;
      keys.reserve(nodes.size());
      for (NodeIndex n = 0; n < nodes.size(); ++n)
        keys.emplace_back(nodes.x[n] * factor, nodes.y[n] * factor, nodes.z[n] * factor,
                          nodes.id[n], n);
      std::sort(keys.begin(), keys.end());
      return keys;
    };
    const auto ka = sorted(a_.nodes, length_), kb = sorted(b_.nodes, 1);
    const auto place = [](const Key& k) {
      return std::tuple(std::get<0>(k), std::get<1>(k), std::get<2>(k));
    };
    for (std::size_t i = 0, j = 0; i < ka.size() && j < kb.size();) {
      if (place(ka[i]) < place(kb[j]))
        ++i;
      else if (place(kb[j]) < place(ka[i]))
        ++j;
      else
        pair_nodes(std::get<4>(ka[i++]), std::get<4>(kb[j++]));
    }
  }

  /// Matches a moved node whose elements have counterparts that differ in such nodes only.
  bool nodes_by_elements() {
    bool found = false;
    for (const ElementKind k : all_families) {
      const Elements& fa = a_.family(k);
      const Elements& fb = b_.family(k);
      std::map<std::vector<NodeIndex>, std::pair<int, std::uint32_t>> of_b;
      const auto key = [&](const Elements& f, std::uint32_t e, auto&& translated) {
        std::vector<NodeIndex> out;
        bool some = false, open = false;
        for (int i = 0; i < f.width; ++i) {
          out.push_back(f.of(e)[i] == no_index ? no_index : translated(f.of(e)[i]));
          some = some || out.back() != no_index;
          open = open || (out.back() == no_index && f.of(e)[i] != no_index);
        }
        if (!some || !open) out.clear();
        return out;
      };
      for (std::uint32_t e = 0; e < fb.size(); ++e) {
        auto words = key(fb, e, [&](NodeIndex n) { return used_node_[n] != 0 ? n : no_index; });
        if (words.empty()) continue;
        auto& entry = of_b[std::move(words)];
        ++entry.first;
        entry.second = e;
      }
      if (of_b.empty()) continue;
      std::map<std::vector<NodeIndex>, std::pair<int, std::uint32_t>> of_a;
      for (std::uint32_t e = 0; e < fa.size(); ++e) {
        auto words = key(fa, e, [&](NodeIndex n) { return out_.node_to_b[n]; });
        if (words.empty() || !of_b.contains(words)) continue;
        auto& entry = of_a[std::move(words)];
        ++entry.first;
        entry.second = e;
      }
      for (const auto& [words, entry] : of_a) {
        const auto& other = of_b[words];
        if (entry.first != 1 || other.first != 1) continue;
        for (int i = 0; i < fa.width; ++i) {
          const NodeIndex n = fa.of(entry.second)[i], m = fb.of(other.second)[i];
          if (n == no_index || m == no_index || out_.node_to_b[n] != no_index || used_node_[m] != 0)
            continue;
          pair_nodes(n, m);
          found = true;
        }
      }
    }
    return found;
  }

  void elements_by_nodes() {
    for (const ElementKind k : all_families) {
      const Elements& fa = a_.family(k);
      const Elements& fb = b_.family(k);
      using Key = std::pair<std::vector<NodeIndex>, std::uint32_t>;
      std::vector<Key> kb;
      kb.reserve(fb.size());
      for (std::uint32_t e = 0; e < fb.size(); ++e)
        kb.emplace_back(std::vector<NodeIndex>(fb.of(e), fb.of(e) + fb.width), e);
      std::sort(kb.begin(), kb.end());
      std::vector<std::uint8_t> used(fb.size(), 0);
      for (std::uint32_t e = 0; e < fa.size(); ++e) {
        std::vector<NodeIndex> words;
        for (int i = 0; i < fa.width; ++i)
          words.push_back(fa.of(e)[i] == no_index ? no_index : out_.node_to_b[fa.of(e)[i]]);
        auto it = std::lower_bound(kb.begin(), kb.end(), Key{words, 0});
        while (it != kb.end() && it->first == words && used[it->second] != 0) ++it;
        if (it == kb.end() || it->first != words) continue;
        used[it->second] = 1;
        out_.element_to_b[at(k)][e] = it->second;
      }
    }
  }

  const Model& a_;
  const Model& b_;
  MatchBy match_;
  double length_;
  Counterparts out_;
  std::vector<std::uint8_t> used_, used_node_;
};

}  // namespace

std::int64_t Counterparts::mapped(const DiffSide& a, const DiffSide& b, std::string_view kind,
                                  std::int64_t id) const {
  if (kind == "node") {
    const NodeIndex n = a.loaded.model().nodes.map.find(id);
    return n == no_index || node_to_b[n] == no_index ? 0 : b.loaded.model().nodes.id[node_to_b[n]];
  }
  if (const auto family = family_of_kind(kind)) {
    const std::uint32_t e = a.loaded.model().family(*family).map.find(id);
    const auto& map = element_to_b[static_cast<std::size_t>(*family)];
    return e == no_index || map[e] == no_index ? 0 : b.loaded.model().family(*family).id[map[e]];
  }
  auto it = id_to_b.find({std::string(kind), id});
  if (it == id_to_b.end() &&
      (kind == "grnod" || kind == "surf" || kind == "line" || kind == "grpart"))
    it = id_to_b.find({"set", id});
  return it == id_to_b.end() ? 0 : it->second;
}

Counterparts find_counterparts(const DiffSide& a, const DiffSide& b, MatchBy match, double length) {
  return ItemMatcher(a, b, match, length).run();
}

}  // namespace deck::detail
