// Builds the verdict: sentences, counts, level and exit code.
#include "deck/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/shared/words.hpp"
#include "contact/shared/reported.hpp"
#include "deck/text.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck {
namespace {

/// Collects the sentences of a verdict; those that say that the solver stops come first.
struct Sentences {
  std::vector<VerdictSentence> all;
  std::ptrdiff_t stops = 0;
  void add(const char* what, std::string text, VerdictCounts counts, bool stop = false) {
    all.insert(stop ? all.begin() + stops++ : all.end(),
               {what, std::move(text), std::move(counts)});
  }
};

std::size_t contacts_with(const ContactFacts& f, std::initializer_list<NotCleanReason> not_clean) {
  std::size_t n = 0;
  for (const NotCleanReason o : not_clean) n += f.not_clean[static_cast<std::size_t>(o)];
  return n;
}

/// Contacts without pairs because something is missing.
std::size_t idle(const ContactFacts& f) {
  return contacts_with(f, {NotCleanReason::empty_main, NotCleanReason::empty_secondary,
                           NotCleanReason::no_gap, NotCleanReason::no_stiffness});
}

/// True if contacts stop the solver before it searches pairs.
bool stop_before_pairs(const ContactFacts& f) {
  return contacts_with(
             f, {NotCleanReason::no_gap, NotCleanReason::no_area, NotCleanReason::no_element}) > 0;
}

/// True if the solver stops at nodes of contacts or ties.
bool stop_at_nodes(const ContactFacts& f) {
  return f.total.solver_errors > 0 || (f.ties && f.ties->solver_errors + f.ties->main_and_tied > 0);
}

/// Level from contacts and ties if the solver does not stop; clean: no problem.
VerdictLevel level_without_stops(const ContactFacts& f) {
  if (f.total.count.pairs > 0) return VerdictLevel::penetrates;
  if (f.total.crossed_elements.value_or(0) > 0) return VerdictLevel::crossed;
  if (f.total.untied + (f.ties ? f.ties->untied : 0) > 0) return VerdictLevel::untied;
  const bool ties_left_out = f.ties && f.ties->not_evaluated > 0;
  return f.not_evaluated > 0 || idle(f) > 0 || ties_left_out ? VerdictLevel::not_examined
                                                             : VerdictLevel::clean;
}

VerdictLevel level_of_contacts(const ContactFacts& f) {
  return stop_before_pairs(f) || stop_at_nodes(f) ? VerdictLevel::stops : level_without_stops(f);
}

void add_not_clean(const ContactFacts& f, Sentences& out) {
  const auto name = [&](const char* what, const char* text,
                        std::initializer_list<NotCleanReason> not_clean) {
    if (const std::size_t n = contacts_with(f, not_clean); n > 0)
      out.add(what, count(n, "contact ", "contacts ") + text + ".", {{what, n}});
  };
  name("empty_sides", "with an empty side",
       {NotCleanReason::empty_main, NotCleanReason::empty_secondary});
  name("without_gap", "without a gap (error 785/786)", {NotCleanReason::no_gap});
  name("without_stiffness", "without stiffness on the main side", {NotCleanReason::no_stiffness});
  name("without_area", "with main segments without area (error 558)", {NotCleanReason::no_area});
  name("without_element", "with segments or edges without element (error 481/482)",
       {NotCleanReason::no_element});
}

/// Values of the deepest pair, and the largest share of a gap, usually of another pair. Depths
/// behind faces of solids may have no gap. `unit`: " mm"; empty: not known.
std::string deepest_text(const ContactFacts& f, const std::string& unit) {
  std::string out;
  if (f.deepest > 0) out += fmt::format(", deepest {:.6g}", f.deepest);
  if (f.deepest_gap > 0) out += fmt::format(" of a gap of {:.6g}", f.deepest_gap);
  if (f.deepest > 0) out += unit;
  const double worst = f.total.max_ratio;
  return out + (worst > 0 ? fmt::format("; worst depth/gap {:.1f} %.", 100 * worst) : ".");
}

/// Untied nodes of a type: "3 of 412 nodes of TYPE2 7 are not tied.", "2 TYPE10 (7, 8) tie none of
/// their 12 nodes."
std::string losses_text(const char* type, const std::vector<TieFacts::Losses>& losses) {
  std::uint64_t of = 0, untied = 0;
  std::vector<std::int64_t> all;
  for (const TieFacts::Losses& l : losses) {
    of += l.nodes, untied += l.untied;
    all.push_back(l.id);
  }
  const std::string ids = list_text(all);
  const bool one = losses.size() == 1;
  const std::string who =
      one ? fmt::format("{} {}", type, ids) : fmt::format("{} {} ({})", losses.size(), type, ids);
  if (untied == of && of > 1)
    return one ? fmt::format("{} ties none of its {} nodes.", who, of)
               : fmt::format("{} {} tie none of their {} nodes ({}).", losses.size(), type, of,
                             ids);
  return fmt::format("{} of {} of {} {} not tied.", untied, count(of, "node", "nodes"), who,
                     untied == 1 ? "is" : "are");
}

void add_penetrations(const ContactFacts& f, const std::string& unit, Sentences& out) {
  const ContactTotals& t = f.total;
  const VerdictCounts counts = {
      {"pairs", t.count.pairs}, {"nodes", t.count.nodes}, {"edges", t.count.edges}};
  if (f.contacts == 0 && f.ties && f.ties->ties > 0) return;
  const std::size_t evaluated = f.contacts - f.not_evaluated - idle(f);
  if (t.count.pairs == 0)
    out.add("penetrations",
            evaluated == 0
                ? "No contact was evaluated."
                : "No initial penetration in " + count(evaluated, "contact", "contacts") + ".",
            counts);
  else
    out.add("penetrations",
            fmt::format("{} on {}{}",
                        count(t.count.pairs, "initial penetration", "initial penetrations"),
                        nodes_and_edges(t.count.nodes, t.count.edges), deepest_text(f, unit)),
            counts);
  if (f.unbounded > 0)
    out.add("unbounded",
            count(f.unbounded, "pair has", "pairs have") +
                " an unbounded gap, beyond ten times the model's size.",
            {{"unbounded", f.unbounded}});
  if (t.round_off > 0)
    out.add("round_off",
            count(t.round_off, "pair penetrates", "pairs penetrate") +
                " by the solver's round-off only.",
            {{"round_off", t.round_off}});
  if (t.solver_errors > 0)
    out.add("on_segment",
            fmt::format("The solver will stop: {} exactly on a segment (error 611/612).",
                        count(t.solver_errors, "node lies", "nodes lie")),
            {{"solver_errors", t.solver_errors}}, true);
  else if (t.on_segment.pairs > 0)
    out.add("on_segment",
            fmt::format("Exactly on a segment: {}.",
                        nodes_and_edges(t.on_segment.nodes, t.on_segment.edges)),
            {{"on_segment", t.on_segment.nodes + t.on_segment.edges}});
  if (t.tied.pairs > 0)
    out.add("ties",
            fmt::format("{} tied ({}).", count(t.tied.pairs, "pair", "pairs"),
                        count(t.tied.nodes, "node", "nodes")),
            {{"tied_pairs", t.tied.pairs}, {"tied_nodes", t.tied.nodes}});
  if (t.untied > 0) out.add("untied", losses_text("TYPE10", f.untied), {});
  if (const std::uint64_t n = t.crossed_elements.value_or(0); n > 0)
    out.add("crossed",
            fmt::format("{}: an edge of the secondary side passes through a main segment.",
                        count(n, "crossed element", "crossed elements")),
            {{"crossed_elements", n}});
}

void add_ties(const TieFacts& f, Sentences& out) {
  if (f.ties == 0) return;
  if (f.not_evaluated > 0)
    out.add("ties_not_evaluated",
            fmt::format("The nodes of {} could not be looked at.",
                        count(f.not_evaluated, "TYPE2", "TYPE2")),
            {{"ties_not_evaluated", f.not_evaluated}});
  if (f.untied > 0) {
    out.add("untied_type2", losses_text("TYPE2", f.losses), {{"untied_type2_nodes", f.untied}});
  } else if (f.nodes > 0 && f.not_evaluated < f.ties) {
    out.add("tied_type2",
            fmt::format("{} of {} tied.", count(f.tied, "node", "nodes"),
                        count(f.ties, "TYPE2", "TYPE2")),
            {{"tied_type2_nodes", f.tied}});
  }
  if (f.solver_errors > 0)
    out.add("ties_stop",
            fmt::format("The solver will stop: {} without a main segment (error 1078).",
                        count(f.solver_errors, "node is", "nodes are")),
            {{"tie_errors", f.solver_errors}}, true);
  if (f.main_and_tied > 0)
    out.add("main_and_tied",
            fmt::format("The solver will stop: {} tied (error 556).",
                        count(f.main_and_tied, "main node of a tie is itself",
                              "main nodes of ties are themselves")),
            {{"main_and_tied", f.main_and_tied}}, true);
}

void add_contacts(const ContactFacts& f, const std::string& unit, Sentences& out) {
  if (f.not_evaluated > 0)
    out.add("not_evaluated",
            fmt::format("{} could not be evaluated, see the findings.",
                        count(f.not_evaluated, "contact", "contacts")),
            {{"not_evaluated", f.not_evaluated}});
  add_not_clean(f, out);
  add_penetrations(f, unit, out);
  if (f.ties) add_ties(*f.ties, out);
}

// ---- forces and time steps ----------------------------------------------------------------------

/// Sums over the contacts of an evaluation.
struct Sums {
  std::size_t pairs = 0, closed = 0, by_step = 0, tied = 0, open = 0;
  const cycle::ContactOutcome* first_gone = nullptr;  ///< first with items removed by dtmin
  const cycle::ContactOutcome* worst = nullptr;       ///< the contact with the largest acceleration

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

/// "node 1, node 2, node 3 and 5 more": items that leave a contact.
std::string gone_text(const Model& model, const cycle::ContactOutcome& o) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, o.removed.size()); ++i)
    text += (i == 0 ? "" : ", ") + secondary_name(model, *o.contact, o.removed[i].secondary);
  if (o.removed.size() > most) text += fmt::format(" and {} more", o.removed.size() - most);
  return text;
}

