// Strategy tie: finds the smallest dsearch per TYPE2 that ties the untied nodes within reach.
// Evaluate all ties with the largest dsearch wanted; sort the untied nodes by distance; stop before
// the first one that another interface ties or that must not be tied; write the roundest number
// above the last node kept; evaluate all ties again and drop nodes until nothing else has changed.
// Cost: one evaluation of the ties per attempt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "contact/shared/tie_steps.hpp"
#include "edit/fix/fix_scene.hpp"
#include "edit/fix/harm.hpp"
#include "model/shared/kinematics.hpp"

namespace deck {
namespace {

using namespace detail;

bool is_penalty(const Tie& tie) { return tie.spotflag >= 25 && tie.spotflag <= 28; }

/// Reason why no dsearch helps; empty if one may.
std::string why_not_treated(const Tie& tie) {
  if (!tie.not_evaluated.empty()) return "not evaluated: " + tie.not_evaluated;
  if (tie.inter->Isearch.value == 1) return "Isearch 1 does not look at dsearch";
  if (tie.ignore >= 4)
    return fmt::format("with Ignore {} the solver does not look as far as dsearch", tie.ignore);
  if (is_penalty(tie) && tie.inter->surf_IDs.value != 0)
    return "dsearch also decides which segments of its two surfaces take part";
  return {};
}

/// Interfaces and conditions that exclude nodes from a further tie.
class TieConflicts {
 public:
  TieConflicts(const LoadedDeck& context, const Scene& scene)
      : model_(scene.model), kinematics_(&context.kinematics()) {
    for (const Tie& tie : scene.ties) {
      for (const TiedNode& n : tie.nodes)
        if (n.tied) add(tie, n.node, n.segment);
    }
    for (const Contact& contact : scene.contacts)
      if (contact.is_tied_contact())
        for (const PenetrationRow& row : contact.penetrations)
          tied_.emplace(contact.secondary[row.secondary].node, contact.inter->id);
  }

  void add(const Tie& tie, NodeIndex node, std::uint32_t segment) {
    tied_.emplace(node, tie.inter->id);
    if (!is_penalty(tie)) dependent_.emplace(node, tie.inter->id);
    for (const NodeIndex corner : tie.main[segment]) in_use_.emplace(corner, tie.inter->id);
  }

  /// Reason against tying a node to this segment; empty if none.
  std::string against(const Tie& tie, NodeIndex node, const Corners& segment) const {
    if (const auto it = tied_.find(node); it != tied_.end())
      return fmt::format("interface {} ties it already", it->second);
    if (const std::string held = condition_on(tie, node); !held.empty()) return held;
    for (const NodeIndex corner : segment)
      if (const auto it = dependent_.find(corner); it != dependent_.end())
        return fmt::format(
            "node {} of its segment is tied by interface {}: the solver would stop (556)",
            model_->node_id(corner), it->second);
    if (const auto it = in_use_.find(node); !is_penalty(tie) && it != in_use_.end())
      return fmt::format("nodes are tied to it by interface {}: the solver would stop (556)",
                         it->second);
    return {};
  }

 private:
  std::string condition_on(const Tie& tie, NodeIndex node) const {
    if (node + std::size_t{1} >= kinematics_->first.size()) return {};
    for (const std::uint32_t s : kinematics_->of(node)) {
      const ConditionSource& source = kinematics_->sources[s];
      const bool of_directions =
          source.type == ConditionType::bcs || source.type == ConditionType::imposed;
      if (source.type == ConditionType::tied || source.type == ConditionType::rwall) continue;
      if (of_directions && is_penalty(tie)) continue;  // deleted with the penalty
      return fmt::format("{}/{} holds it", source.block->keyword, source.id);
    }
    return {};
  }

