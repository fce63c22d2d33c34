// Findings about the first cycle: forces before any motion, contact steps below that of the mesh,
// pairs near the end of their gap.
#include <algorithm>

#include "base/shared/words.hpp"
#include "deck/cycle.hpp"
#include "deck/text.hpp"
#include "lint/checks/geometry/geometry.hpp"

namespace deck::detail {
namespace {

using cycle::InterfaceSummary;
using cycle::PairOutcome;

std::string node_name(const Model& model, NodeIndex n) {
  return n == no_index ? std::string("?") : std::to_string(model.node_id(n));
}

std::string summary_name(const InterfaceSummary& s) {
  return fmt::format("/INTER/TYPE{} {}", s.inter->type, s.id);
}

/// True if some pair is deeper than round-off: a millionth of its gap.
bool counts(const cycle::SceneOutcome& outcome, const InterfaceSummary& s) {
  return std::any_of(outcome.contacts.begin(), outcome.contacts.end(),
                     [&](const cycle::ContactOutcome& c) {
                       return c.contact->inter == s.inter && c.largest_force > 0.0 &&
                              c.largest.penetration > 1e-6 * c.largest.gap;
                     });
}

void report_force(const GeometryRun& run, const InterfaceSummary& s) {
  if (s.pairs_with_force == 0) return;
  std::string message = fmt::format(
      "{}: {} {} before anything moves, with a force of {} in all and {} at most of one pair",
      summary_name(s), count_text(s.pairs_with_force, "pair"),
      s.pairs_with_force == 1 ? "pushes" : "push", figure_text(s.force_sum),
      figure_text(s.largest_pair_force));
  if (s.acceleration_node != no_index)
    message += fmt::format("; node {} starts with an acceleration of {}",
                           node_name(run.model(), s.acceleration_node),
                           figure_text(s.largest_acceleration));
  if (s.elastic_energy > 0)
    message += fmt::format("; stored energy {}", figure_text(s.elastic_energy));
  Finding& d = run.report(RuleId::DK401, *s.inter, "Inacti", std::move(message), s.force_sum);
  if (s.acceleration_node != no_index)
    d.notes.emplace_back(run.model().node_span(s.acceleration_node), "the node pushed most");
}

std::string_view element_of(cycle::StepLimit::Source source) {
  using Source = cycle::StepLimit::Source;
  return source == Source::kinematic  ? "half the time to the mid-surface"
         : source == Source::velocity ? "the gap over the largest relative velocity"
                                      : "contact stiffness against nodal mass";
}

/// "time step 1.2e-06 from contact stiffness against nodal mass at node 5"
std::string step_text(const GeometryRun& run, const InterfaceSummary& s) {
  std::string out =
      fmt::format("time step {:.4g} from {}", s.contact_dt, element_of(s.contact_dt_source));
  if (s.contact_dt_node != no_index)
    out += fmt::format(" at node {}", node_name(run.model(), s.contact_dt_node));
  return out;
}

void report_step(const GeometryRun& run, const InterfaceSummary& s) {
  if (!(s.contact_dt < s.structure_dt) || s.structure_dt >= 1e30) return;
  std::string message = fmt::format(
      "{}: {}; the mesh allows {:.4g}, so the run takes {:.1f} times as many steps",
      summary_name(s), step_text(run, s), s.structure_dt, s.structure_dt / s.contact_dt);
  Finding& d = run.report(RuleId::DK402, *s.inter, "Stfac", std::move(message),
                          s.structure_dt / s.contact_dt);
  if (s.contact_dt_node != no_index)
    d.notes.emplace_back(run.model().node_span(s.contact_dt_node), "the node that limits it");
}

/// "node 5 over segment 1 2 3 4"
std::string pair_text(const Model& model, const Contact& c, const PairOutcome& p) {
  if (c.kind == ContactKind::node_segment)
    return fmt::format("node {} over segment {}", model.node_id(c.secondary[p.at.secondary].node),
                       nodes_text(model, c.main[p.at.main]));
  const auto& a = c.secondary_edges[p.at.secondary].nodes;
  const auto& b = c.main_edges[p.at.main].nodes;
  return fmt::format("edges {}-{} and {}-{}", model.node_id(a[0]), model.node_id(a[1]),
                     model.node_id(b[0]), model.node_id(b[1]));
}

void report_singular(const GeometryRun& run, const InterfaceSummary& s,
                     const cycle::SceneOutcome& outcome) {
  const Contact* where = nullptr;
  const PairOutcome* worst = nullptr;
  double least = 1.0;
  for (const cycle::ContactOutcome& c : outcome.contacts) {
    if (c.contact->inter != s.inter || c.near_singular.empty()) continue;
    const PairOutcome& p = c.near_singular.front();
    const double left = p.gap > 0 ? (p.gap - p.penetration) / p.gap : 1.0;
    if (worst != nullptr && left >= least) continue;
    where = c.contact;
    worst = &p;
    least = left;
  }
  if (worst == nullptr && s.gap_closed == 0) return;
  std::string message = fmt::format("{}:", summary_name(s));
  if (worst != nullptr)
    message +=
        fmt::format(" {} with less than 5 % of the gap left; {} has {:.3g} of {:.4g} ({:.2g} %)",
                    count_text(s.near_singular, "pair"), pair_text(run.model(), *where, *worst),
                    worst->gap - worst->penetration, worst->gap, 100 * least);
  if (s.gap_closed > 0)
    message += fmt::format("{} {} already at the end of the gap, without a force",
                           worst != nullptr ? ";" : "", count_text(s.gap_closed, "pair"));
  run.report(RuleId::DK403, *s.inter, traits_of(*s.inter).gap, std::move(message),
             static_cast<double>(s.near_singular + s.gap_closed));
}

/// Time step of /DT/INTER/DEL at the start, with the nodes at deck positions.
struct DeletionStep {
  double dt = 0;  ///< 0: not requested
  Span place;
};
DeletionStep deletion_step(const LintContext& c) {
  if (c.engine->files.empty() || c.engine->files[0].number != 1) return {};
  for (const EngineBlock& b : c.engine->files[0].blocks) {
    if (b.part(0) != "DT" || b.part(1) != "INTER" || b.part(2) != "DEL" || b.lines.empty())
      continue;
    const std::vector<Span> cells = engine_cells(c.deck.sources, b.lines[0]);
    if (cells.size() < 2) return {};
    return {read_real(c.text(cells[1])).value, b.lines[0]};
  }
  return {};
}

/// dtmin on the card overrides /DT/INTER/DEL; TYPE10 ignores it.
void report_deletion(const GeometryRun& run, const InterfaceSummary& s,
                     const DeletionStep& deletion) {
  if (!(s.contact_dt <= deletion.dt) || s.inter->type == 10) return;
  const ContactCard* card = run.card(*s.inter);
  if (card != nullptr && card->given("dtmin")) return;
  Finding& d = run.report(RuleId::DK808, *s.inter, "dtmin",
                          fmt::format("{}: {}, and /DT/INTER/DEL removes nodes below {:.4g}",
                                      summary_name(s), step_text(run, s), deletion.dt));
  d.notes.emplace_back(deletion.place, "the time step of /DT/INTER/DEL");
}

}  // namespace

void check_cycle(const GeometryRun& run, const cycle::SceneOutcome& outcome) {
  for (const cycle::ContactOutcome& c : outcome.contacts)
    if (c.undecided() && c.contact->evaluated && !c.notes.empty()) {
      if (!c.stiffness_known)
        run.left_out.push_back({name_of(*c.contact) + ": forces", c.notes.back()});
      else if (run.quick)
        run.left_out.push_back(too_many_pairs(name_of(*c.contact), "forces"));
      else
        run.report(RuleId::DK381, *c.contact, gap_field(*c.contact), c.notes.back());
    }
  const DeletionStep deletion = deletion_step(run.context);
  for (const InterfaceSummary& s : cycle::summarize(run.scene, outcome)) {
    if (s.inter->type != 10) {
      if (counts(outcome, s)) report_force(run, s);
      report_singular(run, s, outcome);
    }
    report_step(run, s);
    report_deletion(run, s, deletion);
  }
}

}  // namespace deck::detail
