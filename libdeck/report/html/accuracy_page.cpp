// The page of `deck accuracy`: the first screen answers what each word of --accuracy costs: advice,
// the four words with what they cost and give, which to choose, and the kinds of hard cases each
// decides rightly. Then a hard case in motion, drawn as SVG: who says that the node is in contact,
// and the force of the figures that each word prints; colours are classes, so that a page can give
// it another ground. All figures stand in the page without scripts; the JSON document stands in it,
// too.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/shared/choice.hpp"
#include "base/shared/shown_text.hpp"
#include "deck/contacts.hpp"
#include "report/html/parts.hpp"
#include "report/shared/accuracy.hpp"

namespace deck {
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

std::string first_screen(const Choices& choices) {
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

std::string line(double x1, double y1, double x2, double y2, std::string_view kind) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' class='{}'/>\n", x1, y1,
                     x2, y2, kind);
}
std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view extra = "") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor,
                     extra, xml_text(content));
}

constexpr std::string_view chart_style =
    "<style>.dk-ground{fill:#fff} .dk-grid{stroke:#dde2e8} "
    ".dk-default{fill:none;stroke:#9a5b00;stroke-width:2} .dk-svg text{fill:#5c6979} "
    ".dk-line{fill:none;stroke-width:1.8} .dk-wide{stroke-width:6;stroke-opacity:.4} "
    ".dk-line.dk-reference{stroke:#b3261e} .dk-line.dk-fast{stroke:#1f5fd0} "
    ".dk-line.dk-robust{stroke:#17202b;stroke-dasharray:6 4} .dk-line.dk-exact{stroke:#0b6b3a} "
    ".dk-svg .dk-title{fill:#17202b;font-size:13px;font-weight:bold}</style>\n";

std::string open_svg(double width, double height, const std::string& name) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' class='dk-svg' viewBox='0 0 {0} {1}' width='{0}' "
      "height='{1}' "
      "font-family='system-ui, sans-serif' font-size='12' role='img' aria-label='{3}'>\n{2}<rect "
      "width='{0}' "
      "height='{1}' class='dk-ground'/>\n",
      width, height, chart_style, xml_text(name));
}

/// A line over the steps where a word says that the pair is in contact.
template <class X>
std::string contact_band(const HardMotion::Line& l, double y, const X& x, const std::string& kind) {
  std::string out = "<path d='";
  for (std::size_t k = 0; k + 1 < l.depth.size(); ++k)
    if (l.depth[k] > 0.0 && l.depth[k + 1] > 0.0)
      out += (k > 0 && l.depth[k - 1] > 0.0 ? "" : fmt::format("M{:.1f} {:.1f}", x(k), y)) +
             fmt::format("H{:.1f}", x(k + 1));
  return out +
         fmt::format("' class='{} dk-band' data-accuracy='{}'/>\n", kind, to_string(l.accuracy));
}

std::string motion_panel(const HardMotion& motion) {
  constexpr double width = 360, height = 330, left = 30, right = 348, top = 128, bottom = 292;
  double most = 1.0;
  for (const HardMotion::Line& l : motion.lines)
    most = std::max(most, std::ceil(*std::max_element(l.force.begin(), l.force.end())));
  const std::size_t last = motion.lines.front().force.size() - 1;
  const auto x = [&](std::size_t step) {
    return left + static_cast<double>(step) / static_cast<double>(last) * (right - left);
  };
  const auto y = [&](double force) { return bottom - force / most * (bottom - top); };
  std::string out = open_svg(width, height, "Elastic force against step, a node over a sliver");
  out += text(4, 18, "start", "In contact?", "class='dk-title'");
  out += text(4, 112, "start", "Force from the figures printed, stiffness 1", "class='dk-title'");
  for (double force = 0; force <= most; ++force) {
    out += line(left, y(force), right, y(force), "dk-grid");
    out += text(left - 8, y(force) + 4, "end", fmt::format("{:.0f}", force));
  }
  for (std::size_t step = 0; step <= last; step += 25)
    out += text(x(step), bottom + 18, step == last ? "end" : "middle", std::to_string(step));
  out += text(0.5 * (left + right), bottom + 34, "middle", "step");
  std::string rings;
  double key = left, band = 52;
  // Wide lines below narrow ones: those that coincide are both seen.
  for (const Accuracy a :
       {Accuracy::exact, Accuracy::reference, Accuracy::fast, Accuracy::robust}) {
    const bool wide = a == Accuracy::exact || a == Accuracy::reference;
    const std::string kind = fmt::format("dk-line dk-{}{}", to_string(a), wide ? " dk-wide" : "");
    out += line(key, 38, key + 20, 38, kind) + text(key + 25, 42, "start", to_string(a));
    key += a == Accuracy::reference ? 98 : 76;
    band += 8;
    for (const HardMotion::Line& l : motion.lines) {
      if (l.accuracy != a) continue;
      out += contact_band(l, band, x, kind);
      std::string points;
      for (std::size_t k = 0; k < l.force.size(); ++k)
        points += fmt::format("{:.1f},{:.1f} ", x(k), y(l.force[k]));
      out += "<polyline points='" + points + "' class='" + kind + "'/>\n";
      for (const std::size_t k : l.jumps) {
        rings += fmt::format(
            "<rect x='{:.1f}' y='{:.1f}' width='14' height='14' rx='7' class='dk-default' "
            "data-accuracy='{}' data-step='{}'/>\n",
            x(k) - 7, y(l.force[k]) - 7, to_string(a), k);
        if (a == Accuracy::robust)
          rings += text(x(k) + 8, y(l.force[k]) - 9, "start", fmt::format("step {}", k));
      }
    }
  }
  return out + rings + "</svg>\n";
}

