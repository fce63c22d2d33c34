// State of a contact before its pairs are evaluated: if it can be computed, secondary items without
// part in it, the velocity limit, the approach of its sides, its nodes.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "contact/shared/scene_steps.hpp"
#include "cycle/shared/contact_run.hpp"
#include "deck/model.hpp"

namespace deck::cycle::detail {

LocalNodes::LocalNodes(const PairList& pairs, const std::vector<double>& mass) {
  NodeIndex low = no_index, high = 0;
  for (const auto& role : pairs.node)
    for (const NodeIndex n : role) {
      low = std::min(low, n);
      high = std::max(high, n);
    }
  if (low > high) return;
  first_word_ = low / 64;
  words_.resize(high / 64 - first_word_ + 1);
  for (const auto& role : pairs.node)
    for (const NodeIndex n : role) words_[n / 64 - first_word_].bits |= bit_of(n);
  std::uint32_t count = 0;
  for (NodeWord& w : words_) {
    w.before = count;
    count += static_cast<std::uint32_t>(std::popcount(w.bits));
  }
  node_.reserve(count);
  for (std::size_t w = 0; w < words_.size(); ++w)
    for (std::uint64_t left = words_[w].bits; left != 0; left &= left - 1)
      node_.push_back(static_cast<NodeIndex>((first_word_ + w) * 64) +
                      static_cast<NodeIndex>(std::countr_zero(left)));
  mass_.reserve(count);
  for (const NodeIndex n : node_) mass_.push_back(mass[n]);
}

void LocalNodes::localise(PairList& pairs) const {
  for (auto& role : pairs.node)
    for (std::uint32_t& n : role) {
      const NodeWord& w = words_[n / 64 - first_word_];
      n = w.before + static_cast<std::uint32_t>(std::popcount(w.bits & (bit_of(n) - 1)));
    }
}

double velocity_limit(const Contact& contact, const ContactCard& card, const State& state) {
  if (!state.moving) return 1e30;
  constexpr double big = 1e300;
  std::array<double, 3> low[2], high[2];
  for (std::size_t side = 0; side < 2; ++side) {
    low[side].fill(big);
    high[side].fill(-big);
  }
  const auto add = [&](std::size_t side, NodeIndex n) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[side][c] = std::min(low[side][c], state.velocity[c][n]);
      high[side][c] = std::max(high[side][c], state.velocity[c][n]);
    }
  };
  double least_s = big, least_m = big;
  for (const SecondaryNode& s : contact.secondary) {
    add(0, s.node);
    least_s = std::min(least_s, s.gap);
  }
  for (const MainSegment& m : contact.main) {
    for (const NodeIndex n : m.nodes) add(1, n);
    least_m = std::min(least_m, m.gap);
  }
  for (const ContactEdge& e : contact.secondary_edges) {
    for (const NodeIndex n : e.nodes) add(0, n);
    least_s = std::min(least_s, e.gap);
  }
  for (const ContactEdge& e : contact.main_edges) {
    for (const NodeIndex n : e.nodes) add(1, n);
    least_m = std::min(least_m, e.gap);
  }
  if (least_s == big || least_m == big) return 1e30;
  const double gap = contact.igap == 0 ? card.gapmin : std::max(least_s + least_m, card.gapmin);
  return velocity_step(gap, low[0], high[0], low[1], high[1]);
}

bool has_usable_values(const ContactCard& card, const Contact& contact) {
  for (const double v :
       {card.gapmin, card.stfac, card.viss, card.visf, card.fric, card.drad, contact.max_gap})
    if (!(std::abs(v) < 1e30)) return false;
  return true;
}

