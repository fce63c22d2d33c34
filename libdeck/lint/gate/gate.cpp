// Compares the contacts of a scene with the bounds of a gate and with an earlier run.
#include "lint/shared/gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "lint/shared/config.hpp"

namespace deck {
namespace {

/// True if `pattern` matches an id or title; a slash is an ordinary character.
bool matches(std::string_view pattern, std::int64_t id, std::string_view title) {
  const auto plain = [](std::string_view text) {
    std::string out(text);
    std::replace(out.begin(), out.end(), '/', '|');
    return out;
  };
  return glob_match(plain(pattern), std::to_string(id)) || glob_match(plain(pattern), plain(title));
}

template <class T>
void override_by(std::optional<T>& value, const std::optional<T>& other) {
  if (other) value = other;
}

void override_by(GateLimits& limits, const GateLimits& other) {
  override_by(limits.max_depth, other.max_depth);
  override_by(limits.max_ratio, other.max_ratio);
  override_by(limits.max_dt_loss, other.max_dt_loss);
}

/// Distinct nodes and edges.
struct Items {
  std::set<std::array<std::int64_t, 2>> all = {};
  std::vector<std::uint32_t> rows = {};  ///< SceneView::penetrations, sorted by depth

  void add(const NamedPenetration& p, std::uint32_t at) {
    all.insert(p.secondary);
    rows.push_back(at);
  }
  std::uint32_t deepest() const { return rows.front(); }
  /// "9 nodes penetrate", "1 edge penetrates"
  std::string penetrating() const {
    return text() + (all.size() == 1 ? " penetrates" : " penetrate");
  }
  std::string text() const {
    const auto edges = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const auto& s) { return s[1] != 0; }));
    return nodes_and_edges(all.size() - edges, edges);
  }
};

std::string name_of(const InterBase* inter) {
  return fmt::format("/INTER/TYPE{} {}", inter->type, inter->id);
}

/// "node 57", "edge 3-4"
std::string item_text(const NamedPenetration& p) {
  return p.secondary[1] == 0 ? fmt::format("node {}", p.secondary[0])
                             : fmt::format("edge {}-{}", p.secondary[0], p.secondary[1]);
}

/// Number of penetrations whose lines are examined; the others are less deep.
constexpr std::size_t most_rows = 10'000;

std::vector<std::uint32_t> deepest(const std::vector<std::uint32_t>& rows) {
  return {rows.begin(),
          rows.begin() + static_cast<std::ptrdiff_t>(std::min(most_rows, rows.size()))};
}

/// Places for a gate finding: the deepest penetration, and the changed line that it depends on.
class GatePlaces {
 public:
  using Notes = std::vector<std::pair<Span, std::string>>;

  /// `lines` may be nullptr: no known change.
  GatePlaces(const Scene& scene, const SceneView& view, const ChangedLines* lines)
      : scene_(scene), view_(view), model_(*scene.model) {
    if (lines != nullptr && !lines->empty()) changed_.emplace(*lines, model_.deck->sources);
  }

  /// Notes for penetrations (positions in SceneView::penetrations, deepest first) of an interface
  /// or of the deck (nullptr).
  Notes of_penetrations(const InterBase* inter, const std::vector<std::uint32_t>& all) {
    Notes notes;
    if (all.empty()) return notes;
    const NamedPenetration& first = view_.penetrations[all.front()];
    if (const NodeIndex n = model_.find_node(first.secondary[0]); n != no_index) {
      const PenetrationRow& row = scene_.contacts[first.contact].penetrations[first.row];
      notes.emplace_back(model_.node_span(n),
                         fmt::format("{} is {} deep", item_text(first), length_text(row.depth)));
    }
    if (!changed_) return notes;
    const std::vector<std::uint32_t> rows = deepest(all);
    for (const std::uint32_t i : rows)
      for (const std::int64_t id : view_.penetrations[i].secondary)
        if (add_node(notes, id, "node")) return notes;
    for (const std::uint32_t i : rows)
      for (const std::int64_t id : view_.penetrations[i].main)
        if (add_node(notes, id, "node of the main side,")) return notes;
    if (inter != nullptr && add_changed(notes, inter->block, name_of(inter))) return notes;
    if (!add_parts(notes, rows)) add_elements(notes, rows);
    return notes;
  }

