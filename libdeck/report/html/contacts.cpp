// What evaluating other settings in the page needs: all pairs within a generous reach, exact
// coordinates of their nodes, thickness and mesh-size limits before any factor. The page repeats
// the geometry stage operation by operation, so its results are those of `deck gaps --what-if`.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/shared/scene_parts.hpp"
#include "contact/shared/sides.hpp"
#include "deck/contact/search.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t pairs_per_page = 2000000;
constexpr std::size_t pairs_at_least = 60000;  // per contact
constexpr std::size_t pairs_at_most = 3000000;
constexpr std::size_t penetrations_kept = 200000;  // per contact where all pairs are too many
constexpr double reach_factors[] = {3, 2, 1.5, 1.1};

double thickness_of(const MainSegment& m) {
  return m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3 ? m.thickness : 0.0;
}
double thickness_of(const ContactEdge& e) { return std::max(e.shell, e.section); }

/// Largest gap that the interface has, could have by thickness, or would have by default.
double expected_gap(const Contact& contact, const PlainSides& plain) {
  double s = 0, m = 0;
  if (contact.type != 10) {
    for (const double half : plain.half_thickness) s = std::max(s, node_gap(half, 1));
    for (const MainSegment& n : contact.main) m = std::max(m, segment_gap(thickness_of(n), 1));
    for (const ContactEdge& n : contact.secondary_edges) s = std::max(s, edge_gap(thickness_of(n)));
    for (const ContactEdge& n : contact.main_edges) m = std::max(m, edge_gap(thickness_of(n)));
  }
  return std::max({contact.max_gap, contact.gapmin, s + m});
}

std::vector<std::uint32_t> everything(std::size_t count) {
  std::vector<std::uint32_t> out(count);
  for (std::uint32_t i = 0; i < count; ++i) out[i] = i;
  return out;
}

/// Rows of what penetrates; of too many the deepest, and `all` is set to false.
std::vector<std::uint32_t> deepest_rows(const Contact& contact, bool& all) {
  const auto& found = contact.penetrations;
  std::vector<std::uint32_t> rows = everything(found.size());
  if (rows.size() <= penetrations_kept) return rows;
  all = false;
  std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
    return found[a].depth > found[b].depth;
  });
  rows.resize(penetrations_kept);
  return rows;
}

/// Sides of a contact whose gaps are formed already.
PlainSides formed_sides(const Contact& contact, const Coordinates& x) {
  PlainSides out;
  for (const SecondaryNode& s : contact.secondary) {
    out.half_thickness.push_back(s.gap);
    out.secondary_length.push_back(s.length);
  }
  for (const MainSegment& m : contact.main) out.main_length.push_back(m.length);
  for (const ContactEdge& e : contact.secondary_edges) out.secondary_length.push_back(e.length);
  for (const ContactEdge& e : contact.main_edges) out.main_length.push_back(e.length);
  out.shortest_side = contact.shortest_side;
  out.secondary_side = edge_side(x, contact.secondary_edges);
  out.main_side = edge_side(x, contact.main_edges);
  return out;
}

PageContact wide_pairs(const Contact& contact, PlainSides plain, const Coordinates& x, int threads,
                       std::size_t limit) {
  PageContact page;
  page.plain = std::move(plain);
  if (is_modern(contact.type)) {  // the page has no rules for them: it shows what was found
    page.given = deepest_rows(contact, page.complete);
    for (const std::uint32_t r : page.given)
      page.pairs.push_back({contact.penetrations[r].secondary, contact.penetrations[r].main});
    return page;
  }
  const SearchSides sides(contact, SearchSides::Off::included, threads);
  if (!sides.edge_pairs()) page.margin = sides.margin(x);
  if (!std::isfinite(page.margin)) page.margin = 0;
  SearchOptions search;
  search.threads = threads;
  search.max_pairs = limit;
  const double gap = expected_gap(contact, page.plain);
  for (const double factor : reach_factors) {
    // Every reach includes what the solver's own search has found.
    if (contact.candidates > limit) break;
    page.reach = factor * gap + page.margin;
    if (!(page.reach > 0) || !std::isfinite(page.reach)) break;
    search.gap = PairGap::constant(page.reach);
    SearchResult found = sides.find(x, search);
    if (!found.complete) continue;
    page.pairs = std::move(found.pairs);
    return page;
  }
  // Too many: what penetrates, deepest first if even that is too much.
  page.reach = 0;
  page.complete = false;
  bool all = true;
  for (const std::uint32_t r : deepest_rows(contact, all))
    page.pairs.push_back({contact.penetrations[r].secondary, contact.penetrations[r].main});
  std::sort(page.pairs.begin(), page.pairs.end());
  return page;
}

