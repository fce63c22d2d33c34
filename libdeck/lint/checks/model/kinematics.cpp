// Conflicting kinematic conditions: those that the solver counts, refuses or removes.
#include "model/shared/kinematics.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/shared/words.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// The conditions of the deck, with names of the options.
class Conditions {
 public:
  explicit Conditions(const LintContext& c) : model_(*c.model), shown_(c.loaded->kinematics()) {}
  const Kinematics* operator->() const { return &shown_; }

  const Block& block(std::uint32_t source) const { return *shown_.sources[source].block; }
  std::string name(std::uint32_t source) const {
    return fmt::format("{} {}", block(source).schema->keyword, shown_.sources[source].id);
  }
  std::int64_t node(NodeIndex n) const { return model_.node_id(n); }

 private:
  const Model& model_;
  const Kinematics& shown_;
};

const char* direction_name(int direction) {
  constexpr const char* names[] = {"X", "Y", "Z", "XX", "YY", "ZZ", "all directions"};
  return names[direction];
}

/// Conflict of two options.
struct Pair {
  std::uint64_t bookings = 0;
  std::set<NodeIndex> nodes;
  NodeIndex first = no_index;
  std::uint8_t directions = 0;
};

std::string directions_text(std::uint8_t mask) {
  std::string out;
  for (int d = 0; d < 7; ++d)
    if ((mask >> d & 1) != 0) out += (out.empty() ? "" : ", ") + std::string(direction_name(d));
  return out;
}

void check_conflicts(const LintContext& c, const Rule& rule, Reporter& r) {
  const Conditions k(c);
  if (k->stops || k->conflicts == 0) return;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Pair> pairs;
  std::set<NodeIndex> nodes;
  for (const KinematicConflict& b : k->bookings) {
    if (!b.counted) continue;
    Pair& p = pairs[{b.earlier, b.later}];
    ++p.bookings;
    if (p.nodes.empty()) p.first = b.node;
    p.nodes.insert(b.node);
    p.directions = static_cast<std::uint8_t>(p.directions | 1u << b.direction);
    nodes.insert(b.node);
  }
  if (pairs.empty()) return;
  const Block& head = k.block(pairs.begin()->first.second);
  constexpr std::int64_t detailed = 5;  // Ipri at which the solver lists every conflict
  const bool for_each_pair = printout_level(c).integer >= detailed;
  if (for_each_pair || pairs.size() > 1)
    r.report(rule, head, head.header_span,
             fmt::format("{} on {} (the solver counts per node and direction)",
                         count(k->conflicts, "conflicting condition", "conflicting conditions"),
                         count(nodes.size(), "node", "nodes")));
  for (const auto& [key, p] : pairs) {
    const auto [earlier, later] = key;
    const Block& block = k.block(later);
    const std::string more =
        p.nodes.size() > 1 ? fmt::format(" (and {} more)", p.nodes.size() - 1) : std::string();
    Finding& d = r.report(
        rule, block, block.header_span,
        earlier == later
            ? fmt::format("node {}{}: {} holds it twice", k.node(p.first), more, k.name(later))
            : fmt::format("node {}{}: {} and {} both hold it ({})", k.node(p.first), more,
                          k.name(earlier), k.name(later), directions_text(p.directions)));
    if (earlier != later) d.notes.emplace_back(k.block(earlier).header_span, "the other condition");
    if (for_each_pair) d.reference = rule.message(147);
  }
}

void check_walls(const LintContext& c, const Rule& rule, Reporter& r) {
  const Conditions k(c);
  if (k->stops) return;
  for (const WallCorrection& w : k->walls) {
    const NodeIndex n = w.nodes.front();
    // Other conditions of the wall's node.
    const auto sources = k->of(n);
    const auto other = std::find_if(sources.begin(), sources.end(), [&](std::uint32_t s) {
      const ConditionType t = k->sources[s].type;
      return t == ConditionType::rbody || t == ConditionType::tied;
    });
    const Block& block = k.block(w.wall);
    Finding& d = r.report(
        rule, block, block.header_span,
        fmt::format("{} loses {}: node {} belongs to {}", k.name(w.wall),
                    count(w.nodes.size(), "node", "nodes"), k.node(n),
                    other == sources.end() ? std::string("another condition") : k.name(*other)));
    if (other != sources.end()) d.notes.emplace_back(k.block(*other).header_span, "holds the node");
  }
}

/// True if an Engine file switches rigid bodies off; shared nodes during the run are then unknown.
bool bodies_end(const LintContext& c) {
  return c.engine != nullptr &&
         std::any_of(c.engine->files.begin(), c.engine->files.end(), [](const EngineFile& f) {
           return std::any_of(f.blocks.begin(), f.blocks.end(), [](const EngineBlock& b) {
             return b.keyword.starts_with("/RBODY/OFF");
           });
         });
}

void check_shared_bodies(const LintContext& c, const Rule& rule, Reporter& r) {
  const Conditions k(c);
  if (bodies_end(c)) return;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<const SharedBody*>> pairs;
  for (const SharedBody& s : k->shared) pairs[{s.first, s.second}].push_back(&s);
  for (const auto& [key, shared] : pairs) {
    const Block& block = k.block(key.second);
    Finding& d = r.report(
        rule, block, block.header_span,
        fmt::format("{} of both {} and {}, for example node {}",
                    count(shared.size(), "node is a secondary node", "nodes are secondary nodes"),
                    k.name(key.first), k.name(key.second), k.node(shared.front()->node)));
    d.notes.emplace_back(k.block(key.first).header_span, "the other body");
    if (!shared.front()->sensor) continue;
    d.severity = Severity::warning;
    d.reference = rule.message(1026);
  }
}

/// Effect of conflicting conditions by solver message; warnings from 3000 on.
constexpr std::pair<int, const char*> meetings[] = {
    {148, "are boundary conditions with different skews"},
    {806, "do not go together: the main node of the body follows the rigid element"},
    {807, "have the same main node"},
    {1036, "do not go together: the main node of the rigid element is tied"},
    {3096, "meet at an independent node: the solver uses a penalty instead"},
    {3100, "meet at an independent node: the solver uses a penalty instead"},
    {3115, "meet at the dependent node: the solver uses a penalty instead"}};

void check_refused(const LintContext& c, const Rule& rule, Reporter& r) {
  const Conditions k(c);
  std::map<std::array<std::uint32_t, 3>, std::vector<NodeIndex>> cases;
  for (const ForbiddenCondition& f : k->forbidden)
    cases[{static_cast<std::uint32_t>(f.message), f.first, f.second}].push_back(f.node);
  for (const auto& [key, nodes] : cases) {
    const auto message = static_cast<int>(key[0]);
    const Block& block = k.block(key[1]);
    const auto* what = std::find_if(std::begin(meetings), std::end(meetings),
                                    [&](const auto& m) { return m.first == message; });
    Finding& d = r.report(
        rule, block, block.header_span,
        fmt::format("node {}{}: {} and {} {}", k.node(nodes.front()),
                    nodes.size() > 1 ? fmt::format(" (and {} more)", nodes.size() - 1) : "",
                    k.name(key[1]), k.name(key[2]), what->second));
    d.notes.emplace_back(k.block(key[2]).header_span, "the other condition");
    d.reference = rule.message(message);
    if (message >= 3000) d.severity = Severity::warning;
  }
}

}  // namespace

std::vector<Checked> kinematic_checks() {
  return {{RuleId::DK610, check_conflicts},
          {RuleId::DK611, check_walls},
          {RuleId::DK612, check_shared_bodies},
          {RuleId::DK613, check_refused}};
}

}  // namespace deck::detail