  /// Notes for nodes by id.
  Notes of_nodes(const InterBase* inter, const std::vector<std::int64_t>& nodes) {
    Notes notes;
    if (!nodes.empty())
      if (const NodeIndex n = model_.find_node(nodes.front()); n != no_index)
        notes.emplace_back(model_.node_span(n), fmt::format("node {}", nodes.front()));
    if (!changed_) return notes;
    for (std::size_t i = 0; i < std::min(most_rows, nodes.size()); ++i)
      if (add_node(notes, nodes[i], "node")) return notes;
    for (auto& note : of_interface(inter)) notes.push_back(std::move(note));
    return notes;
  }

  /// Notes for the card of the interface.
  Notes of_interface(const InterBase* inter) {
    Notes notes;
    if (changed_ && inter != nullptr) add_changed(notes, inter->block, name_of(inter));
    return notes;
  }

 private:
  bool add_changed(Notes& notes, const Span& span, const std::string& what) {
    const Span line = changed_->first_in(span);
    if (!line.valid()) return false;
    notes.emplace_back(line, what + " was changed");
    return true;
  }

  bool add_changed(Notes& notes, const Block* block, const std::string& what) {
    if (block == nullptr) return false;
    // Interfaces, parts, properties and materials have short blocks.
    for (const FilePiece& piece : block->body)
      if (add_changed(
              notes, {piece.file, static_cast<std::uint32_t>(piece.end - piece.begin), piece.begin},
              what))
        return true;
    return add_changed(notes, block->header_span, what);
  }

  bool add_node(Notes& notes, std::int64_t id, const char* what) {
    const NodeIndex n = id == 0 ? no_index : model_.find_node(id);
    return n != no_index && add_changed(notes, model_.node_span(n), fmt::format("{} {}", what, id));
  }

  bool add_elements(Notes& notes, const std::vector<std::uint32_t>& rows) {
    for (const std::uint32_t i : rows)
      for (const ElementName& e :
           {view_.penetrations[i].secondary_element, view_.penetrations[i].main_element})
        if (e.valid() && add_changed(notes, model_.element_span(e.kind, e.index),
                                     fmt::format("element {}", e.id)))
          return true;
    return false;
  }

  bool add_parts(Notes& notes, const std::vector<std::uint32_t>& rows) {
    std::set<std::int64_t> ids;
    for (const std::uint32_t i : rows) {
      ids.insert(view_.penetrations[i].secondary_element.part);
      ids.insert(view_.penetrations[i].main_element.part);
    }
    for (const std::int64_t id : ids) {
      const auto it = model_.part_of_id.find(id);
      if (it == model_.part_of_id.end()) continue;
      const Part& part = model_.parts[it->second];
      if (part.prop != no_index) {
        const Property& property = model_.properties[part.prop];
        if (add_changed(notes, property.block, fmt::format("{} {}", property.type, property.id)))
          return true;
      }
      if (part.mat != no_index) {
        const Material& material = model_.materials[part.mat];
        if (add_changed(notes, material.block, fmt::format("{} {}", material.type, material.id)))
          return true;
      }
      if (add_changed(notes, part.span, fmt::format("part {}", id))) return true;
    }
    return false;
  }

  const Scene& scene_;
  const SceneView& view_;
  const Model& model_;
  std::optional<ChangedPlaces> changed_;
};

class Check {
 public:
  Check(const Gate& gate, const Scene& scene, const SceneView& view, const ChangedLines* changed)
      : gate_(gate), scene_(scene), view_(view), places_(scene, view, changed) {
    for (const InterBase* inter : scene.interfaces->all) {
      GateLimits limits = gate.general;
      // Bounds of the deck differ from those of an interface.
      limits.max_count.reset();
      limits.max_untied.reset();
      const GateScope* scope = nullptr;
      for (const GateScope& s : gate.interfaces)
        if (matches(s.match[0], inter->id, inter->title)) scope = &s;
      if (scope != nullptr) {
        override_by(limits, scope->limits);
        limits.max_count = scope->limits.max_count;
        limits.max_untied = scope->limits.max_untied;
      }
      limits_.emplace(inter, limits);
    }
  }

