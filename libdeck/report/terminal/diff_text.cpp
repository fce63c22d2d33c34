// A comparison of two decks as text for a terminal and as Markdown for a review.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "base/shared/vec.hpp"
#include "deck/text/number.hpp"
#include "report/shared/inspection.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

/// A table of a comparison: titles, and rows of texts.
struct DiffTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows = {};
  std::size_t left_out = 0;  ///< further rows
};

std::string diff_value(const DiffValue& v) {
  if (const auto* n = std::get_if<std::int64_t>(&v)) return std::to_string(*n);
  if (const auto* x = std::get_if<double>(&v)) return shortest(*x);
  if (const auto* t = std::get_if<std::string>(&v)) return *t;
  if (const auto* p = std::get_if<std::array<double, 3>>(&v))
    return fmt::format("{} {} {}", shortest((*p)[0]), shortest((*p)[1]), shortest((*p)[2]));
  return "-";
}

std::string entity_text(const Change& c) {
  std::string out = c.keyword;
  if (c.id != 0) out += fmt::format("/{}", c.id);
  if (c.id_b != 0) out += fmt::format(" -> {}", c.id_b);
  if (!c.title.empty()) out += " " + c.title;
  return out;
}

std::string members_text(const std::vector<std::int64_t>& ids, const char* sign) {
  constexpr std::size_t most = 8;
  if (ids.empty()) return "";
  return fmt::format("{}{}: {}{}", sign, ids.size(),
                     fmt::join(ids.begin(), ids.begin() + std::min(most, ids.size()), " "),
                     ids.size() > most ? " ..." : "");
}

std::string place_text(const DiffSide& a, const DiffSide& b, const Change& c) {
  const bool second = c.b.valid();
  if (!second && !c.a.valid()) return "";
  return second ? b.loaded.deck().sources.where(c.b) : a.loaded.deck().sources.where(c.a);
}

/// In which table of its group a change is shown, in this order.
enum class TableOf : std::uint8_t { whole, effective, fields, members, moved };

TableOf table_of(const Change& c) {
  if (c.kind == ChangeKind::moved) return TableOf::moved;
  if (c.field.empty()) return TableOf::whole;
  if (c.evaluated) return TableOf::effective;
  const bool members = !c.gained.empty() || !c.lost.empty() || !c.altered.empty();
  return members ? TableOf::members : TableOf::fields;
}

DiffTable empty_table(TableOf table, const char* group) {
  switch (table) {
    case TableOf::whole:
      return {group, {"change", "what", "place"}};
    case TableOf::effective:
      return {"Effective values",
              {"interface", "field", "card", "now", "effective", "now", "why", "place"}};
    case TableOf::fields:
      return {group, {"what", "field", "old", "new", "place"}};
    case TableOf::members:
      return {"Members", {"what", "list", "old", "new", "gained", "lost", "altered"}};
    case TableOf::moved:
      break;
  }
  return {"Nodes moved", {"node", "from", "to", "by", "place"}};
}

std::vector<std::string> row_of(const Change& c, const std::string& place) {
  const std::string what = entity_text(c), was = diff_value(c.old_value),
                    is = diff_value(c.new_value);
  switch (table_of(c)) {
    case TableOf::whole:
      return {to_string(c.kind), what, place};
    case TableOf::effective:
      return {what,  c.field, was, is, diff_value(c.effective_old), diff_value(c.effective_new),
              c.why, place};
    case TableOf::fields:
      return {what, c.field, was, is, place};
    case TableOf::members:
      return {what,
              c.field,
              was,
              is,
              members_text(c.gained, "+"),
              members_text(c.lost, "-"),
              members_text(c.altered, "")};
    case TableOf::moved:
      break;
  }
  const auto* p = std::get_if<std::array<double, 3>>(&c.old_value);
  const auto* q = std::get_if<std::array<double, 3>>(&c.new_value);
  const double by = p == nullptr || q == nullptr
                        ? 0
                        : length3((*q)[0] - (*p)[0], (*q)[1] - (*p)[1], (*q)[2] - (*p)[2]);
  return {c.id_b == 0 ? std::to_string(c.id) : fmt::format("{} -> {}", c.id, c.id_b), was, is,
          length_text(by), place};
}

