// Finds pairs of neighbouring segments whose contact points coincide, and gives them one force
// instead of two. See pair_shares().
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>

#include "cycle/shared/contact_run.hpp"

namespace deck::cycle {
namespace {

constexpr double nothing = 1e-12;

/// Set of up to four nodes.
struct FeatureNodes {
  std::array<std::uint32_t, 4> id{};
  std::size_t count = 0;
  void add(std::uint32_t n) {
    if (!has(n)) id[count++] = n;
  }
  [[nodiscard]] bool has(std::uint32_t n) const {
    return std::find(id.begin(), id.begin() + static_cast<std::ptrdiff_t>(count), n) !=
           id.begin() + static_cast<std::ptrdiff_t>(count);
  }
  void sort() { std::sort(id.begin(), id.begin() + static_cast<std::ptrdiff_t>(count)); }
  friend auto operator<=>(const FeatureNodes&, const FeatureNodes&) = default;
  [[nodiscard]] bool contains(const FeatureNodes& other) const {
    return std::all_of(other.id.begin(),
                       other.id.begin() + static_cast<std::ptrdiff_t>(other.count),
                       [&](std::uint32_t n) { return has(n); });
  }
};

/// Nodes of both sides of a pair, and the nodes with nonzero weight at its contact point.
struct ContactFeature {
  FeatureNodes all[2], carrying[2];
  [[nodiscard]] bool inside() const {
    return carrying[0].count == all[0].count && carrying[1].count == all[1].count;
  }
};

class Features {
 public:
  Features(const PairList& pairs, const PacketResult& result) : pairs_(pairs), r_(result) {}
  [[nodiscard]] ContactFeature of(std::size_t i) const {
    ContactFeature f;
    if (pairs_.kind == ContactKind::edge_edge) {
      for (std::size_t role = 0; role < 4; ++role)
        add(f, role / 2, pairs_.node[role][i], r_.weights[role][i]);
    } else {
      add(f, 0, pairs_.node[0][i], 1.0);
      for (std::size_t c = 0; c < 4; ++c) add(f, 1, pairs_.node[c + 1][i], r_.weights[c][i]);
    }
    return f;
  }

 private:
  static void add(ContactFeature& f, std::size_t side, std::uint32_t node, double weight) {
    f.all[side].add(node);
    if (weight > nothing) f.carrying[side].add(node);
  }
  const PairList& pairs_;
  const PacketResult& r_;
};

/// Pairs in contact, by secondary node.
std::vector<std::pair<std::uint32_t, std::size_t>> by_secondary(const PairList& pairs,
                                                                const PacketResult& r) {
  std::vector<std::pair<std::uint32_t, std::size_t>> list;
  const std::size_t roles = pairs.kind == ContactKind::edge_edge ? 2 : 1;
  for (std::size_t i = 0; i < r.size; ++i)
    for (std::size_t role = 0; role < roles && (r.status[i] & status_contact) != 0; ++role)
      list.emplace_back(pairs.node[role][i], i);
  std::sort(list.begin(), list.end());
  return list;
}

}  // namespace

std::vector<double> pair_shares(const PairList& pairs, const PacketResult& r) {
  std::vector<double> share(r.size, 1.0);
  const auto list = by_secondary(pairs, r);
  const Features features(pairs, r);
  // Ascending distances of the pairs that contain an edge or corner; computed once per edge or
  // corner, because pairs of overlapping segments share them.
  std::map<std::array<FeatureNodes, 2>, std::vector<double>> met;
  for (std::size_t i = 0; i < r.size; ++i) {
    if ((r.status[i] & status_contact) == 0 || std::isnan(r.distance[i])) continue;
    ContactFeature own = features.of(i);
    if (own.inside() || own.carrying[0].count == 0) continue;
    for (FeatureNodes& side : own.carrying) side.sort();
    const auto [at, is_new] = met.try_emplace({own.carrying[0], own.carrying[1]});
    std::vector<double>& distances = at->second;
    if (is_new) {
      const std::uint32_t key = own.carrying[0].id[0];
      for (auto it = std::lower_bound(list.begin(), list.end(), std::pair{key, std::size_t{0}});
           it != list.end() && it->first == key; ++it) {
        const ContactFeature other = features.of(it->second);
        if (!std::isnan(r.distance[it->second]) && other.all[0].contains(own.carrying[0]) &&
            other.all[1].contains(own.carrying[1]))
          distances.push_back(r.distance[it->second]);
      }
      std::sort(distances.begin(), distances.end());
    }
    if (distances.front() < (1.0 - nothing) * r.distance[i]) {
      share[i] = 0.0;
      continue;
    }
    const auto meeting =
        std::upper_bound(distances.begin(), distances.end(), (1.0 + nothing) * r.distance[i]) -
        distances.begin();
    share[i] = 1.0 / static_cast<double>(meeting);
  }
  return share;
}

void apply_shares(const std::vector<double>& share, PacketResult& r) {
  for (std::size_t i = 0; i < r.size; ++i) {
    const double s = share[i];
    if (s == 1.0) continue;
    for (auto* three : {&r.force, &r.ft})
      for (auto& component : *three) component[i] *= s;
    for (auto* value : {&r.normal_force, &r.k_nodal, &r.elastic_energy, &r.friction_energy,
                        &r.damping_energy, &r.friction_heat, &r.conductance})
      (*value)[i] *= s;
    for (auto& role : r.heat) role[i] *= s;
    if (s != 0.0) continue;
    r.status[i] &= ~static_cast<std::int64_t>(status_contact | status_bc_release);
    r.dt_kinematic[i] = 1e30;
  }
}

}  // namespace deck::cycle
