// Active effects of an interface with the deciding field and line, and their cost on a deck: a
// sentence, JSON, tables for terminals and for the page without scripts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "report/shared/accuracy.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared_records.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

std::string because_of(const Deck& deck, const InterBase& inter, const cycle::EffectState& e,
                       Span& span) {
  if (e.field.empty()) return e.reason;
  std::string reason = e.reason;
  auto place = cycle::field_place(inter, e.field);
  if (!place && e.field == "Tstart") place = cycle::field_place(inter, "Tstop");
  if (!place) return reason;
  span = place->span;
  if (detail::trim(deck.sources.text(span)) == "1000") reason = e.field + " = 1000";  // off
  std::string where;
  if (span.valid()) {  // the line is enough in the main file
    const auto line = deck.sources.position(span).line;
    where = span.file == 0 ? fmt::format("line {}", line)
                           : fmt::format("{}:{}", deck.sources[span.file].path(), line);
  }
  if (place->origin != Origin::card) {
    if (!where.empty()) where += ", ";
    where += place->origin == Origin::built_in        ? "default"
             : place->origin == Origin::default_block ? "/DEFAULT/INTER"
                                                      : "derived";
  }
  return where.empty() ? reason : fmt::format("{} ({})", reason, where);
}

/// True for effects of a TYPE19's card that its edges do not have.
bool wanted_by_card(const InterBase& inter, const cycle::EffectState& e) {
  return inter.type == 19 &&
         (e.name == "boundary-release" || e.name == "friction-law" || e.name == "friction-filter" ||
          e.name == "friction-heat" || e.name == "curvature");
}

}  // namespace

std::vector<EffectLine> effect_lines(const Deck& deck, const cycle::SceneOutcome& outcome,
                                     const InterBase& inter) {
  std::vector<EffectLine> lines;
  for (const cycle::ContactOutcome& c : outcome.contacts) {
    if (c.contact->inter != &inter) continue;
    for (const cycle::EffectState& e : c.effects) {
      auto line = std::find_if(lines.begin(), lines.end(),
                               [&](const EffectLine& l) { return l.name == e.name; });
      if (line == lines.end()) {
        line = lines.emplace(line);
      } else if (line->on || !e.on) {
        // Report both if parts of a TYPE19 differ.
        if (line->on && !e.on && c.contact->role == ContactRole::edges &&
            wanted_by_card(inter, e)) {
          line->because += fmt::format("; not between edges: {}", e.reason);
          line->reason += fmt::format(" (not between edges: {})", e.reason);
        }
        continue;
      }
      *line = {e.name, e.on, {}, e.field, e.reason, {}};
      line->because = because_of(deck, inter, e, line->span);
    }
  }
  return lines;
}

Verdict cycle_verdict(const CycleInput& input) {
  VerdictInput in;
  in.deck = input.deck;
  in.interfaces = input.scene->interfaces;
  in.contacts = contact_facts(*input.scene, input.view ? *input.view : make_view(*input.scene));
  in.model = input.scene->model;
  in.cycle = input.outcome;
  in.steps = input.steps;
  return make_verdict(in);
}

std::string verdict_text(const Verdict& v, bool color) {
  const bool good = v.level == VerdictLevel::clean || v.level == VerdictLevel::remarks;
  const Tone tone = v.level == VerdictLevel::stops ? Tone::red : good ? Tone::green : Tone::yellow;
  return toned(terminal_text(v.text), tone, color) + "\n";
}

namespace {

std::string nanoseconds(double v) { return fmt::format("{:.{}f}", v, std::abs(v) < 10 ? 1 : 0); }

/// "12 ns"; "under 3.1 ns" if the range includes 0; "-" without measurement.
std::string cost_of(const EffectSum& e) {
  if (e.pairs == 0) return "-";
  return e.low > 0.0 ? nanoseconds(e.ns) + " ns"
                     : "under " + nanoseconds(std::max(e.high, 0.1)) + " ns";
}

template <class F>
void each_timed(const CycleInput& input, F&& f) {
  if (input.costs == nullptr) return;
  for (const ContactCost& cost : *input.costs)
    if (cost.problem.empty() && cost.loop_ns > 0.0) f(cost);
}

}  // namespace

