// The page of `deck accuracy`. First screen: price of exact decisions on this deck, the four
// accuracies as a slider over the picture with their wrong pairs, families of hard cases with
// shares of wrong answers. Below: a hard case in motion with contact decision and force per
// accuracy. The figures are readable without scripts; the page contains the JSON document.
#include <fmt/format.h>

#include <algorithm>

#include "accuracy/shared/choice.hpp"
#include "base/shared/shown_text.hpp"
#include "report/html/page_steps.hpp"
#include "report/shared/accuracy.hpp"

namespace deck {
namespace {

using Choices = std::vector<AccuracyChoice>;

std::string share_cell(std::string_view label, std::uint64_t wrong, std::uint64_t all) {
  return fmt::format("<td data-label=\"{}\" class=\"{}\">{} <small>of {}</small></td>", label,
                     wrong == 0 ? "ok" : "bad", wrong, all);
}

/// A row of the slider: an accuracy with time and wrong decisions.
std::string word_row(const AccuracyChoice& c) {
  const bool standard = c.accuracy == Accuracy::robust;
  std::string out = fmt::format(
      "<tr data-accuracy=\"{0}\"><th scope=\"row\"><label><input type=\"radio\" name=\"word\" "
      "value=\"{0}\"{1}><code>{0}</code>{2}</label></th>",
      to_string(c.accuracy), standard ? " checked" : "", standard ? " <small>default</small>" : "");
  const TimeRatio& ratio = c.deck ? c.deck->ratio : c.hard.ratio;
  const double seconds = c.deck ? c.deck->seconds : 1e-9 * c.hard.ns_per_pair;
  out += fmt::format("<td data-label=\"Time\">{}{}</td><td data-label=\"Against fast\">{}</td>",
                     c.deck && c.deck->extrapolated ? "about " : "", seconds_text(seconds),
                     c.accuracy == Accuracy::fast ? "1 x" : ratio_text(ratio));
  return out +
         (c.deck ? share_cell("Wrong", c.deck->wrong.size(), c.deck->pairs)
                 : share_cell("Wrong", c.hard.wrong, c.hard.pairs)) +
         "</tr>\n";
}

std::vector<std::string> groups_of(const Choices& choices) {
  std::vector<std::string> out;
  for (const KindResult& k : choices.front().hard.kinds)
    if (std::find(out.begin(), out.end(), k.kind->group) == out.end())
      out.emplace_back(k.kind->group);
  return out;
}

/// A row per accuracy, a column per family: share of wrong decisions.
std::string families_table(const Choices& choices) {
  std::string out = "<table class=\"families cards\"><thead><tr><th scope=\"col\">--accuracy</th>";
  const std::vector<std::string> groups = groups_of(choices);
  for (const std::string& g : groups) out += "<th scope=\"col\">" + html_text(g) + "</th>";
  out += "<th scope=\"col\">same pair written another way</th></tr></thead><tbody>\n";
  for (const AccuracyChoice& c : choices) {
    out += fmt::format("<tr data-accuracy=\"{0}\"><th scope=\"row\"><code>{0}</code></th>",
                       to_string(c.accuracy));
    for (const std::string& g : groups) {
      std::uint64_t wrong = 0, pairs = 0;
      for (const KindResult& k : c.hard.kinds)
        if (k.kind->group == g) wrong += k.wrong, pairs += k.pairs;
      const double share = 100.0 * static_cast<double>(wrong) / static_cast<double>(pairs);
      out += fmt::format(
          "<td data-label=\"{0}\"><button type=\"button\" data-group=\"{0}\" class=\"{1}\" "
          "style=\"--share:{2:.1f}%\" title=\"{3} wrong of {4}\">{5}</button></td>",
          html_text(g), wrong == 0 ? "ok" : "bad", share, wrong, pairs, share_text(wrong, pairs));
    }
    out += fmt::format("<td data-label=\"Other answer\" class=\"{}\">{}</td></tr>\n",
                       c.hard.other_answer == 0 ? "ok" : "bad",
                       share_text(c.hard.other_answer, c.hard.rewritten));
  }
  return out + "</tbody></table>\n";
}

std::string first_screen(const Choices& choices) {
  const bool deck = choices.front().deck.has_value();
  std::string out = "<p class=\"said\">";
  for (const std::string& sentence : accuracy_advice(choices, "code"))
    out += "<span>" + sentence + "</span> ";
  out +=
      "</p>\n<section class=\"price\"><div><figure id=\"chart\"></figure><table class=\"words "
      "cards\"><thead><tr><th "
      "scope=\"col\">--accuracy</th><th scope=\"col\">";
  out += deck ? "this deck" : "a hard pair";
  out +=
      "</th><th scope=\"col\">against fast</th><th scope=\"col\">wrong</th></tr></thead><tbody>\n";
  for (const AccuracyChoice& c : choices) out += word_row(c);
  out += "</tbody></table></div>\n";
  if (deck)
    out +=
        "<figure class=\"deck\"><div id=\"picture\"></div></figure><div><ol id=\"pairs\" "
        "aria-label=\"Pairs decided wrongly\"></ol></div><div class=\"pair\" id=\"pair\" "
        "aria-live=\"polite\"></div>";
  out += fmt::format(
      "</section>\n<section class=\"stable\"><div><h2>Hard cases decided wrongly: {} pairs of {} "
      "kinds made to break arithmetic</h2>\n",
      choices.front().hard.pairs, choices.front().hard.kinds.size());
  return out + families_table(choices) +
         "</div><div class=\"pair\" id=\"example\" aria-live=\"polite\"></div></section>\n";
}

std::string motion_section() {
  const HardMotion motion = hard_motion();
  std::string said;
  for (const std::string& sentence : motion_sentences(motion, "code"))
    said += "<p class=\"jump\">" + sentence + "</p>\n";
  return fmt::format(
      R"~(<section id="motion"><h2>A node passes a sliver</h2>
<div><figure tabindex="0"><div id="lines"></div><button type="button" class="save" data-name="accuracy_motion.svg">Save as SVG</button></figure>
<div><label>Step <input type="range" id="step" min="0" max="100" value="47"></label><p id="at" aria-live="polite"></p>{}<p class="note">The area of the triangle is round-off: there the reference formula takes the wrong edge. <code>robust</code>
decides contact without round-off and prints the figures of the reference formula; where that formula sees no contact, the exact ones.</p>
<p class="note">A ring is a jump: the depth changes by more than the node moves ({:.3g} a step, gap {:g}), which no distance can do.</p>
</div></div></section>
)~",
      said, motion.way, motion.gap);
}

std::string surface_text(const DeckPicture& picture) {
  std::string out;
  for (const auto& q : picture.surface) {
    out += out.empty() ? "[" : ",[";
    for (const Point3<double>& p : q)
      out += fmt::format("{}{:.6g},{:.6g},{:.6g}", &p == q.data() ? "" : ",", p.x, p.y, p.z);
    out += "]";
  }
  return out;
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
.said span:first-child { font-size: 22px; font-weight: 600; display: block; line-height: 1.3; } .ok { color: var(--good); } .bad { color: var(--bad); }
.price { display: grid; grid-template-columns: 420px minmax(0, 1fr) 200px 336px; gap: 8px 14px; align-items: start; } .price figure { margin: 0; padding: 4px; } .price figure svg { min-width: 0; } .words { width: 100%; margin-top: 6px; } .words th, .words td, .families th, .families td { border-width: 1px 0; text-align: left; white-space: normal; } .words th, .words td { padding: 4px 6px; } .words th label { color: var(--ink); cursor: pointer; display: block; } .words tr:has(:checked) { background: var(--soft); }
#picture svg { height: 330px; } code { white-space: nowrap; } #picture circle { cursor: pointer; } #picture .chosen { stroke: var(--ink); stroke-width: 3; } #pairs { margin: 0; padding: 0; list-style: none; max-height: 345px; overflow: auto; font-size: 12px; } #pairs button { width: 100%; text-align: left; border: 0; padding: 3px 6px; overflow-wrap: anywhere; } #pairs [aria-pressed=true] { background: var(--soft); }
.stable { display: grid; grid-template-columns: minmax(0, 1fr) 350px; gap: 8px 16px; align-items: start; } .families { width: 100%; } .families td { padding: 2px 6px; } .families button { width: 100%; text-align: left; border: 0; background: linear-gradient(90deg, color-mix(in srgb, currentColor 18%, transparent) var(--share), transparent 0); } .families [aria-pressed=true] { outline: 2px solid var(--accent); }
.pair { background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: 6px 12px; max-width: 380px; } .pair:empty { display: none; } .pair h3 { margin: 0; font-size: 14px; overflow-wrap: anywhere; } .pair svg { width: 340px; max-width: 100%; height: auto; display: block; font-size: 13px; } .pair p { margin: 2px 0; font-size: 13px; overflow-wrap: anywhere; }
.pair .seg { fill: var(--soft); stroke: var(--accent); stroke-width: 2; } .pair .other { stroke: var(--bad); stroke-width: 3; fill: var(--bad); } .pair text { fill: var(--ink); } .pair text.dim { fill: var(--muted); } .pair .inside { fill: var(--soft); } .pair .gap { stroke: var(--ink); stroke-dasharray: 5 4; } .pair .got { stroke: var(--bad); stroke-width: 2.5; } .pair .exact { fill: var(--good); }
.surface { fill: var(--line); fill-opacity: .5; stroke: var(--muted); stroke-width: .3; } .wrong { fill: var(--bad); } .right { fill: var(--panel); stroke: var(--good); stroke-width: 2; } [data-theme=dark] .chart { filter: invert(.88) hue-rotate(180deg); }
#motion > div { display: flex; flex-wrap: wrap; gap: 8px 24px; align-items: center; margin-top: 8px; } #motion figure { flex: 0 1 460px; min-width: 0; margin: 0; } #motion figure svg { min-width: 0; } #motion div div { flex: 1 1 320px; } .jump { margin: 4px 0; }
@media (max-width: 1300px) { .price { grid-template-columns: 420px minmax(0, 1fr); } #picture svg { height: 378px; } .stable { grid-template-columns: minmax(0, 1fr); } }
@media (max-width: 820px) {
  header { padding: 6px 12px; flex-wrap: nowrap; } header h1 small { display: block; margin: 0; line-height: 1.3; } main { padding: 0 12px 30px; } .said { font-size: 14px; line-height: 1.4; padding: 8px 10px; margin: 8px 0; } .said span:first-child { font-size: 16px; }
  .price, .stable { grid-template-columns: minmax(0, 1fr); } .price figure svg text { font-size: 13px; } .price > div:first-child { display: flex; flex-direction: column-reverse; } #picture svg { height: 260px; } .words th, .words td { padding: 5px 4px; white-space: normal; }
  .families, .families tbody, .families td, .families th { display: block; } .families thead { display: none; } .families tr { display: flex; flex-wrap: wrap; margin: 0 0 5px; } .families th { flex: 1 0 100%; } .families td { flex: 1 0 40%; } .families td::before { content: attr(data-label); display: block; font-size: 11px; color: var(--muted); }
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
  if (e !== data.nearest) s.append(svg("path", { d: `M55 ${yg - 5}l10 10m0 -10l-10 10`, class: "got" }), svg("text", { x: 72, y: yg + 4 }, `${e.word} ${words(e.computed)}`));
  return { s, span };
}
/** What a pair is, drawn, with both distances. */
function explain(panel, title, lines, e) {
  panel.replaceChildren();
  const add = (tag, text) => { const e = document.createElement(tag); e.textContent = text; panel.append(e); return e; };
  add("h3", title);
  for (const l of lines) add("p", l);
  if (!e) return;
  const gap = drawGap(e), size = extent(e.points);
  panel.append(draw(e), gap.s);
  if (gap.span > 0 && size > 0) add("p", `Pair of size ${size.toPrecision(3)}; below, differences are enlarged ${((20 / gap.span) / (300 / size)).toPrecision(1)} times against it.`).className = "note";
}
const press = (all, chosen) => { for (const b of all) b.setAttribute("aria-pressed", String(b === chosen)); };
const marks = [...document.querySelectorAll(".families button")];
for (const b of marks) b.onclick = () => {
  const word = b.closest("tr").dataset.accuracy, kinds = data.families.filter((k) => k.group === b.dataset.group);
  const share = (k) => k.wrong[word] / k.pairs, kind = kinds.reduce((a, k) => share(k) > share(a) ? k : a);
  press(marks, b);
  explain(document.getElementById("example"), `${kind.name}, ${word}`, [kind.wrong[word] === 0 ? `All pairs of ${b.dataset.group} are decided rightly.` : `${kind.wrong[word]} of ${kind.pairs} pairs are decided wrongly. The worst one:`], kind.worst.find((w) => w.word === word));
};
marks.reduce((a, b) => b.closest("tr").dataset.accuracy === "fast" && parseFloat(b.style.getPropertyValue("--share")) > parseFloat(a?.style.getPropertyValue("--share") ?? 0) ? b : a, null)?.click();
// The lever: the pairs of the deck that any word decides wrongly, those of the chosen word filled.
const key = (e) => [e.interface, ...e.secondary, "-", ...e.main].join(" "), all = new Map(data.wrong_pairs.map((e) => [key(e), e]));
const near = all.size === 0 ? data.nearest : null, picture = document.getElementById("picture");
if (near) all.set(key(near), near);
const name = (e) => `${e.secondary.join("-")} on ${e.main.join("-")}`;
function showPair(e, button) {
  for (const c of picture.querySelectorAll("circle")) c.classList.toggle("chosen", c.dataset.key === key(e));
  press(document.querySelectorAll("#pairs button"), button ?? [...document.querySelectorAll("#pairs button")].find((b) => b.dataset.key === key(e)));
  const said = e.in_contact ? "in contact" : "not in contact";
  explain(document.getElementById("pair"), name(e), [`Interface ${e.interface}, gap ${shortest(e.gap)}.`, near ? `The pair nearest to a doubt: every word says ${said}.` : `Exactly ${said}; ${e.word} says the opposite.`], e.exact === null ? null : e);
}
function lever(word) {
  const wrong = new Map(data.wrong_pairs.filter((e) => e.word === word).map((e) => [key(e), e])), list = document.getElementById("pairs");
  const flat = (x) => [0.87 * (x[0] - x[1]), -0.5 * (x[0] + x[1]) * 0.6 - x[2]], surface = deckSurface.map((q) => [0, 3, 6, 9].map((k) => flat(q.slice(k, k + 3))));
  const middle = (e) => flat([0, 1, 2].map((k) => e.points.reduce((s, p) => s + p[k], 0) / e.points.length));
  const every = [...surface.flat(), ...[...all.values()].map(middle)], low = [0, 1].map((k) => every.reduce((m, p) => Math.min(m, p[k]), Infinity)), high = [0, 1].map((k) => every.reduce((m, p) => Math.max(m, p[k]), -Infinity));
  const size = Math.max((high[0] - low[0]) / 460, (high[1] - low[1]) / 300) || 1, put = (p) => p.map((v, k) => ((v - low[k]) / size + 15).toFixed(1));
  const s = svg("svg", { viewBox: `0 0 ${((high[0] - low[0]) / size + 30).toFixed(0)} ${((high[1] - low[1]) / size + 30).toFixed(0)}`, role: "img", "aria-label": `Pairs that ${word} decides wrongly: ${wrong.size}` });
  s.append(svg("path", { d: surface.map((q) => "M" + q.map((p) => put(p).join(" ")).join("L") + "Z").join(""), class: "surface" }));
  const order = [...all.entries()].sort((a, b) => wrong.has(a[0]) - wrong.has(b[0]));
  for (const [k, e] of order) {
    const [cx, cy] = put(middle(e)), dot = svg("circle", { cx, cy, r: 5, class: wrong.has(k) ? "wrong" : "right", "data-key": k });
    dot.append(svg("title", {}, name(e)));
    dot.onclick = () => showPair(wrong.get(k) ?? e);
    s.append(dot);
  }
  picture.replaceChildren(s);
  const shown = wrong.size ? [...wrong.values()] : near ? [near] : [];
  list.replaceChildren(...shown.map((e) => {
    const item = document.createElement("li"), b = document.createElement("button");
    b.type = "button"; b.textContent = name(e); b.dataset.key = key(e); b.onclick = () => showPair(e, b);
    item.append(b);
    return item;
  }));
  if (shown.length === 0) list.textContent = all.size ? `${word} decides all of these ${all.size} pairs rightly.` : "No pair of this deck is in contact.";
  const first = shown[0] ?? all.values().next().value;
  if (first) showPair(first);
}
const words = [...document.querySelectorAll("[name=word]")];
for (const r of words) r.onchange = () => picture && lever(r.value);
if (picture) { const start = near ? "robust" : "reference"; words.find((r) => r.value === start).checked = true; lever(start); }
const colours = "<style>text{fill:#5c6979} .title{fill:#17202b;font-weight:bold} .grid{stroke:#dde2e8} .ring{fill:none;stroke:#9a5b00;stroke-width:2} .line{fill:none;stroke-width:2} .wide{stroke-width:6;stroke-opacity:.4} .reference{stroke:#b3261e} .fast{stroke:#1f5fd0} .robust{stroke:#17202b;stroke-dasharray:6 4} .exact{stroke:#0b6b3a} .dot{stroke-width:12;stroke-linecap:round;stroke-dasharray:none} .now{stroke:#1f5fd0}</style>";
function chart(width, height, label) {
  const s = svg("svg", { xmlns: "http://www.w3.org/2000/svg", class: "chart", viewBox: `0 0 ${width} ${height}`, width, height, "font-family": "system-ui, sans-serif", "font-size": 13, role: "img", "aria-label": label });
  s.innerHTML = colours;
  s.append(svg("rect", { width, height, fill: "#fff" }));
  return s;
}
// Wrong decisions over time, one point a word; the axis of time is logarithmic.
{
  const s = chart(420, 168, "Wrong decisions against time"), points = data.choices.map((c) => ({ word: c.word, wrong: (c.deck ?? c.hard).wrong, time: c.deck ? c.deck.seconds : 1e-9 * c.hard.ns_per_pair }));
  const low = Math.min(...points.map((p) => p.time)), decades = Math.log10(Math.max(...points.map((p) => p.time)) / low) || 1, most = Math.max(1, ...points.map((p) => p.wrong)), taken = [];
  s.append(svg("line", { x1: 36, x2: 412, y1: 138, y2: 138, class: "grid" }), svg("line", { x1: 36, x2: 36, y1: 20, y2: 138, class: "grid" }), svg("text", { x: 4, y: 14 }, "wrong"), svg("text", { x: 412, y: 160, "text-anchor": "end" }, "time, logarithmic"), svg("text", { x: 28, y: 142, "text-anchor": "end" }, "0"));
  const places = points.map((p) => [50 + 230 * Math.log10(p.time / low) / decades, 138 - 104 * p.wrong / most]);
  for (const [i, p] of points.entries()) {
    const [x, y] = places[i];
    const base = y + (p.wrong ? 4 : -8), free = (k) => !taken.some(([ox, oy]) => Math.abs(ox - x) < 130 && Math.abs(oy - base - k) < 15) && !places.some(([ox, oy]) => ox > x + 4 && ox < x + 150 && Math.abs(oy + 4 - base - k) < 10);
    const at = base + ([0, 8, -8, 16, -16, 24, -24, 32, -32].find((k) => base + k > 10 && free(k)) ?? 0);
    taken.push([x, at]);
    s.append(svg("line", { x1: x, x2: x + 9, y1: y, y2: at - 4, class: "grid" }), svg("line", { x1: x, x2: x, y1: y, y2: y, class: `dot ${p.word}` }), svg("text", { x: x + 11, y: at }, `${p.word}: ${p.wrong} wrong`));
  }
  document.getElementById("chart").append(s);
}
// The hard case in motion: two bands over the steps, and where the slider stands.
{
  const m = data.motion, s = chart(400, 320, "A node over a sliver: in contact, and the figure printed, by step"), last = m.lines[0].force.length - 1, x = (k) => 30 + k / last * 350;
  const most = Math.max(1, ...m.lines.map((l) => Math.ceil(Math.max(...l.force)))), y = (f) => 290 - f / most * 160;
  s.append(svg("text", { x: 4, y: 18, class: "title" }, "In contact?"), svg("text", { x: 4, y: 112, class: "title" }, "Figure printed: force of a stiffness of 1"));
  for (let f = 0; f <= most; ++f) s.append(svg("line", { x1: 30, x2: 380, y1: y(f), y2: y(f), class: "grid" }), svg("text", { x: 22, y: y(f) + 4, "text-anchor": "end" }, f));
  for (let k = 0; k <= last; k += 25) s.append(svg("text", { x: x(k), y: 308, "text-anchor": "middle" }, k));
  ["exact", "reference", "fast", "robust"].forEach((word, i) => { // wide lines below narrow ones: those that coincide are both seen
    const l = m.lines.find((o) => o.word === word), kind = `line ${word}${i < 2 ? " wide" : ""}`, band = 54 + 11 * i;
    s.append(svg("line", { x1: 30 + 88 * i, x2: 48 + 88 * i, y1: 36, y2: 36, class: kind }), svg("text", { x: 52 + 88 * i, y: 40 }, word));
    s.append(svg("path", { d: l.depth.map((d, k) => k < last && d > 0 && l.depth[k + 1] > 0 ? `M${x(k)} ${band}H${x(k + 1)}` : "").join(""), class: `${kind} band`, "data-accuracy": word }));
    s.append(svg("polyline", { points: l.force.map((f, k) => `${x(k).toFixed(1)},${y(f).toFixed(1)}`).join(" "), class: kind }));
    for (const k of l.jumps) s.append(svg("circle", { cx: x(k), cy: y(l.force[k]), r: 7, class: "ring", "data-accuracy": word, "data-step": k }));
  });
  const step = document.getElementById("step"), now = svg("line", { y1: 46, y2: 290, class: "now" }), said = (f) => m.lines.map((l) => `${l.word} ${f(l)}`).join(", ");
  s.append(now);
  document.getElementById("lines").append(s);
  step.oninput = () => {
    const k = Number(step.value);
    for (const end of ["x1", "x2"]) now.setAttribute(end, x(k));
    document.getElementById("at").textContent = `Step ${k}. In contact? ${said((l) => l.depth[k] > 0 ? "yes" : "no")}. Force: ${said((l) => l.force[k].toFixed(2))}.`;
  };
  step.oninput();
}
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
         detail::script_safe(accuracy_json(choices, context)) +
         "</script>\n<script>\nconst deckSurface = [" + surface_text(context.picture) + "];";
  out += page_script;
  return out + "</script>\n</body>\n</html>\n";
}

}  // namespace deck
