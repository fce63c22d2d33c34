// Compares the penetrations and ties of a deck before and after a fix.
#include "edit/fix/harm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "edit/fix/common.hpp"

namespace deck::detail {
namespace {

constexpr double deeper = 1 + 1e-9;  // a penetration that grew by less is the same one

std::vector<NodeIndex> nodes_of(const Scene& scene, const PairKey& key) {
  const bool node = scene.contacts[key.contact].kind == ContactKind::node_segment;
  std::vector<NodeIndex> out(key.secondary.begin(), key.secondary.begin() + (node ? 1 : 2));
  out.insert(out.end(), key.main.begin(), key.main.begin() + (node ? 4 : 2));
  return out;
}

}  // namespace

Baseline::Baseline(const Scene& scene, const FixOptions& options) : options_(&options) {
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    const bool tie = contact.ties() && !is_wanted(options, contact);
    for (const PenetrationRow& row : contact.penetrations) {
      Row& kept = rows_[key_of(scene, {c, row.secondary, row.main})];
      kept.depth = std::max(kept.depth, row.depth);
      kept.tie = tie;
    }
  }
}

std::size_t Baseline::tied_pairs() const {
  return static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const auto& row) { return row.second.tie; }));
}

std::size_t Baseline::tied_nodes() const {
  std::set<std::pair<std::uint32_t, std::array<NodeIndex, 2>>> nodes;
  for (const auto& [key, row] : rows_)
    if (row.tie) nodes.insert({key.contact, key.secondary});
  return nodes.size();
}

std::vector<Harm> Baseline::harm(const Scene& now) const {
  if (options_ == nullptr) return {};
  const Baseline after(now, *options_);
  std::vector<Harm> out;
  const auto add = [&](const PairKey& key, bool tie, double before, double depth) {
    out.push_back({key, nodes_of(now, key), tie, before, depth});
  };
  for (const auto& [key, row] : after.rows_) {
    const auto it = rows_.find(key);
    const double before = it == rows_.end() ? 0 : it->second.depth;
    if (row.tie ? it == rows_.end() : row.depth > before * deeper)
      add(key, row.tie, before, row.depth);
  }
  for (const auto& [key, row] : rows_)
    if (row.tie && !after.rows_.contains(key)) add(key, true, row.depth, 0);
  std::stable_sort(out.begin(), out.end(),
                   [](const Harm& a, const Harm& b) { return a.tie > b.tie; });
  return out;
}

void verify_harmless(PenetrationFix& fix, const Interfaces& interfaces, const FixOptions& options,
                     const Scene& before, const Scene& after) {
  const Baseline baseline(before, options);
  fix.tied_pairs = baseline.tied_pairs();
  fix.tied_nodes = baseline.tied_nodes();
  const std::vector<Harm> harm = baseline.harm(after);
  const auto why = harm_text(*before.model, after, harm);
  if (!why) return;
  fix.rewrite = {};
  fix.interfaces.clear();
  fix.actions.clear();
  set_interfaces(fix, interfaces, options, before, before);
  fix.refused.push_back({after.contacts[harm.front().pair.contact].inter->id,
                         {},
                         0,
                         "nothing done: with the change " + *why});
  fix.complete = false;
}

std::optional<std::string> harm_text(const Model& model, const Scene& scene,
                                     const std::vector<Harm>& harm) {
  if (harm.empty()) return std::nullopt;
  const Harm& worst = harm.front();
  const Contact& contact = scene.contacts[worst.pair.contact];
  std::string text = fmt::format("interface {}, ", contact.inter->id);
  if (contact.kind == ContactKind::node_segment)
    text += fmt::format("node {}", model.node_id(worst.pair.secondary[0]));
  else
    text += fmt::format("edge {}-{}", model.node_id(worst.pair.secondary[0]),
                        model.node_id(worst.pair.secondary[1]));
  if (!worst.tie)
    text += worst.before > 0
                ? fmt::format(" would be {:.4g} deep instead of {:.4g}", worst.after, worst.before)
                : fmt::format(" would penetrate by {:.4g}", worst.after);
  else
    text += worst.after > 0 ? " would be tied to another segment" : " would come off its tie";
  if (harm.size() > 1) text += fmt::format(" (and {} more)", harm.size() - 1);
  return text;
}

}  // namespace deck::detail
