// Summary for people, worst deck first: DIR/index.html and a table in the terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>
#include <vector>

#include "base/shared/embedded.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "batch/record.hpp"
#include "report/shared/text_table.hpp"

namespace deck::cli {
namespace {

/// Relative URL of a file beside the page.
std::string address_of(std::string_view path) {
  std::string out = "./";
  for (const char c : path)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 ||
        std::string_view("/._-~").find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

/// Severity of a deck, from its verdict or its failure.
struct Level {
  std::string_view name, words, colour;
};
constexpr Level levels[] = {  // worst last
    {"clean", "clean", "good"},           {"remarks", "remarks", "good"},
    {"warnings", "warnings", "warn"},     {"not-examined", "not examined", "warn"},
    {"untied", "untied", "warn"},         {"crossed", "crossed", "warn"},
    {"penetrates", "penetrates", "warn"}, {"findings", "findings", "warn"},
    {"stops", "solver stops", "bad"},     {"skipped", "skipped", "bad"},
    {"unreadable", "unreadable", "bad"},  {"failed", "failed", "bad"}};

/// A line of the summary as shown.
struct OverviewRow {
  explicit OverviewRow(const Json& of)
      : line(&of), deck(text_in(of, "deck")), status(text_in(of, "status")) {
    const bool through = status == "clean" || status == "findings" || status == "not-examined";
    const Json verdict = of.value("verdict", Json());
    std::string name = through ? text_in(verdict, "level") : status;
    if (name.empty()) name = status;
    level = std::find_if(std::begin(levels), std::end(levels) - 1,
                         [&](const Level& l) { return l.name == name; });
    // Place in the deck: "178:81: /INTER/TYPE7/3 ...".
    what = text_in(of, "error");
    got_through = status == "clean" || status == "findings";
    if (what.starts_with(deck + ":")) what.erase(0, what.find_first_not_of(' ', deck.size() + 1));
    // Numbers of penetrations have columns of their own.
    if (what.empty() && verdict.is_object())
      for (const Json& said : verdict.value("sentences", Json::array()))
        if (text_in(said, "what") != "penetrations") what += text_in(said, "text") + " ";
    if (what.empty()) what = text_in(verdict, "text");
  }
  double number(const char* name) const { return counted(*line, name).value_or(0); }
  /// Distinct penetrating nodes and edges.
  double penetrations() const { return number("nodes") + number("edges"); }
  const Json* line;
  std::string deck, status, what;
  const Level* level;
  bool got_through = false;
};

/// Worst first.
std::vector<OverviewRow> rows_of(const Json& summary) {
  std::vector<OverviewRow> rows(summary.at("decks").begin(), summary.at("decks").end());
  const auto key = [](const OverviewRow& r) {
    return std::tuple(levels - r.level, -r.number("max_ratio"),
                      -r.penetrations() - r.number("errors") - r.number("warnings"), r.deck);
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const OverviewRow& a, const OverviewRow& b) { return key(a) < key(b); });
  return rows;
}

/// A column, shown if some deck has `of`.
struct Field {
  const char* of;
  const char* title;
  Align align;
  std::string (*text)(const OverviewRow&);
};
constexpr Field all_fields[] = {
    {"pairs", "penetrating", Align::right,
     [](const OverviewRow& r) { return fmt::format("{:.0f}", r.penetrations()); }},
    {"pairs", "deepest", Align::right,
     [](const OverviewRow& r) {
       if (!(r.number("pairs") > 0)) return std::string("-");
       const auto depth = counted(*r.line, "max_depth");
       return depth ? length_text(*depth) : std::string("unbounded");
     }},
    {"pairs", "of gap", Align::right,
     [](const OverviewRow& r) {
       return r.number("pairs") > 0 ? fmt::format("{:.0f} %", 100 * r.number("max_ratio")) : "-";
     }},
    {"gate", "gate", Align::left, [](const OverviewRow& r) { return text_in(*r.line, "gate"); }},
    {"errors", "errors", Align::right,
     [](const OverviewRow& r) { return fmt::format("{:.0f}", r.number("errors")); }},
    {"errors", "warnings", Align::right,
     [](const OverviewRow& r) { return fmt::format("{:.0f}", r.number("warnings")); }}};

bool has(const OverviewRow& row, const Field& field) {
  return counted(*row.line, field.of) || !text_in(*row.line, field.of).empty();
}
std::string text_of(const OverviewRow& row, const Field& field) {
  return has(row, field) ? field.text(row) : "-";
}

std::vector<Field> fields_of(const std::vector<OverviewRow>& rows) {
  std::vector<Field> fields;
  for (const Field& f : all_fields)
    if (std::any_of(rows.begin(), rows.end(), [&](const OverviewRow& r) { return has(r, f); }))
      fields.push_back(f);
  return fields;
}

/// Why a deck is listed, where no number says it.
std::string what_of(const OverviewRow& r, const std::vector<Field>& fields) {
  const bool told = r.level->name == "penetrates" ||
                    (r.level->name != "stops" && r.number("errors") + r.number("warnings") > 0);
  return !fields.empty() && r.got_through && (told || r.level->colour == "good") ? std::string()
                                                                                 : r.what;
}

/// The page of the deck, where the verb has written one.
std::string page_of(const Json& summary, const OverviewRow& r) {
  const std::string result = text_in(*r.line, "result");
  const Json& words = summary.at("arguments");
  return result.empty() || std::find(words.begin(), words.end(), "--html") == words.end()
             ? std::string()
             : page_name(result);
}

std::string page_row(const OverviewRow& r, const std::string& page,
                     const std::vector<Field>& fields, bool whats) {
  std::string deck = html_text(r.deck);
  for (std::size_t at = 0; (at = deck.find('/', at)) != std::string::npos; at += 6)
    deck.insert(at + 1, "<wbr>");  // a line ends behind a folder
  std::string row =
      fmt::format("<tr data-level=\"{}\" title=\"{}\"><td>{}</td><td class=\"level {}\">{}</td>",
                  r.level->name, html_text(r.what),
                  page.empty() ? deck : "<a href=\"" + address_of(page) + "\">" + deck + "</a>",
                  r.level->colour, r.level->words);
  for (const Field& f : fields) {
    const std::string text = html_text(text_of(r, f));
    row += fmt::format("<td class=\"{}\" data-title=\"{}\">{}",
                       f.align == Align::right ? "n" : text, f.title, text);
    if (f.title == std::string_view("of gap") && text != "-")
      row += fmt::format("<span class=\"bar\"><i{} style=\"width:{:.0f}%\"></i></span>",
                         r.number("max_ratio") >= 1 ? " class=\"full\"" : "",
                         std::clamp(100 * r.number("max_ratio"), 0.0, 100.0));
    row += "</td>";
  }
  return row + (whats ? "<td>" + html_text(what_of(r, fields)) + "</td>" : "") + "</tr>\n";
}

}  // namespace

std::string summary_page(const Json& s) {
  const std::vector<OverviewRow> rows = rows_of(s);
  std::vector<Field> fields = fields_of(rows);
  std::erase_if(fields, [&](const Field& f) {  // what all have is no difference
    return rows.size() > 1 && std::all_of(rows.begin(), rows.end(), [&](const OverviewRow& r) {
             return text_of(r, f) == text_of(rows.front(), f);
           });
  });
  const bool whats = std::any_of(rows.begin(), rows.end(),
                                 [&](const OverviewRow& r) { return !what_of(r, fields).empty(); });
  std::string what = text_in(s, "verb"), filters, titles, lines;
  for (const Json& word : s.at("arguments")) what += " " + word.get<std::string>();
  what = html_text(what);
  std::map<const Level*, int, std::greater<>> numbers;
  for (const OverviewRow& r : rows) ++numbers[r.level];
  for (const auto& [level, n] : numbers)
    filters += fmt::format(
        "<button type=\"button\" aria-pressed=\"false\" data-level=\"{}\">{} {}</button>",
        level->name, n, level->words);
  for (const char* title : {"deck", "level"}) titles += fmt::format("<th>{}</th>", title);
  for (const Field& f : fields)
    titles += fmt::format("<th{}>{}</th>", f.align == Align::right ? " class=\"n\"" : "", f.title);
  if (whats) titles += "<th>what</th>";
  for (const OverviewRow& r : rows) lines += page_row(r, page_of(s, r), fields, whats);
  const auto style = detail::embedded_pages()[0].text, script = detail::embedded_pages()[1].text;
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>deck batch: {0}</title>\n"
      "<style>\n{1}</style></head><body>\n<h1>deck {0}: {2}</h1>\n"
      "<div class=\"filters\" role=\"group\" aria-label=\"Only decks of a level\" "
      "hidden>{3}</div>\n"
      "<table><thead><tr>{4}</tr></thead><tbody>\n{5}</tbody></table>\n"
      "<script>\n{6}</script>\n</body></html>\n",
      what, style, count(rows.size(), "deck", "decks"), filters, titles, lines, script);
}