/// Earlier steps with contact forces, if the last step has none.
void add_pushing_steps(const cycle::StepsOutcome& s, Sentences& out) {
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

void add_pairs(const VerdictInput& in, const Sums& sums, Sentences& out) {
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
            fmt::format("{} {}; {} has the largest force {}.",
                        count(sums.pairs, "pair pushes", "pairs push"), when,
                        o.force_node == no_index
                            ? std::string("no node")
                            : fmt::format("node {}", in.model->node_id(o.force_node)),
                        figure_text(o.largest_nodal_force)),
            {{"pairs_with_force", sums.pairs}});
  if (sums.pairs == 0 && in.steps != nullptr) add_pushing_steps(*in.steps, out);
}

/// Forces, removed items, accelerations and time step of the first cycle.
void add_forces(const VerdictInput& in, Sentences& out) {
  const cycle::SceneOutcome& o = *in.cycle;
  const Sums sums(o);
  add_pairs(in, sums, out);
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

// ---- errors, lint, counts -----------------------------------------------------------------------

/// Errors of the deck: all, those that the solver has too, those that it does not have. Empty sides
/// are counted separately.
struct DeckErrors {
  std::uint64_t all = 0, solver = 0, own = 0;
};

DeckErrors errors_of(const Deck& deck) {
  DeckErrors out;
  for (const Finding& d : deck.findings.all()) {
    if (d.severity != Severity::error || is_gate_rule(d.rule)) continue;
    ++out.all;
    if (d.rule == RuleId::DK172 || d.rule == RuleId::DK173) continue;
    ++(d.reference && d.reference->severity == Severity::error ? out.solver : out.own);
  }
  return out;
}

void add_errors(const DeckErrors& errors, Sentences& out) {
  const bool stops = errors.solver > 0;
  if (const auto n = stops ? errors.solver : errors.own; n > 0)
    out.add("errors",
            (stops ? "The solver would stop before it evaluates contacts: " : "") +
                count(n, "error", "errors") + " in the deck (see 'deck lint').",
            {{"errors", errors.all}}, stops);
}

/// The sentence about lint; it comes first.
VerdictSentence lint_sentence(const LintFacts& lint, VerdictLevel level, bool examined) {
  VerdictSentence out{
      "lint",
      {},
      {{"errors", lint.errors}, {"warnings", lint.warnings}, {"remarks", lint.remarks}}};
  const std::string remarks = count(lint.remarks, "remark", "remarks");
  if (examined && (level == VerdictLevel::clean || level == VerdictLevel::remarks))
    out.text = lint.remarks > 0 ? "clean (" + remarks + ": -v)." : "clean.";
  else
    out.text = count(lint.errors, "error", "errors") + ", " +
               count(lint.warnings, "warning", "warnings") +
               (lint.remarks > 0 ? ", " + remarks : std::string()) + ".";
  return out;
}

/// Adds a count unless a sentence has it already.
void note(VerdictCounts& counts, const char* name, std::uint64_t n) {
  const auto known = [&](const auto& c) { return c.first == name; };
  if (std::none_of(counts.begin(), counts.end(), known)) counts.emplace_back(name, n);
}

VerdictCounts all_counts(const VerdictInput& in, const Coverage& coverage, std::uint64_t errors,
                         const Sentences& sentences) {
  VerdictCounts out;
  std::uint64_t left_out = 0;
  for (const NotExamined& n : coverage.not_examined) left_out += n.ids.size();
  if (in.interfaces != nullptr) {
    note(out, "interfaces", coverage.examined);
    note(out, "interfaces_not_examined", left_out);
  }
  if (in.contacts) {
    const ContactTotals& t = in.contacts->total;
    note(out, "contacts", in.contacts->contacts);
    note(out, "not_evaluated", in.contacts->not_evaluated);
    note(out, "pairs", t.count.pairs);
    note(out, "nodes", t.count.nodes);
    note(out, "edges", t.count.edges);
    note(out, "solver_errors", t.solver_errors);
    note(out, "tied_pairs", t.tied.pairs);
    note(out, "tied_nodes", t.tied.nodes);
    note(out, "untied_nodes", t.untied + (in.contacts->ties ? in.contacts->ties->untied : 0));
    if (t.crossed_elements) note(out, "crossed_elements", *t.crossed_elements);
  }
  note(out, "errors", errors);
  if (in.lint) {
    note(out, "warnings", in.lint->warnings);
    note(out, "remarks", in.lint->remarks);
  }
  for (const VerdictSentence& s : sentences.all)
    for (const auto& [name, n] : s.counts) note(out, name.c_str(), n);
  return out;
}

/// Counts a contact as evaluated and by NotCleanReason.
void add_state(ContactFacts& f, const Contact& c) {
  f.not_evaluated += !c.evaluated;
  if (c.evaluated) ++f.not_clean[static_cast<std::size_t>(not_clean_reason(c))];
}

/// " mm"; empty if the deck gives a number or no known unit.
std::string length_unit(const Deck& deck) {
  const std::string& code = deck.begin.working.length_code;
  return code.find_first_of("0123456789") == code.npos && unit_factor(code, 'm') ? " " + code : "";
}

/// `main_and_tied`: nodes of all ties so far, without duplicates.
void add_tie(TieFacts& f, const Tie& tie, std::set<NodeIndex>& main_and_tied) {
  ++f.ties;
  if (!tie.not_evaluated.empty()) {
    ++f.not_evaluated;
    return;
  }
  const TieCounts counts = count_ties(tie);
  f.nodes += counts.nodes;
  f.tied += counts.tied;
  const std::uint64_t lost = counts.lost();
  f.untied += lost;
  if (lost > 0) f.losses.push_back({tie.inter->id, counts.nodes, lost});
  for (const TiedNode& n : tie.nodes) f.solver_errors += n.message == 1078;
  main_and_tied.insert(tie.main_and_tied.begin(), tie.main_and_tied.end());
}

VerdictLevel level_of(const VerdictInput& in, const Coverage& coverage, const Verdict& v,
                      bool stops) {
  if (stops) return VerdictLevel::stops;
  if (in.contacts)
    if (const VerdictLevel found = level_without_stops(*in.contacts); found != VerdictLevel::clean)
      return found;
  const bool left_out =
      (!in.contacts && in.lint && in.lint->contacts_left_out) ||
      (in.cycle != nullptr && std::any_of(in.cycle->contacts.begin(), in.cycle->contacts.end(),
                                          [](const auto& c) { return c.undecided(); }));
  // A lint run without contacts makes no statement about them; decks without any have their own
  // rules.
  const bool looked = in.contacts || (coverage.nothing() && !in.lint);
  if (!coverage.complete() || left_out || (looked && coverage.nothing()) ||
      ((looked || coverage.nothing()) && !coverage.not_examined.empty()))
    return VerdictLevel::not_examined;
  if (v.count("warnings") > 0) return VerdictLevel::warnings;
  return v.count("remarks") > 0 ? VerdictLevel::remarks : VerdictLevel::clean;
}

}  // namespace

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

