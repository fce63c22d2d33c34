// Counts the elements of each part and finds its interfaces and rigid bodies.
#include "report/shared/parts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <map>
#include <span>
#include <utility>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "model/shared/faces.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {
namespace {

/// Nodes of an element; the third one of beams and springs may only orient them.
std::span<const NodeIndex> own_nodes(const Elements& family, std::size_t e) {
  const bool line = family.kind == ElementKind::beam || family.kind == ElementKind::spring;
  return {family.of(e), static_cast<std::size_t>(line ? std::min(2, family.width) : family.width)};
}

/// A bit per set of nodes, for up to 64 sets.
using SetBits = std::uint64_t;
constexpr std::size_t sets_at_once = 64;
constexpr SetBits all_sets = ~SetBits{0};

SetBits common(const std::vector<SetBits>& of_node, std::span<const NodeIndex> nodes) {
  SetBits bits = all_sets;
  for (const NodeIndex n : nodes)
    if (n != no_index) bits &= of_node[n];
  return bits;
}

/// Sets that contain all nodes of a face.
SetBits common_to_a_face(const std::vector<SetBits>& of_node, const NodeIndex* slots) {
  SetBits any = 0;
  for (int f = 0; f < 6; ++f)
    if (const Face face = solid_face(slots, f); face.corners > 0)
      any |= common(of_node, face.nodes);
  return any;
}

/// By part: sets with an element of it (solid: a face), and sets with all of its elements.
struct SetsOfParts {
  std::vector<SetBits> any, all;
};
SetsOfParts find_parts(const Model& model, const std::vector<SetBits>& of_node) {
  SetsOfParts out{std::vector<SetBits>(model.parts.size(), 0),
                  std::vector<SetBits>(model.parts.size(), all_sets)};
  for (std::size_t k = 0; k < 8; ++k) {
    const Elements& f = model.family(static_cast<ElementKind>(k));
    for (std::size_t e = 0; e < f.size(); ++e) {
      if (f.part[e] == no_index) continue;
      SetBits bits = common(of_node, own_nodes(f, e));
      out.all[f.part[e]] &= bits;
      if (f.kind == ElementKind::solid8) bits |= common_to_a_face(of_node, f.of(e));
      out.any[f.part[e]] |= bits;
    }
  }
  return out;
}

class PartBits {
 public:
  explicit PartBits(std::size_t parts) : words_((parts + 63) / 64, 0) {}
  void set(std::size_t p) { words_[p / 64] |= std::uint64_t{1} << (p % 64); }
  bool has(std::size_t p) const { return (words_[p / 64] >> (p % 64) & 1) != 0; }
  std::uint64_t count() const {
    std::uint64_t n = 0;
    for (const std::uint64_t w : words_) n += static_cast<std::uint64_t>(std::popcount(w));
    return n;
  }
  bool none() const { return count() == 0; }
  /// First part of a nonempty set.
  std::size_t first() const {
    std::size_t w = 0;
    while (words_[w] == 0) ++w;
    return 64 * w + static_cast<std::size_t>(std::countr_zero(words_[w]));
  }
  friend PartBits operator&(PartBits a, const PartBits& b) {
    for (std::size_t i = 0; i < a.words_.size(); ++i) a.words_[i] &= b.words_[i];
    return a;
  }
  friend auto operator<=>(const PartBits&, const PartBits&) = default;

 private:
  std::vector<std::uint64_t> words_;
};

struct PartSides {
  PartSides(std::int64_t interface, bool ties, std::size_t parts)
      : id(interface), tie(ties), secondary(parts), main(parts) {}
  std::int64_t id;
  bool tie;
  bool names_secondary = false, names_main = false;  ///< named on the card
  PartBits secondary, main;
};

class Interfaces2Parts {
 public:
  Interfaces2Parts(const LoadedDeck& loaded, PartsView& view)
      : deck_(loaded.deck()), model_(loaded.model()), view_(view) {}

