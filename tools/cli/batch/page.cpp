// The overview of a batch as one HTML page, worst deck first. All is there without a script; with
// one the columns sort and levels are chosen.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>

#include "base/shared/escape.hpp"
#include "batch/reading.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace {

constexpr std::string_view style = R"(
:root{color-scheme:light dark;--ground:#f5f6f8;--panel:#fff;--ink:#17202b;--muted:#5c6979;--line:#e2e6ec;
--accent:#1f5fd0;--bad:#b3261e;--warn:#8a5000;--good:#1d7044;--bar:#d9822b}
@media(prefers-color-scheme:dark){:root{--ground:#10151b;--panel:#171e27;--ink:#e7edf4;--muted:#93a2b4;
--line:#263140;--accent:#7fb2ff;--bad:#ff8a80;--warn:#ffc069;--good:#7bd3a0}}
*{box-sizing:border-box}body{margin:0 auto;padding:20px;max-width:1500px;background:var(--ground);color:var(--ink);font:14px/1.5 system-ui,sans-serif}
h1{font-size:20px;margin:0;overflow-wrap:anywhere}h2{font-size:16px}p{color:var(--muted)}a{color:var(--accent)}
table{border-collapse:collapse;background:var(--panel);font-variant-numeric:tabular-nums;width:100%}
th,td{border-bottom:1px solid var(--line);padding:.35em .8em;text-align:left;vertical-align:top}
th{position:sticky;top:0;background:var(--panel);white-space:nowrap;z-index:1}
th button{font:inherit;color:inherit;background:none;border:0;padding:0;cursor:pointer}th button:hover{text-decoration:underline}
th[aria-sort=ascending] button::after{content:" \2191"}th[aria-sort=descending] button::after{content:" \2193"}
.n{text-align:right;white-space:nowrap}td:first-child{overflow-wrap:anywhere;min-width:20em}
.clean,.passed,.better{color:var(--good)}.findings,.not-examined,.changed{color:var(--warn)}
.failed,.unreadable,.skipped,.worse{color:var(--bad);font-weight:600}.same,.first{color:var(--muted)}
.level{white-space:nowrap;font-weight:600}.level::before{content:"";display:inline-block;width:10px;height:10px;border-radius:50%;margin-right:7px;background:currentColor}
.level.bad{color:var(--bad)}.level.warn{color:var(--warn)}.level.good{color:var(--good)}tr:has(.level.bad) td:first-child{box-shadow:inset 4px 0 var(--bad)}
.bar{display:block;height:5px;border-radius:3px;background:var(--line);min-width:70px;overflow:hidden}.bar i{display:block;height:100%;background:var(--bar)}.bar .full{background:var(--bad)}
.filters{display:flex;flex-wrap:wrap;gap:8px;margin:10px 0}.filters button{font:inherit;color:inherit;background:var(--panel);border:1px solid var(--line);border-radius:14px;padding:3px 12px;cursor:pointer}
.filters [aria-pressed=true]{background:var(--accent);border-color:var(--accent);color:var(--panel)}[hidden]{display:none}
@media(max-width:900px){body{padding:12px}.sorts,.sorts tbody,.sorts tr,.sorts td{display:block}.sorts thead{display:block}
.sorts thead tr{display:flex;flex-wrap:wrap;gap:2px 12px}.sorts th{border:0;padding:2px 0;position:static;background:none;color:var(--accent)}
.sorts tbody tr{display:flex;flex-wrap:wrap;border-bottom:1px solid var(--line);padding:8px 10px}.sorts tbody tr[hidden]{display:none}
.sorts td{border:0;padding:1px 14px 1px 0;text-align:left;white-space:normal;min-width:0}.sorts td:first-child{flex:1 0 100%;min-width:0;box-shadow:none!important}.sorts td:last-child{flex:1 0 100%}
.sorts td.n::before,.sorts td[data-label]::before{content:attr(data-label) " ";color:var(--muted)}.bar{display:inline-block;width:70px;vertical-align:middle;margin:0 6px}.sorts td.level::before{content:"";color:inherit}}
)";

/// Titles become buttons; a click sorts by what the cells say they are worth, else by their text.
/// A button for each level leaves only its decks.
constexpr std::string_view script = R"(
for(const table of document.querySelectorAll("table.sorts")){
 const body=table.tBodies[0];
 [...table.tHead.rows[0].cells].forEach((title,column)=>{
  const button=document.createElement("button");
  button.type="button";button.textContent=title.textContent;title.replaceChildren(button);
  const worth=row=>{const c=row.cells[column],v=c.dataset.v;return v===undefined?c.textContent:Number(v)};
  button.onclick=()=>{
   const down=title.getAttribute("aria-sort")==="ascending";
   for(const t of table.tHead.rows[0].cells)t.removeAttribute("aria-sort");
   title.setAttribute("aria-sort",down?"descending":"ascending");
   body.append(...[...body.rows].sort((a,b)=>{
    const x=worth(a),y=worth(b),order=typeof x==="number"?x-y:x.localeCompare(y,undefined,{numeric:true});
    return down?-order:order}))}});
 const filters=document.querySelector(".filters");
 filters.hidden=false;
 filters.onclick=e=>{
  const button=e.target.closest("button");if(!button)return;
  const on=button.getAttribute("aria-pressed")!=="true";
  for(const b of filters.children)b.setAttribute("aria-pressed",String(on&&b===button));
  for(const r of body.rows)r.hidden=on&&r.dataset.level!==button.dataset.level}}
)";

/// A path as the address of a file beside the page.
std::string address_of(std::string_view path) {
  constexpr std::string_view hex = "0123456789ABCDEF";
  std::string out = "./";
  for (const char c : path) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0 || std::string_view("/._-~").find(c) != std::string_view::npos) {
      out += c;
    } else {
      out += '%';
      out += hex[u >> 4];
      out += hex[u & 15];
    }
  }
  return out;
}