CostSummary summarize_costs(const CycleInput& input) {
  CostSummary s;
  std::set<std::string> on, known;
  for (const cycle::ContactOutcome& c : input.outcome->contacts)
    for (const cycle::EffectState& e : c.effects) {
      known.insert(e.name);
      if (e.on) on.insert(e.name);
    }
  s.on = on.size();
  s.known = known.size();
  double loop = 0, flags = 0, all = 0;
  bool every = true;
  each_timed(input, [&](const ContactCost& cost) {
    const auto n = static_cast<double>(cost.pairs + cost.alike);
    ++s.contacts;
    s.pairs += cost.pairs + cost.alike;
    s.wider += cost.margin > 0.0;
    loop += n * cost.loop_ns;
    flags += n * cost.flags_ns;
    all += n * cost.all_ns;
    every = every && cost.all_ns > 0.0;
  });
  if (s.pairs == 0) return s;
  const auto n = static_cast<double>(s.pairs);
  s.loop_ns = loop / n;
  s.flags_ns = flags / n;
  s.all_ns = every ? all / n : 0.0;
  return s;
}

std::vector<EffectSum> effect_sums(const CycleInput& input) {
  std::vector<EffectSum> out;
  const auto find = [&](const std::string& name) {
    return std::find_if(out.begin(), out.end(), [&](const EffectSum& e) { return e.name == name; });
  };
  for (const InterBase* inter : input.scene->interfaces->ordered)
    for (const EffectLine& line : effect_lines(*input.deck, *input.outcome, *inter)) {
      auto sum = find(line.name);
      if (sum == out.end()) sum = out.insert(sum, {line.name, line.on, line.because});
      if (line.on && !sum->on) sum->on = true, sum->because = line.because;
      ++sum->of;
      sum->in += line.on;
    }
  each_timed(input, [&](const ContactCost& cost) {
    for (const EffectCost& e : cost.effects) {
      const auto sum = find(e.name);
      if (sum == out.end() || e.on != sum->on || !e.why_not.empty()) continue;
      const std::size_t pairs = cost.pairs + cost.alike;
      const double before = static_cast<double>(sum->pairs), n = static_cast<double>(pairs);
      const auto mean = [&](double& all, double one) {
        all = (before * all + n * one) / (before + n);
      };
      mean(sum->ns, e.ns), mean(sum->low, e.low), mean(sum->high, e.high);
      sum->pairs += pairs;
      sum->against = e.other;
      sum->change = std::max(sum->change, e.change);
    }
  });
  std::stable_sort(out.begin(), out.end(), [](const EffectSum& a, const EffectSum& b) {
    return std::pair(!a.on, -std::max(a.ns, 0.0)) < std::pair(!b.on, -std::max(b.ns, 0.0));
  });
  return out;
}

std::string cost_sentence(const CycleInput& input) {
  const CostSummary s = summarize_costs(input);
  std::string out =
      fmt::format("Only what this deck asks for runs: {} of {} effects", s.on, s.known);
  if (input.costs == nullptr) return out + ".";
  if (s.pairs == 0) return out + "; no contact has 100 pairs within five gaps to be timed.";
  out += fmt::format(", {} ns a pair", nanoseconds(s.loop_ns));
  if (s.all_ns > 0.0)
    out += fmt::format("; everything would take {} ns ({:.2g} x)", nanoseconds(s.all_ns),
                       s.all_ns / s.loop_ns);
  if (s.wider > 0)
    out += fmt::format("; in {}, where few pairs are near, over pairs up to five gaps apart",
                       count(s.wider, "contact", "contacts"));
  return out + ".";
}

LINE_RECORD(EffectSum, "effect_sum", "An effect over all interfaces.", COLUMN("name", "", r.name),
            COLUMN("on", "Some interface asks for it", r.on),
            COLUMN("because", "Of the first interface", r.because),
            COLUMN("in", "Interfaces where it runs", r.in),
            COLUMN("of", "Interfaces that can have it", r.of),
            COLUMN("against", "What the card of the loop that it is held against says",
                   if_any(r.pairs > 0, r.against)),
            COLUMN("ns", "What it adds, or would add, per pair", if_any(r.pairs > 0, r.ns)),
            COLUMN("low", "Lower quartile", if_any(r.pairs > 0, r.low)),
            COLUMN("high", "Upper quartile", if_any(r.pairs > 0, r.high)),
            COLUMN("change", "Largest difference of a pair force over the largest pair force",
                   if_any(r.pairs > 0, r.change)));

