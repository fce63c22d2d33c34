// What a verdict says about forces and time steps.
#include <fmt/format.h>

#include <algorithm>

#include "base/shared/count.hpp"
#include "base/shared/length_text.hpp"
#include "verdict/parts.hpp"

namespace deck {

std::string secondary_name(const Model& model, const Contact& c, std::uint32_t secondary) {
  if (c.kind == ContactKind::node_segment)
    return fmt::format("node {}", model.node_id(c.secondary[secondary].node));
  const auto& n = c.secondary_edges[secondary].nodes;
  return fmt::format("edge {}-{}", model.node_id(n[0]), model.node_id(n[1]));
}

std::size_t removed_by_step(const cycle::ContactOutcome& o) {
  return static_cast<std::size_t>(
      std::count_if(o.removed.begin(), o.removed.end(), [](const cycle::Removal& r) {
        return r.because == cycle::Removal::Because::kinematic_step ||
               r.because == cycle::Removal::Because::nodal_step;
      }));
}

namespace detail {
namespace {

/// Sums over the contacts of an evaluation.
struct Sums {
  std::size_t pairs = 0, closed = 0, by_step = 0, tied = 0, open = 0;
  const cycle::ContactOutcome* first_gone = nullptr;  ///< the first that dtmin takes something from
  const cycle::ContactOutcome* worst = nullptr;       ///< with the largest acceleration

  explicit Sums(const cycle::SceneOutcome& o) {
    for (const cycle::ContactOutcome& c : o.contacts) {
      pairs += c.pairs_with_force;
      closed += c.gap_closed;
      tied += c.pairs_tied;
      open += !c.complete;
      by_step += removed_by_step(c);
      if (first_gone == nullptr && removed_by_step(c) > 0) first_gone = &c;
      if (worst == nullptr || c.largest_acceleration > worst->largest_acceleration) worst = &c;
    }
  }
};

/// "node 1, node 2, node 3 and 5 more" of those that leave a contact.
std::string gone_text(const Model& model, const cycle::ContactOutcome& o) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, o.removed.size()); ++i)
    text += (i == 0 ? "" : ", ") + secondary_name(model, *o.contact, o.removed[i].secondary);
  if (o.removed.size() > most) text += fmt::format(" and {} more", o.removed.size() - most);
  return text;
}

/// Evaluations before the last one in which any pair pushes, where the last has none.
void say_pushing_steps(const cycle::StepsOutcome& s, Sentences& out) {
  std::size_t pushing = 0, first = 0;
  for (std::size_t k = 0; k < s.lines.size(); ++k) {
    if (std::none_of(s.lines[k].contacts.begin(), s.lines[k].contacts.end(),
                     [](const cycle::StepContact& c) { return c.pairs_with_force > 0; }))
      continue;
    if (pushing++ == 0) first = k;
  }
  if (pushing > 0)
    out.add("steps_with_force",
            fmt::format("{} of {} before had forces, the first at step {}.", pushing,
                        count(s.lines.size() - 1, "evaluation", "evaluations"), first),
            {{"steps_with_force", pushing}});
}

void say_pairs(const VerdictInput& in, const Sums& sums, Sentences& out) {
  const cycle::SceneOutcome& o = *in.cycle;
  const std::string when =
      in.steps == nullptr
          ? std::string("at the start")
          : "after " + count(in.steps->lines.size() - 1, "step", "steps") + " of prescribed motion";
  if (sums.pairs == 0 && sums.open > 0 && sums.open == o.contacts.size())
    out.add("forces", "No force was evaluated.", {});
  else if (sums.pairs == 0)
    out.add("forces", fmt::format("No contact force {}.", when), {{"pairs_with_force", 0}});
  else
    out.add("forces",
            fmt::format("{} {}; largest nodal force {} at {}.",
                        count(sums.pairs, "pair pushes", "pairs push"), when,
                        figure_text(o.largest_nodal_force),
                        o.force_node == no_index
                            ? std::string("no node")
                            : fmt::format("node {}", in.model->node_id(o.force_node))),
            {{"pairs_with_force", sums.pairs}});
  if (sums.pairs == 0 && in.steps != nullptr) say_pushing_steps(*in.steps, out);
}

}  // namespace

void say_forces(const VerdictInput& in, Sentences& out) {
  const cycle::SceneOutcome& o = *in.cycle;
  const Sums sums(o);
  say_pairs(in, sums, out);
  if (in.contacts && in.contacts->ties && in.contacts->ties->ties > 0)
    out.add("tie_forces",
            fmt::format("Forces of {} are not computed.",
                        count(in.contacts->ties->ties, "tie (TYPE2)", "ties (TYPE2)")),
            {});
  if (in.steps != nullptr && sums.tied > 0)
    out.add("tied_now", count(sums.tied, "pair is tied then.", "pairs are tied then."), {});
  if (sums.by_step > 0)
    out.add("removed",
            fmt::format("dtmin is above the time step of {} in contact: the solver removes {} from "
                        "the interface for good ({}).",
                        count(sums.by_step, "node or edge", "nodes or edges"),
                        sums.by_step == 1 ? "it" : "them", gone_text(*in.model, *sums.first_gone)),
            {{"removed_by_dtmin", sums.by_step}});
  if (sums.open > 0 && (!in.contacts || sums.open > in.contacts->not_evaluated))
    out.add("forces_not_evaluated",
            fmt::format("Forces of {} are not evaluated.", count(sums.open, "contact", "contacts")),
            {{"forces_not_evaluated", sums.open}});
  if (sums.pairs > 0 && sums.worst != nullptr && sums.worst->acceleration_node != no_index)
    out.add("acceleration",
            fmt::format("Largest acceleration {}: node {}, interface {}.",
                        figure_text(sums.worst->largest_acceleration),
                        in.model->node_id(sums.worst->acceleration_node),
                        sums.worst->contact->inter->id),
            {});
  if (sums.closed > 0)
    out.add("mid_surface",
            fmt::format("{} at the mid-surface: the solver drops the {}.",
                        count(sums.closed, "pair is", "pairs are"),
                        sums.closed == 1 ? "node or edge" : "nodes or edges"),
            {{"pairs_at_mid_surface", sums.closed}});
  if (sums.pairs > 0 && o.contact_dt < o.structure.dt && o.structure.dt < 1e30)
    out.add("time_step",
            fmt::format("Contact limits the time step: {:.4g} against {:.4g} of the elements.",
                        o.contact_dt, o.structure.dt),
            {});
}

}  // namespace detail
}  // namespace deck