  const Model* model_;
  const Kinematics* kinematics_;
  std::map<NodeIndex, std::int64_t> tied_, dependent_, in_use_;  ///< by node: the interface
};

struct TieCandidate {
  const TiedNode* node = nullptr;
  double distance = 0;
  std::uint32_t segment = 0;
};

/// A tie that loses nodes.
struct TiePlan {
  std::size_t at = 0;  ///< in Scene::ties
  double asked = 0;    ///< wanted distance
  double reach = 0;    ///< search distance, at most `asked`
  FieldPlace place;
  std::vector<TieCandidate> taken;
  double keep = 0, limit = 0;  ///< bounds of dsearch: above `keep`, at most `limit`
  std::set<NodeIndex> nodes;   ///< nodes to be tied
  double needed = 0;
  RoundedText text;
  double value = 0;  ///< working units
};

class TieFix {
 public:
  TieFix(const LoadedDeck& context, const TieOptions& options)
      : context_(context),
        options_(options),
        before_(fix_scene(context, options, true)),
        ties_(before_.ties) {
    dsearch_.type2 = context.interfaces().type2;
  }

  Result<PenetrationFix> run() {
    fix_.strategy = "tie";
    select();
    if (!plans_.empty()) {
      for (const TiePlan& plan : plans_) set_dsearch(plan.at, widest(plan));
      const std::vector<Tie> wide = ties_with();
      TieConflicts holders(context_, before_);
      for (TiePlan& plan : plans_) decide(plan, wide[plan.at], holders);
      std::erase_if(plans_, [](const TiePlan& plan) { return plan.taken.empty(); });
      drop_harmful();
    }
    return make_result();
  }

 private:
  void refuse(const Tie& tie, std::string reason) {
    add_refusal(fix_, tie.inter->id, std::move(reason));
  }
  void refuse(const Tie& tie, const TiedNode& node, double distance, std::string reason) {
    fix_.refused.push_back(
        {tie.inter->id, {before_.model->node_id(node.node)}, 0, std::move(reason), distance});
  }

  /// Selects ties that lose nodes and may be treated.
  void select() {
    for (std::size_t t = 0; t < ties_.size(); ++t) {
      const Tie& tie = ties_[t];
      if (!asks_for(options_, tie.inter->id)) continue;
      if (tie.not_evaluated.empty() && count_ties(tie).lost() == 0) continue;
      if (const std::string why = why_not_treated(tie); !why.empty()) {
        refuse(tie, why);
        continue;
      }
      auto place = find_field(context_.deck(), *tie.inter->block, "dsearch");
      if (!place) {
        refuse(tie, place.error().message);
        continue;
      }
      TiePlan plan;
      plan.at = t;
      plan.place = *place;
      plan.asked = options_.reach.value_or(mean_side(before_.coordinates, tie.main));
      plan.reach = plan.asked;
      plans_.push_back(std::move(plan));
    }
  }

  /// Largest distance of a tied node.
  static double farthest_tied(const Tie& tie) {
    double out = 0;
    for (const TiedNode& n : tie.nodes)
      if (n.tied) out = std::max(out, n.distance);
    return out;
  }

  /// A dsearch that finds every present tie and every node within reach.
  double widest(const TiePlan& plan) const {
    const Tie& tie = ties_[plan.at];
    const double all = std::max(tie.search_distance, farthest_tied(tie) * (1 + 1e-9));
    return std::max(all, plan.reach);
  }

  void set_dsearch(std::size_t at, double value) { dsearch_.type2[at].dsearch.value = value; }

  /// Ties with the values of `dsearch_`.
  std::vector<Tie> ties_with() {
    Scene scene;
    scene.model = before_.model;
    scene.interfaces = &dsearch_;
    scene.coordinates = before_.coordinates;
    SceneOptions scene_options;
    scene_options.threads = options_.threads;
    scene_options.limits = context_.options().read.limits;
    return detail::ties_of(scene, scene_options);
  }