  void penetrations() {
    std::map<const InterBase*, std::map<double, Items>> deep, large;
    std::map<const InterBase*, Items> of_interface;
    std::vector<Items> of_pair(gate_.part_pairs.size());
    Items of_deck;
    for (std::uint32_t i = 0; i < view_.penetrations.size(); ++i) {
      const NamedPenetration& p = view_.penetrations[i];
      const Contact& c = scene_.contacts[p.contact];
      const PenetrationRow& row = c.penetrations[p.row];
      of_deck.add(p, i);
      of_interface[c.inter].add(p, i);
      GateLimits limits = limits_.at(c.inter);
      if (const std::size_t pair = pair_of(p); pair < of_pair.size()) {
        of_pair[pair].add(p, i);
        override_by(limits, gate_.part_pairs[pair].limits);
      }
      if (limits.max_depth && row.depth > *limits.max_depth)
        deep[c.inter][*limits.max_depth].add(p, i);
      if (limits.max_ratio && row.gap > 0 && row.depth > *limits.max_ratio * row.gap)
        large[c.inter][*limits.max_ratio].add(p, i);
    }
    for (const InterBase* inter : scene_.interfaces->ordered) {
      for (const auto& [bound, items] : deep[inter])
        report(RuleId::DK370, inter,
               fmt::format("{}: {} deeper than the {} that the gate allows; deepest {}",
                           name_of(inter), items.text(), bound, pair_text(items.deepest())),
               places_.of_penetrations(inter, items.rows));
      for (const auto& [bound, items] : large[inter])
        report(RuleId::DK371, inter,
               fmt::format("{}: {} deeper than the {} of the gap that the gate allows; deepest {}",
                           name_of(inter), items.text(), bound, pair_text(items.deepest())),
               places_.of_penetrations(inter, items.rows));
      count(inter, name_of(inter), of_interface[inter], limits_.at(inter).max_count);
    }
    for (std::size_t k = 0; k < of_pair.size(); ++k) {
      const GateScope& pair = gate_.part_pairs[k];
      count(nullptr, fmt::format("parts '{}' and '{}'", pair.match[0], pair.match[1]), of_pair[k],
            pair.limits.max_count);
    }
    count(nullptr, "the deck", of_deck, gate_.general.max_count);
  }

  void ties() {
    std::set<std::int64_t> of_deck;
    for (const Tie& tie : scene_.ties) {
      std::vector<std::int64_t> lost;
      for (const TiedNode& n : tie.nodes)
        if (n.lost()) lost.push_back(scene_.model->node_id(n.node));
      of_deck.insert(lost.begin(), lost.end());
      if (const auto most = limits_.at(tie.inter).max_untied; most && lost.size() > *most)
        report(RuleId::DK376, tie.inter, untied_text(name_of(tie.inter), lost.size(), *most),
               places_.of_nodes(tie.inter, lost));
    }
    if (const auto most = gate_.general.max_untied; most && of_deck.size() > *most)
      report(RuleId::DK376, nullptr, untied_text("the deck", of_deck.size(), *most),
             places_.of_nodes(nullptr, {of_deck.begin(), of_deck.end()}));
  }

  void time_steps(const cycle::SceneOutcome& forces) {
    for (const cycle::InterfaceSummary& s : cycle::summarize(scene_, forces)) {
      const auto most = limits_.at(s.inter).max_dt_loss;
      if (!most || !(s.contact_dt < s.structure_dt) || s.structure_dt >= 1e30) continue;
      const double loss = 1 - s.contact_dt / s.structure_dt;
      if (loss > *most)
        report(
            RuleId::DK373, s.inter,
            fmt::format("{}: time step {:.4g}, the mesh allows {:.4g}: a loss of {:.4g}, the gate "
                        "allows {}",
                        name_of(s.inter), s.contact_dt, s.structure_dt, loss, *most),
            places_.of_interface(s.inter));
    }
  }

  void trends(const GapBaseline& earlier) {
    std::map<const InterBase*, Items> fresh;
    std::map<const InterBase*, std::pair<Items, double>> worse;
    const GapsComparison comparison = compare_gaps(earlier, scene_, view_);
    for (const GapsComparison::Row& r : comparison.rows) {
      const NamedPenetration& p = view_.penetrations[r.penetration];
      const InterBase* inter = scene_.contacts[p.contact].inter;
      if (r.trend == Trend::added) fresh[inter].add(p, r.penetration);
      if (r.trend != Trend::worse) continue;
      auto& [items, was] = worse[inter];
      if (items.rows.empty()) was = earlier.rows[r.earlier].depth;
      items.add(p, r.penetration);
    }
    for (const InterBase* inter : scene_.interfaces->all)
      if (const auto it = comparison.lost_ties.find(inter);
          gate_.on_fresh && it != comparison.lost_ties.end())
        report(RuleId::DK374, inter,
               fmt::format("{}: {} not tied {} {}; first is node {}", name_of(inter),
                           deck::count(it->second.size(), "node is", "nodes are"),
                           earlier.accepts ? "and not accepted in" : "now that was tied in",
                           earlier.path, it->second.front()),
               places_.of_nodes(inter, it->second));
    for (const InterBase* inter : scene_.interfaces->ordered) {
      if (const auto it = fresh.find(inter); gate_.on_fresh && it != fresh.end())
        report(RuleId::DK374, inter,
               fmt::format("{}: {} now that did not in {}; deepest {}", name_of(inter),
                           it->second.penetrating(), earlier.path, pair_text(it->second.deepest())),
               places_.of_penetrations(inter, it->second.rows));
      if (const auto it = worse.find(inter); gate_.on_worse && it != worse.end())
        report(RuleId::DK375, inter,
               fmt::format("{}: {} deeper than in {}; deepest {}, which was {:.6g}", name_of(inter),
                           it->second.first.penetrating(), earlier.path,
                           pair_text(it->second.first.deepest()), it->second.second),
               places_.of_penetrations(inter, it->second.first.rows));
    }
  }