/// Sorted distinct positions of one side of the pairs; the side has `count` items.
std::vector<std::uint32_t> distinct(const std::vector<CandidatePair>& pairs,
                                    std::uint32_t CandidatePair::*side, std::size_t count) {
  std::vector<std::uint8_t> marks(count, 0);
  for (const CandidatePair& p : pairs) marks[p.*side] = 1;
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < count; ++i)
    if (marks[i]) out.push_back(i);
  return out;
}

struct NodeLine {
  std::uint32_t file = Span::no_file;
  std::uint64_t line = 0;
};

/// Places of nodes, sorted and each once, in one pass over their blocks.
std::vector<NodeLine> node_places(const Model& model, const Deck& deck,
                                  const std::vector<NodeIndex>& nodes) {
  std::vector<NodeLine> places(nodes.size());
  std::span<const BulkBlock> runs;
  for (std::size_t b = 0; b < model.node_blocks.size(); b += runs.size()) {
    runs = runs_of_block(model.node_blocks, b);
    LineCursor cursor(deck.sources, *runs.front().block);
    std::uint32_t file = Span::no_file;
    std::uint64_t at = 0, line_number = 1, given_back = 0;
    auto run = runs.begin();
    NodeIndex node = run->first;
    auto wanted = std::lower_bound(nodes.begin(), nodes.end(), node);
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      while (run != runs.end() && node == run->first + run->count)
        if (++run != runs.end()) {
          node = run->first;
          wanted = std::lower_bound(nodes.begin(), nodes.end(), node);
        }
      if (run == runs.end() || (runs.size() == 1 && wanted == nodes.end())) break;
      if (line.text.find_first_not_of(' ') == std::string_view::npos) continue;
      const NodeIndex here = node++;
      const bool another = line.file != file || line.offset < at;
      const bool is_wanted = wanted != nodes.end() && *wanted == here;
      if (!is_wanted && !another && line.offset - at < given_back_at_once) continue;
      if (another) {
        file = line.file;
        line_number = deck.sources[file].position(line.offset).line;
        given_back = line.offset;
      } else {
        const std::string_view between = deck.sources[file].bytes().substr(at, line.offset - at);
        line_number += static_cast<std::uint64_t>(std::count(between.begin(), between.end(), '\n'));
      }
      at = line.offset;
      if (at - given_back >= given_back_at_once) {
        deck.sources[file].release(given_back, at);
        given_back = at;
      }
      if (is_wanted)
        places[static_cast<std::size_t>(wanted++ - nodes.begin())] = {file, line_number};
    }
  }
  return places;
}

struct Owner {
  int kind = 0;  ///< ElementKind + 1, 0: none
  std::int64_t id = 0;
  std::uint32_t part = no_index;
};

Owner owner(const Model& model, ElementKind kind, std::uint32_t e) {
  const Elements& family = model.family(kind);
  return {static_cast<int>(kind) + 1, family.id[e], family.part[e]};
}

Owner owner(const Model& model, Carrier carrier, std::uint32_t e) {
  const auto family = family_of_carrier(carrier);
  return family && e != no_index ? owner(model, *family, e) : Owner{};
}

/// Same rule as the views of a scene: the first family that has an element at the node.
Owner owner_of_node(const Model& model, Connectivity& connectivity, NodeIndex node) {
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::beam, ElementKind::truss, ElementKind::spring}) {
    const std::uint32_t e = connectivity.first(kind, node);
    if (e != no_index) return owner(model, kind, e);
  }
  return {};
}

/// The segments or edges of all contacts, numbered as they come, those alike once: contacts share
/// surfaces.
template <class Item>
class Shared {
 public:
  explicit Shared(std::size_t nodes) : newest_(nodes, no_index) {}

  std::vector<std::uint32_t> numbers(const std::vector<Item>& items) {
    std::vector<std::uint32_t> out;
    out.reserve(items.size());
    for (const Item& item : items) out.push_back(number({item.nodes, item.carrier, item.element}));
    return out;
  }
  struct Key {
    decltype(Item::nodes) nodes;
    Carrier carrier;
    std::uint32_t element;
    friend bool operator==(const Key&, const Key&) = default;
  };
  const std::vector<Key>& all() const { return all_; }