std::string_view to_string(VerdictLevel level) {
  static constexpr std::string_view names[] = {"stops",        "penetrates", "crossed", "untied",
                                               "not-examined", "warnings",   "remarks", "clean"};
  return names[static_cast<std::size_t>(level)];
}

std::uint64_t Verdict::count(std::string_view name) const {
  for (const auto& [known, n] : counts)
    if (known == name) return n;
  return 0;
}

ContactFacts contact_facts(const Scene& scene, const SceneView& view) {
  ContactFacts out;
  out.contacts = scene.contacts.size();
  for (const Contact& c : scene.contacts) {
    add_state(out, c);
    if (const std::size_t untied = untied_secondary(c).size(); untied > 0)
      out.untied.push_back({c.inter->id, c.secondary.size(), untied});
  }
  out.total = view.total;
  if (scene.examined == Examined::contacts_and_ties) out.ties = tie_facts(scene.ties);
  const auto bounded = [&](const PenetrationRow& r) { return r.gap <= view.largest_gap; };
  for (const Contact& c : scene.contacts)
    for (const PenetrationRow& row : c.penetrations)
      out.unbounded += !c.is_tied_contact() && !bounded(row);
  for (const auto& p : view.penetrations.places)  // deepest first
    if (const PenetrationRow& row = scene.contacts[p.contact].penetrations[p.row]; bounded(row)) {
      out.deepest = row.depth;
      out.deepest_gap = row.gap;
      break;
    }
  return out;
}