std::string curvature_problem(const Scene& scene, const Contact& contact, const ContactCard& card) {
  if (card.kind != ContactKind::node_segment || (card.icurv != 1 && card.icurv != 2)) return {};
  std::array<std::int64_t, 2> id{};
  visit_interface(*contact.inter, [&](const auto& inter) {
    inter.for_each([&](std::string_view name, const auto& e) {
      if constexpr (std::is_same_v<std::decay_t<decltype(e)>, EffectiveInt>) {
        if (name == "node_ID1") id[0] = e.value;
        if (name == "node_ID2") id[1] = e.value;
      }
    });
  });
  for (int k = 0; k < card.icurv; ++k)
    if (scene.model->nodes.map.find(id[static_cast<std::size_t>(k)]) == no_index)
      return "node_ID" + std::to_string(k + 1) + " = " +
             std::to_string(id[static_cast<std::size_t>(k)]) +
             " is not a node: the place of the curved surface is not known, nothing was evaluated";
  if (card.icurv == 2 && card.curv_node1 == card.curv_node2)
    return "node_ID1 and node_ID2 are at one place: the cylinder (Icurv = 2) has no axis, nothing "
           "was evaluated";
  return {};
}

std::string stiffness_problem(const RunContext& run, const Contact& contact) {
  if (run.unread.empty() || contact.istf == 1 || contact.factor < 0) return {};
  std::string why;
  const auto look = [&](NodeIndex n) {
    if (const auto it = run.unread.find(n); it != run.unread.end()) why = it->second;
  };
  for (const MainSegment& m : contact.main) std::for_each(m.nodes.begin(), m.nodes.end(), look);
  for (const auto* edges : {&contact.main_edges, &contact.secondary_edges})
    for (const ContactEdge& e : *edges) std::for_each(e.nodes.begin(), e.nodes.end(), look);
  for (const SecondaryNode& s : contact.secondary)
    if (contact.istf >= 2) look(s.node);
  return why.empty() ? why : why + ": no force was evaluated";
}

void begin(const RunContext& run, const Contact& contact, ContactMemory& m) {
  const bool edges = contact.kind == deck::ContactKind::edge_edge;
  m.off.assign(
      std::max<std::size_t>(1, edges ? contact.secondary_edges.size() : contact.secondary.size()),
      0);
  if (edges) return;
  bool drops = false;
  visit_interface(*contact.inter, [&](const auto& inter) {
    if constexpr (requires { inter.Irem_i2; }) drops = inter.Irem_i2.value == 1;
  });
  if (drops) m.tied_elsewhere = pairs_around_ties(run, contact);
}

void SearchPositions::record(const Contact& contact, const Coordinates& x) {
  for (auto& n : nodes_) n.clear();
  for (const SecondaryNode& s : contact.secondary) nodes_[0].push_back(s.node);
  for (const ContactEdge& e : contact.secondary_edges)
    nodes_[0].insert(nodes_[0].end(), e.nodes.begin(), e.nodes.end());
  for (const MainSegment& m : contact.main)
    nodes_[1].insert(nodes_[1].end(), m.nodes.begin(), m.nodes.end());
  for (const ContactEdge& e : contact.main_edges)
    nodes_[1].insert(nodes_[1].end(), e.nodes.begin(), e.nodes.end());
  const std::vector<double>* now[] = {&x.x, &x.y, &x.z};
  for (std::size_t side = 0; side < 2; ++side) {
    std::sort(nodes_[side].begin(), nodes_[side].end());
    nodes_[side].erase(std::unique(nodes_[side].begin(), nodes_[side].end()), nodes_[side].end());
    for (std::size_t c = 0; c < 3; ++c) {
      x_[side][c].clear();
      for (const NodeIndex n : nodes_[side]) x_[side][c].push_back((*now[c])[n]);
    }
  }
}

double SearchPositions::approach(const Coordinates& x) const {
  const std::vector<double>* now[] = {&x.x, &x.y, &x.z};
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    double low[2], high[2];
    for (std::size_t side = 0; side < 2; ++side) {
      low[side] = std::numeric_limits<double>::infinity();
      high[side] = -low[side];
      for (std::size_t i = 0; i < nodes_[side].size(); ++i) {
        const double moved = (*now[c])[nodes_[side][i]] - x_[side][c][i];
        if (!std::isfinite(moved)) return std::numeric_limits<double>::infinity();
        low[side] = std::min(low[side], moved);
        high[side] = std::max(high[side], moved);
      }
      if (nodes_[side].empty()) return 0.0;
    }
    const double most = std::max({high[0] - low[1], high[1] - low[0], 0.0});
    sum += most * most;
  }
  return std::sqrt(sum);
}

}  // namespace deck::cycle::detail