std::string summary_table(const Json& s, std::size_t width, bool color) {
  constexpr std::size_t most_rows = 40;
  std::vector<OverviewRow> rows = rows_of(s);
  const std::size_t all = rows.size();
  std::erase_if(rows, [](const OverviewRow& r) { return r.status == "clean"; });
  const std::size_t clean = all - rows.size();
  std::string out;
  if (!rows.empty()) {
    const std::vector<Field> fields = fields_of(rows);
    std::vector<TextTable::Column> columns = {{"deck"}, {"status"}};
    for (const Field& f : fields) columns.push_back({f.title, f.align});
    if (std::any_of(rows.begin(), rows.end(),
                    [&](const OverviewRow& r) { return !what_of(r, fields).empty(); }))
      columns.push_back({"what"});
    TextTable table(columns);
    for (std::size_t i = 0; i < std::min(rows.size(), most_rows); ++i) {
      const OverviewRow& r = rows[i];
      std::vector<TextTable::Cell> cells = {r.deck,
                                            {r.status, r.level->colour == "good"   ? Tone::green
                                                       : r.level->colour == "warn" ? Tone::yellow
                                                                                   : Tone::red}};
      for (const Field& f : fields) cells.emplace_back(text_of(r, f));
      if (cells.size() < columns.size()) cells.emplace_back(what_of(r, fields));
      table.row(std::move(cells));
    }
    out = table.fitted(width, color);
    if (rows.size() > most_rows)
      out += fmt::format("... and {} more, see index.html\n", rows.size() - most_rows);
    if (clean > 0)
      out += fmt::format("{} clean {} not listed\n", clean, clean == 1 ? "deck is" : "decks are");
  }
  return out;
}

}  // namespace deck::cli
