// What belongs beside a contact: edges that TYPE7 does not see, the recommended friction, radiation
// factors that emissivities can give. One finding per deck or per interface, never per element.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/shared/count.hpp"
#include "base/shared/length3.hpp"
#include "lint/check.hpp"
#include "lint/check_tables.hpp"

namespace deck::detail {
namespace {

using SurfaceSide = std::pair<NodeIndex, NodeIndex>;  // smaller node first

/// Calls f for the sides of some segments.
template <class F>
void each_side_of(std::span<const Segment> segments, F&& f) {
  for (const Segment& s : segments)
    for (std::size_t k = 0; k < 4; ++k) {
      const SurfaceSide side = std::minmax(s.nodes[k], s.nodes[(k + 1) % 4]);
      if (side.first != side.second && side.second != no_index) f(side);
    }
}

/// Sides whose smaller nodes are close to each other. Most nodes are the smaller one of few sides:
/// those are held here, further ones together with the further ones of other buckets. A `Side` is
/// the larger node alone where all have the same smaller one.
template <class Side>
struct SideBucket {
  std::array<Side, 3> side;
  std::uint16_t held = 0, again = 0;  ///< again: bit k of three if side[k] has come more than once

  /// False: there is no room for it.
  bool add(const SurfaceSide& s) {
    for (std::uint16_t k = 0; k < held; ++k)
      if (side[k] == kept(s)) {
        again = static_cast<std::uint16_t>(again | 1U << k);
        return true;
      }
    if (held == side.size()) return false;
    side[held++] = kept(s);
    return true;
  }
  std::size_t single() const {
    return std::size_t{held} - (again & 1U) - (again >> 1 & 1U) - (again >> 2);
  }

 private:
  static Side kept(const SurfaceSide& s) {
    if constexpr (std::is_same_v<Side, NodeIndex>)
      return s.second;
    else
      return s;
  }
};

/// Sides that occur once. Sorts them.
std::size_t count_single(std::vector<SurfaceSide>& sides) {
  std::size_t count = 0;
  std::sort(sides.begin(), sides.end());
  for (auto i = sides.begin(); i != sides.end();) {
    const auto j = std::find_if(i, sides.end(), [&](const SurfaceSide& s) { return s != *i; });
    count += j - i == 1;
    i = j;
  }
  return count;
}

/// The nodes of some segments lie between these two.
struct NodeRange {
  NodeIndex low = no_index, high = 0;
  void add(NodeIndex n) {
    low = std::min(low, n);
    high = std::max(high, n);
  }
};

/// A surface piece by piece, with the nodes of each piece: those that lie elsewhere are not read.
class SurfacePieces {
 public:
  explicit SurfacePieces(const SegmentList& segments) : segments_(segments) {
    segments.each_piece([&](std::size_t, std::span<const Segment> piece) {
      NodeRange& here = ranges_.emplace_back();
      for (const Segment& s : piece)
        for (const NodeIndex n : s.nodes)
          if (n != no_index) here.add(n);
      if (here.low > here.high) return;
      all_.add(here.low);
      all_.add(here.high);
    });
  }
  const NodeRange& all() const { return all_; }

  /// How many pieces are read in all where their nodes are looked at `width` at a time.
  std::size_t readings(std::uint64_t width) const {
    std::size_t count = 0;
    for (const NodeRange& r : ranges_)
      if (r.low <= r.high) count += (r.high - all_.low) / width - (r.low - all_.low) / width + 1;
    return count;
  }
  std::size_t count() const { return ranges_.size(); }

  /// Calls f(side) for the sides of the pieces that have nodes in low ... high.
  template <class F>
  void each_side_near(const NodeRange& nodes, F&& f) {
    constexpr std::size_t size = SegmentList::piece_size;
    for (std::size_t i = 0; i < ranges_.size(); ++i)
      if (ranges_[i].low <= nodes.high && nodes.low <= ranges_[i].high)
        each_side_of(segments_.some(i * size, std::min(segments_.size(), (i + 1) * size), room_),
                     f);
  }

