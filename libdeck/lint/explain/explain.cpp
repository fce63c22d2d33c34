// The pages of `deck explain`: rules, keywords and fields as text.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/shared/shown_text.hpp"
#include "deck/lint.hpp"
#include "lint/check.hpp"
#include "lint/shared/example.hpp"
#include "lint/shared/topics.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {
namespace {

std::string section(std::string_view name, std::string_view text, std::size_t width) {
  return text.empty() ? std::string() : std::string(name) + "\n" + wrapped(text, 2, width) + "\n";
}

/// Card lines after a bar; longer ones than `width` (0: no limit) continue with whole cells of ten
/// columns.
std::string indented(std::string_view text, std::size_t width) {
  std::string out;
  const std::size_t room = width == 0 ? text.size() : std::max<std::size_t>(width, 24) - 4;
  for (std::string_view line : detail::parts_of(text, '\n')) {
    const char* bar = "  | ";
    for (; line.size() > room; bar = "  … ") {
      const std::size_t cells = room / 10 * 10;
      std::string piece(line.substr(0, cells));
      piece.resize(piece.find_last_not_of(' ') + 1);
      out += bar + piece + "\n";
      line.remove_prefix(cells);
    }
    out += line.empty() ? "  |\n" : bar + std::string(line) + "\n";
  }
  return out;
}

std::string versions(int from, int until) {
  if (from == 0 && until == 9999) return "all versions";
  if (until == 9999) return "from version " + std::to_string(from);
  if (from == 0) return "up to version " + std::to_string(until);
  return "versions " + std::to_string(from) + " to " + std::to_string(until);
}

std::string type_name(const Field& f) {
  switch (f.type) {
    case FieldType::integer:
      return "integer";
    case FieldType::real:
      return "real";
    case FieldType::text:
      return "text";
    case FieldType::flag:
      return "one column";
    case FieldType::id:
      return "id of " + f.ref;
  }
  return "";
}

std::string dimension_text(const Dimension& d) {
  std::string out;
  const auto add = [&](const char* symbol, int power) {
    if (power == 0) return;
    out += (out.empty() ? "" : " ") + std::string(symbol);
    if (power != 1) out += "^" + std::to_string(power);
  };
  add("mass", d.mass);
  add("length", d.length);
  add("time", d.time);
  add("temperature", d.temperature);
  return out.empty() ? "none" : out;
}

std::string conditions(const std::vector<Condition>& when) {
  std::string out;
  for (const Condition& c : when) {
    std::string one = c.field;
    const auto list = [&](const std::vector<std::int64_t>& values, const char* single,
                          const char* several) {
      if (values.empty()) return;
      one += fmt::format("{}{}", values.size() == 1 ? single : several, fmt::join(values, ", "));
    };
    list(c.in, " = ", " in ");
    list(c.not_in, " other than ", " none of ");
    if (c.min) one += " >= " + std::to_string(*c.min);
    if (c.max) one += " <= " + std::to_string(*c.max);
    out += (out.empty() ? "" : " and ") + one;
  }
  return out;
}

std::string range_text(const Field& f) {
  if (!f.values.empty()) return fmt::format("{}", fmt::join(f.values, ", "));
  std::string out;
  if (f.min) out += std::string(f.min_open ? "> " : ">= ") + detail::number_text(*f.min);
  if (f.max)
    out += (out.empty() ? "" : ", ") + std::string(f.max_open ? "< " : "<= ") +
           detail::number_text(*f.max);
  return out;
}

/// "name        text", continued in the column of the text.
std::string page_row(std::string_view name, const std::string& text, std::size_t width) {
  return text.empty() ? text : behind(fmt::format("  {:<12}", name), text, width);
}

std::string field_head(const Schema& schema, const CardSchema& card, const Field& f,
                       std::size_t width) {
  return wrapped(
      fmt::format("{} of {}: {}", f.name, schema.keyword, f.doc.empty() ? card.name : f.doc), 0,
      width);
}

/// Card, columns and versions of a cell.
std::string field_place(const CardSchema& card, const Field& f, std::size_t width) {
  return page_row("columns",
                  fmt::format("{}-{} of the line '{}', {}", f.first, f.last, card.name,
                              versions(std::max(card.from, f.from), std::min(card.until, f.until))),
                  width);
}

/// Other properties of a cell.
std::string field_rows(const CardSchema& card, const Field& f, std::size_t width) {
  std::vector<Condition> present = card.when;
  present.insert(present.end(), f.when.begin(), f.when.end());
  std::string out =
      page_row("present if", conditions(present), width) + page_row("type", type_name(f), width) +
      page_row("legal", range_text(f), width) + page_row("default", f.default_text, width);
  if (f.type == FieldType::real) {
    std::string dimension = f.dimension_known ? dimension_text(f.dimension) : "not known";
    for (const auto& [when, d] : f.dimension_when)
      dimension += "; " + dimension_text(d) + " if " + conditions(when);
    out += page_row("dimension", dimension, width);
  }
  if (f.ignored) out += page_row("effect", "none: the reference solver does not use it", width);
  return out + page_row("manual", f.from_manual, width);
}

/// Newest layout first; layouts that differ only in columns are listed with it.
std::string field_page(const Schema& schema, std::string_view field, std::size_t width) {
  struct Layout {
    std::string head, places, rows;
  };
  std::vector<Layout> layouts;
  for (auto card = schema.cards.rbegin(); card != schema.cards.rend(); ++card)
    for (auto f = card->fields.rbegin(); f != card->fields.rend(); ++f) {
      if (f->name != field) continue;
      Layout l{field_head(schema, *card, *f, width), field_place(*card, *f, width),
               field_rows(*card, *f, width)};
      const auto same = std::find_if(layouts.begin(), layouts.end(), [&](const Layout& other) {
        return other.head == l.head && other.rows == l.rows;
      });
      if (same != layouts.end())
        same->places += l.places;
      else
        layouts.push_back(std::move(l));
    }
  std::string out;
  for (const Layout& l : layouts) out += (out.empty() ? "" : "\n") + l.head + l.places + l.rows;
  return out;
}

/// Converts "run error 79; manual /RBODY" to words. Sections of a specification are not named,
/// because users do not have it.
std::string sources_text(std::string_view sources) {
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"run ", "run of the solver: "},
      {"record ", "recorded values of the solver: "},
      {"listing ", "listing of a public deck: "},
      {"specification ", "observed behaviour of the solver"},
      {"manual ", "manual: "}};
  std::string out;
  std::string_view before;
  for (const std::string_view item : detail::parts_of(sources, ';')) {
    const std::string_view text = item.substr(std::min(item.find_first_not_of(' '), item.size()));
    for (const auto& [kind, word] : words) {
      if (!text.starts_with(kind)) continue;
      const bool named = kind != "specification ";
      if (kind != before)
        out += (out.empty() ? "" : "; ") + std::string(word);
      else if (named)
        out += ", ";
      if (named) out += text.substr(kind.size());
      before = kind;
    }
  }
  return out + ".";
}

