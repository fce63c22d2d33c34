// A comparison of two decks as text for a terminal and as Markdown for a review.
#include <fmt/format.h>

#include "base/shared/escape.hpp"
#include "report/diff_rows.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

/// Text in a cell of a Markdown table: nothing of it is markup.
std::string markdown_cell(std::string_view text) {
  std::string out;
  for (const char c : terminal_text(text)) {
    if (std::string_view("|\\`*_[]<>~#@").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::string diff_text(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                      const DiffTextOptions& options) {
  const std::string verdict =
      toned(diff_verdict(diff), diff.equal() ? Tone::green : Tone::bold, options.color) + "\n";
  std::string out =
      terminal_text(a.loaded.path()) + " -> " + terminal_text(b.loaded.path()) + "\n" + verdict;
  for (const std::string& note : diff.notes) out += "note: " + terminal_text(note) + "\n";
  const auto tables = diff_tables(a, b, diff, options.rows);
  for (const DiffTable& t : tables) {
    std::vector<TextTable::Column> columns;
    for (const std::string& name : t.columns) columns.push_back({name});
    TextTable table(columns);
    for (const auto& row : t.rows) table.row({row.begin(), row.end()});
    out += titled(t.title, table.fitted(options.width, options.color, 2), options.color);
    out += more_line(t.left_out, 0, " (--rows N, --json)");
  }
  if (!tables.empty()) out += "\n" + verdict;
  return out;
}

std::string diff_markdown(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                          const DiffTextOptions& options) {
  std::string out = fmt::format("### {} → {}\n\n**{}**\n", markdown_cell(a.loaded.path()),
                                markdown_cell(b.loaded.path()), markdown_cell(diff_verdict(diff)));
  for (const std::string& note : diff.notes) out += fmt::format("\n> {}\n", markdown_cell(note));
  for (const DiffTable& t : diff_tables(a, b, diff, options.rows)) {
    out += fmt::format("\n#### {}\n\n| {} |\n|", t.title, fmt::join(t.columns, " | "));
    for (std::size_t i = 0; i < t.columns.size(); ++i) out += " --- |";
    out += "\n";
    for (const auto& row : t.rows) {
      out += "|";
      for (const std::string& cell : row) out += fmt::format(" {} |", markdown_cell(cell));
      out += "\n";
    }
    if (t.left_out > 0) out += fmt::format("\n… and {} more.\n", t.left_out);
  }
  return out;
}

}  // namespace deck