 private:
  const SegmentList& segments_;
  std::vector<NodeRange> ranges_;
  NodeRange all_;
  std::vector<Segment> room_;
};

/// As count_free_edges(), with 2^shift nodes a bucket.
template <class Side>
std::size_t count_free_edges(SurfacePieces& pieces, int shift) {
  const NodeIndex low = pieces.all().low, high = pieces.all().high;
  const std::size_t buckets = ((high - low) >> shift) + std::size_t{1};
  // Few where that hardly needs more readings: they stay in the caches.
  constexpr std::size_t few = 1 << 18, many = 1 << 21;
  const std::size_t at_once =
      pieces.readings(std::uint64_t{few} << shift) <= 2 * pieces.count() ? few : many;
  std::size_t count = 0;
  std::vector<SideBucket<Side>> here;
  std::vector<SurfaceSide> further;
  for (std::size_t begin = 0; begin < buckets; begin += at_once) {
    const std::size_t size = std::min(at_once, buckets - begin);
    here.assign(size, {});
    further.clear();
    pieces.each_side_near({static_cast<NodeIndex>(low + (begin << shift)),
                           static_cast<NodeIndex>(std::min<std::uint64_t>(
                               high, low + ((std::uint64_t{begin} + size) << shift) - 1))},
                          [&](const SurfaceSide& s) {
                            const std::size_t bucket = ((s.first - low) >> shift) - begin;
                            if (bucket < size && !here[bucket].add(s)) further.push_back(s);
                          });
    for (const SideBucket<Side>& bucket : here) count += bucket.single();
    count += count_single(further);
  }
  return count;
}

/// Sides that belong to one segment only: the border of the surface. Linear in the segments: sides
/// go into buckets by their smaller node, so many buckets at a time that little memory is needed.
std::size_t count_free_edges(const SegmentList& surface) {
  SurfacePieces pieces(surface);
  const NodeRange all = pieces.all();
  if (all.low > all.high) return 0;
  int shift = 0;  // not many more buckets than segments
  while ((all.high - all.low) >> shift > 4 * surface.size()) ++shift;
  return shift == 0 ? count_free_edges<NodeIndex>(pieces, shift)
                    : count_free_edges<SurfaceSide>(pieces, shift);
}

void check_edge_companion(const LintContext& c, const Rule& rule, Reporter& r) {
  bool edges_seen = false;
  for (const ContactCard& card : c.contacts)
    edges_seen = edges_seen || card.type == 11 || card.type == 19;
  if (edges_seen) return;
  const ContactCard* first = nullptr;
  std::size_t interfaces = 0, free = 0;
  each(c, rule, [&](const ContactCard& card) {
    const auto s = c.selections->outline(static_cast<std::int64_t>(card.value("surf_IDm")));
    const std::size_t n = s ? count_free_edges(s->segments) : 0;
    if (n == 0) return;
    if (first == nullptr) {
      first = &card;
      free = n;
    }
    ++interfaces;
  });
  if (first == nullptr) return;
  report_at(r, rule, *first, "surf_IDm",
            fmt::format("the main surface of {} has {} free edge{}{}, but the deck has no "
                        "interface for edges (TYPE11, TYPE19)",
                        name_of(*first), free, free == 1 ? "" : "s",
                        interfaces == 1 ? ""
                                        : fmt::format(" (as have those of {} more interfaces)",
                                                      interfaces - 1)));
}

void check_formulation(const LintContext& c, const Rule& rule, Reporter& r) {
  const ContactCard* first = nullptr;
  std::size_t interfaces = 0;
  each(c, rule, [&](const ContactCard& card) {
    if (card.given("fric_ID") || !(card.given("Fric") || card.given("Ifric"))) return;
    if (card.find("Iform") == nullptr || card.flag("Iform") == 2) return;
    if (first == nullptr) first = &card;
    ++interfaces;
  });
  if (first == nullptr) return;
  report_at(r, rule, *first, "Iform",
            fmt::format("{}{} {} friction with Iform {}, the viscous formulation", name_of(*first),
                        interfaces == 1 ? ""
                                        : " and " + deck::count(interfaces - 1, "more interface",
                                                                "more interfaces"),
                        interfaces == 1 ? "has" : "have", first->flag("Iform")));
}

/// Nodes that follow a rigid body.
std::vector<bool> rigid_nodes(const LintContext& c) {
  std::vector<bool> out(c.model->nodes.size(), false);
  for (const DecodedBlock& d : c.loads) {
    if (d.block->schema->keyword != "/RBODY") continue;
    const NodeSet* set =
        c.selections->node_group(c.resolved(*d.block, "grnod", d.integer("grnd_ID")));
    if (set == nullptr) continue;
    for (const NodeIndex n : set->nodes)
      if (n != no_index) out[n] = true;
  }
  return out;
}

/// Shortest side of a surface; 0: it has none.
double shortest_side(const Model& model, const SegmentList& surface) {
  const auto& x = model.nodes;
  double least = 0;
  surface.each([&](const Segment& s) {
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = s.nodes[k], b = s.nodes[(k + 1) % 4];
      if (a == b || a == no_index || b == no_index) continue;
      const double length = length3(x.x[a] - x.x[b], x.y[a] - x.y[b], x.z[a] - x.z[b]);
      if (length > 0 && (least == 0 || length < least)) least = length;
    }
  });
  return least;
}

/// A node of either side that follows a rigid body; no_index: none.
NodeIndex rigid_side(const LintContext& c, const ContactCard& card, const std::vector<bool>& rigid,
                     const SegmentList& main) {
  const auto first = [&](const auto& nodes) {
    for (const NodeIndex n : nodes)
      if (n != no_index && rigid[n]) return n;
    return no_index;
  };
  const auto of_surface = [&](const SegmentList& surface) {
    const auto found = surface.find([&](const Segment& s) { return first(s.nodes) != no_index; });
    return found ? first(found->nodes) : no_index;
  };
  const auto id = [&](std::string_view field) {
    return static_cast<std::int64_t>(card.value(field));
  };
  NodeIndex found = no_index;
  if (card.type == 19) {
    if (const auto s = c.selections->outline(id("surf_IDs"))) found = of_surface(s->segments);
  } else if (const NodeSet* set = c.selections->node_group(id("grnd_IDs"))) {
    found = first(set->nodes);
  }
  return found != no_index ? found : of_surface(main);
}

/// Nodes that an /INTER/TYPE2 ties to a surface.
struct Ties {
  const ContactCard* card;
  const NodeSet* nodes;
  std::vector<bool> on_main;  ///< by node
};

std::vector<Ties> ties_of(const LintContext& c) {
  std::vector<Ties> out;
  for (const ContactCard& card : c.contacts) {
    if (card.block->schema->keyword != "/INTER/TYPE2") continue;
    const auto id = [&](std::string_view field, std::string_view kind) {
      return c.resolved(*card.block, kind, static_cast<std::int64_t>(card.value(field)));
    };
    const NodeSet* nodes = c.selections->node_group(id("grnd_IDs", "grnod"));
    const auto main = c.selections->outline(id("surf_IDm", "surf"));
    if (nodes == nullptr || !main) continue;
    out.push_back({&card, nodes, std::vector<bool>(c.model->nodes.size(), false)});
    main->segments.each([&](const Segment& s) {
      for (const NodeIndex n : s.nodes)
        if (n != no_index) out.back().on_main[n] = true;
    });
  }
  return out;
}

/// First node of `tie` that the contact may push off the surface that it is tied to.
NodeIndex pushed_tied_node(const LintContext& c, const ContactCard& card, const Ties& tie) {
  const auto id = [&](std::string_view field) {
    return static_cast<std::int64_t>(card.value(field));
  };
  const auto main = c.selections->outline(id("surf_IDm"));
  if (!main) return no_index;
  std::vector<bool> secondary(c.model->nodes.size(), false);
  const auto mark = [&](const auto& nodes) {
    for (const NodeIndex n : nodes)
      if (n != no_index) secondary[n] = true;
  };
  if (card.type == 7) {
    const NodeSet* group = c.selections->node_group(id("grnd_IDs"));
    if (group == nullptr) return no_index;
    mark(group->nodes);
  } else if (const auto other = c.selections->outline(id("surf_IDs"))) {
    other->segments.each([&](const Segment& s) { mark(s.nodes); });
  }
  const auto met = [&](const Segment& s) {
    return std::any_of(s.nodes.begin(), s.nodes.end(),
                       [&](NodeIndex n) { return n != no_index && tie.on_main[n]; });
  };
  if (!main->segments.find(met)) return no_index;
  for (const NodeIndex n : tie.nodes->nodes)
    if (n != no_index && secondary[n]) return n;
  return no_index;
}

/// One finding for the deck: spot welds in a contact of everything are common.
void check_tied_nodes(const LintContext& c, const Rule& rule, Reporter& r) {
  const std::vector<Ties> ties = ties_of(c);
  if (ties.empty()) return;
  const ContactCard* first = nullptr;
  const Ties* tie = nullptr;
  NodeIndex node = no_index;
  std::size_t interfaces = 0;
  each(c, rule, [&](const ContactCard& card) {
    const FieldView* f = card.find("Irem_i2");
    if (f == nullptr || f->field == nullptr || card.value("Irem_i2") == 1) return;
    for (const Ties& t : ties) {
      const NodeIndex n = pushed_tied_node(c, card, t);
      if (n == no_index) continue;
      ++interfaces;
      if (first != nullptr) return;
      first = &card;
      tie = &t;
      node = n;
      return;
    }
  });
  if (first == nullptr) return;
  Diagnostic* d = report_at(
      r, rule, *first, "Irem_i2",
      fmt::format("{}{}: node {} may be pushed off the surface that {} ties it to", name_of(*first),
                  interfaces == 1 ? "" : fmt::format(" (and {} more)", interfaces - 1),
                  c.model->node_id(node), name_of(*tie->card)));
  if (d != nullptr) d->notes.emplace_back(tie->card->block->header_span, "the tie");
}

void check_rigid_gap(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model->rbodies.empty()) return;
  constexpr double small = 0.02;  // of the shortest main side; usual gaps are a tenth and more
  std::vector<bool> rigid;
  each(c, rule, [&](const ContactCard& card) {
    const double gap = card.input("Gapmin");
    // With a variable gap Gapmin is only its floor.
    if (!(gap > 0) || card.flag("Igap") != 0) return;
    const auto main = c.selections->outline(static_cast<std::int64_t>(card.value("surf_IDm")));
    if (!main) return;
    const double side = shortest_side(*c.model, main->segments);
    if (!(gap < small * side)) return;
    if (rigid.empty()) rigid = rigid_nodes(c);
    const NodeIndex n = rigid_side(c, card, rigid, main->segments);
    if (n == no_index) return;
    report_at(
        r, rule, card, "Gapmin",
        fmt::format("{}: {} is {:.2g} of the shortest main side ({:.4g}), and node {} follows "
                    "a rigid body",
                    name_of(card), card.show("Gapmin"), gap / side, side, c.model->node_id(n)));
  });
}