/// Overrides for the fields of `selector`; fields with equal texts share a row.
std::string field_table(const Rule& rule, std::size_t width, std::string_view selector) {
  std::vector<std::pair<std::string, std::string>> rows;  // names, text
  for (const RuleField& f : rule.fields) {
    if (!selects(selector, rule.id, f.name)) continue;
    std::string text;
    for (const std::string* part : {&f.note, &f.solver, &f.fix})
      if (!part->empty()) text += (text.empty() ? "" : " ") + *part;
    std::string name = f.name;
    if (f.severity) name += fmt::format(" ({})", to_string(*f.severity));
    const auto same =
        std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.second == text; });
    if (same == rows.end())
      rows.emplace_back(std::move(name), std::move(text));
    else
      same->first += ", " + name;
  }
  std::string out;
  for (const auto& [names, text] : rows)
    out += wrapped(names, 2, width) + (text.empty() ? "" : wrapped(text, 6, width));
  return out.empty() ? out : "Fields\n" + out + "\n";
}

/// The page with the fields of `selector`; `marked`: mark the cell in the example.
std::string page_of_rule(const Rule& rule, const SchemaSet& schemas, std::size_t width,
                         std::string_view selector, bool marked) {
  const std::size_t card_width = width;
  if (width == 0) width = usual_page_width;
  namespace heading = detail::heading;
  std::string severities;
  for (const Severity s : rule.severities)
    severities += (severities.empty() ? "" : " or ") + std::string(to_string(s));
  std::string out = fmt::format("{}: {}\nName: {}\n{}, {}", id_text(rule.id), rule.title, rule.name,
                                severities, family_of(rule.id));
  if (rule.fixable != Fixable::no)
    out += rule.fixable == Fixable::safe ? ", fixed by --fix" : ", fixed by --unsafe-fixes";
  if (!rule.types.empty()) out += fmt::format("\nAbout TYPE{}", fmt::join(rule.types, ", TYPE"));
  out += "\n\n" + section(heading::problem, rule.problem, width) +
         section(heading::why, rule.why, width);
  const auto message = rule.messages.empty() ? std::nullopt : std::optional(rule.messages.front());
  out += section(heading::solver, detail::with_message(rule.solver, message), width);
  out += field_table(rule, width, selector);
  if (!rule.source.empty()) out += section(heading::source, sources_text(rule.source), width);
  out += section(heading::fix, rule.fix, width);
  if (!rule.bad.empty()) {
    const std::string card = marked ? marked_example(rule, schemas, card_width) : std::string();
    out +=
        fmt::format("{}\n{}\n", heading::bad,
                    !card.empty() ? card : indented(example_text(rule.bad, schemas), card_width));
  }
  if (!rule.ignore.empty()) out += section(heading::ignore, rule.ignore, width);
  out += "Suppress it for one block with a comment in or above the block:\n";
  const auto named = std::find_if(rule.fields.begin(), rule.fields.end(), [&](const RuleField& f) {
    return selects(selector, rule.id, f.name);
  });
  out += fmt::format("  # decklint: ignore[{}{}] reason=...\n", id_text(rule.id),
                     named == rule.fields.end() ? "" : ":" + named->name);
  return out;
}

}  // namespace