  void run() {
    for (const Block& b : deck_.blocks)
      if (b.schema != nullptr && !b.opaque && b.schema->kind == "inter") interface(b);
    groups();
    for (PartSides& s : sides_) {
      for (std::size_t p = 0; p < view_.parts.size(); ++p)
        if (s.secondary.has(p) || s.main.has(p)) view_.parts[p].interfaces.push_back(s.id);
      // A single side is in contact with itself.
      if (!s.names_main) s.main = s.secondary;
      if (!s.names_secondary) s.secondary = s.main;
    }
    find_repeated();
    for (PartView& p : view_.parts) {
      std::sort(p.interfaces.begin(), p.interfaces.end());
      p.interfaces.erase(std::unique(p.interfaces.begin(), p.interfaces.end()), p.interfaces.end());
    }
  }

 private:
  struct Group {
    std::size_t sides = 0;
    const NodeSet* nodes = nullptr;
  };

  static bool is_tie(const Block& block) {
    static constexpr std::string_view ties[] = {"/INTER/TYPE1", "/INTER/TYPE2", "/INTER/TYPE9",
                                                "/INTER/TYPE12"};
    return std::find(std::begin(ties), std::end(ties), block.schema->keyword) != std::end(ties);
  }

  /// Adds the parts with an element that has all nodes of a segment or edge.
  void loose(PartBits& side, std::span<const NodeIndex> nodes) {
    if (nodes[0] == no_index) return;
    for (std::size_t k = 0; k < of_nodes_.size(); ++k) {
      const Elements& f = model_.family(static_cast<ElementKind>(k));
      if (of_nodes_[k].first.empty()) of_nodes_[k] = connect_nodes(f, model_.nodes.size());
      for (const std::uint32_t e : of_nodes_[k].row(nodes[0])) {
        const std::span<const NodeIndex> own = own_nodes(f, e);
        const bool has = std::all_of(nodes.begin(), nodes.end(), [&](NodeIndex n) {
          return std::find(own.begin(), own.end(), n) != own.end();
        });
        if (has && f.part[e] != no_index) side.set(f.part[e]);
      }
    }
  }

  /// Adds the part of the element of a segment or edge.
  template <class Item>
  void see(PartBits& side, const Item& item) {
    const auto family = family_of_carrier(item.carrier);
    if (!family || item.element == no_index) return loose(side, item.nodes);
    const std::uint32_t part = model_.family(*family).part[item.element];
    if (part != no_index) side.set(part);
  }

  void interface(const Block& block) {
    const DecodedBlock d = decode(deck_, block);
    PartSides& sides = sides_.emplace_back(deck_.shifted_id(block, "inter", block.id.value),
                                           is_tie(block), model_.parts.size());
    const auto id_in = [&](const char* field, const char* kind) {
      return std::max<std::int64_t>(0, deck_.shifted_id(block, kind, d.integer(field)));
    };
    const auto surface = [&](const char* field, PartBits& side, bool& named) {
      const std::int64_t id = id_in(field, "surf");
      if (id == 0) return;
      named = true;
      if (const auto outline = model_.selections->outline(id))
        outline->segments.for_each([&](const Segment& g) { see(side, g); });
    };
    const auto line = [&](const char* field, PartBits& side, bool& named) {
      const std::int64_t id = id_in(field, "line");
      if (id == 0) return;
      named = true;
      if (const LineSet* set = model_.selections->line(id))
        for (const Edge& e : set->edges) see(side, e);
    };
    surface("surf_IDs", sides.secondary, sides.names_secondary);
    surface("surf_ID1", sides.secondary, sides.names_secondary);
    surface("surf_IDm", sides.main, sides.names_main);
    surface("surf_ID2", sides.main, sides.names_main);
    line("line_IDs", sides.secondary, sides.names_secondary);
    line("line_IDm", sides.main, sides.names_main);
    if (const std::int64_t id = id_in("grnd_IDs", "grnod"); id != 0) {
      sides.names_secondary = true;
      if (const NodeSet* set = model_.selections->node_group(id))
        groups_.push_back({sides_.size() - 1, set});
    }
  }

