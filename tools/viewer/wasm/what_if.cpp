// The what-if of the HTML report: contacts evaluated at other settings from the pairs that the page
// carries, by the rules of libdeck/contact/rules. Compiled to WebAssembly by the script `build`
// beside it. Page and module exchange doubles; the order of the structs below is that of
// src/core.ts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/rules/actions.hpp"
#include "contact/rules/gaps.hpp"
#include "contact/rules/settings.hpp"
#include "contact/shared/removal.hpp"

namespace {

using namespace deck;
using namespace deck::detail;

struct SamplesInput {
  double count, sum, smallest, largest, shortest;
};

/// One contact. Addresses are doubles too; arrays of nodes hold positions among the exact ones.
struct ContactInput {
  double edges, type, interface_type, shortest_side, longest_main, longest_secondary, margin;
  double gapmin, igap, inacti, irem_gap, fscalegap, gapmax, fpenmax, thermal, drad, edge_scale_gap;
  SamplesInput main_samples, secondary_samples;  // of node-segment contacts only the first
  double secondaries, mains, pairs;
  double secondary_node, main_node;            // uint32: 1 or 2 and 4 or 2 an item
  double secondary_thickness, main_thickness;  // nodes: half, all others whole
  double secondary_length, main_length;
  double pair_secondary, pair_main;  // uint32
};

/// Other settings; what is no number is as on the card.
struct ChangeInput {
  double gapmin, fscalegap, gapmax, fpenmax, igap, inacti;
};

struct ResultOutput {
  double igap, inacti, irem_gap, fpenmax, scale, gapmin, gapmin_origin, gapmax, largest_gap, drad;
  double reached;    // largest gap of a pair
  double uncertain;  // 1: nodes have moved, and lengths that the page cannot measure with them
  double rows, rows_address;  // RowOutput
};

struct RowOutput {
  double secondary, main, depth, gap, distance, normal[3], on_surface, action, has_gap0, gap0, p0;
  double moved_by[3], weight;
};

template <class T>
std::span<const T> list(double address, double count) {
  return {reinterpret_cast<const T*>(static_cast<std::uintptr_t>(address)),
          static_cast<std::size_t>(count)};
}

using Segment4 = std::array<std::uint32_t, 4>;
using Edge2 = std::array<std::uint32_t, 2>;

struct Contact {
  explicit Contact(const ContactInput& in)
      : input(in),
        edges(in.edges != 0),
        pair_secondary(list<std::uint32_t>(in.pair_secondary, in.pairs)),
        pair_main(list<std::uint32_t>(in.pair_main, in.pairs)),
        length_s(list<double>(in.secondary_length, in.secondaries)),
        length_m(list<double>(in.main_length, in.mains)) {
    const auto s = in.secondary_node, m = in.main_node;
    if (edges) {
      edges_s = list<Edge2>(s, in.secondaries);
      edges_m = list<Edge2>(m, in.mains);
    } else {
      nodes = list<std::uint32_t>(s, in.secondaries);
      segments = list<Segment4>(m, in.mains);
    }
  }
  ContactInput input;
  bool edges;
  std::span<const std::uint32_t> pair_secondary, pair_main;
  std::span<const double> length_s, length_m;
  std::span<const std::uint32_t> nodes;
  std::span<const Segment4> segments;
  std::span<const Edge2> edges_s, edges_m;
};

struct Module {
  std::size_t node_count = 0;
  std::vector<double> start, now;  // x of all nodes, then y, then z
  double largest = 0;              // coordinate of `start`
  std::vector<Contact> contacts;
  std::vector<PenetrationRow> rows;
  std::vector<RowOutput> output;
  std::vector<double> gap_s, gap_m;  // of the sides, of the contact evaluated last
  double exchange[64] = {};