/// A cell of a column that sorts by number. `kind` is its class, `label` what a narrow page calls
/// it.
std::string number_cell(double worth, const std::string& text, std::string_view kind = "n",
                        std::string_view label = "") {
  return fmt::format("<td class=\"{}\" data-label=\"{}\" data-v=\"{}\">{}</td>", kind, label,
                     shortest(worth), text);
}

/// How bad a deck is: by its verdict, or because it did not get through.
struct Level {
  int worth = 0;            ///< the larger, the worse
  std::string name, words;  ///< "stops", "solver stops"
  std::string_view colour;  ///< class of its cell
};

Level level_of_entry(const EntryReading& e) {
  struct Known {
    const char* name;
    const char* words;
    std::string_view colour;
  };
  // Worst last.
  static constexpr Known known[] = {
      {"clean", "clean", "good"},           {"remarks", "remarks", "good"},
      {"warnings", "warnings", "warn"},     {"not-examined", "not examined", "warn"},
      {"untied", "untied", "warn"},         {"crossed", "crossed", "warn"},
      {"penetrates", "penetrates", "warn"}, {"findings", "findings", "warn"},
      {"stops", "solver stops", "bad"},     {"skipped", "skipped", "bad"},
      {"unreadable", "unreadable", "bad"},  {"failed", "failed", "bad"}};
  const bool through = e.status == "clean" || e.status == "findings" || e.status == "not-examined";
  std::string name = through ? e.verdict("level") : e.status;
  if (name.empty()) name = e.status;
  for (std::size_t k = 0; k < std::size(known); ++k)
    if (name == known[k].name)
      return {static_cast<int>(k), std::move(name), known[k].words, known[k].colour};
  return {0, name, name, "warn"};
}