  /// Adds parts with a whole element in a group of secondary nodes.
  void groups() {
    for (std::size_t begin = 0; begin < groups_.size(); begin += sets_at_once) {
      const std::size_t end = std::min(groups_.size(), begin + sets_at_once);
      std::vector<SetBits> of_node(model_.nodes.size(), 0);
      for (std::size_t g = begin; g < end; ++g)
        for (const NodeIndex n : groups_[g].nodes->nodes)
          if (n != no_index) of_node[n] |= SetBits{1} << (g - begin);
      const std::vector<SetBits> any = find_parts(model_, of_node).any;
      for (std::size_t p = 0; p < any.size(); ++p)
        for (std::size_t g = begin; g < end; ++g)
          if ((any[p] >> (g - begin) & 1) != 0) sides_[groups_[g].sides].secondary.set(p);
    }
  }

  /// Number of pairs of a part of each set; (a, b) equals (b, a).
  static std::uint64_t pairs_of(const PartBits& one, const PartBits& other) {
    const std::uint64_t both = (one & other).count();
    return one.count() * other.count() - both * (both - 1) / 2;
  }

  /// Groups contacts with equal parts and compares only groups that share a part: many interfaces
  /// between the same parts do not cost a comparison per pair.
  void find_repeated() {
    std::vector<std::vector<std::size_t>> alike;  // of sides_
    std::map<std::pair<PartBits, PartBits>, std::size_t> known;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const PartSides& s = sides_[i];
      if (s.tie || s.secondary.none() || s.main.none()) continue;
      const auto [at, is_new] = known.try_emplace({s.secondary, s.main}, alike.size());
      if (is_new) alike.emplace_back();
      alike[at->second].push_back(i);
    }
    std::vector<std::vector<std::size_t>> of_part(model_.parts.size());  // earlier groups
    std::vector<std::size_t> last(alike.size(), SIZE_MAX);  // last group compared with each
    for (std::size_t k = 0; k < alike.size(); ++k) {
      if (alike[k].size() > 1) compare(alike[k], {});
      const PartSides& s = sides_[alike[k].front()];
      for (std::size_t p = 0; p < of_part.size(); ++p) {
        if (!s.secondary.has(p) && !s.main.has(p)) continue;
        for (const std::size_t other : of_part[p])
          if (std::exchange(last[other], k) != k) compare(alike[other], alike[k]);
        of_part[p].push_back(k);
      }
      if (view_.repeated.size() >= most_repeated_contacts) return;
    }
  }

  /// Pairs of parts in contacts of two groups (or one), regardless of the main side.
  void compare(const std::vector<std::size_t>& one, const std::vector<std::size_t>& other) {
    if (view_.repeated.size() >= most_repeated_contacts) return;
    const PartSides &a = sides_[one.front()], &b = sides_[(other.empty() ? one : other).front()];
    const PartBits secondary = a.secondary & b.secondary, main = a.main & b.main;
    const PartBits crossed = a.secondary & b.main, back = a.main & b.secondary;
    const bool same_sides = !secondary.none() && !main.none();
    if (!same_sides && (crossed.none() || back.none())) return;
    RepeatedContacts out;
    std::vector<std::size_t> all = one;
    all.insert(all.end(), other.begin(), other.end());
    std::sort(all.begin(), all.end());
    for (const std::size_t i : all) out.interfaces.push_back(sides_[i].id);
    out.part = model_.parts[(same_sides ? secondary : crossed).first()].id;
    out.other = model_.parts[(same_sides ? main : back).first()].id;
    // Pairs in both directions count once.
    const PartBits everywhere = secondary & main;
    out.pairs = pairs_of(secondary, main) + pairs_of(crossed, back) +
                pairs_of(everywhere, everywhere) - pairs_of(secondary & crossed, main & back) -
                pairs_of(secondary & back, main & crossed);
    view_.repeated.push_back(std::move(out));
  }