  std::span<double> axis(std::size_t k) { return {now.data() + k * node_count, node_count}; }
  MovableNodes movable() { return {axis(0), axis(1), axis(2)}; }
  NodeArrays arrays() { return {axis(0), axis(1), axis(2)}; }
  Point3<double> point(std::uint32_t n) const {
    return {now[n], now[node_count + n], now[2 * node_count + n]};
  }
};
Module module;

/// What the geometry stage measures where the nodes are when it comes to a contact.
struct Measures {
  EdgeSide main, secondary;
  double shortest_side = 0, margin = 0;
  bool moved = false;  ///< a contact before has moved a node of it
};

/// Effective settings of a contact, as the geometry stage forms them.
struct Settings {
  CardSettings card;
  double scale = 1, gapmax = no_gap_limit, largest = 0, drad = 0;
  DefaultGap gapmin;
  PairGap rule;
  Measures measures;
};

CardSettings card_of(const Contact& c, const ChangeInput& change) {
  const ContactInput& in = c.input;
  CardSettings card;
  card.igap = static_cast<int>(in.igap);
  card.inacti = static_cast<int>(in.inacti);
  card.irem_gap = static_cast<int>(in.irem_gap);
  card.gapmin = in.gapmin;
  card.gap_scale = in.fscalegap;
  card.gapmax = in.gapmax;
  card.fpenmax = in.fpenmax;
  card.thermal = in.thermal != 0;
  card.drad = in.drad;
  WhatIf w;
  const auto take = [](double from, auto& to) {
    if (!std::isnan(from)) to = static_cast<std::decay_t<decltype(*to)>>(from);
  };
  take(change.gapmin, w.Gapmin);
  take(change.fscalegap, w.Fscalegap);
  take(change.gapmax, w.Gapmax);
  take(change.fpenmax, w.Fpenmax);
  take(change.igap, w.Igap);
  take(change.inacti, w.Inacti);
  const int type = static_cast<int>(in.interface_type);
  apply(w, type, card);
  if (type == 19 && c.edges) adapt_to_type19_edges(card, in.edge_scale_gap);
  if (type == 19 && !c.edges) adapt_to_type19_nodes(card);
  return card;
}

EdgeSide side_of(const SamplesInput& in) {
  return {{static_cast<std::size_t>(in.count), in.sum, in.smallest, in.largest}, in.shortest};
}

template <std::size_t N>
bool any_moved(std::span<const std::array<std::uint32_t, N>> items) {
  const std::size_t n = module.node_count;
  for (const auto& item : items)
    for (const std::uint32_t i : item)
      for (std::size_t k = 0; k < 3; ++k)
        if (module.now[k * n + i] != module.start[k * n + i]) return true;
  return false;
}

Measures measures_of(const Contact& c, double moved) {
  Measures m{side_of(c.input.main_samples), side_of(c.input.secondary_samples),
             c.input.shortest_side, c.input.margin};
  if (moved == 0) return m;
  const NodeArrays x = module.arrays();
  if (c.edges) {
    m.moved = any_moved(c.edges_s) || any_moved(c.edges_m);
    if (!m.moved) return m;
    m.main.shortest = shortest_side(x, c.edges_m);
    m.secondary.shortest = shortest_side(x, c.edges_s);
    m.shortest_side = shortest_of_both(m.main, m.secondary);
  } else if (any_moved(c.segments)) {
    m.moved = true;
    m.shortest_side = shortest_side(x, c.segments);
    m.margin = candidate_margin(x, c.segments);
  }
  return m;
}

/// Fills the gaps of both sides; they are 0 with a constant gap.
SideExtremes side_gaps(const Contact& c, const Settings& s) {
  const auto ts = list<double>(c.input.secondary_thickness, c.input.secondaries);
  const auto tm = list<double>(c.input.main_thickness, c.input.mains);
  module.gap_s.assign(ts.size(), 0);
  module.gap_m.assign(tm.size(), 0);
  SideExtremes out;
  if (s.card.igap != 0) {
    for (std::size_t i = 0; i < ts.size(); ++i)
      module.gap_s[i] = c.edges ? edge_gap(ts[i]) : node_gap(ts[i], s.scale);
    for (std::size_t i = 0; i < tm.size(); ++i)
      module.gap_m[i] = c.edges ? edge_gap(tm[i]) : segment_gap(tm[i], s.scale);
    for (const double g : module.gap_s)
      out.thickest_secondary = std::max(out.thickest_secondary, g);
    for (const double g : module.gap_m) out.thickest_main = std::max(out.thickest_main, g);
  }
  out.longest_main = c.input.longest_main;
  out.longest_secondary = c.input.longest_secondary;
  return out;
}

Settings settings_of(const Contact& c, const ChangeInput& change, double moved) {
  Settings s;
  s.measures = measures_of(c, moved);
  s.card = card_of(c, change);
  s.scale = gap_scale_of(s.card, c.edges);
  s.gapmax = gapmax_of(s.card, c.edges);
  const bool variable = s.card.igap != 0;
  if (s.card.gapmin > 0)
    s.gapmin = {s.card.gapmin, GapminOrigin::card};
  else if (c.edges)
    s.gapmin = default_edge_gap(s.measures.main, s.measures.secondary, variable);
  else
    s.gapmin = default_gap(s.measures.main.thickness, s.measures.shortest_side,
                           variable && c.input.type != 10, s.scale);
  const double gapmin = s.gapmin.value;
  const SideExtremes sides = side_gaps(c, s);
  s.largest =
      c.edges ? largest_edge_gap(gapmin, sides) : largest_gap(s.card.igap, gapmin, s.gapmax, sides);
  s.drad = radiation_distance(s.card.thermal, s.card.drad, s.largest, s.measures.shortest_side);
  s.rule = PairGap::from_igap(s.card.igap, gapmin,
                              c.edges ? std::numeric_limits<double>::infinity() : s.gapmax);
  return s;
}

/// The pairs of one contact at one setting.
class Pairs {
 public:
  Pairs(const Contact& contact, const Settings& settings, double moved)
      : c_(contact), s_(settings), largest_(module.largest + moved) {}

