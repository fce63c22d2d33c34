// Initial penetrations of a contact.
// Candidates come from the pair search (contact/search), which may return too many but never too
// few. Each one is judged in parallel by PairJudge: in the solver's arithmetic, exactly, or both,
// as SceneOptions::accuracy asks. Then rows and Inacti actions are made one by one in the solver's
// order, because Inacti 3 moves nodes of later pairs. Cost: linear in the candidates.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/rules/actions.hpp"
#include "contact/shared/filtered.hpp"
#include "contact/shared/scene_steps.hpp"
#include "contact/shared/sides.hpp"
#include "deck/text.hpp"

namespace deck::detail {
namespace {

/// Copies of a pair during the merge of both search forms.
constexpr std::size_t copies_of_a_pair = 4;

std::size_t most_pairs(const SceneContext& c) {
  return c.options.limits.pair_bytes / (copies_of_a_pair * sizeof(CandidatePair));
}

/// Mean edge length of the main side, as a scale for gaps.
double mean_main_edge(const SceneContext& c, const Contact& contact) {
  double sum = 0;
  std::size_t count = 0;
  const auto add = [&](NodeIndex a, NodeIndex b) {
    if (a == b) return;
    sum += distance(c.scene.coordinates, a, b);
    ++count;
  };
  for (const MainSegment& m : contact.main)
    for (std::size_t k = 0; k < 4; ++k) add(m.nodes[k], m.nodes[(k + 1) % 4]);
  for (const ContactEdge& e : contact.main_edges) add(e.nodes[0], e.nodes[1]);
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

/// Drops the results of a contact with more pairs than memory allows.
void give_up(SceneContext& c, Contact& contact) {
  contact.evaluated = false;
  std::vector<PenetrationRow>().swap(contact.penetrations);
  contact.candidates = contact.removed_pairs = 0;
  if (!c.findings.wants(RuleId::DK390)) return;
  const double gap = std::max(contact.max_gap, contact.gapmin);
  const double edge = mean_main_edge(c, contact);
  Finding d = make_finding(
      RuleId::DK390, contact.inter->span,
      fmt::format("/INTER/TYPE{} {}: the list of pairs within the gap would need more than {} MB; "
                  "penetrations of this interface were not evaluated. Its largest gap is {:.6g}, "
                  "{:.3g} times the mean edge of its main side ({:.6g})",
                  contact.inter->type, contact.inter->id, c.options.limits.pair_bytes >> 20, gap,
                  edge > 0 ? gap / edge : 0.0, edge));
  d.keyword = "/INTER/TYPE" + std::to_string(contact.inter->type);
  d.id = contact.inter->id;
  c.findings.add(std::move(d));
}

/// True while the penetrations fit into the allowed memory.
bool rows_fit(const SceneContext& c, const Contact& contact) {
  return contact.penetrations.size() <= c.options.limits.pair_bytes / sizeof(PenetrationRow);
}

/// Memory for `more` rows and for all that the first `looked_at` of `pairs` predict: repeated
/// doubling would take several times the memory of a long list.
void reserve_rows(std::vector<PenetrationRow>& rows, std::size_t more, std::uint64_t looked_at,
                  std::size_t pairs) {
  const std::size_t after = rows.size() + more;
  if (after <= rows.capacity()) return;
  const double share = std::max(1.0, static_cast<double>(looked_at)) / static_cast<double>(pairs);
  const double expected = 1.05 * static_cast<double>(after) / share;
  const std::size_t least = after + after / 2, most = 4 * after;
  rows.reserve(expected < static_cast<double>(most)
                   ? std::max(least, static_cast<std::size_t>(expected))
                   : most);
}

Point3<double> point(const Coordinates& c, NodeIndex n) { return {c.x[n], c.y[n], c.z[n]}; }

/// Candidates of a contact: those of the solver's search, and those of the exact search only.
struct Candidates {
  std::vector<CandidatePair> pairs;  // all, sorted
  std::vector<CandidatePair> extra;  // of the exact search only: not counted as candidates
  bool complete = true;

  bool is_counted(const CandidatePair& pair) const {
    return !std::binary_search(extra.begin(), extra.end(), pair);
  }
};

/// Pairs of a range with a penetration or a difference.
struct JudgedPairs {
  std::vector<PairVerdict> verdicts;
  DecisionReport report;
};

/// Searches in the forms that the accuracy needs. Exact decisions need both: the reference distance
/// of a segment without area can be far too large, and its round-off can hide a touch.
Candidates candidates(const SearchSides& sides, const Coordinates& x, Accuracy accuracy,
                      SearchOptions search) {
  const bool one = accuracy == Accuracy::fast || accuracy == Accuracy::reference;
  search.form = accuracy == Accuracy::fast ? Form::robust : Form::reference;
  // Far above the round-off of the robust formula.
  const double margin = one ? sweep::one_form : 1e-6 * sides.edge_length(x);
  sweep::BothForms found = sides.find_both_forms(x, search, margin);
  Candidates out;
  out.complete = found.result.complete;
  out.pairs = std::move(found.result.pairs);
  out.extra = std::move(found.robust_only);
  if (out.extra.empty()) return out;
  std::vector<CandidatePair> all;
  all.reserve(out.pairs.size() + out.extra.size());
  std::merge(out.pairs.begin(), out.pairs.end(), out.extra.begin(), out.extra.end(),
             std::back_inserter(all));
  out.pairs = std::move(all);
  return out;
}

/// Order of judging and acting.
enum class Judging : bool {
  ahead,   ///< on all threads: no action changes the judgement of later pairs
  in_turn  ///< pair by pair
};

/// For all pairs not removed, in order: before(pair) returns whether to continue; act(verdict) is
/// called if judge(judge, pair) gives a penetration or a difference. False if stopped.
template <class Before, class Judge, class Act>
bool judge_in_order(const SceneContext& c, DecisionReport& all, const Candidates& found,
                    const RemovalLists& removed, Judging judging, const Before& before,
                    const Judge& judge, const Act& act) {
  const bool ahead = judging == Judging::ahead;
  const std::size_t at_once = ahead ? 4096 : 1;
  std::atomic<bool> ended{false};
  const auto each = [&](std::size_t piece, const auto& f) {
    const std::size_t end = std::min((piece + 1) * at_once, found.pairs.size());
    for (std::size_t i = piece * at_once; i < end && !ended; ++i)
      if (!is_removed(removed, found.pairs[i])) f(found.pairs[i]);
  };
  const auto work = [&](std::size_t piece, JudgedPairs& out) {
    out.verdicts.clear();
    out.report = {};
    const bool exact = c.options.accuracy == Accuracy::exact;
    const bool over = exact && c.options.exact_over && c.options.exact_over();
    PairJudge own(over ? Accuracy::robust : c.options.accuracy, out.report);
    each(piece, [&](const CandidatePair& pair) {
      if (!ahead && !before(pair)) {
        ended = true;
        return;
      }
      PairVerdict verdict = judge(own, pair);
      if (!verdict.is_row() && !verdict.differs) return;
      verdict.row.secondary = pair.secondary;
      verdict.row.main = pair.main;
      out.verdicts.push_back(verdict);
    });
  };
  const auto take = [&](std::size_t piece, JudgedPairs& in) {
    all.fallback += in.report.fallback;
    all.exact += in.report.exact;
    auto next = in.verdicts.begin();
    each(piece, [&](const CandidatePair& pair) {
      if (ahead && !before(pair)) {
        ended = true;
        return;
      }
      ++all.pairs;
      if (next != in.verdicts.end() && next->row.secondary == pair.secondary &&
          next->row.main == pair.main)
        act(*next++);
    });
  };
  const std::size_t pieces = (found.pairs.size() + at_once - 1) / at_once;
  run_in_order<JudgedPairs>(pieces, ahead ? c.options.threads : 1, work, take);
  return !ended;
}

std::uint64_t count_removed(const Candidates& found, const RemovalLists& removed) {
  return static_cast<std::uint64_t>(
      std::count_if(found.pairs.begin(), found.pairs.end(), [&](const CandidatePair& pair) {
        return is_removed(removed, pair) && found.is_counted(pair);
      }));
}

/// Reports a pair on which solver and exact arithmetic differ.
void note(PairJudge& judge, const PairVerdict& verdict, const PenetrationRow& row) {
  DecisionDifference d = verdict.difference;
  d.secondary = row.secondary;
  d.main = row.main;
  d.action = row.action;
  judge.note(d);
}

/// Search options of the start, for nodes and edges, without margin.
SearchOptions search_of(const SceneContext& c, const Contact& contact) {
  SearchOptions search;
  search.gap = contact.gap_rule;
  search.drad = contact.drad;
  search.threads = c.options.threads;
  search.max_pairs = most_pairs(c);
  return search;
}

}  // namespace

bool find_removed(const Scene& scene, const Contact& contact, const SearchSides& sides,
                  RemovalLists& removed) {
  if (contact.irem_gap != 2) return true;
  const RemovalGaps gaps{contact.gap_rule, contact.igap, contact.drad, contact.max_gap,
                         contact.shortest_side};
  const std::uint64_t room = scene.limits.pair_bytes / sizeof(std::uint32_t);
  const Coordinates& x = scene.coordinates;
  return sides.edge_pairs() ? remove_along_mesh(sides.edges(x), gaps, room, removed)
                            : remove_along_mesh(sides.nodes(x), gaps, room, removed);
}

void find_penetrations(SceneContext& c, Contact& contact, DecisionReport& decisions) {
  if (contact.main.empty() || contact.secondary.empty()) return;
  const Coordinates& x = c.scene.coordinates;
  SearchOptions search = search_of(c, contact);
  std::optional<SearchSides> sides(std::in_place, contact, SearchSides::Off::included,
                                   c.options.threads);
  const bool wide = c.options.candidates || contact.inacti == 3;
  search.margin = wide ? sides->margin(x) : 0;
  Candidates found = candidates(*sides, x, c.options.accuracy, search);
  if (!found.complete && wide) {
    search.margin = 0;
    found = candidates(*sides, x, c.options.accuracy, search);
  }
  RemovalLists removed;
  if (!found.complete || !find_removed(c.scene, contact, *sides, removed))
    return give_up(c, contact);
  sides.reset();
  PairJudge judge(c.options.accuracy, decisions);
  const int error = on_surface_error(contact.type, contact.itied, contact.fpenmax, contact.inacti);
  // The solver measures a group of candidates before it acts on any of them.
  CandidateGroup group;
  std::vector<PairVerdict> verdicts;
  Coordinates& moved = c.scene.coordinates;
  const MovableNodes movable{moved.x, moved.y, moved.z};
  const auto act_on_group = [&] {
    group.start();
    reserve_rows(contact.penetrations, verdicts.size(), contact.candidates, found.pairs.size());
    for (PairVerdict& verdict : verdicts) {
      if (verdict.solver_acts) {
        SecondaryNode& s = contact.secondary[verdict.row.secondary];
        act_on_node(contact.inacti, contact.fpenmax, verdict.row, movable, s.node, group);
        s.off |= verdict.row.action == PenetrationAction::node_stiffness_zero;
        contact.main[verdict.row.main].off |=
            verdict.row.action == PenetrationAction::segment_stiffness_zero;
      }
      if (verdict.row.on_surface && error != 0)
        verdict.row.action =
            error == 611 ? PenetrationAction::error_611 : PenetrationAction::error_612;
      if (verdict.differs) note(judge, verdict, verdict.row);
      if (verdict.is_row()) contact.penetrations.push_back(verdict.row);
    }
    verdicts.clear();
  };
  contact.removed_pairs = count_removed(found, removed);
  const auto before = [&](const CandidatePair& pair) {
    if (!found.is_counted(pair)) return true;
    ++contact.candidates;
    if (!group.begins_another()) return true;
    act_on_group();
    return rows_fit(c, contact);
  };
  const auto judge_pair = [&](PairJudge& by, const CandidatePair& pair) {
    const SecondaryNode& s = contact.secondary[pair.secondary];
    const MainSegment& m = contact.main[pair.main];
    const std::array<Point3<double>, 4> corners{point(x, m.nodes[0]), point(x, m.nodes[1]),
                                                point(x, m.nodes[2]), point(x, m.nodes[3])};
    const double gap = contact.pair_gap(pair.secondary, pair.main);
    return by.judge(point(x, s.node), corners, m.nodes[2] == m.nodes[3], gap);
  };
  const auto take = [&](const PairVerdict& verdict) { verdicts.push_back(verdict); };
  // Inacti 3 moves nodes of later pairs.
  const Judging judging = contact.inacti == 3 ? Judging::in_turn : Judging::ahead;
  if (!judge_in_order(c, decisions, found, removed, judging, before, judge_pair, take))
    return give_up(c, contact);
  act_on_group();
}

void find_edge_penetrations(SceneContext& c, Contact& contact, DecisionReport& decisions) {
  if (contact.main_edges.empty() || contact.secondary_edges.empty()) return;
  const Coordinates& x = c.scene.coordinates;
  const SearchOptions search = search_of(c, contact);
  std::optional<SearchSides> sides(std::in_place, contact, SearchSides::Off::included,
                                   c.options.threads);
  const Candidates found = candidates(*sides, x, c.options.accuracy, search);
  RemovalLists removed;
  if (!found.complete || !find_removed(c.scene, contact, *sides, removed))
    return give_up(c, contact);
  sides.reset();
  PairJudge judge(c.options.accuracy, decisions);
  contact.removed_pairs = count_removed(found, removed);
  const auto before = [&](const CandidatePair& pair) {
    contact.candidates += found.is_counted(pair);
    return rows_fit(c, contact);
  };
  const auto judge_pair = [&](PairJudge& by, const CandidatePair& pair) {
    const ContactEdge& s = contact.secondary_edges[pair.secondary];
    const ContactEdge& m = contact.main_edges[pair.main];
    return by.judge(
        {point(x, s.nodes[0]), point(x, s.nodes[1]), point(x, m.nodes[0]), point(x, m.nodes[1])},
        contact.pair_gap(pair.secondary, pair.main));
  };
  const auto act = [&](PairVerdict& verdict) {
    ContactEdge& s = contact.secondary_edges[verdict.row.secondary];
    ContactEdge& m = contact.main_edges[verdict.row.main];
    if (verdict.solver_acts) {
      contact.secondary_stored.resize(contact.secondary_edges.size());
      contact.main_stored.resize(contact.main_edges.size());
      act_on_edges(contact.inacti, verdict.row, contact.secondary_stored[verdict.row.secondary],
                   contact.main_stored[verdict.row.main]);
      if (verdict.row.action == PenetrationAction::edge_stiffness_zero)
        (contact.inacti == 2 ? m : s).off = true;
    }
    if (verdict.differs) note(judge, verdict, verdict.row);
    if (verdict.is_row()) contact.penetrations.push_back(verdict.row);
  };
  if (!judge_in_order(c, decisions, found, removed, Judging::ahead, before, judge_pair, act) ||
      !rows_fit(c, contact))
    return give_up(c, contact);
  // The remaining gap is known only after all pairs of the edge.
  if (contact.main_stored.empty()) return;
  for (PenetrationRow& row : contact.penetrations)
    complete_edge_row(row, contact.secondary_stored[row.secondary], contact.main_stored[row.main]);
}

/// Coincident nodes, typical of a part exported at the origin: reported once, because every node
/// then is on every segment of the others.
void report_one_place(SceneContext& c, const Contact& contact) {
  const Coordinates& x = c.scene.coordinates;
  std::vector<NodeIndex> touching;
  for (const PenetrationRow& row : contact.penetrations) {
    if (!row.on_surface) continue;
    if (contact.kind == ContactKind::node_segment) {
      touching.push_back(contact.secondary[row.secondary].node);
    } else {
      const auto& nodes = contact.secondary_edges[row.secondary].nodes;
      touching.insert(touching.end(), nodes.begin(), nodes.end());
    }
  }
  const auto place = [&](NodeIndex n) { return std::array{x.x[n], x.y[n], x.z[n]}; };
  const auto before = [&](NodeIndex a, NodeIndex b) {
    return std::tuple(place(a), a) < std::tuple(place(b), b);
  };
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  std::sort(touching.begin(), touching.end(), before);
  constexpr std::ptrdiff_t most = 8;  // as in joints and seams
  for (auto first = touching.begin(); first != touching.end();) {
    const auto last =
        std::find_if(first, touching.end(), [&](NodeIndex n) { return place(n) != place(*first); });
    if (last - first > most && c.findings.wants(RuleId::DK336)) {
      const auto at = place(*first);
      Finding d = make_finding(
          RuleId::DK336, contact.inter->span,
          fmt::format("/INTER/TYPE{} {}: {} nodes at one place ({:.6g}, {:.6g}, {:.6g}), {} and {} "
                      "among them",
                      contact.inter->type, contact.inter->id, last - first, at[0], at[1], at[2],
                      c.model.node_id(*first), c.model.node_id(*(last - 1))));
      d.keyword = "/INTER/TYPE" + std::to_string(contact.inter->type);
      d.id = contact.inter->id;
      d.notes.emplace_back(c.model.node_span(*first), "one of the nodes");
      c.findings.add(std::move(d));
    }
    first = last;
  }
}

}  // namespace deck::detail
