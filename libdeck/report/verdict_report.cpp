// The verdict as a member of JSON documents and as a line of text.
#include "base/shared/escape.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared/verdict.hpp"

namespace deck {
namespace {

void write_counts(JsonWriter& j, const VerdictCounts& counts) {
  j.key("counts").begin_object(true);
  for (const auto& [name, n] : counts) j.field(name, n);
  j.end_object();
}

}  // namespace

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

namespace {

void write_object(JsonWriter& j, const Verdict& v) {
  j.begin_object();
  j.field("level", to_string(v.level)).field("text", v.text).key("sentences").begin_array();
  for (const VerdictSentence& s : v.sentences) {
    j.begin_object(true).field("what", s.what).field("text", s.text);
    write_counts(j, s.counts);
    j.end_object();
  }
  j.end_array();
  write_counts(j, v.counts);
  j.end_object();
}

}  // namespace

void write_verdict(JsonWriter& j, const Verdict& v) {
  j.key("verdict");
  write_object(j, v);
}

std::string verdict_json(const Verdict& v) {
  std::string out;
  JsonWriter j(out);
  write_object(j, v);
  return out;
}

std::string verdict_text(const Verdict& v, bool color) {
  const bool good = v.level == VerdictLevel::clean || v.level == VerdictLevel::remarks;
  const Tone tone = v.level == VerdictLevel::stops ? Tone::red : good ? Tone::green : Tone::yellow;
  return toned(terminal_text(v.text), tone, color) + "\n";
}

}  // namespace deck
