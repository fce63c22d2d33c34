// The page of `deck accuracy`: one sentence, one chart, the families as a heat map with an example
// drawn on click, where the time goes, then the tables. All figures stand in the page without
// scripts; the JSON document stands in it, too.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/base/escape.hpp"
#include "report/accuracy_chart.hpp"
#include "report/html/parts.hpp"

namespace deck {
namespace {

constexpr std::string_view kPageStyle = R"~(
:root { --ground:#f5f6f8; --panel:#fff; --ink:#17202b; --muted:#5c6979; --line:#e2e6ec; --accent:#1f5fd0; --soft:#e8f0fe; color-scheme: light; }
[data-theme=dark] { --ground:#10151b; --panel:#171e27; --ink:#e7edf4; --muted:#93a2b4; --line:#303c4c; --accent:#7fb2ff; --soft:#1b2c47; color-scheme: dark; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 14px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif; font-variant-numeric: tabular-nums; }
header { display: flex; flex-wrap: wrap; gap: 6px 16px; align-items: center; padding: 10px 20px; background: var(--panel); border-bottom: 1px solid var(--line); }
header h1 { font-size: 16px; margin: 0; flex: 1; overflow-wrap: anywhere; } main { max-width: 1100px; margin: 0 auto; padding: 0 20px 40px; }
.said { font-size: 18px; padding: 14px 18px; margin: 18px 0; border-radius: 10px; border-left: 5px solid var(--accent); background: var(--soft); }
h2 { font-size: 17px; margin: 28px 0 8px; } .note { color: var(--muted); font-size: 13px; margin: 6px 0; overflow-wrap: anywhere; }
button { font: inherit; font-size: 13px; color: inherit; background: var(--panel); border: 1px solid var(--line); border-radius: 7px; padding: 4px 11px; cursor: pointer; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px; }
figure { margin: 0 0 14px; background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: 8px; } figure svg { width: 100%; height: auto; display: block; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: 13px; background: var(--panel); }
th, td { padding: 4px 10px; border: 1px solid var(--line); text-align: right; white-space: nowrap; } th { color: var(--muted); font-weight: 600; } .l { text-align: left; }
.heat td { padding: 0; } .heat button { width: 100%; min-width: 48px; border: 0; border-radius: 0; padding: 4px 8px; background: none; text-align: right; }
.heat td.plain { padding: 4px 8px; }
.h1 button { background: #fee19d; color: #222; } .h2 button { background: #fa8f48; color: #222; } .h3 button { background: #bd0026; color: #fff; }
.share { display: flex; height: 26px; border-radius: 6px; overflow: hidden; margin: 3px 0 8px; } .share span { min-width: 2px; }
.s0 { background: #7fa8d8; } .s1 { background: #f0a860; } .s2 { background: #bd0026; } .key { display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 6px; }
[data-theme=dark] .dk-ground, [data-theme=dark] .dk-mark.dk-hollow { fill: #171e27; } [data-theme=dark] .dk-grid { stroke: #303c4c; }
[data-theme=dark] .dk-svg text { fill: #93a2b4; } [data-theme=dark] .dk-svg .dk-label, [data-theme=dark] .dk-svg .dk-title { fill: #e7edf4; }
[data-theme=dark] .dk-svg .dk-label { stroke: #171e27; } [data-theme=dark] .dk-mark { fill: #7fb2ff; stroke: #7fb2ff; } [data-theme=dark] .dk-frontier { stroke: #7fb2ff; } [data-theme=dark] .dk-default { stroke: #ffc069; }
#example svg { max-width: 520px; } #example .seg { fill: var(--soft); stroke: var(--accent); stroke-width: 2; } #example .other { stroke: #bd0026; stroke-width: 3; fill: #bd0026; }
@media print { header button, .save { display: none; } }
)~";

constexpr std::string_view kPageScript = R"~(
const root = document.documentElement, data = JSON.parse(document.getElementById("accuracy-json").textContent);
root.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
document.getElementById("theme").onclick = () => root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
for (const b of document.querySelectorAll(".save")) b.onclick = () => {
  const a = document.createElement("a");
  a.download = b.dataset.name;
  a.setAttribute("hr" + "ef", URL.createObjectURL(new Blob([b.closest("figure").querySelector("svg").outerHTML], { type: "image/svg+xml" })));
  a.click();
};
const svg = (tag, attributes, text) => {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  if (text) e.textContent = text;
  return e;
};
/** The pair as seen obliquely, all of it in the frame whatever its size. */
function draw(p, example) {
  const low = [0, 1, 2].map((k) => Math.min(...p.map((x) => x[k]))), size = Math.max(...[0, 1, 2].map((k) => Math.max(...p.map((x) => x[k])) - low[k])) || 1;
  const flat = p.map((x) => { const [a, b, c] = x.map((v, k) => (v - low[k]) / size); return [0.87 * (a - b), 0.5 * (a + b) - c]; });
  const box = [0, 1].map((k) => [Math.min(...flat.map((f) => f[k])), Math.max(...flat.map((f) => f[k]))]);
  const span = Math.max(box[0][1] - box[0][0], box[1][1] - box[1][0]) || 1;
  const at = flat.map((f) => [40 + 420 * (f[0] - box[0][0]) / span, 30 + 240 * (f[1] - box[1][0]) / span]);
  const s = svg("svg", { viewBox: "0 0 520 300", role: "img", "aria-label": "The pair" });
  const path = (i) => i.map((k) => at[k].join(",")).join(" ");
  if (example.kind === "edge_edge") s.append(svg("polyline", { points: path([0, 1]), class: "other" }), svg("polyline", { points: path([2, 3]), class: "seg" }));
  else s.append(svg("polygon", { points: path(example.triangle ? [0, 1, 2] : [0, 1, 2, 3]), class: "seg" }), svg("circle", { cx: at[4][0], cy: at[4][1], r: 5, class: "other" }));
  return s;
}
const panel = document.getElementById("example");
for (const b of document.querySelectorAll(".heat button")) b.onclick = () => {
  const f = data.families.find((x) => x.id === Number(b.dataset.family) && x.tier === b.dataset.tier);
  panel.hidden = false;
  panel.replaceChildren();
  const add = (tag, text) => { const e = document.createElement(tag); e.textContent = text; panel.append(e); return e; };
  add("h3", `${f.id} ${f.name}, ${f.tier}`);
  add("p", `Expected: ${f.expected}.`).className = "note";
  const e = f.example;
  if (!e) { add("p", "This tier has no error here, so there is no example."); return; }
  const decided = (d) => d === null ? "not finite" : `${d} (${d < e.gap ? "in contact" : "not in contact"})`;
  add("p", `Gap ${e.gap}. ${f.tier}: distance ${decided(e.distance)}. Exactly: ${decided(e.exact_distance)}.`);
  panel.append(draw(e.points, e));
  const names = e.kind === "edge_edge" ? ["edge", "edge", "main edge", "main edge"] : ["corner", "corner", "corner", "corner", "node"];
  const table = document.createElement("table");
  e.points.forEach((p, i) => { const r = table.insertRow(); for (const t of [names[i], ...p]) r.insertCell().textContent = String(t); });
  panel.append(table);
  panel.scrollIntoView({ block: "nearest" });
};
)~";

const TierResult* tier(const AccuracyReport& r, std::string_view name, std::string_view what) {
  const auto found = std::find_if(r.tiers.begin(), r.tiers.end(), [&](const TierResult& t) {
    return t.name == name && t.what == what;
  });
  return found == r.tiers.end() ? nullptr : &*found;
}

std::string figure(double v) {
  if (!std::isfinite(v)) return "unbounded";
  if (v == 0.0) return "0";
  return v >= 0.01 && v < 1e6 ? fmt::format("{:.4g}", v) : fmt::format("{:.1e}", v);
}

std::string percent(double part, double all) {
  return all > 0 ? fmt::format("{:.3g} %", 100.0 * part / all) : "0 %";
}

std::string times(std::uint64_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// What the measurement says, in one sentence.
std::string sentence(const AccuracyReport& r) {
  const TierResult* robust = tier(r, "robust", "gaps");
  const TierResult* plain = tier(r, "fast", "gaps");
  const TierResult* solver = tier(r, "reference", "gaps");
  if (robust == nullptr || plain == nullptr || solver == nullptr)
    return "There are no pairs to decide, so there is nothing to compare.";
  return fmt::format(
      "On {} <b>robust</b> costs <b>{:.2f} &times; plain double</b> and makes <b>{}</b> of {}; "
      "plain "
      "double makes {}, the solver's arithmetic {}.",
      r.scene == "deck" ? "this deck" : "the built-in hard cases",
      robust->ns_per_pair / plain->ns_per_pair, times(robust->decision_errors, "wrong decision"),
      robust->samples, plain->decision_errors, solver->decision_errors);
}

std::string chart(const AccuracyReport& r, const std::string& what) {
  const std::string panel = accuracy_panel(r, what);
  if (panel.empty()) return {};
  return "<figure>" + panel + "<button type=\"button\" class=\"save\" data-name=\"accuracy_" +
         what + ".svg\">Save as SVG</button></figure>\n";
}

std::string heat_map(const AccuracyReport& r) {
  if (r.scene != "hard-cases")
    return "<p class=\"note\">The families belong to the built-in hard cases: run deck accuracy "
           "without a deck.</p>\n";
  std::vector<std::string> tiers;
  for (const FamilyResult& f : r.families)
    if (std::find(tiers.begin(), tiers.end(), f.tier) == tiers.end()) tiers.push_back(f.tier);
  std::string out =
      "<p class=\"note\">Wrong decisions and results that are not finite, of the pairs of a "
      "family. Choose a cell to see its "
      "worst pair.</p>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Families\"><table class=\"heat\"><thead><tr><th class=\"l\" "
      "colspan=\"2\">Family</th>";
  for (const std::string& t : tiers) out += "<th>" + html_text(t) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const HardFamily& family : hard_families()) {
    out += fmt::format("<tr><td>{}</td><th class=\"l\" scope=\"row\">{}</th>", family.id,
                       html_text(family.name));
    for (const std::string& t : tiers) {
      const auto f = std::find_if(
          r.families.begin(), r.families.end(),
          [&](const FamilyResult& row) { return row.id == family.id && row.tier == t; });
      if (f == r.families.end()) {
        out +=
            "<td class=\"plain\" title=\"a property of the search or of builds, held by their own "
            "tests\">&ndash;</td>";
        continue;
      }
      const std::uint64_t wrong = f->decision_errors + f->non_finite;
      const double share = static_cast<double>(wrong) / static_cast<double>(f->samples);
      const int heat = wrong == 0 ? 0 : share < 0.05 ? 1 : share < 0.25 ? 2 : 3;
      out += fmt::format(
          "<td class=\"h{}\"><button type=\"button\" data-family=\"{}\" data-tier=\"{}\" "
          "aria-label=\"{}, {}: {} wrong of {}\">{}</button></td>",
          heat, family.id, html_text(t), html_text(family.name), html_text(t), wrong, f->samples,
          wrong);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n<div id=\"example\" aria-live=\"polite\" hidden></div>\n";
}

std::string time_shares(const AccuracyReport& r) {
  double pairs = 0, time = 0;
  for (const StageResult& s : r.stages) {
    pairs += static_cast<double>(s.pairs);
    time += static_cast<double>(s.pairs) * s.ns_per_pair;
  }
  static constexpr const char* words[] = {"the filter in double is sure", "double-double is sure",
                                          "integers or rationals decide"};
  std::string bars[2], rows;
  for (std::size_t k = 0; k < r.stages.size(); ++k) {
    const StageResult& s = r.stages[k];
    const double spent = static_cast<double>(s.pairs) * s.ns_per_pair;
    const double shares[] = {static_cast<double>(s.pairs) / std::max(pairs, 1.0),
                             spent / std::max(time, 1e-300)};
    for (int b = 0; b < 2; ++b)
      if (s.pairs > 0)
        bars[b] += fmt::format("<span class=\"s{}\" style=\"flex:{:.6f}\"></span>", k, shares[b]);
    rows += fmt::format(
        "<tr><td class=\"l\"><span class=\"key s{}\"></span>{}</td><td "
        "class=\"l\">{}</td><td>{}</td><td>{}</td><td>{:.0f}</td><td>{}</td></tr>\n",
        k, html_text(s.name), words[std::min<std::size_t>(k, 2)], s.pairs,
        percent(static_cast<double>(s.pairs), pairs), s.ns_per_pair, percent(spent, time));
  }
  return "<p class=\"note\">Of the robust decision. Each pair is counted in the stage that decides "
         "it, with its whole time.</p>\n"
         "Share of the pairs<div class=\"share\">" +
         bars[0] + "</div>Share of the time<div class=\"share\">" + bars[1] +
         "</div>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
         "aria-label=\"Figures\"><table><thead><tr><th class=\"l\">Ends in</th><th "
         "class=\"l\">because</th><th>pairs</th>"
         "<th>of the pairs</th><th>ns per pair</th><th>of the time</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string tier_table(const AccuracyReport& r) {
  std::string out;
  for (const auto& [what, title] :
       {std::pair("gaps", "Decision"), std::pair("distance", "Distance"),
        std::pair("force", "Elastic force")}) {
    std::string rows;
    for (const TierResult& t : r.tiers)
      if (t.what == what)
        rows += fmt::format(
            "<tr><th class=\"l\" "
            "scope=\"row\">{}</th><td>{}</td><td>{:.1f}</td><td>{}</td><td>{}</td><td>{}</"
            "td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            html_text(t.name), t.samples, t.ns_per_pair, t.decision_errors, t.non_finite,
            t.what == "gaps" ? "does not compute one" : figure(t.max_relative_error),
            t.rewritten > 0
                ? std::to_string(t.invariance_violations) + " of " + std::to_string(t.rewritten)
                : "not asked",
            percent(t.fallback_share, 1.0), percent(t.exact_share, 1.0));
    if (rows.empty()) continue;
    out += std::string("<h3>") + title +
           "</h3>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
           "aria-label=\"Figures\"><table><thead><tr><th "
           "class=\"l\">tier</th><th>pairs</th><th>ns per pair</th><th>wrong decisions</th>"
           "<th>not finite</th><th>worst relative error</th><th>answer depends on how the pair is "
           "written</th><th>needed more than double</th>"
           "<th>needed exact arithmetic</th></tr></thead><tbody>\n" +
           rows + "</tbody></table></div>\n";
  }
  return out;
}

}  // namespace

std::string accuracy_html(const AccuracyReport& report, const AccuracyContext& context) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
      "'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      html_text(accuracy_title(report, context)) + "</title>\n<style>";
  out += kPageStyle;
  out += "</style>\n</head>\n<body>\n<header><h1>" + html_text(accuracy_title(report, context)) +
         "</h1><button type=\"button\" id=\"theme\">Dark or light</button></header>\n<main>\n";
  out += "<p class=\"said\">" + sentence(report) + "</p>\n" + chart(report, "gaps");
  out += "<h2>Hard cases by family</h2>\n" + heat_map(report);
  out += "<h2>Where the time goes</h2>\n" + time_shares(report);
  out += "<h2>Distances and forces</h2>\n" + chart(report, "distance") + chart(report, "force");
  out += "<h2>All figures</h2>\n" + tier_table(report);
  for (const std::string& line : {context.processor, accuracy_compiler(), context.command})
    out += "<p class=\"note\">" + html_text(terminal_text(line)) + "</p>\n";
  out += "</main>\n<script type=\"application/json\" id=\"accuracy-json\">" +
         detail::script_safe(accuracy_json(report, context)) + "</script>\n<script>";
  out += kPageScript;
  return out + "</script>\n</body>\n</html>\n";
}

}  // namespace deck