  void run() {
    module.rows.clear();
    if (s_.card.irem_gap == 2) find_removed();
    c_.edges ? edge_rows() : node_rows();
  }

  /// The pair with the least room left beyond its gap; none where the contact has no pairs.
  std::optional<PenetrationRow> nearest() {
    if (s_.card.irem_gap == 2) find_removed();
    std::optional<PenetrationRow> out;
    for (std::size_t p = 0; p < c_.pair_main.size(); ++p) {
      const double g = gap(p);
      if (out && apart(p, g + (out->distance - out->gap))) continue;
      if (is_out(p)) continue;
      PenetrationRow row = measured(p, g);
      if (!c_.edges) row.distance = node_distance(p);
      if (!out || row.distance - g < out->distance - out->gap) out = row;
    }
    return out;
  }

  double gap(std::size_t p) const {
    const auto s = c_.pair_secondary[p], m = c_.pair_main[p];
    return s_.rule(module.gap_s[s], module.gap_m[m], c_.length_s[s], c_.length_m[m]);
  }

 private:
  /// Whether a pair is at least this far apart for sure: a look at the boxes round its two sides.
  /// Round-off makes distances shorter by a few units in the last place of the coordinates.
  bool apart(std::size_t p, double distance) const {
    const double limit = distance * (1 + 0x1p-40) + (largest_ * 0x1p-42 + 0x1p-500);
    const auto s = c_.pair_secondary[p], m = c_.pair_main[p];
    return c_.edges ? boxes_apart(c_.edges_s[s], c_.edges_m[m], limit)
                    : boxes_apart(std::array{c_.nodes[s]}, c_.segments[m], limit);
  }
  template <class Nodes, class OtherNodes>
  static bool boxes_apart(const Nodes& nodes, const OtherNodes& others, double limit) {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double* const x = module.now.data() + k * module.node_count;
      const auto [low, high] = range(x, nodes);
      const auto [other_low, other_high] = range(x, others);
      const double d = std::max(0.0, std::max(low - other_high, other_low - high));
      squared += d * d;
      if (squared >= limit * limit) return true;  // mostly the first axis tells
    }
    return limit <= 0;
  }
  template <class Nodes>
  static std::pair<double, double> range(const double* x, const Nodes& nodes) {
    double low = x[nodes[0]], high = low;
    for (const std::uint32_t n : nodes) {
      low = std::min(low, x[n]);
      high = std::max(high, x[n]);
    }
    return {low, high};
  }