  void decide(TiePlan& plan, const Tie& wide, TieConflicts& holders) {
    const Tie& tie = ties_[plan.at];
    std::vector<TieCandidate> wanted;
    double limit = std::numeric_limits<double>::infinity();  // above it, excluded nodes tie too
    std::string who;
    for (std::size_t k = 0; k < tie.nodes.size(); ++k) {
      const TiedNode &is = tie.nodes[k], &found = wide.nodes[k];
      if (is.tied || is.segment != no_index || found.segment == no_index ||
          !(found.distance < widest(plan))) {
        const double away = is.segment != no_index ? is.distance : is.nearest_distance;
        if (is.lost()) refuse(tie, is, away, why_out_of_reach(plan, is));
        continue;
      }
      if (!found.tied && found.removed_by == 0) {
        refuse(tie, is, found.distance, beyond_rim);
        continue;
      }
      const std::string held = holders.against(tie, is.node, tie.main[found.segment]);
      if (held.empty()) {
        wanted.push_back({&is, found.distance, found.segment});
        continue;
      }
      refuse(tie, is, found.distance, held);
      if (found.distance >= limit) continue;
      limit = found.distance;
      who = fmt::format("node {}, {:.6g} from its segment: {}", before_.model->node_id(is.node),
                        limit, held);
    }
    select_nearer(plan, wanted, limit, who, holders);
  }

  static constexpr const char* beyond_rim =
      "it lies farther beyond the rim of the nearest segment than the solver accepts: no dsearch "
      "ties it";

  std::string why_out_of_reach(const TiePlan& plan, const TiedNode& node) const {
    if (node.segment != no_index) return beyond_rim;
    if (node.nearest == no_index) return "the main side has no segment for it";
    if (node.nearest_distance < plan.reach) return beyond_rim;
    if (node.nearest_distance < plan.asked) return "a dsearch for it would lose nearer nodes";
    return fmt::format("farther away than {:.6g} (--reach)", plan.asked);
  }

  /// Selects the nodes before the limit, and their dsearch.
  void select_nearer(TiePlan& plan, std::vector<TieCandidate>& wanted, double limit,
                     const std::string& who, TieConflicts& holders) {
    const Tie& tie = ties_[plan.at];
    plan.keep = farthest_tied(tie);
    plan.limit = limit;
    for (const TieCandidate& c : wanted)
      if (c.distance < limit && plan.keep < limit)
        plan.taken.push_back(c);
      else
        refuse(tie, *c.node, c.distance, "a dsearch for it would also tie " + who);
    if (!choose(plan)) return;
    for (const TieCandidate& c : plan.taken) holders.add(tie, c.node->node, c.segment);
  }

  /// Chooses a dsearch for the selected nodes; false if there is none.
  bool choose(TiePlan& plan) {
    plan.nodes.clear();
    plan.needed = 0;
    if (plan.taken.empty()) return false;
    for (const TieCandidate& c : plan.taken) plan.needed = std::max(plan.needed, c.distance);
    if (!choose_text(plan, std::max(plan.needed, plan.keep), plan.limit)) {
      for (const TieCandidate& c : plan.taken)
        refuse(ties_[plan.at], *c.node, c.distance,
               "no number that fits the cell of dsearch ties it alone");
      plan.taken.clear();
      return false;
    }
    for (const TieCandidate& c : plan.taken) plan.nodes.insert(c.node->node);
    return true;
  }

  /// Drops the nodes that need the largest dsearch; false if none is left.
  bool do_with_less(TiePlan& plan, const std::string& why) {
    const double most = plan.needed;
    std::erase_if(plan.taken, [&](const TieCandidate& c) {
      if (c.distance < most) return false;
      refuse(ties_[plan.at], *c.node, c.distance, "with a dsearch for it " + why);
      return true;
    });
    return choose(plan);
  }