LINE_RECORD(EffectCost, "effect_cost", "", COLUMN("name", "", r.name),
            COLUMN("on", "The card asks for it", r.on),
            COLUMN("why_not", "Why there are no times", if_any(!r.why_not.empty(), r.why_not)),
            COLUMN("against", "What the card of the other loop says",
                   if_any(r.why_not.empty(), r.other)),
            COLUMN("ns", "What it adds, or would add: median", if_any(r.why_not.empty(), r.ns)),
            COLUMN("low", "Lower quartile", if_any(r.why_not.empty(), r.low)),
            COLUMN("high", "Upper quartile", if_any(r.why_not.empty(), r.high)),
            COLUMN("change", "Largest difference of a pair force over the largest pair force",
                   if_any(r.why_not.empty(), r.change)));

std::optional<ContactCost> measured_cost(const CycleInput& input,
                                         const cycle::ContactOutcome& contact) {
  const auto i = static_cast<std::size_t>(&contact - input.outcome->contacts.data());
  return input.costs == nullptr ? std::nullopt : std::optional(input.costs->at(i));
}

RECORD(ContactCost, "cost",
       "The loop over pairs of this contact, in nanoseconds of processor time per pair.",
       COLUMN("pairs", "", r.pairs),
       COLUMN("measured", "The first of the pairs, which were timed", r.measured),
       COLUMN("margin", "How far beyond their gap pairs were looked for, where few are nearer",
              r.margin),
       COLUMN("problem", "Why nothing was timed; empty: it was", r.problem),
       COLUMN("loop_ns", "The loop that the card asks for", r.loop_ns),
       COLUMN("flags_ns", "The same effects, asked for by flags inside the loop", r.flags_ns),
       COLUMN("all_ns", "Every effect that this kind of contact can have together; 0: no such loop",
              r.all_ns),
       COLUMN("all", "What the card of that loop says in addition", r.all),
       COLUMN("effects", "", rows_of(r.effects)));

std::optional<CostsRow> measured_costs(const CycleInput& input) {
  if (input.costs == nullptr) return std::nullopt;
  return CostsRow{&input, summarize_costs(input)};
}

RECORD(CostsRow, "costs", "All contacts together, by their pairs.",
       COLUMN("verdict", "", cost_sentence(*r.input)), COLUMN("contacts", "", r.sums.contacts),
       COLUMN("pairs", "", r.sums.pairs), COLUMN("effects_on", "", r.sums.on),
       COLUMN("effects", "", r.sums.known), COLUMN("loop_ns", "", r.sums.loop_ns),
       COLUMN("flags_ns", "", r.sums.flags_ns), COLUMN("all_ns", "", r.sums.all_ns),
       COLUMN("repeats", "", r.input->cost_repeats), COLUMN("processor", "", r.input->processor),
       COLUMN("compiler", "", accuracy_compiler()));
std::string effects_text(const CycleInput& input, const CycleTextOptions& options) {
  std::string out = "  " + cost_sentence(input) + "\n";
  const bool timed = input.costs != nullptr;
  TextTable on({"runs", "asked by", ">in", "+>costs"}, timed);
  TextTable off({"does not run", timed ? "would begin with" : "because", ">in", "+>would cost"},
                timed);
  std::size_t left = 0;
  for (const EffectSum& e : effect_sums(input)) {
    const std::string in = fmt::format("{}/{}", e.in, e.of);
    if (e.on)
      on.row({e.name, e.because, in, cost_of(e)});
    else if (options.effects || (timed && off.size() < 7))
      off.row(
          {e.name, e.pairs > 0 ? e.against : (timed ? "off: " : "") + e.because, in, cost_of(e)});
    else
      ++left;
  }
  if (on.size() + off.size() + left == 0) return {};
  out += on.below_heading(options) + off.below_heading(options);
  if (left > 0)
    out += fmt::format("  ({} more; --effects: all{})\n", left, timed ? "" : "; --costs: times");
  if (timed)
    out +=
        fmt::format("  Times of deck's own loop over pairs, not of the Engine; {} each; {}; {}\n",
                    input.cost_repeats, terminal_text(input.processor), accuracy_compiler());
  return out;
}

std::string cost_html(const CycleInput& input) {
  std::string out = "<h2>Effects</h2>\n<p>" + html_text(cost_sentence(input)) +
                    "</p>\n<table><thead><tr><th>Effect</th><th>Asked by</th><th>In</th>"
                    "<th>Costs</th></tr></thead><tbody>\n";
  for (const EffectSum& e : effect_sums(input))
    if (e.on)
      out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}/{}</td><td>{}</td></tr>\n",
                         html_text(e.name), html_text(e.because), e.in, e.of, cost_of(e));
  return out + "</tbody></table>\n";
}

}  // namespace deck