  std::vector<Finding> found;

 private:
  void count(const InterBase* inter, const std::string& of, const Items& items,
             const std::optional<std::uint64_t>& most) {
    if (most && items.all.size() > *most)
      report(RuleId::DK372, inter,
             fmt::format("{}: {}, the gate allows {}", of, items.penetrating(), *most),
             places_.of_penetrations(inter, items.rows));
  }

  static std::string untied_text(const std::string& of, std::size_t lost, std::uint64_t most) {
    return fmt::format("{}: {} not tied, the gate allows {}", of,
                       deck::count(lost, "node is", "nodes are"), most);
  }

  /// "node 57 by 0.4 of a gap of 1.2"
  std::string pair_text(std::uint32_t at) const {
    const NamedPenetration& p = view_.penetrations[at];
    const PenetrationRow& row = scene_.contacts[p.contact].penetrations[p.row];
    return fmt::format("{} by {} (gap {})", item_text(p), length_text(row.depth),
                       length_text(row.gap));
  }

  /// The last scope of Gate::part_pairs that matches the pair; size: none.
  std::size_t pair_of(const NamedPenetration& p) {
    const std::size_t none = gate_.part_pairs.size();
    if (none == 0) return none;
    const std::pair parts(p.secondary_element.part, p.main_element.part);
    const auto [it, is_new] = pair_scopes_.emplace(parts, none);
    if (!is_new) return it->second;
    const auto fits = [&](const std::string& pattern, std::int64_t id) {
      const auto part = scene_.model->part_of_id.find(id);
      return part != scene_.model->part_of_id.end() &&
             matches(pattern, id, scene_.model->parts[part->second].title);
    };
    for (std::size_t k = 0; k < none; ++k) {
      const auto& m = gate_.part_pairs[k].match;
      if ((fits(m[0], parts.first) && fits(m[1], parts.second)) ||
          (fits(m[1], parts.first) && fits(m[0], parts.second)))
        it->second = k;
    }
    return it->second;
  }

  void report(RuleId rule, const InterBase* inter, std::string message, GatePlaces::Notes notes) {
    Finding d =
        make_finding(rule, inter != nullptr ? inter->span : Span{0, 0, 0}, std::move(message));
    if (inter != nullptr) {
      d.keyword = "/INTER/TYPE" + std::to_string(inter->type);
      d.id = inter->id;
    }
    d.notes = std::move(notes);
    found.push_back(std::move(d));
  }

  const Gate& gate_;
  const Scene& scene_;
  const SceneView& view_;
  GatePlaces places_;
  std::map<const InterBase*, GateLimits> limits_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> pair_scopes_;
};

bool any_limit(const GateLimits& l) {
  return l.max_depth || l.max_ratio || l.max_dt_loss || l.max_count || l.max_untied;
}

template <class F>
bool some(const Gate& gate, F&& of) {
  const auto in = [&](const std::vector<GateScope>& scopes) {
    return std::any_of(scopes.begin(), scopes.end(),
                       [&](const GateScope& s) { return of(s.limits); });
  };
  return of(gate.general) || in(gate.interfaces) || in(gate.part_pairs);
}

}  // namespace

bool Gate::any() const { return on_fresh || on_worse || some(*this, any_limit); }
bool Gate::needs_forces() const {
  return some(*this, [](const GateLimits& l) { return l.max_dt_loss.has_value(); });
}

std::vector<Finding> check_gate(const Gate& gate, const Scene& scene, const SceneView& view,
                                const cycle::SceneOutcome* forces, const GapBaseline* earlier,
                                const ChangedLines* changed) {
  Check check(gate, scene, view, changed);
  check.penetrations();
  check.ties();
  if (forces != nullptr && gate.needs_forces()) check.time_steps(*forces);
  if (earlier != nullptr) check.trends(*earlier);
  return std::move(check.found);
}

}  // namespace deck
