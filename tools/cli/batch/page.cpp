// The overview of a batch as one HTML page. All is there without a script; with one the columns
// sort.
#include <fmt/format.h>

#include <cctype>
#include <map>

#include "batch/reading.hpp"
#include "deck/base/escape.hpp"
#include "deck/report/json.hpp"

namespace deck::cli {
namespace {

constexpr std::string_view style = R"(
:root{color-scheme:light dark;--ground:#f5f6f8;--panel:#fff;--ink:#17202b;--muted:#5c6979;--line:#e2e6ec;
--accent:#1f5fd0;--bad:#b3261e;--warn:#9a5b00;--good:#1d7044}
@media(prefers-color-scheme:dark){:root{--ground:#10151b;--panel:#171e27;--ink:#e7edf4;--muted:#93a2b4;
--line:#263140;--accent:#7fb2ff;--bad:#ff8a80;--warn:#ffc069;--good:#7bd3a0}}
body{margin:2em;background:var(--ground);color:var(--ink);font:14px/1.5 system-ui,sans-serif}
h1{font-size:20px;margin:0}h2{font-size:16px}p{color:var(--muted)}a{color:var(--accent)}
table{border-collapse:collapse;background:var(--panel);font-variant-numeric:tabular-nums}
th,td{border-bottom:1px solid var(--line);padding:.3em .8em;text-align:left;vertical-align:top}
th{position:sticky;top:0;background:var(--panel);white-space:nowrap}
th button{font:inherit;color:inherit;background:none;border:0;padding:0;cursor:pointer}
th[aria-sort=ascending] button::after{content:" \2191"}th[aria-sort=descending] button::after{content:" \2193"}
.n{text-align:right;white-space:nowrap}td:first-child{overflow-wrap:anywhere;min-width:14em}
.clean,.passed,.better{color:var(--good)}.findings,.not-examined,.changed{color:var(--warn)}
.failed,.unreadable,.skipped,.worse{color:var(--bad);font-weight:600}.same,.first{color:var(--muted)}
)";

/// Titles become buttons; a click sorts by what the cells say they are worth, else by their text.
constexpr std::string_view script = R"(
for(const table of document.querySelectorAll("table.sorts")){
 const body=table.tBodies[0];
 [...table.tHead.rows[0].cells].forEach((title,column)=>{
  const button=document.createElement("button");
  button.textContent=title.textContent;title.replaceChildren(button);
  const worth=row=>{const c=row.cells[column],v=c.dataset.v;return v===undefined?c.textContent:Number(v)};
  button.onclick=()=>{
   const down=title.getAttribute("aria-sort")==="ascending";
   for(const t of table.tHead.rows[0].cells)t.removeAttribute("aria-sort");
   title.setAttribute("aria-sort",down?"descending":"ascending");
   body.append(...[...body.rows].sort((a,b)=>{
    const x=worth(a),y=worth(b),order=typeof x==="number"?x-y:x.localeCompare(y,undefined,{numeric:true});
    return down?-order:order}))}})}
)";

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

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

/// A cell of a column that sorts by number. `kind` is its class.
std::string number_cell(double worth, const std::string& text, std::string_view kind = "n") {
  return fmt::format("<td class=\"{}\" data-v=\"{}\">{}</td>", kind, shortest(worth), text);
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
  const bool geometry = any_counted(entries, "pairs"), lint = any_counted(entries, "errors");
  const bool gate = std::any_of(entries.begin(), entries.end(),
                                [](const EntryReading& e) { return !e.text("gate").empty(); });
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
  page += "; <a href=\"./summary.json\">summary.json</a></p>\n<table class=\"sorts\"><thead><tr>";
  const auto title = [&](const char* text, bool number) {
    page += std::string(number ? "<th class=\"n\">" : "<th>") + text + "</th>";
  };
  title("deck", false);
  title("status", false);
  if (geometry)
    for (const char* t : {"penetrating", "deepest", "of gap"}) title(t, true);
  if (lint)
    for (const char* t : {"errors", "warnings"}) title(t, true);
  if (gate) title("gate", false);
  title("seconds", true);
  if (!earlier.empty()) title("trend", false);
  title("what", false);
  page += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const EntryReading& e = entries[i];
    const std::string deck = html_text(e.text("deck")), result = e.text("result");
    const std::string status = html_text(e.status);
    page += "<tr><td>";
    page += result.empty() ? deck : "<a href=\"" + address_of(result) + "\">" + deck + "</a>";
    page += "</td>" + number_cell(e.rank(), status, status);
    const auto counted = [&](const char* name, double worth, const std::string& text) {
      page += e.counted(name) ? number_cell(worth, text) : number_cell(-1, "-");
    };
    if (geometry) {
      const double depth = e.count("max_depth"), ratio = 100 * e.count("max_ratio");
      counted("pairs", e.penetrations(), fmt::format("{:.0f}", e.penetrations()));
      counted("max_depth", depth, fmt::format("{:.6g}", depth));
      counted("max_ratio", ratio, fmt::format("{:.1f} %", ratio));
    }
    if (lint)
      for (const char* name : {"errors", "warnings"})
        counted(name, e.count(name), fmt::format("{:.0f}", e.count(name)));
    if (gate) {
      const std::string said = html_text(e.text("gate"));
      page += "<td class=\"" + said + "\">" + (said.empty() ? "-" : said) + "</td>";
    }
    const auto took = seconds.find(s.entries[i].json);
    page += took == seconds.end()
                ? number_cell(-1, "-", "n seconds")
                : number_cell(took->second, fmt::format("{:.2f}", took->second), "n seconds");
    if (!earlier.empty()) {
      const auto before = earlier.find(e.text("deck"));
      const Trend trend = trend_of(e, before == earlier.end() ? nullptr : &before->second);
      page += number_cell(trend.worth, html_text(trend.words), trend.name);
    }
    page += "<td>" + html_text(e.what()) + "</td></tr>\n";
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