  /// Shortest number above `needed` and not above `limit`.
  static bool choose_text(TiePlan& plan, double needed, double limit) {
    const double factor = plan.place.factor;
    for (int digits = 2; digits <= 17; ++digits) {
      auto text = round_up(needed / factor, digits, plan.place.width());
      // The search is strict, and the product with the unit factor may round down.
      for (int i = 0; text && !(text->value * factor > needed) && i < 8; ++i)
        text = round_up(std::nextafter(text->value, std::numeric_limits<double>::infinity()),
                        digits, plan.place.width());
      if (!text || !(text->value * factor > needed) || text->value * factor > limit) continue;
      plan.text = *text;
      plan.value = text->value * factor;
      return true;
    }
    return false;
  }

  /// First unintended change; empty if none. `tie`: its index.
  std::string harm(const std::vector<Tie>& after, std::size_t& tie) const {
    for (tie = 0; tie < ties_.size(); ++tie) {
      const auto plan =
          std::find_if(plans_.begin(), plans_.end(), [&](const TiePlan& p) { return p.at == tie; });
      const Tie &was = ties_[tie], &is = after[tie];
      if (is.nodes.size() != was.nodes.size() || is.main != was.main)
        return "the sides of the tie would change";
      for (std::size_t k = 0; k < was.nodes.size(); ++k) {
        const bool meant = plan != plans_.end() && plan->nodes.contains(was.nodes[k].node);
        if (const std::string why = change_of(was, was.nodes[k], is.nodes[k], meant); !why.empty())
          return fmt::format("node {} {}", before_.model->node_id(was.nodes[k].node), why);
      }
      if (is.main_and_tied.size() > was.main_and_tied.size())
        return "the solver would stop: main nodes would be tied as well (556)";
    }
    return {};
  }

  static std::string change_of(const Tie& tie, const TiedNode& was, const TiedNode& is,
                               bool meant) {
    if (meant) return is.tied ? "" : "would still not be tied";
    if (was.tied != is.tied) return is.tied ? "would be tied too" : "would come off its tie";
    if (!was.tied) return {};
    // The solver rounds distances to the search distance: equally far nodes may swap.
    const double equal =
        4 * std::numeric_limits<double>::epsilon() * std::max(is.search, tie.search_distance);
    if (was.segment != is.segment && std::fabs(was.distance - is.distance) > equal)
      return "would be tied to another segment";
    return was.penalty == is.penalty ? "" : "would be tied by penalty";
  }

  /// Searches nearer nodes: a large dsearch finds other segments, also for near nodes. `taken`
  /// stays empty if there are none.
  void search_nearer(TiePlan& plan) {
    const Tie& tie = ties_[plan.at];
    const double keep = std::max(tie.search_distance, farthest_tied(tie));
    constexpr int most = 40;  // down to a ten-thousandth of the wanted distance
    for (int step = 0; step < most && plan.reach * nearer > keep; ++step) {
      plan.reach *= nearer;
      std::erase_if(fix_.refused,
                    [&](const FixRefusal& r) { return r.interface_id == tie.inter->id; });
      plan.taken.clear();
      put_planned();
      set_dsearch(plan.at, widest(plan));
      const std::vector<Tie> wide = ties_with();
      TieConflicts holders(context_, before_);
      for (const TiePlan& other : plans_)
        if (other.at != plan.at)
          for (const TieCandidate& c : other.taken)
            holders.add(ties_[other.at], c.node->node, c.segment);
      decide(plan, wide[plan.at], holders);
      if (!plan.taken.empty()) return;
    }
  }
  static constexpr double nearer = 0.8;  ///< few steps from any reach to the distance of a node

  void put_planned() {
    dsearch_.type2 = context_.interfaces().type2;
    for (const TiePlan& plan : plans_)
      if (!plan.taken.empty()) set_dsearch(plan.at, plan.value);
  }