/// Stefan-Boltzmann constant, W/(m2 K4) (CODATA 2018, exact).
constexpr double stefan_boltzmann = 5.670374419e-8;

void check_radiation_factor(const LintContext& c, const Rule& rule, Reporter& r) {
  if (!c.deck.begin.has_working && !c.deck.begin.has_input) return;  // units unknown
  const UnitSystem& u = c.deck.begin.has_working ? c.deck.begin.working : c.deck.begin.input;
  // M T^-3 per kelvin^4: so many kg/s3 are one unit of the deck.
  const double sigma = stefan_boltzmann / (u.mass / (u.time * u.time * u.time));
  if (!std::isfinite(sigma) || !(sigma > 0)) return;
  each(c, rule, [&](const ContactCard& card) {
    const double frad = card.value("Frad");
    if (card.input("Ithe") != 1 || !(frad > 0)) return;
    // 1 / (1/e1 + 1/e2 - 1) is at most 1, and above 1e-3 for any surface that people make.
    if (frad <= sigma * (1 + 1e-6) && frad >= 1e-3 * sigma) return;
    report_at(r, rule, card, "Frad",
              fmt::format("{}: Frad = {} is {} what two surfaces can radiate: the "
                          "Stefan-Boltzmann constant is {:.6g} in the units of the deck",
                          name_of(card), number_text(frad),
                          frad > sigma ? "more than" : "far below", sigma));
  });
}

}  // namespace

std::span<const Checked> companion_checks() {
  static constexpr Checked all[] = {
      {RuleId::DK916, check_edge_companion}, {RuleId::DK917, check_rigid_gap},
      {RuleId::DK918, check_formulation},    {RuleId::DK919, check_radiation_factor},
      {RuleId::DK920, check_tied_nodes},
  };
  return all;
}

}  // namespace deck::detail