  const Deck& deck_;
  const Model& model_;
  PartsView& view_;
  std::vector<PartSides> sides_;
  std::vector<Group> groups_;
  std::array<NodeElements, 8> of_nodes_;  ///< by family; made for the first segment without element
};

/// Rigid bodies with all nodes of a part.
void find_bodies(const LoadedDeck& loaded, PartsView& view) {
  const Model& model = loaded.model();
  const Deck& deck = loaded.deck();
  std::vector<SetBits> of_node(model.nodes.size(), 0);
  std::vector<std::int64_t> ids;
  const auto flush = [&] {
    const std::vector<SetBits> all = find_parts(model, of_node).all;
    for (std::size_t p = 0; p < all.size(); ++p) {
      PartView& part = view.parts[p];
      if (part.count() == 0 || part.rigid_body != 0 || all[p] == 0) continue;
      part.rigid_body = ids[static_cast<std::size_t>(std::countr_zero(all[p]))];
    }
    ids.clear();
    std::fill(of_node.begin(), of_node.end(), 0);
  };
  for (const Block& block : deck.blocks) {
    if (block.schema == nullptr || block.opaque || block.schema->keyword != "/RBODY") continue;
    const DecodedBlock d = decode(deck, block);
    const std::int64_t group = d.integer("grnd_ID"), main = d.integer("node_ID");
    const NodeSet* set =
        group > 0 ? model.selections->node_group(deck.shifted_id(block, "grnod", group)) : nullptr;
    if (set == nullptr) continue;
    std::vector<NodeIndex> nodes = set->nodes;
    if (main > 0) nodes.push_back(model.find_node(deck.shifted_id(block, "node", main)));
    for (const NodeIndex n : nodes)
      if (n != no_index) of_node[n] |= SetBits{1} << ids.size();
    ids.push_back(deck.shifted_id(block, "rbody", block.id.value));
    if (ids.size() == sets_at_once) flush();
  }
  if (!ids.empty()) flush();
}

}  // namespace

std::string_view kind_name(ElementKind kind) {
  constexpr std::string_view names[] = {"shell4", "shell3", "solid", "quad",
                                        "tria",   "truss",  "beam",  "spring"};
  return names[static_cast<std::size_t>(kind)];
}

PartsView view_parts(const LoadedDeck& loaded) {
  const Model& model = loaded.model();
  PartsView out;
  out.parts.resize(model.parts.size());
  std::vector<char> used(model.nodes.size(), 0);
  for (std::size_t k = 0; k < 8; ++k) {
    const Elements& f = model.family(static_cast<ElementKind>(k));
    for (const std::uint32_t part : f.part)
      if (part != no_index) ++out.parts[part].elements[k];
    for (const NodeIndex n : f.nodes)
      if (n != no_index) used[n] = 1;
    for (const NodeIndex n : f.extra_nodes)
      if (n != no_index) used[n] = 1;
  }
  out.unconnected_nodes = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), 0));
  for (std::size_t p = 0; p < out.parts.size(); ++p) {
    const Part& part = model.parts[p];
    PartView& v = out.parts[p];
    v.thickness = part.thickness != 0     ? part.thickness
                  : part.prop != no_index ? model.properties[part.prop].thickness
                                          : 0.0;
    if (v.count() == 0) out.empty_parts.push_back(part.id);
  }
  if (model.selections == nullptr) return out;
  Interfaces2Parts(loaded, out).run();
  find_bodies(loaded, out);
  for (std::size_t p = 0; p < out.parts.size(); ++p)
    if (out.parts[p].count() > 0 && out.parts[p].interfaces.empty())
      out.unseen_parts.push_back(model.parts[p].id);
  return out;
}

}  // namespace deck::detail