  void find_removed() {
    const RemovalGaps gaps{s_.rule, s_.card.igap, s_.drad, s_.largest, s_.measures.shortest_side};
    constexpr std::uint64_t any_number = std::numeric_limits<std::uint64_t>::max();
    if (c_.edges) {
      const EdgeEdgeInput in{module.arrays(), c_.edges_s,   module.gap_s, c_.length_s, {},
                             c_.edges_m,      module.gap_m, c_.length_m,  {}};
      remove_along_mesh(in, gaps, any_number, removed_);
    } else {
      const NodeSegmentInput in{module.arrays(), c_.nodes,     module.gap_s, c_.length_s, {},
                                c_.segments,     module.gap_m, c_.length_m,  {}};
      remove_along_mesh(in, gaps, any_number, removed_);
    }
  }
  bool is_out(std::size_t p) const {
    return is_removed(removed_, {c_.pair_secondary[p], c_.pair_main[p]});
  }

  PenetrationRow measured(std::size_t p, double gap) const {
    const auto s = c_.pair_secondary[p], m = c_.pair_main[p];
    PenetrationRow row;
    if (c_.edges) {
      const Edge2 &a = c_.edges_s[s], &b = c_.edges_m[m];
      row = measured_row<Form::reference>(
          {module.point(a[0]), module.point(a[1]), module.point(b[0]), module.point(b[1])}, gap);
    } else {
      const Segment4& n = c_.segments[m];
      row = measured_row<Form::reference>(
          module.point(c_.nodes[s]),
          {module.point(n[0]), module.point(n[1]), module.point(n[2]), module.point(n[3])},
          n[2] == n[3], gap);
    }
    row.secondary = s;
    row.main = m;
    return row;
  }

  double node_distance(std::size_t p) const {
    const Segment4& n = c_.segments[c_.pair_main[p]];
    return closest_on_segment<Form::reference>(
               module.point(c_.nodes[c_.pair_secondary[p]]),
               {module.point(n[0]), module.point(n[1]), module.point(n[2]), module.point(n[3])},
               n[2] == n[3])
        .distance();
  }

  /// With Inacti 3: the pairs that the solver's search finds, before anything moves.
  std::vector<std::uint8_t> candidates() const {
    std::vector<std::uint8_t> out(c_.pair_main.size(), 0);
    for (std::size_t p = 0; p < out.size(); ++p) {
      const double limit = std::max(s_.drad, gap(p)) + s_.measures.margin;
      if (apart(p, limit)) continue;
      out[p] = node_distance(p) < limit;
    }
    return out;
  }

  void node_rows() {
    const bool moves = s_.card.inacti == 3;
    const std::vector<std::uint8_t> found = moves ? candidates() : std::vector<std::uint8_t>{};
    CandidateGroup group;
    std::size_t acted = 0;
    const auto act = [&] {
      group.start();
      for (; acted < module.rows.size(); ++acted) {
        PenetrationRow& row = module.rows[acted];
        act_on_node(s_.card.inacti, s_.card.fpenmax, row, module.movable(), c_.nodes[row.secondary],
                    group);
      }
    };
    for (std::size_t p = 0; p < c_.pair_main.size(); ++p) {
      const double g = gap(p);
      if (moves ? found[p] == 0 : apart(p, g)) continue;
      if (is_out(p)) continue;
      if (moves && group.begins_another()) act();
      const PenetrationRow row = measured(p, g);
      if (row.depth > 0) module.rows.push_back(row);
    }
    act();
  }

