// The first screen of the page of `deck accuracy`: advice, the four words of --accuracy with what
// they cost and give, which to choose, and the kinds of hard cases each decides rightly.
#include <fmt/format.h>

#include <algorithm>

#include "accuracy/shared/choice.hpp"
#include "base/shared/escape.hpp"
#include "deck/contact/scene.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

using Choices = std::vector<AccuracyChoice>;

std::string cell(std::string_view label, const std::string& content, bool bad = false) {
  return fmt::format("<td data-label=\"{}\"{}>{}</td>", label, bad ? " class=\"bad\"" : "",
                     content);
}

std::string wrong_cell(std::string_view label, std::uint64_t wrong, std::uint64_t all) {
  if (wrong == 0)
    return cell(label, fmt::format("<b class=\"ok\">0</b> <small>of {}</small>", all));
  return cell(
      label, fmt::format("<b>{}</b> <small>of {} = {}</small>", wrong, all, share_text(wrong, all)),
      true);
}

std::string ratio_words(const TimeRatio& r, bool is_fast) {
  return is_fast ? "1 x" : html_text(ratio_text(r)) + " <code>fast</code>";
}

/// A bar as long as the time; what is longer than the scale is drawn as cut.
std::string bar(double value, double scale) {
  const double share = scale > 0.0 ? value / scale : 0.0;
  return fmt::format("<span class=\"bar{}\" style=\"width:{:.1f}%\"></span>",
                     share > 1.0 ? " cut" : "", 100.0 * std::min(share, 1.0));
}

/// The largest time but that of `exact`, with room above.
double scale_of(const Choices& choices, double (*time)(const AccuracyChoice&)) {
  double most = 0.0;
  for (const AccuracyChoice& c : choices)
    if (c.accuracy != Accuracy::exact) most = std::max(most, time(c));
  return 1.6 * most;
}

double deck_time(const AccuracyChoice& c) { return c.deck ? c.deck->seconds : 0.0; }
double hard_time(const AccuracyChoice& c) { return c.hard.ns_per_pair; }

std::string choice_row(const AccuracyChoice& c, double deck_scale, double hard_scale) {
  const bool is_fast = c.accuracy == Accuracy::fast, standard = c.accuracy == Accuracy::robust;
  std::string out =
      fmt::format("<tr data-accuracy=\"{0}\"{1}><th scope=\"row\"><code>{0}</code>{2}</th>",
                  to_string(c.accuracy), standard ? " class=\"default\"" : "",
                  standard ? " <small>default</small>" : "");
  if (c.deck) {
    out += cell("This deck",
                fmt::format("{}<b class=\"seconds\">{}</b> <small>{}</small>",
                            bar(c.deck->seconds, deck_scale), seconds_text(c.deck->seconds),
                            ratio_words(c.deck->ratio, is_fast)));
    out += wrong_cell("Wrong, deck", c.deck->wrong.size(), c.deck->pairs);
  }
  out += cell(
      "Hard cases",
      fmt::format("{}<b>{}</b> <small>{}</small>", bar(c.hard.ns_per_pair, hard_scale),
                  seconds_text(1e-9 * c.hard.ns_per_pair), ratio_words(c.hard.ratio, is_fast)));
  out += wrong_cell("Wrong, hard cases", c.hard.wrong, c.hard.pairs);
  out += wrong_cell("Other answer", c.hard.other_answer, c.hard.rewritten);
  return out + "</tr>\n";
}

/// never, in under 10 % of the pairs, or more often wrong
int kind_level(const KindResult& k) {
  if (k.wrong == 0) return 0;
  return 10 * k.wrong < k.pairs ? 1 : 2;
}

std::string strip_row(const AccuracyChoice& c) {
  const char* name = to_string(c.accuracy);
  std::string out = fmt::format(
      "<div class=\"strip\" data-accuracy=\"{0}\"><span class=\"who\"><code>{0}</code> "
      "<b>{1} of {2}</b> kinds</span><span class=\"kinds\" role=\"toolbar\" aria-label=\"Kinds of "
      "hard cases, {0}\">",
      name, c.hard.kinds_never_wrong(), c.hard.kinds.size());
  bool first = true;
  for (const KindResult& k : c.hard.kinds) {
    out += fmt::format(
        "<button type=\"button\" class=\"l{}\" data-kind=\"{}\"{} aria-label=\"{}, {}: {} wrong of "
        "{}\" title=\"{}: {} wrong of {}\"></button>",
        kind_level(k), k.kind->id, first ? "" : " tabindex=\"-1\"", html_text(k.kind->name), name,
        k.wrong, k.pairs, html_text(k.kind->name), k.wrong, k.pairs);
    first = false;
  }
  return out + "</span></div>\n";
}

}  // namespace

std::string accuracy_first_screen(const Choices& choices) {
  std::string out = "<p class=\"said\">";
  for (const std::string& sentence : accuracy_advice(choices, "code")) out += sentence + " ";
  out += "</p>\n<table class=\"choices cards\"><thead><tr><th scope=\"col\">--accuracy</th>";
  const auto& first = choices.front();
  if (first.deck) out += "<th scope=\"col\">This deck: time</th><th scope=\"col\">wrong</th>";
  out += fmt::format(
      "<th scope=\"col\">Hard cases: time per pair</th><th scope=\"col\">wrong</th>"
      "<th scope=\"col\">other answer</th></tr></thead><tbody>\n");
  const double deck_scale = scale_of(choices, deck_time), hard_scale = scale_of(choices, hard_time);
  for (const AccuracyChoice& c : choices) out += choice_row(c, deck_scale, hard_scale);
  out += fmt::format(
      "</tbody></table>\n<p class=\"note\">{}Hard cases: {} pairs made to break arithmetic. Other "
      "answer: of {} pairs written in other ways (order of nodes, axes, units).</p>\n",
      first.deck ? "This deck: the whole of deck gaps, reading included. " : "", first.hard.pairs,
      first.hard.rewritten);
  out +=
      "<dl class=\"choose\"><dt><code>reference</code></dt><dd>to compare with a Starter listing, "
      "pair by pair</dd><dt><code>fast</code></dt><dd>for thousands of variants, where one pair "
      "more "
      "or less does not matter</dd><dt><code>robust</code></dt><dd>for everything else</dd>"
      "<dt><code>exact</code></dt><dd>to settle one doubtful deck</dd></dl>\n";
  out +=
      "<section class=\"stable\"><div><h2>Which hard cases stay stable</h2>\n<p class=\"note\">"
      "<span class=\"key l0\"></span>never decides wrongly <span class=\"key l1\"></span>under 10 "
      "% wrong "
      "<span class=\"key l2\"></span>more. Choose a mark to see the worst pair of its kind.</p>\n";
  for (const AccuracyChoice& c : choices) out += strip_row(c);
  return out + "</div><div id=\"example\" aria-live=\"polite\"></div></section>\n";
}

}  // namespace deck::detail
