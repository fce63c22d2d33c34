// `deck diff`: comparison of two decks as JSON, text, and Markdown for reviews.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/shared/shown_text.hpp"
#include "base/shared/vec.hpp"
#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "report/html/page_steps.hpp"
#include "report/shared/inspection.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"

namespace deck {

/// Empty, a number, a text, or coordinates.
template <>
struct Value<DiffValue> {
  static void write(JsonWriter& json, const DiffValue& value) {
    std::visit(
        [&](const auto& v) {
          using T = std::remove_cvref_t<decltype(v)>;
          if constexpr (std::same_as<T, std::monostate>)
            json.null();
          else
            Value<T>::write(json, v);
        },
        value);
  }
  static JsonForm form(SchemaDefinitions&) {
    return {"",
            R"("oneOf": [{ "type": ["number", "string", "null"] }, )"
            R"({ "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 }])"};
  }
};

template <>
inline constexpr std::size_t word_count<ChangeKind> = 4;

LINE_RECORD(PenetrationChange, "changed_penetration", "A node or edge, by its deepest pair.",
            COLUMN("interface", "", r.interface_id), COLUMN("role", "", r.role),
            COLUMN("node", "Secondary node", if_any(r.secondary[1] == 0, r.secondary[0])),
            COLUMN("edge", "Secondary edge", if_any(r.secondary[1] != 0, r.secondary)),
            COLUMN("depth_old", "", r.depth_old), COLUMN("depth_new", "", r.depth_new),
            COLUMN("gap_old", "", r.gap_old), COLUMN("gap_new", "", r.gap_new));

namespace {

struct ChangeRow {
  const Deck &deck_a, &deck_b;
  const Change* change = nullptr;

  IfAny<std::vector<std::int64_t>> members(const std::vector<std::int64_t>& ids) const {
    return if_any(!change->gained.empty() || !change->lost.empty() || !change->altered.empty(),
                  ids);
  }
};
RECORD(ChangeRow, "change", "", COLUMN("kind", "", r.change->kind),
       COLUMN("group", "deck, interface, group, part, property, material, node or other",
              r.change->group),
       LINE_OBJECT("entity", "", COLUMN("keyword", "", r.change->keyword),
                   COLUMN("id", "In the first deck; of an added entity in the second",
                          known(r.change->id != 0, r.change->id)),
                   COLUMN("id_b", "In the second deck, if it differs",
                          if_any(r.change->id_b != 0, r.change->id_b)),
                   COLUMN("title", "", r.change->title)),
       COLUMN("field", "null: the entity as a whole was added or removed",
              known(!r.change->field.empty(), r.change->field)),
       COLUMN("old", "As on the card; of lists the number of members; null: blank",
              r.change->old_value),
       COLUMN("new", "", r.change->new_value),
       COLUMN("effective_old", "Of a field of a contact",
              if_any(r.change->evaluated, r.change->effective_old)),
       COLUMN("effective_new", "", if_any(r.change->evaluated, r.change->effective_new)),
       COLUMN("why", "Origin of the new effective value: card, default-block, built-in, derived",
              if_any(r.change->evaluated, r.change->why)),
       COLUMN("gained", "Ids of members", r.members(r.change->gained)),
       COLUMN("lost", "", r.members(r.change->lost)),
       COLUMN("altered", "", r.members(r.change->altered)),
       COLUMN("a", "Place in the first deck", place_of(r.deck_a, r.change->a)),
       COLUMN("b", "Place in the second deck", place_of(r.deck_b, r.change->b)));

struct SideOfDiff {
  const DiffSide* side = nullptr;
};
RECORD(SideOfDiff, "side", "", COLUMN("deck", "", deck_row(r.side->loaded)),
       COLUMN("verdict", "",
              r.side->verdict == nullptr ? IfAny<Verdict>{} : if_any(true, *r.side->verdict)));

struct DiffDocument {
  const DiffSide &a, &b;
  const DeckDiff& diff;
};
RECORD(DiffDocument, "document", "", COLUMN("a", "", SideOfDiff{&r.a}),
       COLUMN("b", "", SideOfDiff{&r.b}), COLUMN("equal", "", r.diff.equal()),
       COLUMN("text", "The result as a sentence", diff_verdict(r.diff)),
       COLUMN("notes", "", rows_of(r.diff.notes)),
       COLUMN("changes", "", rows<ChangeRow>(r.diff.changes, r.a.loaded.deck(), r.b.loaded.deck())),
       OBJECT("penetrations", "", COLUMN("new", "", rows_of(r.diff.appeared)),
              COLUMN("gone", "", rows_of(r.diff.gone)), COLUMN("worse", "", rows_of(r.diff.worse)),
              COLUMN("better", "", rows_of(r.diff.better)),
              COLUMN("same", "How many", r.diff.same.size())));

constexpr DocumentHead diff_head{"deck/diff", 1, "Written by deck diff A B --json.", false};

}  // namespace

DocumentSchema diff_schema() { return document_schema<DiffDocument>(diff_head); }

std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff) {
  return write_document(diff_head, DiffDocument{a, b, diff});
}

// ---- for people --------------------------------------------------------------------------------

namespace {

/// A table of a comparison: titles, and rows of texts.
struct DiffTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows = {};
  std::size_t left_out = 0;  ///< number of further rows
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

/// Table of a change within its group, in this order.
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
              {"what", "field", "card", "new card", "effective", "new effective", "why", "place"}};
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

/// Nonempty tables with at most `rows` rows each; 0: all.
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
    DiffTable table{title, {"interface", "node/edge", "depth", "new depth", "gap", "new gap"}};
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

/// Escapes a text for a cell of a Markdown table.
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

namespace {

LINE_RECORD(DiffTable, "changed_table", "", COLUMN("title", "", r.title),
            COLUMN("columns", "", r.columns), COLUMN("rows", "", r.rows));

struct ChangesBlock {
  const DeckDiff& diff;
  std::vector<DiffTable> tables;
};
RECORD(ChangesBlock, "changes", "The block deck-changes.",
       COLUMN("text", "The result as a sentence", diff_verdict(r.diff)),
       COLUMN("tables", "What differs, without moved nodes and penetrations", r.tables));

}  // namespace

std::string changes_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff) {
  DeckDiff cards{diff.changes, {}, {}, {}, {}, {}, {}};
  std::erase_if(cards.changes, [](const Change& c) { return c.kind == ChangeKind::moved; });
  return detail::block_json(ChangesBlock{diff, diff_tables(a, b, cards, 0)});
}

void changes_form(SchemaDefinitions& definitions) { record_form<ChangesBlock>(definitions); }

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
    for (const std::string& name : t.columns)
      columns.push_back({name, Align::left, name == "place"});
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