  void edge_rows() {
    std::vector<double> store_s(c_.edges_s.size(), 0), store_m(c_.edges_m.size(), 0);
    for (std::size_t p = 0; p < c_.pair_main.size(); ++p) {
      const double g = gap(p);
      if (apart(p, g)) continue;
      PenetrationRow row = measured(p, g);
      if (!(row.depth > 0) || is_out(p)) continue;
      act_on_edges(s_.card.inacti, row, store_s[row.secondary], store_m[row.main]);
      module.rows.push_back(row);
    }
    for (PenetrationRow& row : module.rows)
      finish_edge_row(row, store_s[row.secondary], store_m[row.main]);
  }

  const Contact& c_;
  const Settings& s_;
  double largest_;  // coordinate
  RemovalLists removed_;
};

template <class T>
T received() {
  static_assert(sizeof(T) <= sizeof module.exchange);
  T in;
  std::memcpy(&in, module.exchange, sizeof in);
  return in;
}

RowOutput output_of(const PenetrationRow& r) {
  const auto flag = [](bool b) { return b ? 1.0 : 0.0; };
  return {static_cast<double>(r.secondary),
          static_cast<double>(r.main),
          r.depth,
          r.gap,
          r.distance,
          {r.normal[0], r.normal[1], r.normal[2]},
          flag(r.on_surface),
          static_cast<double>(r.action),
          flag(r.has_gap0),
          r.gap0,
          r.p0,
          {r.moved_by[0], r.moved_by[1], r.moved_by[2]},
          r.weight_s};
}

}  // namespace

// A page that runs out of memory stops here; the library's versions would bring their messages and
// the printing of them along.
void* operator new(std::size_t bytes) {
  void* const room = std::malloc(bytes);
  if (room == nullptr) __builtin_trap();
  return room;
}
void operator delete(void* room) noexcept { std::free(room); }
void operator delete(void* room, std::size_t) noexcept { std::free(room); }

#define EXPORT(name) __attribute__((export_name(#name))) extern "C"

extern "C" void __wasm_call_ctors();

/// Once, before everything else. (The linker wraps the exports of modules that do not ask for it.)
EXPORT(initialize) void initialize() { __wasm_call_ctors(); }

/// Room that the page fills; never given back.
EXPORT(room) void* room(std::size_t bytes) { return std::malloc(bytes); }

/// Where values are exchanged.
EXPORT(exchange) double* exchange() { return module.exchange; }

/// Coordinates of `count` nodes: all x, then y, then z.
EXPORT(nodes) void set_nodes(std::size_t count, const double* xyz) {
  module.node_count = count;
  module.start.assign(xyz, xyz + 3 * count);
  module.now = module.start;
  module.largest = 0;
  for (const double x : module.start) module.largest = std::max(module.largest, std::abs(x));
}

/// Adds the contact whose ContactInput has been exchanged.
EXPORT(contact) void add_contact() { module.contacts.emplace_back(received<ContactInput>()); }

/// All nodes back to where the deck has them: before the first contact of an evaluation.
EXPORT(reset) void reset() {
  std::copy(module.start.begin(), module.start.end(), module.now.begin());
}