/// Positions of the entries, worst first.
std::vector<std::size_t> worst_first(const std::vector<EntryReading>& entries) {
  std::vector<std::size_t> order(entries.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](std::size_t i) {
    const EntryReading& e = entries[i];
    return std::tuple(-level_of_entry(e).worth, -e.count("max_ratio"), -e.found(), e.text("deck"));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

/// "41.0 %" with a bar as long as that part of the gap.
std::string ratio_text(double percent) {
  return fmt::format("{:.1f} %<span class=\"bar\"><i{} style=\"width:{:.0f}%\"></i></span>",
                     percent, percent >= 100.0 ? " class=\"full\"" : "",
                     std::clamp(percent, 0.0, 100.0));
}

/// A button for every level that occurs, worst first.
std::string filters(const std::vector<EntryReading>& entries,
                    const std::vector<std::size_t>& order) {
  std::string out =
      "<div class=\"filters\" role=\"group\" aria-label=\"Only decks of a level\" hidden>";
  for (std::size_t k = 0; k < order.size();) {
    const Level level = level_of_entry(entries[order[k]]);
    std::size_t n = 0;
    while (k < order.size() && level_of_entry(entries[order[k]]).name == level.name) ++k, ++n;
    out += fmt::format(
        "<button type=\"button\" aria-pressed=\"false\" data-level=\"{}\">{} {}</button>",
        html_text(level.name), n, html_text(level.words));
  }
  return out + "</div>\n";
}

struct Trend {
  const char* name;   ///< class of the cell
  int worth;          ///< to sort by
  std::string words;  ///< what it was
};

/// How a deck does against its previous results.
Trend trend_of(const EntryReading& now, const EntryReading* before) {
  if (before == nullptr) return {"first", 1, "new"};
  std::string words;
  bool up = false, down = false;
  const auto compare = [&](double was, double is, const std::string& text) {
    if (was == is) return;
    (is > was ? up : down) = true;
    words += (words.empty() ? "" : "; ") + text;
  };
  compare(before->rank(), now.rank(), before->status + " before");
  compare(before->found(), now.found(), fmt::format("{:.0f} found before", before->found()));
  compare(before->count("max_depth"), now.count("max_depth"),
          fmt::format("deepest {:.6g} before", before->count("max_depth")));
  if (up && down) return {"changed", 2, "better and worse: " + words};
  if (up) return {"worse", 3, "worse: " + words};
  if (down) return {"better", 0, "better: " + words};
  return {"same", 1, "same"};
}

/// Which columns the table has beside deck, level, status, seconds and what was said.
struct Columns {
  bool geometry = false, lint = false, gate = false, trend = false;
};

/// The row of a deck. `took`: seconds; nullptr: it was not run now. `before`: its earlier result.
std::string entry_row(const EntryReading& e, const Columns& columns, const double* took,
                      const EntryReading* before) {
  const std::string deck = html_text(e.text("deck")), result = e.text("result");
  const std::string status = html_text(e.status);
  const Level level = level_of_entry(e);
  std::string row = "<tr data-level=\"" + html_text(level.name) + "\"><td>";
  row += result.empty() ? deck : "<a href=\"" + address_of(result) + "\">" + deck + "</a>";
  row += "</td>" +
         number_cell(level.worth, html_text(level.words), "level " + std::string(level.colour));
  row += number_cell(e.rank(), status, status);
  const auto counted = [&](const char* name, double worth, const std::string& text,
                           std::string_view label) {
    row +=
        e.counted(name) ? number_cell(worth, text, "n", label) : number_cell(-1, "-", "n", label);
  };
  if (columns.geometry) {
    const double depth = e.count("max_depth"), ratio = 100 * e.count("max_ratio");
    counted("pairs", e.penetrations(), fmt::format("{:.0f}", e.penetrations()), "penetrating");
    counted("max_depth", depth, fmt::format("{:.6g}", depth), "deepest");
    counted("max_ratio", ratio, ratio_text(ratio), "of gap");
  }
  if (columns.lint)
    for (const char* name : {"errors", "warnings"})
      counted(name, e.count(name), fmt::format("{:.0f}", e.count(name)), name);
  if (columns.gate) {
    const std::string said = html_text(e.text("gate"));
    row +=
        "<td class=\"" + said + "\" data-label=\"gate\">" + (said.empty() ? "-" : said) + "</td>";
  }
  row += took == nullptr ? number_cell(-1, "-", "n seconds", "seconds")
                         : number_cell(*took, fmt::format("{:.2f}", *took), "n seconds", "seconds");
  if (columns.trend) {
    const Trend trend = trend_of(e, before);
    row += number_cell(trend.worth, html_text(trend.words), trend.name);
  }
  return row + "<td>" + html_text(e.what()) + "</td></tr>\n";
}

}  // namespace

std::string summary_page(const Summary& s, const Summary* previous,
                         const std::map<std::string, double>& seconds) {
  std::string what = s.verb;
  for (const std::string& a : s.arguments) what += " " + a;
  std::vector<EntryReading> entries;
  for (const SummaryEntry& e : s.entries) entries.emplace_back(e);
  std::map<std::string, EntryReading> earlier;
  if (previous != nullptr && previous->verb == s.verb)
    for (const SummaryEntry& e : previous->entries) {
      const EntryReading reading(e);
      earlier.emplace(reading.text("deck"), reading);
    }
  Columns columns;
  columns.geometry = any_counted(entries, "pairs");
  columns.lint = any_counted(entries, "errors");
  columns.gate = std::any_of(entries.begin(), entries.end(),
                             [](const EntryReading& e) { return !e.text("gate").empty(); });
  columns.trend = !earlier.empty();
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>deck batch: " +
      html_text(what) + "</title>\n<style>" + std::string(style) +
      "</style></head><body>\n<h1>deck " + html_text(what) + "</h1>\n<p>" +
      std::to_string(s.entries.size()) + " decks";
  for (const char* status :
       {"clean", "findings", "not-examined", "unreadable", "skipped", "failed"})
    if (const std::size_t n = s.count(status); n > 0)
      page += ", <span class=\"" + std::string(status) + "\">" + std::to_string(n) + " " + status +
              "</span>";
  page += "; <a href=\"./summary.json\">summary.json</a></p>\n";
  const std::vector<std::size_t> order = worst_first(entries);
  page += filters(entries, order) + "<table class=\"sorts\"><thead><tr>";
  const auto title = [&](const std::string& text, bool number) {
    page += number            ? "<th class=\"n\">"
            : text == "level" ? "<th aria-sort=\"descending\">"
                              : "<th>";
    page += text + "</th>";
  };
  title("deck", false);
  title("level", false);
  title("status", false);
  if (columns.geometry)
    for (const char* t : {"penetrating", "deepest", "of gap"}) title(t, true);
  if (columns.lint)
    for (const char* t : {"errors", "warnings"}) title(t, true);
  if (columns.gate) title("gate", false);
  title("seconds", true);
  if (columns.trend) title("trend", false);
  title("what", false);
  page += "</tr></thead><tbody>\n";
  for (const std::size_t i : order) {
    const auto took = seconds.find(s.entries[i].json);
    const auto before = earlier.find(entries[i].text("deck"));
    page += entry_row(entries[i], columns, took == seconds.end() ? nullptr : &took->second,
                      before == earlier.end() ? nullptr : &before->second);
  }
  page += "</tbody></table>\n";
  if (!s.includes.empty()) {
    page += "<h2>Includes, not run</h2>\n<table><tbody>\n";
    for (const IncludeFile& f : s.includes)
      page += "<tr><td>" + html_text(f.path) + "</td><td>" + html_text(f.why) + "</td></tr>\n";
    page += "</tbody></table>\n";
  }
  return page + "<script>" + std::string(script) + "</script>\n</body></html>\n";
}

}  // namespace deck::cli