TieFacts tie_facts(const std::vector<Tie>& ties) {
  TieFacts out;
  std::set<NodeIndex> main_and_tied;
  for (const Tie& tie : ties) add_tie(out, tie, main_and_tied);
  out.main_and_tied = main_and_tied.size();
  return out;
}

InterfaceVerdict verdict_of_interface(const Scene& scene, const SceneView& view,
                                      const InterBase& inter) {
  InterfaceVerdict out;
  ContactFacts own;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (scene.contacts[i].inter != &inter) continue;
    add_state(own, scene.contacts[i]);
    const ContactTotals& t = view.contacts[i];
    ContactTotals& sum = own.total;
    sum.count.pairs += t.count.pairs;
    sum.untied += t.untied;
    sum.solver_errors += t.solver_errors;
    sum.crossed_elements = sum.crossed_elements.value_or(0) + t.crossed_elements.value_or(0);
    out.max_depth = std::max(out.max_depth, t.max_depth);
    out.max_ratio = std::max(out.max_ratio, t.max_ratio);
  }
  out.level = level_of_contacts(own);
  return out;
}

VerdictLevel level_of_tie(const Tie& tie) {
  ContactFacts own;
  std::set<NodeIndex> main_and_tied;
  add_tie(own.ties.emplace(), tie, main_and_tied);
  own.ties->main_and_tied = main_and_tied.size();
  return level_of_contacts(own);
}