std::string behind(const std::string& head, std::string_view text, std::size_t width) {
  const std::string lines = wrapped(text, head.size(), width);
  return head + (lines.empty() ? "\n" : lines.substr(head.size()));
}

std::string explain_rule(const Rule& rule, const SchemaSet& schemas, std::size_t width,
                         std::string_view selector) {
  return page_of_rule(rule, schemas, width, selector, true);
}

std::string explain_rule(const Rule& rule, const SchemaSet& schemas) {
  return page_of_rule(rule, schemas, 0, "all", false);
}

std::string explain_keyword(const Schema& schema, std::string_view field) {
  return explain_keyword(schema, field, 0);
}

std::string explain_keyword(const Schema& schema, std::string_view field, std::size_t width) {
  if (width == 0) width = usual_page_width;
  if (!field.empty()) return field_page(schema, field, width);
  std::string out = schema.keyword;
  for (const std::string& alias : schema.aliases) out += ", " + alias;
  out += "\n" + wrapped(schema.doc, 2, width);
  if (schema.from > 0) out += fmt::format("  from version {}\n", schema.from);
  out += std::string("  header: ") + schema.keyword + (schema.has_id ? "/id" : "") +
         (schema.has_id && schema.has_unit ? "/unit_ID" : "") +
         (schema.has_title ? ", then a title line of at most 100 characters" : ", no title line") +
         "\n";
  for (const CardSchema& card : schema.cards) {
    out += fmt::format("\n{} ({}{}{})\n", card.name, versions(card.from, card.until),
                       card.when.empty() ? "" : "; only if " + conditions(card.when),
                       card.repeat == Repeat::once ? ""
                       : card.count.empty()        ? "; repeats"
                                                   : "; repeats, count " + card.count);
    if (card.blank()) out += "  must be blank: its text is not read, but the line counts\n";
    for (const Field& f : card.fields) {
      std::string text = f.doc;
      if (const std::string range = range_text(f); !range.empty()) text += " [" + range + "]";
      if (!f.default_text.empty()) text += "; 0 or blank: " + f.default_text;
      if (f.from != 0 || f.until != 9999) text += " (" + versions(f.from, f.until) + ")";
      if (!f.when.empty()) text += "; only if " + conditions(f.when);
      if (f.ignored) text += " (not used)";
      out += behind(fmt::format("  {:>3}-{:<3} {:<15} ", f.first, f.last, f.name), text, width);
      if (!f.from_manual.empty()) out += wrapped("Manual: " + f.from_manual, 12, width);
    }
  }
  return out;
}

}  // namespace deck
