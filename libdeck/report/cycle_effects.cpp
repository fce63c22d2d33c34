// Which effects of an interface run, and because of which field on which line. The verdict of a
// cycle, and verdicts as a line of text.
#include <fmt/format.h>

#include <algorithm>

#include "base/shared/escape.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/text_table.hpp"

namespace deck {
namespace {

std::string because_of(const Deck& deck, const InterBase& inter, const cycle::EffectState& e,
                       Span& span) {
  if (e.field.empty()) return e.reason;
  auto place = cycle::field_place(inter, e.field);
  if (!place && e.field == "Tstart") place = cycle::field_place(inter, "Tstop");
  if (!place) return e.reason;
  span = place->span;
  std::string where;
  if (span.valid()) {  // in the main file its line is enough
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
  return where.empty() ? e.reason : fmt::format("{} ({})", e.reason, where);
}

/// Effects that a TYPE19 asks for as a whole and its edges do not have.
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
        // On in one part of a TYPE19 and off in another: both are said.
        if (line->on && !e.on && c.contact->role == ContactRole::edges &&
            wanted_by_card(inter, e)) {
          line->because += fmt::format("; not between edges: {}", e.reason);
          line->not_edges = e.reason;
        }
        continue;
      }
      *line = {e.name, e.on, {}, e.field, e.reason, {}, {}};
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

}  // namespace deck