Verdict make_verdict(const VerdictInput& in) {
  Coverage coverage;
  const bool with_ties = in.lint || (in.contacts && in.contacts->ties);
  if (in.interfaces != nullptr)
    coverage = coverage_of(*in.deck, *in.interfaces,
                           with_ties ? Examined::contacts_and_ties : Examined::contacts);
  const DeckErrors errors = errors_of(*in.deck);
  Verdict v;
  Sentences say;
  if (!in.lint && coverage.complete()) add_errors(errors, say);
  const std::string lead = in.interfaces == nullptr ? "" : coverage_lead(coverage);
  if (!lead.empty())
    say.add(coverage.complete() ? "nothing_examined" : "no_verdict", lead, {});
  else if (in.contacts)
    add_contacts(*in.contacts, length_unit(*in.deck), say);
  if (lead.empty() && in.cycle != nullptr) add_forces(in, say);
  if (const std::string tail = coverage_tail(coverage);
      !tail.empty() && (in.contacts || !lead.empty()))
    say.add("not_examined", tail.substr(1), {});
  if (in.lint && in.lint->contacts_left_out)
    say.add("left_out", "The contacts were not examined: too large for a quick look (--geometry).",
            {});
  const std::uint64_t all_errors = in.lint ? in.lint->errors : errors.all;
  v.counts = all_counts(in, coverage, all_errors, say);
  const bool contacts_decide = !in.lint && in.contacts;  // else the errors of lint decide
  v.stops_before_pairs = all_errors > 0 || (contacts_decide && stop_before_pairs(*in.contacts));
  v.undecided = in.contacts && in.contacts->not_evaluated > in.contacts->left_out;
  v.level = level_of(in, coverage, v,
                     v.stops_before_pairs || (contacts_decide && stop_at_nodes(*in.contacts)));
  v.warns = in.lint ? in.lint->warnings > 0
                    : v.count("pairs") + v.count("crossed_elements") + v.count("untied_nodes") > 0;
  if (in.lint) say.all.insert(say.all.begin(), lint_sentence(*in.lint, v.level, lead.empty()));
  v.sentences = std::move(say.all);
  for (const VerdictSentence& s : v.sentences) v.text += (v.text.empty() ? "" : " ") + s.text;
  return v;
}

Verdict verdict_of(const LoadedDeck& loaded) {
  loaded.findings();
  const Scene& scene = loaded.scene();
  const int threads = loaded.scene_options().threads;
  const std::vector<Crossing> crossed = find_crossings(scene, threads);
  VerdictInput in;
  in.deck = &loaded.deck();
  in.interfaces = scene.interfaces;
  in.contacts = contact_facts(scene, make_view(scene, &crossed, threads));
  in.contacts->ties = tie_facts(loaded.ties());
  return make_verdict(in);
}

Verdict verdict_of(const Deck& deck, const Scene& scene, const SceneView& view) {
  VerdictInput in;
  in.deck = &deck;
  in.interfaces = scene.interfaces;
  in.contacts = contact_facts(scene, view);
  return make_verdict(in);
}

int exit_code_of(const Verdict& v, const ExitRules& rules) {
  if (rules.require_examined && v.level == VerdictLevel::not_examined) return 1;
  if (rules.never) return 0;
  const bool stops = v.level == VerdictLevel::stops;
  const bool found = (stops && (v.stops_before_pairs || !rules.pairs_accepted)) ||
                     (rules.on_warning && v.warns && !rules.pairs_accepted) || v.undecided;
  return found ? 1 : 0;
}

}  // namespace deck