constexpr std::pair<const char*, const char*> diff_groups[] = {{"deck", "Deck"},
                                                               {"interface", "Interfaces"},
                                                               {"group", "Groups, surfaces, sets"},
                                                               {"part", "Parts"},
                                                               {"property", "Properties"},
                                                               {"material", "Materials"},
                                                               {"other", "Other keywords"},
                                                               {"node", "Nodes"}};

/// All tables that have a row; at most `rows` rows in each, 0: all.
std::vector<DiffTable> diff_tables(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                                   std::size_t rows) {
  std::vector<DiffTable> out;
  const auto fits = [&](DiffTable& table) {
    if (rows == 0 || table.rows.size() < rows) return true;
    ++table.left_out;
    return false;
  };
  for (const auto& [group, title] : diff_groups)
    for (const TableOf kind :
         {TableOf::whole, TableOf::effective, TableOf::fields, TableOf::members, TableOf::moved}) {
      DiffTable table = empty_table(kind, title);
      for (const Change& c : diff.changes)
        if (table_of(c) == kind && c.group == group && fits(table))
          table.rows.push_back(row_of(c, place_text(a, b, c)));
      if (!table.rows.empty()) out.push_back(std::move(table));
    }
  const std::pair<const char*, const std::vector<PenetrationChange>*> lists[] = {
      {"New penetrations", &diff.appeared},
      {"Deeper penetrations", &diff.worse},
      {"Shallower penetrations", &diff.better},
      {"Penetrations gone", &diff.gone}};
  for (const auto& [title, list] : lists) {
    DiffTable table{title, {"interface", "node/edge", "depth", "now", "gap", "now"}};
    const auto was = [&](double v) { return list != &diff.appeared ? length_text(v) : "-"; };
    const auto is = [&](double v) { return list != &diff.gone ? length_text(v) : "-"; };
    for (const PenetrationChange& p : *list)
      if (fits(table))
        table.rows.push_back({p.role == "primary" ? std::to_string(p.interface_id)
                                                  : fmt::format("{} {}", p.interface_id, p.role),
                              p.secondary[1] == 0
                                  ? std::to_string(p.secondary[0])
                                  : fmt::format("{}-{}", p.secondary[0], p.secondary[1]),
                              was(p.depth_old), is(p.depth_new), was(p.gap_old), is(p.gap_new)});
    if (!table.rows.empty()) out.push_back(std::move(table));
  }
  return out;
}

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

std::string diff_verdict(const DeckDiff& diff) {
  if (diff.equal())
    return diff.same.empty()
               ? "Equal in meaning: no initial penetrations in either."
               : fmt::format("Equal in meaning, with the same {} penetrating nodes and edges.",
                             diff.same.size());
  std::vector<std::string> parts;
  if (diff.stops_a != diff.stops_b)
    parts.push_back(diff.stops_b ? "the solver stops at the second deck"
                                 : "the solver stops at the first deck");
  const auto say = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) parts.push_back(count(n, one, many));
  };
  const auto changes = [&](TableOf table, ChangeKind kind, const char* one, const char* many) {
    say(static_cast<std::size_t>(
            std::count_if(diff.changes.begin(), diff.changes.end(),
                          [&](const Change& c) { return table_of(c) == table && c.kind == kind; })),
        one, many);
  };
  using Kind = ChangeKind;
  changes(TableOf::whole, Kind::added, "keyword added", "keywords added");
  changes(TableOf::whole, Kind::removed, "keyword removed", "keywords removed");
  changes(TableOf::effective, Kind::changed, "effective value of a contact changed",
          "effective values of contacts changed");
  changes(TableOf::members, Kind::changed, "list of members changed", "lists of members changed");
  changes(TableOf::fields, Kind::changed, "other field changed", "other fields changed");
  changes(TableOf::moved, Kind::moved, "node moved", "nodes moved");
  say(diff.appeared.size(), "new penetration", "new penetrations");
  say(diff.worse.size(), "deeper", "deeper");
  say(diff.better.size(), "shallower", "shallower");
  say(diff.gone.size(), "penetration gone", "penetrations gone");
  return fmt::format("Different: {}.", fmt::join(parts, ", "));
}

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
