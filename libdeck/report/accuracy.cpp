// `deck accuracy`: the measured tiers as text and JSON.
#include "deck/report/accuracy.hpp"
#include "deck/base/escape.hpp"

#include <fmt/format.h>

#include <cmath>

#include "deck/report/json.hpp"
#include "deck/report/text_table.hpp"

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

std::string accuracy_text(const AccuracyReport& report, const AccuracyContext& context, bool color,
                          std::size_t width) {
  if (report.tiers.empty()) return "No pairs to measure.\n";
  std::string out =
      fmt::format("{} pairs of {}\n\n", report.tiers[0].samples,
                  context.path.empty() ? "the hard cases" : terminal_text(context.path));
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
  const auto count = [](std::uint64_t n) {
    return TextTable::Cell(std::to_string(n), n > 0 ? Tone::red : Tone::green);
  };
  for (const TierResult& t : report.tiers) {
    const bool value = t.what != "gaps" || t.max_relative_error > 0.0;
    const double plain = plain_time(report, t.what);
    table.row({t.name, t.what, fmt::format("{:.0f}", t.ns_per_pair),
               plain > 0 ? fmt::format("{:.2f}", t.ns_per_pair / plain) : std::string(),
               value ? number(t.max_relative_error) : "-", value ? number(t.max_ulp) : "-",
               value ? number(t.max_scaled_error) : "-", count(t.decision_errors),
               t.what == "distance" ? count(t.feature_errors) : TextTable::Cell("-"),
               count(t.non_finite),
               t.rewritten > 0 ? count(t.invariance_violations) : TextTable::Cell("-"),
               t.rewritten > 0 && t.what == "distance" ? count(t.jumps) : TextTable::Cell("-"),
               percent(t.fallback_share), percent(t.exact_share),
               t.dominated ? TextTable::Cell("dominated", Tone::dim) : TextTable::Cell("")});
  }
  out += table.fitted(width, color, 0, 2);
  if (!report.families.empty()) {
    TextTable families({{"family", Align::right},
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
                    count(f.decision_errors), count(f.non_finite), f.expected});
    }
    out += "\nFamilies (reference; robust only where it fails):\n" +
           families.fitted(width, color, 0, 3);
  }
  out += fmt::format("\n{}; {}\n", terminal_text(context.processor), accuracy_compiler());
  return out;
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
  j.key("tiers").begin_array();
  for (const TierResult& t : report.tiers) {
    j.begin_object(true).field("name", t.name).field("what", t.what).field("samples", t.samples);
    j.field("ns_per_pair", t.ns_per_pair).field("max_relative_error", t.max_relative_error);
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
