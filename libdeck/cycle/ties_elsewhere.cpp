// Irem_i2 = 1: which pairs of a contact a tie (/INTER/TYPE2) of the deck holds already.
#include <algorithm>

#include "contact/shared/tie_parts.hpp"
#include "cycle/shared/contact_run.hpp"

namespace deck::cycle::detail {
namespace {

/// Places in a list, by node.
using Places = std::vector<std::pair<NodeIndex, std::uint32_t>>;

template <class F>
void each_at(const Places& places, NodeIndex n, F&& f) {
  for (auto it = std::lower_bound(places.begin(), places.end(), std::pair{n, std::uint32_t{0}});
       it != places.end() && it->first == n; ++it)
    f(it->second);
}

}  // namespace

std::vector<CandidatePair> pairs_around_ties(const RunContext& run, const Contact& contact) {
  Places nodes, segments;
  for (std::uint32_t i = 0; i < contact.secondary.size(); ++i)
    nodes.emplace_back(contact.secondary[i].node, i);
  for (std::uint32_t i = 0; i < contact.main.size(); ++i)
    for (const NodeIndex n : contact.main[i].nodes) segments.emplace_back(n, i);
  std::sort(nodes.begin(), nodes.end());
  std::sort(segments.begin(), segments.end());
  std::vector<CandidatePair> out;
  const auto drop = [&](NodeIndex secondary, NodeIndex corner) {
    each_at(nodes, secondary, [&](std::uint32_t s) {
      each_at(segments, corner, [&](std::uint32_t m) { out.push_back({s, m}); });
    });
  };
  // Unless the scene was made without them, or for some interfaces only.
  const bool known = run.scene.ties.size() == run.scene.interfaces->type2.size();
  SceneOptions options;
  options.threads = run.options.threads;
  options.limits = run.scene.limits;
  const std::vector<Tie> found =
      known ? std::vector<Tie>() : deck::detail::ties_of(run.scene, options);
  for (const Tie& tie : known ? run.scene.ties : found)
    for (const TiedNode& n : tie.nodes) {
      if (!n.tied) continue;
      for (const NodeIndex corner : tie.main[n.segment]) {
        drop(n.node, corner);
        drop(corner, n.node);
      }
    }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace deck::cycle::detail