 private:
  std::uint32_t number(const Key& key) {
    if (next_ < all_.size() && all_[next_] == key) return next_++;
    std::uint32_t& newest = newest_[key.nodes[0]];
    int few = 16;  // where a node has more, some are repeated
    for (std::uint32_t i = newest; i != no_index && few-- > 0; i = older_[i])
      if (all_[i] == key) {
        next_ = i + 1;
        return i;
      }
    older_.push_back(newest);
    newest = static_cast<std::uint32_t>(all_.size());
    all_.push_back(key);
    return newest;
  }
  std::vector<Key> all_;
  std::vector<std::uint32_t> newest_, older_;  // by first node; before one with the same first node
  std::uint32_t next_ = 0;                     // mostly the same follows as before
};

class Writer {
 public:
  Writer(const HtmlInput& input, PageContacts& page, const PageNodes& nodes)
      : input_(input),
        page_(page),
        nodes_(nodes),
        model_(*input.scene->model),
        connectivity_(model_),
        of_ties_(std::move(page.of_ties)),
        segments_(model_.nodes.size()),
        edges_(model_.nodes.size()) {
    for (std::size_t i = 0; i < page.contacts.size(); ++i) {
      const Contact& c = input.scene->contacts[i];
      chosen_.push_back(choose_items(c, page.contacts[i]));
      main_.push_back(c.kind == ContactKind::node_segment ? segments_.numbers(c.main)
                                                          : edges_.numbers(c.main_edges));
      secondary_.push_back(edges_.numbers(c.secondary_edges));
    }
  }

  /// Nodes to the last bit, segments and edges.
  std::string shared() const {
    ByteStream out;
    exact_coordinates(out);
    shared_items(out, segments_.all());
    shared_items(out, edges_.all());
    return std::move(out).text();
  }

  /// All contacts; the last that is done with `page`.
  std::string contacts() {
    find_places();
    for (std::size_t i = 0; i < page_.contacts.size(); ++i) {
      const Contact& c = input_.scene->contacts[i];
      const PageContact& wide = page_.contacts[i];
      pairs(wide);
      if (c.kind == ContactKind::node_segment)
        node_segment(c, i);
      else
        edges(c, i);
      places(c, chosen_[i].secondary);
      selected(chosen_[i].secondary, wide.plain.secondary_length);
      selected(chosen_[i].main, wide.plain.main_length);
      if (is_modern(c.type)) given(c, wide.given);
    }
    page_ = {};  // meshes are large, too
    return std::move(out_).text();
  }

 private:
  /// The items of a contact of which the page needs more than their nodes.
  struct Chosen {
    std::vector<std::uint32_t> secondary, main;
  };
  static Chosen choose_items(const Contact& c, const PageContact& wide) {
    const bool edge_pairs = c.kind == ContactKind::edge_edge;
    const std::size_t s = edge_pairs ? c.secondary_edges.size() : c.secondary.size();
    const std::size_t m = edge_pairs ? c.main_edges.size() : c.main.size();
    // Removal along the mesh looks at all items.
    if (c.irem_gap == 2) return {everything(s), everything(m)};
    return {distinct(wide.pairs, &CandidatePair::secondary, s),
            distinct(wide.pairs, &CandidatePair::main, m)};
  }

  /// The node by which a chosen item of the secondary side is found in the deck.
  static NodeIndex named_by(const Contact& c, std::uint32_t secondary) {
    return c.kind == ContactKind::node_segment ? c.secondary[secondary].node
                                               : c.secondary_edges[secondary].nodes[0];
  }

  /// Lines of the nodes of all contacts together: blocks of nodes are long.
  void find_places() {
    std::vector<std::uint8_t> wanted(model_.nodes.size(), 0);
    for (std::size_t i = 0; i < page_.contacts.size(); ++i) {
      const Contact& c = input_.scene->contacts[i];
      for (const std::uint32_t s : chosen_[i].secondary) wanted[named_by(c, s)] = 1;
    }
    for (NodeIndex n = 0; n < wanted.size(); ++n)
      if (wanted[n]) named_.push_back(n);
    lines_ = node_places(model_, *input_.deck, named_);
  }

  /// True if Inacti 3 of a contact before can move a node whose place the gaps depend on.
  static bool can_be_moved(const Contact& c, const std::vector<std::uint8_t>& movable) {
    const auto any = [&](const auto& items) {
      for (const auto& item : items)
        for (const NodeIndex n : item.nodes)
          if (movable[n]) return true;
      return false;
    };
    return any(c.main) || any(c.secondary_edges) || any(c.main_edges);
  }