std::string motion_section() {
  const HardMotion motion = hard_motion();
  std::string said;
  for (const std::string& sentence : motion_sentences(motion, "code"))
    said += "<p class=\"jump\">" + sentence + "</p>\n";
  return fmt::format(
      R"~(<section id="motion"><h2>A node passes a sliver</h2>
<div><figure tabindex="0">{}<button type="button" class="save" data-name="accuracy_motion.svg">Save as SVG</button></figure>
<div>{}<p class="note">The area of the triangle is round-off: there the reference formula takes the wrong edge. <code>robust</code>
decides contact without round-off and prints the figures of the reference formula; where that formula sees no contact, the exact ones.</p>
<p class="note">A ring is a jump: the depth changes by more than the node moves ({:.3g} a step, gap {:g}), which no distance can do.</p>
</div></div></section>
)~",
      motion_panel(motion), said, motion.way, motion.gap);
}

constexpr std::string_view page_style = R"~(
:root { --ground:#f5f6f8; --panel:#fff; --ink:#17202b; --muted:#5c6979; --line:#e2e6ec; --accent:#1f5fd0; --soft:#e8f0fe; --good:#0b6b3a; --some:#b45309; --bad:#b3261e; color-scheme: light; }
[data-theme=dark] { --ground:#10151b; --panel:#171e27; --ink:#e7edf4; --muted:#93a2b4; --line:#303c4c; --accent:#7fb2ff; --soft:#1b2c47; --good:#5fd38d; --some:#f0a860; --bad:#ff8a80; color-scheme: dark; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 14px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif; font-variant-numeric: tabular-nums; }
code { font-family: ui-monospace, "SFMono-Regular", Menlo, Consolas, "DejaVu Sans Mono", monospace; font-size: .95em; } small { font-size: 12px; color: var(--muted); }
header { display: flex; flex-wrap: wrap; gap: 6px 12px; align-items: center; padding: 8px 20px; background: var(--panel); border-bottom: 1px solid var(--line); }
header h1 { font-size: 16px; margin: 0; flex: 1; overflow-wrap: anywhere; } header h1 small { font-weight: 400; margin-left: 8px; } main { max-width: 1420px; margin: 0 auto; padding: 0 20px 40px; }
.said { font-size: 17px; padding: 10px 16px; margin: 14px 0; border-radius: 10px; border-left: 5px solid var(--accent); background: var(--soft); }
h2 { font-size: 16px; margin: 14px 0 2px; } .note { color: var(--muted); font-size: 13px; margin: 4px 0; overflow-wrap: anywhere; }
button { font: inherit; font-size: 13px; color: inherit; background: var(--panel); border: 1px solid var(--line); border-radius: 7px; padding: 4px 11px; cursor: pointer; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px; }
figure { margin: 0 0 14px; background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: 8px; overflow-x: auto; } figure svg { width: 100%; min-width: 880px; max-width: 1100px; height: auto; display: block; }
table { border-collapse: collapse; font-size: 13px; background: var(--panel); max-width: 100%; }
th, td { padding: 4px 10px; border: 1px solid var(--line); text-align: right; white-space: nowrap; } th { color: var(--muted); font-weight: 600; } thead th { white-space: normal; } .l { text-align: left; }
.choices { width: 100%; font-size: 15px; border-radius: 10px; } .choices th, .choices td { border-width: 1px 0; padding: 7px 12px; } .choices th { text-align: left; color: var(--ink); } .choices thead th { color: var(--muted); font-size: 13px; }
.choices td { text-align: left; white-space: normal; } .choices td b { white-space: nowrap; } .choices .default { background: var(--soft); } .choices .default th { box-shadow: inset 4px 0 var(--accent); } .ok { color: var(--good); } .bad b { color: var(--bad); }
.bar { display: block; height: 6px; border-radius: 3px; background: var(--accent); margin-bottom: 2px; min-width: 2px; } .bar.cut { background: repeating-linear-gradient(115deg, var(--accent) 0 14px, transparent 14px 18px); }
.choose { display: grid; grid-template-columns: auto 1fr auto 1fr; gap: 2px 14px; margin: 10px 0; } .choose dd { margin: 0; color: var(--muted); }
.stable { display: grid; gap: 8px 16px; align-items: start; } .strip { display: flex; gap: 10px; align-items: center; margin: 5px 0; } .who { flex: none; width: 104px; line-height: 1.25; font-size: 13px; white-space: nowrap; } .who code { display: block; } .kinds { display: flex; flex-wrap: wrap; }
.kinds button, .key { width: 24px; height: 24px; padding: 0; border: 0; border-radius: 5px; background: none; position: relative; } .key { display: inline-block; vertical-align: -7px; }
.kinds button::after, .key::after { content: ""; position: absolute; inset: 4px; border-radius: 50%; } .l0::after { background: var(--good); } .l1::after { border: 3px solid var(--some); } .kinds .l2::after, .key.l2::after { background: var(--bad); border-radius: 2px; transform: scale(.8) rotate(45deg); }
.kinds [aria-pressed=true] { background: var(--line); outline: 1px solid var(--muted); } .kinds button:hover { background: var(--line); }
#example { background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: 8px 12px; max-width: 380px; } #example:empty { display: none; } #example h3 { margin: 0; font-size: 14px; } #example svg { width: 340px; max-width: 100%; height: auto; display: block; font-size: 12px; } #example p { margin: 2px 0; font-size: 13px; overflow-wrap: anywhere; }
#example .seg { fill: var(--soft); stroke: var(--accent); stroke-width: 2; } #example .other { stroke: var(--bad); stroke-width: 3; fill: var(--bad); } #example text { fill: var(--ink); } #example text.dim { fill: var(--muted); } #example .inside { fill: var(--soft); } #example .gap { stroke: var(--ink); stroke-dasharray: 5 4; } #example .got { stroke: var(--bad); stroke-width: 2.5; } #example .exact { fill: var(--good); }
[data-theme=dark] .dk-ground { fill: #171e27; } [data-theme=dark] .dk-grid { stroke: #303c4c; } [data-theme=dark] .dk-default { stroke: #ffc069; }
[data-theme=dark] .dk-svg text { fill: #93a2b4; } [data-theme=dark] .dk-svg .dk-title { fill: #e7edf4; }
[data-theme=dark] .dk-line.dk-reference { stroke: #ff8a80; } [data-theme=dark] .dk-line.dk-fast { stroke: #7fb2ff; } [data-theme=dark] .dk-line.dk-robust { stroke: #e7edf4; } [data-theme=dark] .dk-line.dk-exact { stroke: #5fd38d; }
#motion > div { display: flex; flex-wrap: wrap; gap: 8px 24px; align-items: center; margin-top: 8px; } #motion figure { flex: 0 1 460px; min-width: 0; margin: 0; } #motion figure svg { min-width: 0; } #motion div div { flex: 1 1 320px; } .jump { margin: 4px 0; }
@media (min-width: 1400px) { .stable { grid-template-columns: minmax(0, 1fr) 350px; } }
@media (max-width: 1120px) { .choose { grid-template-columns: auto 1fr; } .who { width: auto; min-width: 104px; } }
@media (max-width: 820px) {
  header { padding: 6px 12px; flex-wrap: nowrap; } header h1 small { display: block; margin: 0; line-height: 1.3; } .strip { display: block; } .who code { display: inline; } main { padding: 0 12px 30px; } .said { font-size: 14px; line-height: 1.4; padding: 8px 10px; margin: 8px 0; }
  .cards, .cards tbody, .cards td, .cards th { display: block; } .cards thead { display: none; } .cards { background: none; width: 100%; } .cards tr { display: flex; flex-wrap: wrap; background: var(--panel); border: 1px solid var(--line); border-radius: 8px; margin: 0 0 5px; padding: 3px 8px; }
  .cards th, .choices th { flex: 1 0 100%; text-align: left; border: 0; padding: 0; white-space: normal; } .cards td, .choices td { flex: 1 0 33%; max-width: 100%; text-align: left; white-space: normal; border: 0; padding: 0 6px 2px 0; font-size: 13px; line-height: 1.3; } .choices td { flex: 0 0 38%; } .choices td:nth-of-type(2) { flex-basis: 24%; } .choices td small { display: block; }
  .cards td::before { content: attr(data-label); display: block; font-size: 11px; color: var(--muted); } .choices .default th { box-shadow: none; } .choices .bar { display: none; }
}
@media print { header button, .save { display: none; } }
)~";

constexpr std::string_view page_script = R"~(
const root = document.documentElement, data = JSON.parse(document.getElementById("accuracy-json").textContent);
root.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
document.getElementById("theme").onclick = () => root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
function save(name, type, text) {
  const a = document.createElement("a");
  a.download = name;
  a.setAttribute("hr" + "ef", URL.createObjectURL(new Blob([text], { type })));
  a.click();
}
document.getElementById("json").onclick = () => save("accuracy.json", "application/json", JSON.stringify(data, null, 1));
for (const b of document.querySelectorAll(".save")) b.onclick = () => save(b.dataset.name, "image/svg+xml", b.closest("figure").querySelector("svg").outerHTML);
const svg = (tag, attributes, text) => {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  if (text) e.textContent = text;
  return e;
};
const extent = (p) => Math.max(...[0, 1, 2].map((k) => Math.max(...p.map((x) => x[k])) - Math.min(...p.map((x) => x[k]))));
/** The pair as seen obliquely, all of it in the frame whatever its size. */
function draw(e) {
  const p = e.points, low = [0, 1, 2].map((k) => Math.min(...p.map((x) => x[k]))), size = extent(p) || 1;
  const flat = p.map((x) => { const [a, b, c] = x.map((v, k) => (v - low[k]) / size); return [0.87 * (a - b), 0.5 * (a + b) - c]; });
  const box = [0, 1].map((k) => [Math.min(...flat.map((f) => f[k])), Math.max(...flat.map((f) => f[k]))]);
  const span = Math.max(box[0][1] - box[0][0], 2.6 * (box[1][1] - box[1][0])) || 1;
  const at = flat.map((f) => [20 + 300 * (f[0] - box[0][0]) / span, 12 + 300 * (f[1] - box[1][0]) / span]);
  const s = svg("svg", { viewBox: "0 0 340 140", role: "img", "aria-label": "The pair" });
  const path = (i) => i.map((k) => at[k].join(",")).join(" ");
  if (e.kind === "edge_edge") s.append(svg("polyline", { points: path([0, 1]), class: "other" }), svg("polyline", { points: path([2, 3]), class: "seg" }));
  else s.append(svg("polygon", { points: path(e.triangle ? [0, 1, 2] : [0, 1, 2, 3]), class: "seg" }), svg("circle", { cx: at[4][0], cy: at[4][1], r: 5, class: "other" }));
  return s;
}
/** All digits, in the shorter way of writing. */
const shortest = (d) => String(d).length > 18 ? d.toExponential() : String(d);
/** Both distances beside the gap, so far enlarged that their difference is seen. Each mark stands on the side it was decided for. */
function drawGap(e) {
  const s = svg("svg", { viewBox: "0 0 340 148", role: "img", "aria-label": "Gap and distances" }), middle = 74;
  const off = (d) => Number.isFinite(d) ? Math.abs(d - e.gap) : 0, span = Math.max(off(e.exact), off(e.computed));
  const y = (d, inside) => middle + (inside ? 1 : -1) * (Number.isFinite(d) && span > 0 ? 26 + 20 * Math.min(1, off(d) / span) : 36);
  s.append(svg("rect", { x: 0, y: middle, width: 340, height: 74, class: "inside" }), svg("line", { x1: 0, x2: 340, y1: middle, y2: middle, class: "gap" }));
  s.append(svg("text", { x: 6, y: middle - 5 }, `gap ${shortest(e.gap)}`), svg("text", { x: 6, y: 12, class: "dim" }, "not in contact"), svg("text", { x: 6, y: 142, class: "dim" }, "in contact"));
  const words = (d) => d === null ? "not finite" : shortest(d), ye = y(e.exact, e.in_contact), yg = y(e.computed, !e.in_contact);
  s.append(svg("circle", { cx: 60, cy: ye, r: 5, class: "exact" }), svg("text", { x: 72, y: ye + 4 }, `exactly ${words(e.exact)}`));
  s.append(svg("path", { d: `M55 ${yg - 5}l10 10m0 -10l-10 10`, class: "got" }), svg("text", { x: 72, y: yg + 4 }, `${e.word} ${words(e.computed)}`));
  return { s, span };
}
const panel = document.getElementById("example"), marks = [...document.querySelectorAll(".kinds button")];
function show(accuracy, id) {
  const kind = data.families.find((k) => k.id === id), wrong = kind.wrong[accuracy], e = kind.worst.find((w) => w.word === accuracy);
  for (const b of marks) b.setAttribute("aria-pressed", String(b.closest(".strip").dataset.accuracy === accuracy && Number(b.dataset.kind) === id));
  panel.replaceChildren();
  const add = (tag, text) => { const e = document.createElement(tag); e.textContent = text; panel.append(e); return e; };
  add("h3", `${kind.name}, ${accuracy}`);
  add("p", wrong === 0 ? `All ${kind.pairs} pairs are decided rightly.` : `${wrong} of ${kind.pairs} pairs are decided wrongly. The worst one:`);
  if (!e) { add("p", `Expected: ${kind.expected}.`).className = "note"; return; }
  panel.append(draw(e));
  const gap = drawGap(e), size = extent(e.points);
  panel.append(gap.s);
  if (gap.span > 0 && size > 0) add("p", `Pair of size ${size.toPrecision(3)}; below, differences are enlarged ${((20 / gap.span) / (300 / size)).toPrecision(1)} times against it.`).className = "note";
}
for (const strip of document.querySelectorAll(".kinds")) {
  const buttons = [...strip.children];
  buttons.forEach((b, i) => {
    b.onclick = () => show(strip.closest(".strip").dataset.accuracy, Number(b.dataset.kind));
    b.onkeydown = (e) => {
      const to = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: buttons.length - 1 }[e.key];
      if (to === undefined || !buttons[to]) return;
      e.preventDefault();
      for (const o of buttons) o.tabIndex = o === buttons[to] ? 0 : -1;
      buttons[to].focus();
    };
  });
}
// First the kind that plain double decides worst.
const share = (k) => k.wrong.fast / k.pairs, worst = data.families.reduce((a, b) => share(b) > share(a) ? b : a);
if (worst.wrong.fast > 0) show("fast", worst.id);
)~";

}  // namespace

std::string accuracy_html(const AccuracyChoices& choices, const AccuracyContext& context) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
      "'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>"
      "What accuracy costs</title>\n<style>";
  out += page_style;
  out += "</style>\n</head>\n<body>\n<header><h1>What accuracy costs <small>" +
         html_text(context.path.empty() ? "the hard cases" : terminal_text(context.path)) +
         "</small></h1><button type=\"button\" id=\"json\">JSON</button><button type=\"button\" "
         "id=\"theme\">Dark or light</button></header>\n<main>\n";
  out += first_screen(choices);
  out += motion_section();
  for (const std::string& line : {context.processor, accuracy_compiler(), context.command})
    out += "<p class=\"note\">" + html_text(terminal_text(line)) + "</p>\n";
  out += "</main>\n<script type=\"application/json\" id=\"accuracy-json\">" +
         detail::script_safe(accuracy_json(choices, context)) + "</script>\n<script>";
  out += page_script;
  return out + "</script>\n</body>\n</html>\n";
}

}  // namespace deck
