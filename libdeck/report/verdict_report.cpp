// The verdict of a cycle, and verdicts as a line of text.
#include "base/shared/escape.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared/verdict.hpp"

namespace deck {
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