  /// Page nodes whose coordinates are given to the last bit: those of all pairs, and of all items
  /// whose sides are measured: for removal along the mesh, or again once nodes have moved.
  void exact_coordinates(ByteStream& out) const {
    std::vector<std::uint8_t> wanted(nodes_.list().size(), 0);
    const auto use = [&](NodeIndex n) { wanted[nodes_[n]] = 1; };
    std::vector<std::uint8_t> movable(model_.nodes.size(), 0);
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const Contact& c = input_.scene->contacts[i];
      const auto use_items = [&](const auto& items, const std::vector<std::uint32_t>& positions) {
        for (const std::uint32_t k : positions)
          for (const NodeIndex n : items[k].nodes) use(n);
      };
      if (c.kind == ContactKind::node_segment) {
        for (const std::uint32_t s : chosen_[i].secondary) use(c.secondary[s].node);
        use_items(c.main, chosen_[i].main);
      } else {
        use_items(c.secondary_edges, chosen_[i].secondary);
        use_items(c.main_edges, chosen_[i].main);
      }
      const bool measured = c.irem_gap == 2 || can_be_moved(c, movable);
      for (const SecondaryNode& n : c.secondary) movable[n.node] = 1;
      if (!measured) continue;
      for (const MainSegment& m : c.main)
        for (const NodeIndex n : m.nodes) use(n);
      for (const ContactEdge& e : c.main_edges)
        for (const NodeIndex n : e.nodes) use(n);
      for (const ContactEdge& e : c.secondary_edges)
        for (const NodeIndex n : e.nodes) use(n);
    }
    for (const NodeIndex n : of_ties_) use(n);
    std::vector<double> values;
    out.u(static_cast<std::uint64_t>(std::count(wanted.begin(), wanted.end(), 1)));
    Delta d;
    for (std::uint32_t n = 0; n < wanted.size(); ++n)
      if (wanted[n]) out.s(d(n));
    for (const std::vector<double>* axis : {&model_.nodes.x, &model_.nodes.y, &model_.nodes.z}) {
      values.clear();
      for (std::uint32_t n = 0; n < wanted.size(); ++n)
        if (wanted[n]) values.push_back((*axis)[nodes_.list()[n]]);
      out.decimals(values);
    }
  }

  void selected(const std::vector<std::uint32_t>& positions, const std::vector<double>& of_all) {
    std::vector<double> values;
    values.reserve(positions.size());
    for (const std::uint32_t p : positions) values.push_back(of_all[p]);
    out_.f64(values);
  }

  static void owners(ByteStream& out, const std::vector<Owner>& all) {
    Delta part, id;
    for (const Owner& o : all) out.byte(static_cast<unsigned>(o.kind));
    for (const Owner& o : all) out.s(id(o.id));
    for (const Owner& o : all) out.s(part(o.part == no_index ? 0 : std::int64_t{o.part} + 1));
  }

  /// Segments or edges with their elements; contacts name them by number.
  template <class Keys>
  void shared_items(ByteStream& out, const Keys& all) const {
    Delta corner;
    std::vector<Owner> of;
    out.u(all.size());
    for (const auto& item : all) {
      for (const NodeIndex n : item.nodes) out.s(corner(nodes_[n]));
      of.push_back(owner(model_, item.carrier, item.element));
    }
    owners(out, of);
  }

  void numbers(const std::vector<std::uint32_t>& all) {
    Delta number;
    out_.u(all.size());
    for (const std::uint32_t n : all) out_.s(number(n));
  }

  void places(const Contact& c, const std::vector<std::uint32_t>& secondary) {
    Delta file, line;
    for (const std::uint32_t s : secondary) {
      const auto at = std::lower_bound(named_.begin(), named_.end(), named_by(c, s));
      const NodeLine& p = lines_[static_cast<std::size_t>(at - named_.begin())];
      out_.s(file(p.file == Span::no_file ? -1 : std::int64_t{p.file}));
      out_.s(line(static_cast<std::int64_t>(p.line)));
    }
  }

  void node_segment(const Contact& c, std::size_t i) {
    Delta n;
    out_.u(c.secondary.size());
    for (const SecondaryNode& s : c.secondary) out_.s(n(nodes_[s.node]));
    const bool formed = is_modern(c.type);  // the gaps stand in place of thicknesses
    out_.palette(page_.contacts[i].plain.half_thickness,
                 [&](double half) { return formed ? half : node_gap(half, 1); });
    numbers(main_[i]);
    out_.palette(c.main, [&](const MainSegment& m) { return formed ? m.gap : thickness_of(m); });
    std::vector<Owner> of;
    for (const std::uint32_t s : chosen_[i].secondary)
      of.push_back(owner_of_node(model_, connectivity_, c.secondary[s].node));
    owners(out_, of);
  }

  void edges(const Contact& c, std::size_t i) {
    const auto thickness = [&](const ContactEdge& e) {
      return is_modern(c.type) ? e.gap : thickness_of(e);
    };
    numbers(secondary_[i]);
    out_.palette(c.secondary_edges, thickness);
    numbers(main_[i]);
    out_.palette(c.main_edges, thickness);
  }

  /// How many pairs, then each secondary with the number of its pairs, then all mains.
  void pairs(const PageContact& wide) {
    const auto& all = wide.pairs;
    Delta secondary, main;
    out_.u(all.size());
    for (auto p = all.begin(), next = p; p != all.end(); p = next) {
      next = std::find_if(p, all.end(),
                          [&](const CandidatePair& q) { return q.secondary != p->secondary; });
      out_.s(secondary(p->secondary));
      out_.u(static_cast<std::uint64_t>(next - p));
    }
    for (const CandidatePair& p : all) out_.s(main(p.main));
  }

  /// What was found of a contact for which the page has no rules, one number after the other.
  void given(const Contact& c, const std::vector<std::uint32_t>& rows) {
    const auto column = [&](const auto& value) {
      std::vector<double> values;
      for (const std::uint32_t r : rows) values.push_back(value(c.penetrations[r]));
      out_.f64(values);
    };
    using Row = PenetrationRow;
    column([](const Row& r) { return r.depth; });
    column([](const Row& r) { return r.gap; });
    column([](const Row& r) { return r.distance; });
    for (std::size_t k = 0; k < 3; ++k) column([k](const Row& r) { return r.normal[k]; });
    column([](const Row& r) { return r.weight_s; });
    column([](const Row& r) { return r.p0; });
    for (const std::uint32_t r : rows) out_.byte(static_cast<unsigned>(c.penetrations[r].action));
  }

  const HtmlInput& input_;
  PageContacts& page_;
  const PageNodes& nodes_;
  const Model& model_;
  Connectivity connectivity_;
  std::vector<NodeIndex> of_ties_;
  Shared<MainSegment> segments_;
  Shared<ContactEdge> edges_;
  ByteStream out_;                                            // of contacts()
  std::vector<Chosen> chosen_;                                // by contact
  std::vector<std::vector<std::uint32_t>> secondary_, main_;  // by contact: numbers of shared items
  std::vector<NodeIndex> named_;                              // ascending
  std::vector<NodeLine> lines_;                               // of these
};

}  // namespace