  /// Drops nodes that change other ties.
  void drop_harmful() {
    while (!plans_.empty()) {
      put_planned();
      std::size_t where = 0;
      const std::string why = harm(ties_with(), where);
      if (why.empty()) return;
      const bool own = std::any_of(plans_.begin(), plans_.end(),
                                   [&](const TiePlan& p) { return p.at == where; });
      for (TiePlan& p : plans_)
        if ((!own || p.at == where) &&
            !do_with_less(p, own ? why : name_of(*ties_[where].inter) + ": " + why))
          search_nearer(p);
      std::erase_if(plans_, [](const TiePlan& p) { return p.taken.empty(); });
    }
  }

  Result<PenetrationFix> make_result() {
    CellWriter edits(context_.deck().sources);
    for (const TiePlan& plan : plans_) plan.place.write(edits, plan.text.text);
    fix_.rewrite.edits = edits.release_edits();
    const auto again = AfterRewrite::read(context_, fix_.rewrite, options_, true, before_);
    if (!again) return again.error();
    Scene after = again->scene();
    std::size_t where = 0;
    if (const std::string why = harm(after.ties, where); !why.empty()) {
      // The text does not have the intended effect: change nothing.
      for (const TiePlan& plan : plans_)
        refuse(ties_[plan.at], fmt::format("nothing done: read again, interface {}, {}",
                                           ties_[where].inter->id, why));
      plans_.clear();
      fix_.rewrite = {};
      after = fix_scene(context_, options_, true);
    }
    fix_.complete = true;
    for (std::size_t t = 0; t < ties_.size(); ++t) list(t, after.ties[t]);
    std::stable_sort(
        fix_.refused.begin(), fix_.refused.end(),
        [](const FixRefusal& a, const FixRefusal& b) { return a.interface_id < b.interface_id; });
    fix_.complete &= fix_.refused.empty();
    before_.ties.clear();  // already judged
    after.ties.clear();
    verify_harmless(fix_, context_.interfaces(), options_, before_, after);
    if (fix_.rewrite.edits.empty())
      for (FixedTie& tie : fix_.ties)
        if (!tie.changes.empty())
          tie = {tie.id, tie.title, tie.reach, tie.before, tie.before, 0, {}, {}};
    return std::move(fix_);
  }

  void list(std::size_t at, const Tie& after) {
    const Tie& before = ties_[at];
    if (!asks_for(options_, before.inter->id) || count_ties(before).lost() == 0) return;
    FixedTie out;
    out.id = before.inter->id;
    out.title = before.inter->title;
    out.before = count_ties(before);
    out.after = count_ties(after);
    out.reach = options_.reach.value_or(mean_side(before_.coordinates, before.main));
    fix_.complete &= out.after.lost() == 0;
    for (const TiePlan& plan : plans_) {
      if (plan.at != at) continue;
      out.needed = plan.needed;
      out.changes.push_back({"dsearch", std::string(plan.place.text), plan.text.text,
                             before.search_distance, plan.value});
      for (const TiedNode& n : after.nodes) {
        if (!plan.nodes.contains(n.node)) continue;
        NewlyTied tied{before_.model->node_id(n.node), {}, n.distance};
        for (const NodeIndex corner : after.main[n.segment])
          tied.segment.push_back(before_.model->node_id(corner));
        out.nodes.push_back(std::move(tied));
      }
    }
    fix_.ties.push_back(std::move(out));
  }

  const LoadedDeck& context_;
  const TieOptions& options_;
  Scene before_;
  std::vector<Tie> ties_;  ///< of `before_`
  Interfaces dsearch_;     ///< ties with other search distances
  std::vector<TiePlan> plans_;
  PenetrationFix fix_;
};

}  // namespace

Result<PenetrationFix> tie_nodes(const LoadedDeck& context, const TieOptions& options) {
  if (options.reach && !(*options.reach > 0))
    return Error{Error::Code::config, "the reach of ties is a length above 0"};
  return TieFix(context, options).run();
}

}  // namespace deck
