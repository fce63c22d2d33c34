// Books kinematic conditions in the solver's order: each option claims directions of its nodes.
// Output: conflicts (a direction claimed twice), nodes that walls lose, refused conditions. Cost:
// O(claims).
#include "model/shared/kinematics.hpp"

#include <algorithm>
#include <unordered_map>

#include "model/mesh/condition_cards.hpp"
#include "model/mesh/mesh_parts.hpp"

namespace deck {

const char* to_string(ConditionType type) {
  constexpr const char* names[] = {"BCS",    "IMPOSED", "RLINK", "RBE2", "RBE3",
                                   "LAGMUL", "RWALL",   "RBODY", "TIED", "CYL_JOINT"};
  return names[static_cast<std::size_t>(type)];
}

namespace {

using namespace detail;

constexpr std::uint8_t all_directions = 0b111111;
constexpr int lagrange_direction = 6;

std::uint16_t bit(ConditionType t) {
  return static_cast<std::uint16_t>(1u << static_cast<unsigned>(t));
}

/// Bookings of one half (translations or rotations) of a node's freedoms.
struct Half {
  std::uint8_t booked = 0;  ///< three bits
  std::int64_t system = 0;  ///< of the first booking
};

/// One option on one node.
struct KinematicEntry {
  NodeIndex node = no_index;
  std::uint32_t source = 0;
  std::uint32_t before = no_index;  ///< the previous entry of this node
  std::uint8_t directions = 0;
};

class Booking {
 public:
  Booking(const Model& model, ConditionCards cards)
      : model_(model),
        cards_(std::move(cards)),
        halves_(2 * model.nodes.size()),
        last_(model.nodes.size(), no_index),
        noted_(model.nodes.size(), 0) {
    out_.types.assign(model.nodes.size(), 0);
  }

  Kinematics run() {
    out_.left_out = std::move(cards_.left_out);
    for (const ConditionCard& c : cards_.cards) out_.sources.push_back({c.type, c.block, c.id});
    refusals();
    for (const std::size_t i : cards_.order(Turn::before_ties)) book(i, true);
    first_pass_of_ties();
    for (const Turn turn : {Turn::walls_and_bodies, Turn::ties, Turn::joints, Turn::late_ties})
      for (const std::size_t i : cards_.order(turn)) book(i, true);
    shared_bodies();
    walls();
    complete_types();
    return std::move(out_);
  }

 private:
  Half& half(NodeIndex n, int direction) { return halves_[2 * n + (direction < 3 ? 0u : 1u)]; }

  bool wall_and_body(NodeIndex n) const {
    const std::uint16_t both = bit(ConditionType::rwall) | bit(ConditionType::rbody);
    return !cards_.ikrem && (out_.types[n] & both) == both;
  }

  /// The option before `entry` that booked this direction, else one of this half.
  std::uint32_t opponent(NodeIndex n, int direction, std::uint32_t own) const {
    std::uint32_t other = own;
    for (std::uint32_t e = last_[n]; e != no_index; e = entries_[e].before) {
      const unsigned mask = entries_[e].directions;
      if (direction < 6 && (mask >> direction & 1) != 0) return entries_[e].source;
      if (direction >= 6 || (mask & (direction < 3 ? 7u : 56u)) != 0) other = entries_[e].source;
    }
    return other;
  }

  void conflict(NodeIndex n, int direction, std::uint32_t source, bool keep) {
    const std::uint32_t other = opponent(n, direction, source);
    // Two options of one kind, or several types.
    if ((out_.types[n] & (out_.types[n] - 1)) != 0 ||
        cards_.cards[other].rank == cards_.cards[source].rank)
      noted_[n] = 1;
    const bool counted = !wall_and_body(n);
    if (counted) ++out_.conflicts;
    if (keep)
      out_.bookings.push_back({n, static_cast<std::uint8_t>(direction), source, other, counted});
  }

  bool book_all(NodeIndex n) {
    bool conflicts = false;
    for (int d : {0, 3}) {
      Half& h = half(n, d);
      conflicts = conflicts || (h.booked != 0 && h.booked != 7);
      h.booked = 7;
    }
    return conflicts;
  }

  bool book_one(NodeIndex n, int direction, std::int64_t system) {
    Half& h = half(n, direction);
    const auto mask = static_cast<std::uint8_t>(1u << (direction % 3));
    if (h.booked == 0) {
      h = {mask, system};
      return false;
    }
    const bool again = (h.booked & mask) != 0;
    h.booked |= mask;
    return again || h.system != system;
  }

  void book_node(const ConditionCard& card, std::uint32_t source, NodeIndex n, bool keep) {
    if (card.directions != 0) out_.types[n] |= bit(card.type);
    if (card.lagrange) {
      if (book_all(n)) conflict(n, lagrange_direction, source, keep);
    } else {
      for (int d = 0; d < 6; ++d)
        if ((card.directions >> d & 1) != 0 && book_one(n, d, card.system))
          conflict(n, d, source, keep);
    }
    if (!keep) return;
    entries_.push_back({n, source, last_[n], card.lagrange ? all_directions : card.directions});
    last_[n] = static_cast<std::uint32_t>(entries_.size() - 1);
  }

  void book(std::size_t i, bool keep) {
    const ConditionCard& card = cards_.cards[i];
    for (const NodeIndex n : card.nodes)
      if (!cards_.excluded(card.type, n) && !refused(card, n))
        book_node(card, static_cast<std::uint32_t>(i), n, keep);
  }

