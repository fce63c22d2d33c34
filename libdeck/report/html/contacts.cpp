// Contacts in the page: penetrations as found, and, if the page can try settings, all pairs within
// a given reach, with distances and inputs of their gaps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/shared/closest.hpp"
#include "contact/shared/node_elements.hpp"
#include "contact/shared/scene_steps.hpp"
#include "contact/shared/sides.hpp"
#include "deck/contacts.hpp"
#include "model/shared/item_spans.hpp"
#include "report/html/page_steps.hpp"

namespace deck::detail {
namespace {

constexpr std::size_t pairs_per_page = 2000000;
constexpr std::size_t pairs_at_least = 60000;  // per contact
constexpr std::size_t pairs_at_most = 3000000;
constexpr std::size_t penetrations_kept = 200000;  // per contact with too many pairs
constexpr double reach_factors[] = {1.5, 1.1};     // of the largest gap; less if pairs are too many
constexpr double farthest_factor = 3;              // without penetrations

/// Largest gap of the interface: present, by thickness, or default.
double expected_gap(const Model& model, const Contact& contact, const PlainSides& plain) {
  double s = 0, m = 0;
  if (contact.type != 10) {
    for (const double half : plain.half_thickness) s = std::max(s, half);
    const auto half = [&](const auto& n) { return edge_gap(contact_thickness(model, n)); };
    for (const MainSegment& n : contact.main) m = std::max(m, half(n));
    for (const ContactEdge& n : contact.secondary_edges) s = std::max(s, half(n));
    for (const ContactEdge& n : contact.main_edges) m = std::max(m, half(n));
  }
  return std::max({contact.max_gap, contact.gapmin, s + m});
}

/// Sides of a contact with final gaps.
PlainSides formed_sides(const Contact& contact, const Coordinates& x) {
  PlainSides out;
  for (const SecondaryNode& s : contact.secondary) out.half_thickness.push_back(s.gap);
  out.secondary_length = contact.secondary_length;
  out.secondary_length.resize(contact.secondary.size() + contact.secondary_edges.size());
  out.main_length = contact.main_length;
  out.main_length.resize(contact.main.size() + contact.main_edges.size());
  out.shortest_side = contact.shortest_side;
  out.secondary_side = edge_side(x, contact.secondary_edges);
  out.main_side = edge_side(x, contact.main_edges);
  return out;
}

/// Reason in the cards why the page cannot try settings of a contact; empty if it can. `moves`:
/// Inacti 3 of this or an earlier contact moves nodes.
const char* why_fixed(const Contact& contact, const std::vector<WhatIf>& what_if, bool moves) {
  if (is_type24_or_25(contact.type))
    return "other settings decide anew which segment a node is paired with";
  if (moves) return "Inacti 3 moves nodes, of this interface or of one before it";
  if (contact.irem_gap == 2) return "Irem_gap 2 leaves out pairs by their distance along the mesh";
  if (!contact.evaluated) return "it was not evaluated";
  for (const WhatIf& w : what_if)
    if (w.interface_id == contact.inter->id && (w.Fpenmax || w.mesh_size || w.Inacti || w.Irem_gap))
      return "the page was written with --what-if of a field that it cannot try";
  return "";
}

/// Pairs nearer than `reach`; nothing if they are more than `limit`.
std::optional<std::vector<CandidatePair>> pairs_within(const SearchSides& sides,
                                                       const Coordinates& x, double reach,
                                                       int threads, std::size_t limit) {
  if (!(reach > 0) || !std::isfinite(reach)) return {};
  SearchOptions search;
  search.threads = threads;
  search.max_pairs = limit;
  search.gap = PairGap::constant(reach);
  SearchResult found = sides.find(x, search);
  if (!found.complete) return {};
  return std::move(found.pairs);
}

struct Measured {
  double distance = 0, gap = 0;
  /// Earlier sub-triangles whose distance equals the smallest within round-off: at equal depth the
  /// solver reports the first.
  std::vector<double> others = {};
};

Measured measured(const Contact& c, const Coordinates& x, const CandidatePair& p, double reach) {
  Measured out;
  if (c.kind == ContactKind::edge_edge) {
    const ContactEdge &s = c.secondary_edges[p.secondary], &m = c.main_edges[p.main];
    out.gap = c.pair_gap(p.secondary, p.main);
    out.distance = closest_between_edges<Form::reference>(at(x, s.nodes[0]), at(x, s.nodes[1]),
                                                          at(x, m.nodes[0]), at(x, m.nodes[1]))
                       .distance;
    return out;
  }
  const SecondaryNode& s = c.secondary[p.secondary];
  const MainSegment& m = c.main[p.main];
  out.gap = c.pair_gap(p.secondary, p.main);
  const auto closest = closest_on_segment<Form::reference>(
      at(x, s.node), {at(x, m.nodes[0]), at(x, m.nodes[1]), at(x, m.nodes[2]), at(x, m.nodes[3])},
      m.nodes[2] == m.nodes[3]);
  out.distance = closest.distance();
  for (int k = 0; k < closest.best; ++k)
    if (const double d = closest.sub[static_cast<std::size_t>(k)].distance;
        d - out.distance <= 0x1p-52 * reach)
      out.others.push_back(d);
  return out;
}

/// Calls take(pair, measured) for all pairs, in order.
template <class Take>
void measure(const Contact& contact, const Coordinates& x, std::span<const CandidatePair> pairs,
             double reach, int threads, const Take& take) {
  constexpr std::size_t at_once = 4096;
  run_in_order<std::vector<Measured>>((pairs.size() + at_once - 1) / at_once, threads,
                                      [&](std::size_t piece, std::vector<Measured>& out) {
                                        out.clear();
                                        const std::size_t end =
                                            std::min(pairs.size(), (piece + 1) * at_once);
                                        for (std::size_t i = piece * at_once; i < end; ++i)
                                          out.push_back(measured(contact, x, pairs[i], reach));
                                      },
                                      [&](std::size_t piece, const std::vector<Measured>& all) {
                                        for (std::size_t k = 0; k < all.size(); ++k)
                                          take(pairs[piece * at_once + k], all[k]);
                                      });
}

/// Adds all near pairs; for a contact without penetrations also its nearest pair, if it is within a
/// few times `gap` and the pairs so near are no more than `limit`.
void carry_pairs(const Contact& contact, const SearchSides& sides, const Coordinates& x, double gap,
                 int threads, std::size_t limit, PageContact& page) {
  CandidatePair nearest;
  double room = std::numeric_limits<double>::infinity(), distance = 0;
  const auto look = [&](const CandidatePair& pair, const Measured& m) {
    if (!(m.distance - m.gap < room)) return;
    room = m.distance - m.gap;
    nearest = pair;
    distance = m.distance;
  };
  const auto carry = [&](const CandidatePair& pair, const Measured& m) {
    look(pair, m);
    for (const double d : m.others)
      page.others.emplace_back(static_cast<std::uint32_t>(page.pairs.size()), d);
    page.pairs.push_back(pair);
    page.distance.push_back(m.distance);
  };
  measure(contact, x, page.near, page.reach, threads, carry);
  // No pair beyond a reach has less room than the reach less the largest gap.
  if (!contact.penetrations.empty() || room <= page.reach - contact.max_gap) return;
  const double margin = sides.edge_pairs() ? 0 : sides.margin(x);
  const double farthest = farthest_factor * gap + (std::isfinite(margin) ? margin : 0);
  if (!std::isfinite(farthest)) return;
  sides.find_nearest(x, std::min(farthest, room + contact.max_gap), limit,
                     [&](const CandidatePair& pair) {
                       look(pair, measured(contact, x, pair, page.reach));
                       return room + contact.max_gap;
                     });
  if (!std::isfinite(room) || std::binary_search(page.near.begin(), page.near.end(), nearest))
    return;
  page.near.push_back(nearest);
  page.pairs.push_back(nearest);
  page.distance.push_back(distance);
}

/// Adds the penetrations, and their pairs if missing.
void carry_rows(const Contact& contact, PageContact& page) {
  const std::size_t sorted = page.pairs.size();
  for (const std::uint32_t r : page.rows) {
    const PenetrationRow& row = contact.penetrations[r];
    const CandidatePair pair{row.secondary, row.main};
    const auto end = page.pairs.begin() + static_cast<std::ptrdiff_t>(sorted);
    const auto found = std::lower_bound(page.pairs.begin(), end, pair);
    const bool known = found != end && *found == pair;
    page.pair_of.push_back(
        static_cast<std::uint32_t>((known ? found : page.pairs.end()) - page.pairs.begin()));
    if (known) continue;
    page.pairs.push_back(pair);
    page.distance.push_back(row.distance);
  }
}

PageContact page_contact(const Model& model, const Contact& contact, PlainSides plain,
                         const Coordinates& x, int threads, std::size_t limit, const char* fixed) {
  PageContact page;
  page.plain = std::move(plain);
  page.fixed = fixed;
  const SearchSides sides(contact, SearchSides::Off::included, threads);
  const double gap = expected_gap(model, contact, page.plain);
  const bool modern = is_type24_or_25(contact.type);
  std::optional<std::vector<CandidatePair>> near;
  for (const double factor : reach_factors) {
    if (near || modern || contact.candidates > limit) break;
    page.reach = factor * (contact.max_gap > 0 ? std::min(gap, contact.max_gap) : gap);
    near = pairs_within(sides, x, page.reach, threads, limit);
  }
  if (!near) page.reach = 0;
  if (!near && !modern && gap > 0 && *page.fixed == 0)
    page.fixed = "it has too many pairs for a page, or a gap without bound";
  if (near) page.near = std::move(*near);
  if (*page.fixed == 0 && !contact.dropped)
    carry_pairs(contact, sides, x, gap, threads, limit, page);
  const auto& found = contact.penetrations;
  page.complete = *page.fixed == 0 || found.size() <= penetrations_kept;
  page.rows.resize(found.size());
  std::iota(page.rows.begin(), page.rows.end(), 0u);
  if (!page.complete)
    keep_largest(page.rows, penetrations_kept, [&](std::uint32_t r) { return found[r].depth; });
  carry_rows(contact, page);
  return page;
}

/// Sorted distinct positions of one side of the pairs; the side has `count` items.
std::vector<std::uint32_t> distinct(const std::vector<CandidatePair>& pairs,
                                    std::uint32_t CandidatePair::*side, std::size_t count) {
  std::vector<std::uint8_t> marks(count, 0);
  for (const CandidatePair& p : pairs) marks[p.*side] = 1;
  return marked(marks);
}

/// Distinct segments or edges of all contacts, numbered in order of appearance: contacts share
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
    int few = 16;  // a node with more has some repeated
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
  std::vector<std::uint32_t> newest_, older_;  // by first node; predecessor with this first node
  std::uint32_t next_ = 0;                     // the sequence mostly repeats
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
      const bool edge_pairs = c.kind == ContactKind::edge_edge;
      const auto& pairs = page.contacts[i].pairs;
      chosen_.push_back({distinct(pairs, &CandidatePair::secondary,
                                  edge_pairs ? c.secondary_edges.size() : c.secondary.size()),
                         distinct(pairs, &CandidatePair::main,
                                  edge_pairs ? c.main_edges.size() : c.main.size())});
      main_.push_back(c.kind == ContactKind::node_segment ? segments_.numbers(c.main)
                                                          : edges_.numbers(c.main_edges));
      secondary_.push_back(edges_.numbers(c.secondary_edges));
    }
  }

  /// Exact coordinates, segments and edges.
  std::string shared() const {
    ByteStream out;
    exact_coordinates(out);
    shared_items(out, segments_.all());
    shared_items(out, edges_.all());
    return std::move(out).text();
  }

  /// All contacts; the last user of `page`.
  std::string contacts() {
    find_places();
    for (std::size_t i = 0; i < page_.contacts.size(); ++i) {
      const Contact& c = input_.scene->contacts[i];
      const PageContact& page = page_.contacts[i];
      pairs(page);
      if (c.kind == ContactKind::node_segment)
        node_segment(c, i);
      else
        edges(c, i);
      places(c, chosen_[i].secondary);
      selected(chosen_[i].secondary, page.plain.secondary_length);
      selected(chosen_[i].main, page.plain.main_length);
      rows(c, page);
    }
    page_ = {};  // meshes are large, too
    return std::move(out_).text();
  }

 private:
  /// Items of a contact of which the page needs more than nodes.
  struct Chosen {
    std::vector<std::uint32_t> secondary, main;
  };

  static std::span<const NodeIndex> secondary_nodes(const Contact& c, std::uint32_t s) {
    if (c.kind == ContactKind::node_segment) return {&c.secondary[s].node, 1};
    return c.secondary_edges[s].nodes;
  }
  static std::span<const NodeIndex> main_nodes(const Contact& c, std::uint32_t m) {
    if (c.kind == ContactKind::node_segment) return c.main[m].nodes;
    return c.main_edges[m].nodes;
  }

  void find_places() {
    places_.resize(model_.nodes.size());
    std::span<const BulkBlock> runs;
    for (std::size_t b = 0; b < model_.node_blocks.size(); b += runs.size()) {
      runs = runs_of_block(model_.node_blocks, b);
      for_each_item_place(*input_.deck, runs, [&](NodeIndex n, ItemPlace at) { places_[n] = at; });
    }
  }

  /// Nodes with coordinates to the last bit: those of pairs and ties.
  void exact_coordinates(ByteStream& out) const {
    std::vector<std::uint8_t> wanted(nodes_.list().size(), 0);
    const auto use = [&](NodeIndex n) { wanted[nodes_[n]] = 1; };
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const Contact& c = input_.scene->contacts[i];
      for (const std::uint32_t k : chosen_[i].secondary)
        for (const NodeIndex n : secondary_nodes(c, k)) use(n);
      for (const std::uint32_t k : chosen_[i].main)
        for (const NodeIndex n : main_nodes(c, k)) use(n);
    }
    for (const NodeIndex n : of_ties_) use(n);
    const std::vector<std::uint32_t> exact = marked(wanted);
    std::vector<double> values;
    out.u(exact.size());
    Delta d;
    for (const std::uint32_t n : exact) out.s(d(n));
    for (const std::vector<double>* axis : {&model_.nodes.x, &model_.nodes.y, &model_.nodes.z}) {
      values.clear();
      for (const std::uint32_t n : exact) values.push_back((*axis)[nodes_.list()[n]]);
      out.decimals(values);
    }
  }

  void selected(const std::vector<std::uint32_t>& positions, const std::vector<double>& of_all) {
    std::vector<double> values;
    for (const std::uint32_t p : positions) values.push_back(of_all[p]);
    out_.f64(values);
  }

  void owners(ByteStream& out, const std::vector<ElementName>& all) const {
    Delta part, id;
    for (const ElementName& e : all) out.byte(e.valid() ? static_cast<unsigned>(e.kind) + 1 : 0);
    for (const ElementName& e : all) out.s(id(e.id));
    for (const ElementName& e : all) out.s(part(part_position(model_, e) + 1));
  }

  /// Segments or edges with their elements; contacts refer to them by number.
  template <class Keys>
  void shared_items(ByteStream& out, const Keys& all) const {
    Delta corner;
    std::vector<ElementName> of;
    out.u(all.size());
    for (const auto& item : all) {
      for (const NodeIndex n : item.nodes) out.s(corner(nodes_[n]));
      of.push_back(carrier_name(model_, item.carrier, item.element));
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
      const ItemPlace& at = places_[secondary_nodes(c, s)[0]];
      out_.s(file(at.file == Span::no_file ? -1 : std::int64_t{at.file}));
      out_.s(line(at.line));
    }
  }

  /// Final gaps replace thicknesses.
  template <class Items>
  void thicknesses(const Contact& c, const Items& items) {
    out_.palette(items, [&](const auto& n) {
      return is_type24_or_25(c.type) ? n.gap : contact_thickness(model_, n);
    });
  }

  void node_segment(const Contact& c, std::size_t i) {
    Delta n;
    out_.u(c.secondary.size());
    for (const SecondaryNode& s : c.secondary) out_.s(n(nodes_[s.node]));
    out_.palette(page_.contacts[i].plain.half_thickness, [](double half) { return half; });
    numbers(main_[i]);
    thicknesses(c, c.main);
    std::vector<ElementName> of;
    for (const std::uint32_t s : chosen_[i].secondary)
      of.push_back(element_at(model_, connectivity_, c.secondary[s].node));
    owners(out_, of);
  }

  void edges(const Contact& c, std::size_t i) {
    numbers(secondary_[i]);
    thicknesses(c, c.secondary_edges);
    numbers(main_[i]);
    thicknesses(c, c.main_edges);
  }

  /// Number of pairs; pairs per secondary; all mains; all distances; other distances with the
  /// position of their pair.
  void pairs(const PageContact& page) {
    const auto& all = page.pairs;
    Delta secondary, main, at;
    out_.u(all.size());
    for (auto p = all.begin(), next = p; p != all.end(); p = next) {
      next = std::find_if(p, all.end(),
                          [&](const CandidatePair& q) { return q.secondary != p->secondary; });
      out_.s(secondary(p->secondary));
      out_.u(static_cast<std::uint64_t>(next - p));
    }
    for (const CandidatePair& p : all) out_.s(main(p.main));
    out_.f64(page.distance);
    out_.u(page.others.size());
    for (const auto& [pair, distance] : page.others) out_.s(at(pair));
    std::vector<double> others;
    for (const auto& [pair, distance] : page.others) others.push_back(distance);
    out_.f64(others);
  }

  /// Penetrations in the page, column by column.
  void rows(const Contact& c, const PageContact& page) {
    const auto column = [&](const auto& value) {
      std::vector<double> values;
      for (const std::uint32_t r : page.rows) values.push_back(value(c.penetrations[r]));
      out_.f64(values);
    };
    using Row = PenetrationRow;
    Delta pair;
    out_.u(page.rows.size());
    for (const std::uint32_t p : page.pair_of) out_.s(pair(p));
    out_.palette(page.rows, [&](std::uint32_t r) { return c.penetrations[r].gap; });
    if (is_type24_or_25(c.type))
      column([](const Row& r) { return r.depth; });  // else gap - distance
    for (std::size_t k = 0; k < 3; ++k) column([k](const Row& r) { return r.normal[k]; });
    if (c.kind == ContactKind::edge_edge) column([](const Row& r) { return r.weight_s; });
    column([](const Row& r) {  // 1 if Inacti 3 moves the node
      const bool moved = r.action == PenetrationAction::node_moved;
      return moved ? (r.moved_by != std::array<double, 3>{} ? 1 : 0) : r.p0;
    });
    for (const std::uint32_t r : page.rows)
      out_.byte(static_cast<unsigned>(c.penetrations[r].action));
  }

  const HtmlInput& input_;
  PageContacts& page_;
  const PageNodes& nodes_;
  const Model& model_;
  Connectivity connectivity_;
  std::vector<NodeIndex> of_ties_;
  Shared<MainSegment> segments_;
  Shared<ContactEdge> edges_;
  ByteStream out_;                                            // for contacts()
  std::vector<Chosen> chosen_;                                // by contact
  std::vector<std::vector<std::uint32_t>> secondary_, main_;  // by contact: numbers of shared items
  std::vector<ItemPlace> places_;                             // by node
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
  const int threads = effective_threads(input.threads);
  {
    Connectivity connectivity(*scene.model);
    ElementTables shells;
    const std::vector<double> lines = shortest_line_elements(*scene.model, start);
    const GapInputs around{*scene.model, connectivity, shells, start, threads, &lines};
    // Built before several threads read it.
    for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring})
      connectivity.prepare(kind);
    shell_half_thickness(around);
    parallel_items(threads, plain.size(), [&](std::size_t i) {
      const Contact& c = scene.contacts[i];
      plain[i] = is_type24_or_25(c.type) ? formed_sides(c, start) : plain_sides(around, c);
    });
  }
  std::size_t left = pairs_per_page;
  bool moves = false;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Contact& c = scene.contacts[i];
    moves |= c.kind == ContactKind::node_segment && !is_type24_or_25(c.type) && c.inacti == 3;
    const std::size_t share = left / (scene.contacts.size() - i);
    page.contacts.push_back(page_contact(*scene.model, c, std::move(plain[i]), start, threads,
                                         std::clamp(4 * share, pairs_at_least, pairs_at_most),
                                         why_fixed(c, input.what_if, moves)));
    left -= std::min(left, page.contacts.back().near.size());
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
