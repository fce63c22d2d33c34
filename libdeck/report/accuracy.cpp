// `deck accuracy`: what each word of --accuracy costs and gives, as text and JSON.
#include "report/shared/accuracy.hpp"

#include <fmt/format.h>

#include <utility>

#include "accuracy/shared/motion.hpp"
#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "report/shared/json.hpp"
#include "report/shared/text_table.hpp"

namespace deck {
namespace {

TextTable::Cell wrong_cell(std::uint64_t wrong, std::uint64_t all) {
  if (wrong == 0) return {"0", Tone::green};
  return {fmt::format("{} = {}", wrong, share_text(wrong, all)), Tone::red};
}

// One row an accuracy, as on the page.
std::string choice_text(const AccuracyChoices& choices, bool color, std::size_t width) {
  std::string out;
  for (const std::string& sentence : accuracy_advice(choices))
    out += (out.empty() ? "" : " ") + sentence;
  out += "\n\n";
  const bool deck = choices.front().deck.has_value();
  std::vector<TextTable::Column> columns{{"--accuracy"}};
  if (deck) {
    columns.push_back({"on this deck", Align::right});
    columns.push_back({"wrong", Align::right});
  }
  for (const char* title : {"hard cases", "wrong there", "other answer", "kinds"})
    columns.push_back({title, Align::right});
  TextTable table(columns);
  for (const AccuracyChoice& c : choices) {
    const Tone own = c.accuracy == Accuracy::robust ? Tone::bold : Tone::plain;
    std::vector<TextTable::Cell> cells{{to_string(c.accuracy), own}};
    if (deck) {
      cells.emplace_back(seconds_text(c.deck->seconds), own);
      cells.push_back(wrong_cell(c.deck->wrong.size(), c.deck->pairs));
    }
    cells.emplace_back(ratio_text(c.hard.ratio.value), own);
    cells.push_back(wrong_cell(c.hard.wrong, c.hard.pairs));
    cells.push_back(wrong_cell(c.hard.other_answer, c.hard.rewritten));
    const std::size_t right = c.hard.kinds_never_wrong();
    cells.emplace_back(fmt::format("{} of {}", right, c.hard.kinds.size()),
                       right == c.hard.kinds.size() ? Tone::green : Tone::red);
    table.row(std::move(cells));
  }
  out += table.fitted(width, color);
  const AccuracyChoice::OnHardCases& hard = choices.front().hard;
  if (deck)
    out += fmt::format("\nOn this deck: the whole of deck gaps, {}.",
                       count(choices.front().deck->pairs, "pair", "pairs"));
  return out + fmt::format(
                   "\nHard cases: {} made to break arithmetic, time against fast."
                   "\nOther answer: of {} written in other ways (order of nodes, axes, units)."
                   "\nKinds: kinds of hard cases without a wrong decision.\n",
                   count(hard.pairs, "pair", "pairs"), count(hard.rewritten, "pair", "pairs"));
}

void write_choices(JsonWriter& j, const AccuracyChoices& choices) {
  j.key("choices").begin_array();
  for (const AccuracyChoice& c : choices) {
    j.begin_object().field("word", to_string(c.accuracy)).key("deck");
    const auto ratio = [&](const TimeRatio& r) {
      j.field("ratio", r.value).field("spread", r.spread);
    };
    if (c.deck) {
      j.begin_object(true).field("seconds", c.deck->seconds);
      ratio(c.deck->ratio);
      j.field("pairs", c.deck->pairs).field("wrong", c.deck->wrong.size()).end_object();
    } else {
      j.null();
    }
    j.key("hard").begin_object(true).field("ns_per_pair", c.hard.ns_per_pair);
    ratio(c.hard.ratio);
    j.field("pairs", c.hard.pairs).field("wrong", c.hard.wrong);
    j.field("rewritten", c.hard.rewritten).field("other_answer", c.hard.other_answer);
    j.field("kinds_never_wrong", c.hard.kinds_never_wrong()).end_object().end_object();
  }
  j.end_array();
}

void write_point(JsonWriter& j, const Point3<double>& p) {
  j.begin_array(true).value(p.x).value(p.y).value(p.z).end_array();
}

void write_worst(JsonWriter& j, Accuracy accuracy, const KindResult& kind) {
  const PairSample& s = kind.worst;
  j.begin_object(true).field("word", to_string(accuracy));
  j.field("kind", s.edges ? "edge_edge" : "node_segment").field("triangle", s.triangle);
  j.key("points").begin_array(true);
  for (std::size_t k = 0; k < (s.edges ? 4u : 5u); ++k) write_point(j, s.x[k]);
  j.end_array().field("gap", s.gap).field("exact", kind.exact).field("computed", kind.computed);
  j.field("in_contact", kind.in_contact).end_object();
}

void write_families(JsonWriter& j, const AccuracyChoices& choices) {
  j.key("families").begin_array();
  for (std::size_t k = 0; k < choices.front().hard.kinds.size(); ++k) {
    const KindResult& first = choices.front().hard.kinds[k];
    j.begin_object().field("id", first.kind->id).field("name", first.kind->name);
    j.field("group", first.kind->group).field("expected", first.kind->expected);
    j.field("pairs", first.pairs).key("wrong").begin_object(true);
    for (const AccuracyChoice& c : choices) j.field(to_string(c.accuracy), c.hard.kinds[k].wrong);
    j.end_object().key("worst").begin_array();
    for (const AccuracyChoice& c : choices)
      if (c.hard.kinds[k].wrong > 0) write_worst(j, c.accuracy, c.hard.kinds[k]);
    j.end_array().end_object();
  }
  j.end_array();
}

void write_wrong_pairs(JsonWriter& j, const AccuracyChoices& choices) {
  const auto ids = [&](const char* name, const std::vector<std::int64_t>& nodes) {
    j.key(name).begin_array(true);
    for (const std::int64_t n : nodes) j.value(n);
    j.end_array();
  };
  j.key("wrong_pairs").begin_array();
  for (const AccuracyChoice& c : choices) {
    if (!c.deck) continue;
    for (const WrongPair& p : c.deck->wrong) {
      j.begin_object(true).field("word", to_string(c.accuracy)).field("interface", p.interface);
      ids("secondary", p.secondary);
      ids("main", p.main);
      j.field("gap", p.gap).field("exact", p.exact).field("computed", p.computed).end_object();
    }
  }
  j.end_array();
}

void write_motion(JsonWriter& j, const HardMotion& m) {
  j.key("motion").begin_object().key("corners").begin_array(true);
  for (const Point3<double>& p : m.corners) write_point(j, p);
  j.end_array().key("from");
  write_point(j, m.from);
  j.key("to");
  write_point(j, m.to);
  j.field("gap", m.gap).field("way", m.way).key("lines").begin_array();
  for (const HardMotion::Line& line : m.lines) {
    j.begin_object().field("word", to_string(line.accuracy));
    for (const auto& [name, values] : {std::pair("depth", &line.depth), {"force", &line.force}}) {
      j.key(name).begin_array(true);
      for (const double v : *values) j.value(v);
      j.end_array();
    }
    j.key("jumps").begin_array(true);
    for (const std::size_t step : line.jumps) j.value(step);
    j.end_array().end_object();
  }
  j.end_array().key("sentences").begin_array();
  for (const std::string& sentence : motion_sentences(m)) j.value(sentence);
  j.end_array().end_object();
}

}  // namespace

std::string accuracy_compiler() {
#if defined(__clang__)
  const std::string name = "clang ";
#elif defined(__GNUC__)
  const std::string name = "g++ ";
#else
  const std::string name;
#endif
#ifdef __OPTIMIZE__
  const std::string level = ", optimised";
#else
  const std::string level = ", not optimised";
#endif
  return name + __VERSION__ + level + ", no contraction";
}

std::string accuracy_text(const AccuracyChoices& choices, const AccuracyContext& context,
                          bool color, std::size_t width) {
  std::string out;
  if (!context.path.empty())
    out = terminal_text(context.path) + (choices.front().deck ? "\n" : ": no pair to decide\n");
  return out + choice_text(choices, color, width) +
         fmt::format("\n{}; {}\n", terminal_text(context.processor), accuracy_compiler());
}

std::string accuracy_json(const AccuracyChoices& choices, const AccuracyContext& context) {
  std::string out;
  JsonWriter j(out);
  j.begin_object();
  write_json_head(j, "deck/accuracy", 2);
  if (context.deck != nullptr) write_json_deck(j, context.path, *context.deck, nullptr, nullptr);
  j.key("machine").begin_object(true).field("processor", context.processor);
  j.field("compiler", accuracy_compiler()).field("command", context.command).end_object();
  j.key("advice").begin_array();
  for (const std::string& sentence : accuracy_advice(choices)) j.value(sentence);
  j.end_array();
  write_choices(j, choices);
  write_families(j, choices);
  write_wrong_pairs(j, choices);
  write_motion(j, hard_motion());
  j.end_object();
  return out;
}

}  // namespace deck
