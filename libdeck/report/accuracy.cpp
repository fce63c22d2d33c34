// `deck accuracy`: the measured tiers as text and JSON.
#include "report/shared/accuracy.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "accuracy/shared/motion.hpp"
#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "report/shared/json.hpp"
#include "report/shared/text_table.hpp"

namespace deck {
namespace {

std::string number(double v) {
  if (std::isinf(v)) return "inf";
  if (v == 0.0) return "0";
  return v >= 0.1 && v < 1e5 ? fmt::format("{:.3g}", v) : fmt::format("{:.1e}", v);
}
std::string percent(double share) {
  if (share == 0.0) return "0";
  return share < 1e-3 ? fmt::format("{:.1e} %", 100.0 * share)
                      : fmt::format("{:.3g} %", 100.0 * share);
}

// Time of the plain tier of the same kind.
double plain_time(const AccuracyReport& report, const std::string& what) {
  for (const TierResult& t : report.tiers)
    if (t.what == what && (t.name == "double" || t.name == "fast")) return t.ns_per_pair;
  return 0.0;
}

std::size_t points_of(const PairSample& s) { return s.edges ? 4 : 5; }

// The pair of an example, to be typed in again: every coordinate as a hexadecimal number.
std::string example_text(const FamilyResult& f) {
  const PairSample& s = f.example;
  std::string out = fmt::format(
      "{:>2} {}, {}: gap {}, distance {}, exactly {}\n   {}", f.id, f.name, f.tier, s.gap, f.got,
      f.exact, s.edges ? "edges" : (s.triangle ? "triangle, node last" : "quad, node last"));
  for (std::size_t k = 0; k < points_of(s); ++k)
    out += fmt::format(" ({:a}, {:a}, {:a})", s.x[k].x, s.x[k].y, s.x[k].z);
  return out + "\n";
}

void write_example(JsonWriter& j, const FamilyResult& f) {
  j.key("example");
  if (!f.has_example) {
    j.null();
    return;
  }
  const PairSample& s = f.example;
  j.begin_object(true).field("kind", s.edges ? "edge_edge" : "node_segment");
  j.field("triangle", s.triangle).key("points").begin_array(true);
  for (std::size_t k = 0; k < points_of(s); ++k) {
    j.begin_array(true).value(s.x[k].x).value(s.x[k].y).value(s.x[k].z).end_array();
  }
  j.end_array().field("gap", s.gap).field("distance", f.got).field("exact_distance", f.exact);
  j.end_object();
}

TextTable::Cell wrong_cell(std::uint64_t wrong, std::uint64_t all) {
  if (wrong == 0) return {"0", Tone::green};
  return {fmt::format("{} = {}", wrong, share_text(wrong, all)), Tone::red};
}

// One row an accuracy, as on the page.
std::string choice_text(const std::vector<AccuracyChoice>& choices, bool color, std::size_t width) {
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
  for (const char* title : {"hard cases", "wrong there", "two answers", "kinds"})
    columns.push_back({title, Align::right});
  TextTable table(columns);
  for (const AccuracyChoice& c : choices) {
    const Tone own = c.accuracy == Accuracy::robust ? Tone::bold : Tone::plain;
    std::vector<TextTable::Cell> cells{{to_string(c.accuracy), own}};
    if (deck) {
      cells.emplace_back(seconds_text(c.deck->seconds), own);
      cells.push_back(wrong_cell(c.deck->wrong, c.deck->pairs));
    }
    cells.emplace_back(ratio_text(c.hard.ratio.value) + " x", own);
    cells.push_back(wrong_cell(c.hard.wrong, c.hard.pairs));
    cells.push_back(wrong_cell(c.hard.other_answers, c.hard.rewritten));
    cells.emplace_back(fmt::format("{} of {}", c.hard.kinds_right, c.hard.kinds),
                       c.hard.kinds_right == c.hard.kinds ? Tone::green : Tone::red);
    table.row(std::move(cells));
  }
  out += table.fitted(width, color);
  const AccuracyChoice::OnHardCases& hard = choices.front().hard;
  if (deck)
    out += fmt::format("\nOn this deck: the whole of deck gaps, {}.",
                       count(choices.front().deck->pairs, "pair", "pairs"));
  return out + fmt::format(
                   "\nHard cases: {} made to break arithmetic, time against fast."
                   "\nThey are measured once per program; --again measures them anew."
                   "\nTwo answers: of {} written in other ways (order of nodes, axes, units)."
                   "\nKinds: kinds of hard cases without a wrong decision.\n",
                   count(hard.pairs, "pair", "pairs"), count(hard.rewritten, "pair", "pairs"));
}

void write_choices(JsonWriter& j, const std::vector<AccuracyChoice>& choices) {
  j.key("choices").begin_array();
  for (const AccuracyChoice& c : choices) {
    j.begin_object().field("accuracy", to_string(c.accuracy)).key("deck");
    const auto ratio = [&](const TimeRatio& r) {
      j.field("ratio", r.value).field("ratio_spread", r.spread);
      j.field("measurable", !r.unmeasurable());
    };
    if (c.deck) {
      j.begin_object(true).field("seconds", c.deck->seconds);
      ratio(c.deck->ratio);
      j.field("wrong", c.deck->wrong).field("pairs", c.deck->pairs).end_object();
    } else {
      j.null();
    }
    j.key("hard_cases").begin_object(true).field("ns_per_pair", c.hard.ns_per_pair);
    ratio(c.hard.ratio);
    j.field("wrong", c.hard.wrong).field("pairs", c.hard.pairs);
    j.field("rewritten", c.hard.rewritten).field("other_answers", c.hard.other_answers);
    j.field("kinds_right", c.hard.kinds_right).field("kinds", c.hard.kinds).end_object();
    j.key("kinds").begin_array();
    for (const FamilyResult* f : c.kinds) {
      j.begin_object(true).field("id", f->id).field("name", f->name);
      j.field("pairs", f->samples).field("wrong", f->decision_errors);
      j.field("in_contact", f->exact_closer).field("expected", f->expected);
      write_example(j, *f);
      j.end_object();
    }
    j.end_array().end_object();
  }
  j.end_array();
}

void write_motion(JsonWriter& j, const HardMotion& m) {
  const auto point = [&](const Point3<double>& p) {
    j.begin_array(true).value(p.x).value(p.y).value(p.z).end_array();
  };
  j.key("motion").begin_object().key("corners").begin_array(true);
  for (const Point3<double>& p : m.corners) point(p);
  j.end_array().key("from");
  point(m.from);
  j.key("to");
  point(m.to);
  j.field("gap", m.gap).field("way", m.way).key("lines").begin_array();
  for (const HardMotion::Line& line : m.lines) {
    j.begin_object().field("accuracy", to_string(line.accuracy));
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

// Number types and formulas, and what kinds of hard cases the reference formula gets wrong.
std::string expert_tables(const AccuracyReport& report, bool color, std::size_t width) {
  std::string out;
  TextTable table({{"tier"},
                   {"what"},
                   {"ns/pair", Align::right},
                   {"x plain", Align::right},
                   {"worst rel.", Align::right},
                   {"worst ulp", Align::right},
                   {"of size", Align::right},
                   {"wrong decisions", Align::right},
                   {"wrong features", Align::right},
                   {"not finite", Align::right},
                   {"not invariant", Align::right},
                   {"jumps", Align::right},
                   {"fallback", Align::right},
                   {"to exact", Align::right},
                   {""}});
  const auto counted = [](std::uint64_t n) {
    return TextTable::Cell(std::to_string(n), n > 0 ? Tone::red : Tone::green);
  };
  for (const TierResult& t : report.tiers) {
    const bool value = t.what != "gaps" || t.max_relative_error > 0.0;
    const double plain = plain_time(report, t.what);
    table.row({t.name, t.what, fmt::format("{:.0f}", t.ns_per_pair),
               plain > 0 ? fmt::format("{:.2f}", t.ns_per_pair / plain) : std::string(),
               value ? number(t.max_relative_error) : "-", value ? number(t.max_ulp) : "-",
               value ? number(t.max_scaled_error) : "-", counted(t.decision_errors),
               t.what == "distance" ? counted(t.feature_errors) : TextTable::Cell("-"),
               counted(t.non_finite),
               t.rewritten > 0 ? counted(t.invariance_violations) : TextTable::Cell("-"),
               t.rewritten > 0 && t.what == "distance" ? counted(t.jumps) : TextTable::Cell("-"),
               percent(t.fallback_share), percent(t.exact_share),
               t.dominated ? TextTable::Cell("dominated", Tone::dim) : TextTable::Cell("")});
  }
  out += table.fitted(width, color, 0, 2);
  if (!report.families.empty()) {
    TextTable families({{"kind", Align::right},
                        {""},
                        {"tier"},
                        {"worst rel.", Align::right},
                        {"wrong decisions", Align::right},
                        {"not finite", Align::right},
                        {"expected"}});
    for (const FamilyResult& f : report.families) {
      const bool failing = f.decision_errors > 0 || f.max_ulp > 1.0;
      if (f.tier != "reference" && !(f.tier == "robust" && failing)) continue;
      families.row({std::to_string(f.id), f.name, f.tier, number(f.max_relative_error),
                    counted(f.decision_errors), counted(f.non_finite), f.expected});
    }
    out += "\nKinds of hard cases (reference; robust only where it fails):\n" +
           families.fitted(width, color, 0, 3);
  }
  return out;
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

std::vector<AccuracyChoice> accuracy_choices_of(const AccuracyReport& report,
                                                const AccuracyContext& context) {
  if (report.scene == "hard-cases") return accuracy_choices(report, nullptr);
  if (context.hard == nullptr) return {};
  return accuracy_choices(*context.hard, report.tiers.empty() ? nullptr : &report);
}

std::string accuracy_text(const AccuracyReport& report, const AccuracyContext& context, bool color,
                          std::size_t width, bool verbose) {
  const std::vector<AccuracyChoice> choices = accuracy_choices_of(report, context);
  std::string out;
  if (context.deck != nullptr || !context.path.empty())
    out += terminal_text(context.path) + (report.tiers.empty() ? ": no pair to decide\n" : "\n");
  if (!choices.empty()) out += choice_text(choices, color, width);
  if (choices.empty() && report.tiers.empty()) return out + "No pairs to measure.\n";
  if (verbose && !report.tiers.empty())
    out += fmt::format("\nNumber types and formulas, {} of {}\n",
                       count(report.tiers[0].samples, "pair", "pairs"),
                       context.path.empty() ? "the hard cases" : "the deck") +
           expert_tables(report, color, width);
  out += fmt::format("\n{}; {}\n", terminal_text(context.processor), accuracy_compiler());
  return verbose ? out : out + "(--verbose: number types, formulas and kinds of hard cases)\n";
}

std::string accuracy_examples(const AccuracyReport& report) {
  std::string out;
  for (const FamilyResult& f : report.families) {
    const bool shown = f.tier == "reference" || f.tier == "robust";
    if (shown && f.has_example && (f.decision_errors > 0 || f.non_finite > 0))
      out += example_text(f);
  }
  return out.empty() ? out : "Examples of wrong decisions:\n" + out;
}

std::string accuracy_json(const AccuracyReport& report, const AccuracyContext& context) {
  std::string out;
  JsonWriter j(out);
  j.begin_object();
  write_json_head(j, "deck/accuracy", 1);
  if (context.deck != nullptr) write_json_deck(j, context.path, *context.deck, nullptr, nullptr);
  j.field("scene", report.scene);
  j.key("machine").begin_object(true).field("processor", context.processor);
  j.field("compiler", accuracy_compiler()).field("command", context.command).end_object();
  const std::vector<AccuracyChoice> choices = accuracy_choices_of(report, context);
  j.key("advice").begin_array();
  for (const std::string& sentence : accuracy_advice(choices)) j.value(sentence);
  j.end_array();
  write_choices(j, choices);
  if (!choices.empty()) write_motion(j, hard_motion());
  j.key("tiers").begin_array();
  for (const TierResult& t : report.tiers) {
    j.begin_object(true).field("name", t.name).field("what", t.what).field("samples", t.samples);
    j.field("ns_per_pair", t.ns_per_pair).field("spread", t.spread).field("seconds", t.seconds);
    j.field("max_relative_error", t.max_relative_error);
    j.field("max_ulp", t.max_ulp).field("max_scaled_error", t.max_scaled_error);
    j.field("decision_errors", t.decision_errors)
        .field("feature_errors", t.feature_errors)
        .field("non_finite", t.non_finite);
    j.field("rewritten", t.rewritten).field("invariance_violations", t.invariance_violations);
    j.field("jumps", t.jumps)
        .field("fallback_share", t.fallback_share)
        .field("exact_share", t.exact_share);
    j.field("dominated", t.dominated).end_object();
  }
  j.end_array();
  j.key("families").begin_array();
  for (const FamilyResult& f : report.families) {
    j.begin_object(true).field("id", f.id).field("name", f.name).field("tier", f.tier);
    j.field("samples", f.samples).field("max_relative_error", f.max_relative_error);
    j.field("max_ulp", f.max_ulp).field("decision_errors", f.decision_errors);
    j.field("non_finite", f.non_finite).field("expected", f.expected);
    write_example(j, f);
    j.end_object();
  }
  j.end_array().key("stages").begin_array();
  for (const StageResult& s : report.stages) {
    j.begin_object(true).field("name", s.name).field("pairs", s.pairs);
    j.field("ns_per_pair", s.ns_per_pair).end_object();
  }
  j.end_array().end_object();
  return out;
}

}  // namespace deck