PageContacts collect_contacts(const HtmlInput& input, PageNodes& nodes) {
  PageContacts page;
  const Scene& scene = *input.scene;
  const Nodes& nodes_of_deck = scene.model->nodes;
  if (scene.coordinates.x != nodes_of_deck.x || scene.coordinates.y != nodes_of_deck.y ||
      scene.coordinates.z != nodes_of_deck.z)
    page.before_moves = {nodes_of_deck.x, nodes_of_deck.y, nodes_of_deck.z};
  const Coordinates& start = page.start(scene);
  std::vector<PlainSides> plain(scene.contacts.size());
  {
    const int threads = effective_threads(input.threads);
    Connectivity connectivity(*scene.model);
    ShellsAtNodes shells;
    const std::vector<double> lines = shortest_line_elements(*scene.model, start);
    const Surroundings around{*scene.model, connectivity, shells, start, threads, &lines};
    // Formed before several threads read it.
    for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring})
      connectivity.prepare(kind);
    shell_half_thickness(around);
    parallel_items(threads, plain.size(), [&](std::size_t i) {
      const Contact& c = scene.contacts[i];
      plain[i] = is_modern(c.type) ? formed_sides(c, start) : plain_sides(around, c);
    });
  }
  std::size_t left = pairs_per_page;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Contact& c = scene.contacts[i];
    const std::size_t share = left / (scene.contacts.size() - i);
    page.contacts.push_back(wide_pairs(c, std::move(plain[i]), start, input.threads,
                                       std::clamp(4 * share, pairs_at_least, pairs_at_most)));
    left -= std::min(left, page.contacts.back().pairs.size());
    for (const SecondaryNode& s : c.secondary) nodes.use(s.node);
    for (const MainSegment& m : c.main)
      for (const NodeIndex n : m.nodes) nodes.use(n);
    for (const auto* side : {&c.secondary_edges, &c.main_edges})
      for (const ContactEdge& e : *side)
        for (const NodeIndex n : e.nodes) nodes.use(n);
  }
  return page;
}

ContactBlocks contact_blocks(const HtmlInput& input, PageContacts& page, const PageNodes& nodes) {
  const auto writer = std::make_shared<Writer>(input, page, nodes);
  return {[writer] { return writer->shared(); }, [writer] { return writer->contacts(); }};
}

}  // namespace deck::detail
