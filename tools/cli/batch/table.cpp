// The table that a batch ends with in a terminal.
#include <fmt/format.h>

#include <algorithm>

#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "batch/reading.hpp"
#include "report/shared/text_table.hpp"

namespace deck::cli {
namespace {

constexpr std::size_t most_rows = 40;

Tone tone_of(const EntryReading& e) {
  if (e.rank() == 0) return Tone::green;
  return e.status == "findings" || e.status == "not-examined" ? Tone::yellow : Tone::red;
}

/// A number of things; "-" where they were not counted.
std::string number(const EntryReading& e, const char* name) {
  return e.counted(name) ? fmt::format("{:.0f}", e.count(name)) : "-";
}

struct Field {
  TextTable::Column column;
  std::string (*text)(const EntryReading&);
};

/// What is worth a column: what some deck counted.
std::vector<Field> fields_of(const std::vector<EntryReading>& entries) {
  const auto has = [&](const char* name) { return any_counted(entries, name); };
  std::vector<Field> fields;
  if (has("pairs")) {
    fields.push_back({{"penetrating", Align::right}, [](const EntryReading& e) {
                        return e.counted("pairs") ? fmt::format("{:.0f}", e.penetrations()) : "-";
                      }});
    fields.push_back({{"deepest", Align::right}, [](const EntryReading& e) {
                        if (!(e.count("pairs") > 0)) return std::string("-");
                        return e.counted("max_depth") ? length_text(e.count("max_depth"))
                                                      : std::string("unbounded");
                      }});
    fields.push_back({{"of gap", Align::right}, [](const EntryReading& e) {
                        return e.count("pairs") > 0
                                   ? fmt::format("{:.0f} %", 100 * e.count("max_ratio"))
                                   : "-";
                      }});
  }
  if (std::any_of(entries.begin(), entries.end(),
                  [](const EntryReading& e) { return !e.text("gate").empty(); }))
    fields.push_back({{"gate"}, [](const EntryReading& e) {
                        const std::string gate = e.text("gate");
                        return gate.empty() ? "-" : gate;
                      }});
  if (has("errors")) {
    fields.push_back(
        {{"errors", Align::right}, [](const EntryReading& e) { return number(e, "errors"); }});
    fields.push_back(
        {{"warnings", Align::right}, [](const EntryReading& e) { return number(e, "warnings"); }});
  }
  const bool told = !fields.empty();  // then only what did not get through needs words
  if (!told || std::any_of(entries.begin(), entries.end(),
                           [](const EntryReading& e) { return e.rank() > 1; }))
    fields.push_back(
        {{"what"},
         told ? [](const EntryReading& e) { return e.rank() > 1 ? e.what() : std::string(); }
              : [](const EntryReading& e) { return e.what(); }});
  return fields;
}

}  // namespace

std::string summary_table(const Summary& s, std::size_t width, bool color) {
  std::vector<EntryReading> entries;
  for (const SummaryEntry& e : s.entries)
    if (e.status != "clean") entries.emplace_back(e);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const EntryReading& a, const EntryReading& b) {
                     if (a.rank() != b.rank()) return a.rank() > b.rank();
                     if (a.count("max_ratio") != b.count("max_ratio"))
                       return a.count("max_ratio") > b.count("max_ratio");
                     return a.found() > b.found();
                   });
  std::string out;
  if (!entries.empty()) {
    const std::vector<Field> fields = fields_of(entries);
    std::vector<TextTable::Column> columns = {{"deck"}, {"status"}};
    for (const Field& f : fields) columns.push_back(f.column);
    TextTable table(std::move(columns));
    for (std::size_t i = 0; i < std::min(entries.size(), most_rows); ++i) {
      std::vector<TextTable::Cell> cells = {entries[i].text("deck"),
                                            {entries[i].status, tone_of(entries[i])}};
      for (const Field& f : fields) cells.emplace_back(f.text(entries[i]));
      table.row(std::move(cells));
    }
    out = table.fitted(width, color);
    if (entries.size() > most_rows)
      out += fmt::format("... and {} more, see index.html\n", entries.size() - most_rows);
    if (const std::size_t clean = s.count("clean"); clean > 0)
      out += fmt::format("{} clean {} not listed\n", clean, clean == 1 ? "deck is" : "decks are");
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(s.includes.size(), 5); ++i)
    out += fmt::format("include, not run: {} ({})\n", terminal_text(s.includes[i].path),
                       terminal_text(s.includes[i].why));
  if (s.includes.size() > 5)
    out += fmt::format("... and {} includes more, see index.html\n", s.includes.size() - 5);
  return out;
}

}  // namespace deck::cli
