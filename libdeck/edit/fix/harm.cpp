// Compares the penetrations and ties of a deck before and after a fix.
#include "edit/fix/harm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "edit/fix/fix_scene.hpp"

namespace deck::detail {
namespace {

constexpr double deeper = 1 + 1e-9;  // less growth is round-off

bool is_tie(const Scene& scene, const PairKey& key) { return key.contact >= scene.contacts.size(); }
const InterBase& interface_of(const Scene& scene, const PairKey& key) {
  if (is_tie(scene, key)) return *scene.ties[key.contact - scene.contacts.size()].inter;
  return *scene.contacts[key.contact].inter;
}
bool of_node(const Scene& scene, const PairKey& key) {
  return is_tie(scene, key) || scene.contacts[key.contact].kind == ContactKind::node_segment;
}

std::vector<NodeIndex> nodes_of_pair(const Scene& scene, const PairKey& key) {
  const bool node = of_node(scene, key);
  std::vector<NodeIndex> out(key.secondary.begin(), key.secondary.begin() + (node ? 1 : 2));
  out.insert(out.end(), key.main.begin(), key.main.begin() + (node ? 4 : 2));
  return out;
}

}  // namespace

StateBefore::StateBefore(const Scene& scene, const FixOptions& options) : options_(&options) {
  for (const Contact& contact : scene.contacts)
    by_node_.push_back(is_type24_or_25(contact.type) && contact.kind == ContactKind::node_segment);
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    const bool tie = contact.is_tied_contact() && !is_wanted(options, contact);
    for (const PenetrationRow& row : contact.penetrations)
      if (is_penetration(row)) add(key_of(scene, {c, row.secondary, row.main}), row.depth, tie);
  }
  for (std::size_t t = 0; t < scene.ties.size(); ++t)
    for (const TiedNode& n : scene.ties[t].nodes) {
      if (!n.tied) continue;
      PairKey pair;
      pair.contact = static_cast<std::uint32_t>(scene.contacts.size() + t);
      pair.secondary = {n.node, 0};
      pair.main = scene.ties[t].main[n.segment];
      std::sort(pair.main.begin(), pair.main.end());
      add(pair, 1, true);
    }
}

void StateBefore::add(const PairKey& pair, double depth, bool tie) {
  DepthRow& row = rows_[judged(pair)];
  row = {pair, std::max(row.depth, depth), tie};
}

std::size_t StateBefore::tied_pairs() const {
  return static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const auto& row) { return row.second.tie; }));
}

std::size_t StateBefore::tied_nodes() const {
  std::set<std::pair<std::uint32_t, std::array<NodeIndex, 2>>> nodes;
  for (const auto& [key, row] : rows_)
    if (row.tie) nodes.insert({key.contact, key.secondary});
  return nodes.size();
}

std::vector<HarmedPair> StateBefore::harm(const Scene& now) const {
  if (options_ == nullptr) return {};
  const StateBefore after(now, *options_);
  std::vector<HarmedPair> out;
  const auto report = [&](const DepthRow& row, double before, double depth) {
    out.push_back({row.pair, nodes_of_pair(now, row.pair), row.tie, before, depth});
  };
  for (const auto& [key, row] : after.rows_) {
    const auto known = rows_.find(key);
    const double before = known == rows_.end() ? 0 : known->second.depth;
    if (row.tie ? known == rows_.end() : row.depth > before * deeper)
      report(row, before, row.depth);
  }
  for (const auto& [key, row] : rows_)
    if (row.tie && !after.rows_.contains(key)) report(row, row.depth, 0);
  std::stable_sort(out.begin(), out.end(),
                   [](const HarmedPair& a, const HarmedPair& b) { return a.tie > b.tie; });
  return out;
}

void verify_harmless(PenetrationFix& fix, const Interfaces& interfaces, const FixOptions& options,
                     const Scene& before, const Scene& after) {
  const StateBefore baseline(before, options);
  fix.tied_pairs = baseline.tied_pairs();
  fix.tied_nodes = baseline.tied_nodes();
  std::vector<HarmedPair> harm = baseline.harm(after);
  // Inacti is part of the search of TYPE24 and TYPE25: penetrations found with another Inacti
  // existed before.
  if (fix.strategy == "inacti")
    std::erase_if(harm, [&](const HarmedPair& h) {
      return !h.tie && interface_of(after, h.pair).type >= 24;
    });
  const auto why = harm_text(*before.model, after, harm);
  if (!why) return;
  fix.rewrite = {};
  fix.interfaces.clear();
  fix.actions.clear();
  set_interfaces(fix, interfaces, options, before, before);
  add_refusal(fix, interface_of(after, harm.front().pair).id,
              "nothing done: with the change " + *why, "deck fix DECK --strategy move-nodes");
  fix.complete = false;
}

std::optional<std::string> harm_text(const Model& model, const Scene& scene,
                                     const std::vector<HarmedPair>& harm) {
  if (harm.empty()) return std::nullopt;
  const HarmedPair& worst = harm.front();
  std::string text = fmt::format("interface {}, ", interface_of(scene, worst.pair).id);
  if (of_node(scene, worst.pair))
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