  /// A second skew of a boundary condition is refused: bookings of a node use that of the last.
  bool refused(const ConditionCard& card, NodeIndex n) {
    if (card.type != ConditionType::bcs || card.lagrange) return false;
    const auto own = static_cast<std::uint32_t>(&card - cards_.cards.data());
    const auto [last, first] = last_condition_.try_emplace(n, own);
    if (!first && cards_.cards[last->second].system != card.system) {
      out_.forbidden.push_back({148, n, last->second, own});
      return true;
    }
    last->second = own;
    return false;
  }

  /// Ties are booked twice. The first bookings are removed, but their conflicts are counted.
  void first_pass_of_ties() {
    const std::vector<std::size_t> ties = cards_.order(Turn::ties);
    if (ties.empty()) return;
    std::vector<std::pair<NodeIndex, std::uint16_t>> types;
    std::vector<std::pair<std::size_t, Half>> halves;
    for (const std::size_t i : ties)
      for (const NodeIndex n : cards_.cards[i].nodes) {
        types.emplace_back(n, out_.types[n]);
        halves.emplace_back(2 * n, halves_[2 * n]);
        halves.emplace_back(2 * n + 1, halves_[2 * n + 1]);
      }
    for (const std::size_t i : ties)
      if (cards_.cards[i].twice) book(i, false);
    for (const auto& [n, t] : types) out_.types[n] = t;
    for (const auto& [at, h] : halves) halves_[at] = h;
  }

  void shared_bodies() {
    std::vector<std::uint32_t> body(model_.nodes.size(), no_index);
    for (std::size_t i = 0; i < cards_.cards.size(); ++i) {
      const ConditionCard& c = cards_.cards[i];
      if (c.type != ConditionType::rbody || c.lagrange) continue;
      for (const NodeIndex n : c.nodes) {
        if (body[n] == no_index)
          body[n] = static_cast<std::uint32_t>(i);
        else
          out_.shared.push_back({n, body[n], static_cast<std::uint32_t>(i),
                                 c.sensor || cards_.cards[body[n]].sensor});
      }
    }
  }

  /// Messages about rigid elements and bodies that depend on one another.
  void refusals() {
    for (const Refusal& r : cards_.refusals(model_)) {
      out_.forbidden.push_back({r.message, r.node, r.first, r.second});
      out_.stops = out_.stops || r.ends;
    }
  }

  void walls() {
    for (std::size_t i = 0; i < cards_.cards.size(); ++i) {
      const ConditionCard& c = cards_.cards[i];
      if (c.type != ConditionType::rwall || c.penalty) continue;
      WallCorrection wall{static_cast<std::uint32_t>(i), {}};
      const std::uint16_t held = static_cast<std::uint16_t>(
          bit(ConditionType::tied) | (cards_.ikrem ? 0u : bit(ConditionType::rbody)));
      for (const NodeIndex n : c.nodes)
        if ((out_.types[n] & held) != 0) wall.nodes.push_back(n);
      std::sort(wall.nodes.begin(), wall.nodes.end());
      if (!wall.nodes.empty()) out_.walls.push_back(std::move(wall));
    }
    const auto keep = static_cast<std::uint16_t>(~bit(ConditionType::rwall));
    for (const WallCorrection& w : out_.walls)
      for (const NodeIndex n : w.nodes) out_.types[n] &= keep;
  }

  void complete_types() {
    for (const std::size_t i : cards_.penalty_elements)
      for (const NodeIndex n : cards_.cards[i].nodes)
        out_.types[n] &= static_cast<std::uint16_t>(~bit(ConditionType::rbe3));
    const std::size_t size = model_.nodes.size();
    for (std::size_t n = 0; n < size; ++n)
      if (noted_[n] != 0 || (out_.types[n] & (out_.types[n] - 1)) != 0)
        out_.several.push_back(static_cast<NodeIndex>(n));
    out_.first.assign(size + 1, 0);
    for (const KinematicEntry& e : entries_) ++out_.first[e.node + 1];
    for (std::size_t n = 0; n < size; ++n) out_.first[n + 1] += out_.first[n];
    out_.entries.resize(entries_.size());
    std::vector<std::uint32_t> next(out_.first.begin(), out_.first.end() - 1);
    for (const KinematicEntry& e : entries_) out_.entries[next[e.node]++] = e.source;
  }

  const Model& model_;
  ConditionCards cards_;
  Kinematics out_;
  std::vector<Half> halves_;                                     ///< two per node
  std::vector<std::uint32_t> last_;                              ///< last entry of each node
  std::unordered_map<NodeIndex, std::uint32_t> last_condition_;  ///< card of type bcs, by node
  std::vector<char> noted_;
  std::vector<KinematicEntry> entries_;
};

}  // namespace

Kinematics read_kinematics(const Model& model, const std::vector<TiedNodes>* ties) {
  ConditionCards cards = read_condition_cards(model, ties);
  if (!cards.cards.empty()) return Booking(model, std::move(cards)).run();
  Kinematics none;
  none.left_out = std::move(cards.left_out);
  none.types.assign(model.nodes.size(), 0);
  none.first.assign(model.nodes.size() + 1, 0);
  return none;
}

}  // namespace deck