/// Evaluates a contact at the ChangeInput exchanged; its ResultOutput takes the place of it.
/// `moved`: how far the contacts before it have moved a node; `with_pairs` 0: settings only.
EXPORT(evaluate) void evaluate(std::size_t contact, double moved, int with_pairs) {
  const Contact& c = module.contacts[contact];
  const Settings s = settings_of(c, received<ChangeInput>(), moved);
  Pairs pairs(c, s, moved);
  double reached = s.largest;
  module.output.clear();
  if (with_pairs != 0) {
    for (std::size_t p = 0; p < c.pair_main.size(); ++p) reached = std::max(reached, pairs.gap(p));
    pairs.run();
    for (const PenetrationRow& row : module.rows) module.output.push_back(output_of(row));
  }
  const ResultOutput out{
      static_cast<double>(s.card.igap),
      static_cast<double>(s.card.inacti),
      static_cast<double>(s.card.irem_gap),
      s.card.fpenmax,
      s.scale,
      s.gapmin.value,
      static_cast<double>(s.gapmin.origin),
      s.gapmax,
      s.largest,
      s.drad,
      reached,
      s.measures.moved && s.card.igap == 3 ? 1.0 : 0.0,
      static_cast<double>(module.output.size()),
      static_cast<double>(reinterpret_cast<std::uintptr_t>(module.output.data()))};
  std::memcpy(module.exchange, &out, sizeof out);
}

/// The pair of a contact, at the ChangeInput exchanged, that is nearest to a penetration; a
/// RowOutput takes the place of it, with the secondary -1 where there is none.
EXPORT(nearest) void nearest(std::size_t contact) {
  const Contact& c = module.contacts[contact];
  const Settings s = settings_of(c, received<ChangeInput>(), 0);
  RowOutput out{};
  out.secondary = -1;
  if (const auto row = Pairs(c, s, 0).nearest()) out = output_of(*row);
  std::memcpy(module.exchange, &out, sizeof out);
}

/// Gaps of the two sides of the contact evaluated last.
EXPORT(secondary_gaps) const double* secondary_gaps() { return module.gap_s.data(); }
EXPORT(main_gaps) const double* main_gaps() { return module.gap_m.data(); }

/// The gap of a pair from what its sides bring.
EXPORT(pair_gap)
double pair_gap(int igap, double gapmin, double gapmax, double gap_s, double gap_m, double length_s,
                double length_m) {
  return PairGap::from_igap(igap, gapmin, gapmax)(gap_s, gap_m, length_s, length_m);
}

/// The solver's error for a node exactly on a segment, or 0.
EXPORT(on_surface_error)
int error_on_surface(int type, int itied, double fpenmax, int inacti) {
  return on_surface_error(type, itied, fpenmax, inacti);
}

/// What Inacti and Fpenmax would do about one penetration: the RowOutput takes the exchange's
/// place.
EXPORT(act) void act(int inacti, double fpenmax, double depth, double gap, int on_surface) {
  PenetrationRow row;
  row.depth = depth;
  row.gap = gap;
  row.on_surface = on_surface != 0;
  row.normal = {1, 0, 0};
  double at[3] = {0, 0, 0};
  CandidateGroup group;
  act_on_node(inacti, fpenmax, row, {{at, 1}, {at + 1, 1}, {at + 2, 1}}, 0, group);
  const RowOutput out = output_of(row);
  std::memcpy(module.exchange, &out, sizeof out);
}

/// The same of a TYPE24 or TYPE25.
EXPORT(act_modern) void act_modern(int type, int inacti, double depth) {
  PenetrationRow row;
  row.depth = depth;
  act_on_modern(type, inacti, row);
  const RowOutput out = output_of(row);
  std::memcpy(module.exchange, &out, sizeof out);
}
EXPORT(finds_the_same) int same_found(int inacti, int other) {
  return finds_the_same(inacti, other) ? 1 : 0;
}

/// Texts, ended by a zero: of PenetrationAction, of GapminOrigin.
EXPORT(action_text) const char* action_text(int action) {
  return to_string(static_cast<PenetrationAction>(action));
}
EXPORT(origin_text) const char* origin_text(int origin) {
  return to_string(static_cast<GapminOrigin>(origin));
}
