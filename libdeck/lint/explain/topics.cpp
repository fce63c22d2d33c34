// Finds the pages of `deck explain` for user input.
#include "lint/shared/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "deck/lint.hpp"

namespace deck {
namespace {

constexpr const char* contact_keywords[] = {"/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11",
                                            "/INTER/TYPE19"};

/// A schema by its keyword, with or without the leading slash, in any case.
const Schema* keyword_named(const SchemaSet& schemas, std::string_view name) {
  const std::string wanted =
      in_capitals(name.starts_with('/') ? std::string(name) : "/" + std::string(name));
  if (const Schema* s = schemas.find(wanted)) return s;
  // "TYPE7" is the interface; also "/DEFAULT/INTER/TYPE7".
  if (const Schema* s = schemas.find("/INTER" + wanted)) return s;
  const Schema* best = nullptr;
  for (const Schema* s : schemas.all())
    if (in_capitals(s->keyword).ends_with(wanted) &&
        (best == nullptr || s->keyword.size() < best->keyword.size()))
      best = s;
  if (best != nullptr) return best;
  for (const Schema* s : schemas.all())
    if (std::any_of(s->aliases.begin(), s->aliases.end(),
                    [&](const std::string& a) { return in_capitals(a).ends_with(wanted); }))
      return s;
  return nullptr;
}

/// A header of a deck with ids: "/INTER/TYPE7/3".
const Schema* header_named(const SchemaSet& schemas, std::string_view header) {
  while (header.starts_with('/')) {
    const std::size_t slash = header.rfind('/');
    const bool ids = header.find_first_not_of("0123456789", slash + 1) == header.npos;
    if (slash == 0 || !ids) return nullptr;
    header = header.substr(0, slash);
    if (const Schema* s = schemas.find(in_capitals(header))) return s;
  }
  return nullptr;
}

/// Name of a field in the spelling of the schema; empty: unknown.
std::string field_named(const Schema& schema, std::string_view name) {
  const std::string wanted = in_capitals(name);
  for (const CardSchema& card : schema.cards)
    for (const Field& f : card.fields)
      if (in_capitals(f.name) == wanted) return f.name;
  return {};
}

std::string field_with_help(const Schema& schema, const std::string& name, const SchemaSet& schemas,
                            std::size_t width) {
  std::string page = explain_keyword(schema, name, width);
  for (const CardSchema& card : schema.cards)
    for (const Field& f : card.fields)
      if (f.name == name)
        if (const std::string help = field_help(f, schemas, width); !help.empty())
          return page + "\n" + help;
  return page;
}

/// A field of any contact: the page of one, and the differences of others.
std::string field_everywhere(std::string_view name, const SchemaSet& schemas, std::size_t width) {
  std::string page, others;
  for (const Schema* s : contacts_first(schemas)) {
    const std::string field = field_named(*s, name);
    if (field.empty()) continue;
    if (page.empty())
      page = field_with_help(*s, field, schemas, width);
    else
      others += (others.empty() ? "" : ", ") + s->keyword + "." + field;
  }
  if (others.empty()) return page;
  return page + "\nAlso a field of\n" + wrapped(others, 2, width);
}

/// The page of a rule by id, with a field ("DK201:ISTF"), or by a former id.
std::string rule_page(std::string_view capitals, const SchemaSet& schemas, std::size_t width) {
  if (const Rule* rule = find_successor(capitals))
    return renamed_selector(capitals) + ".\n\n" + explain_rule(*rule, schemas, width, capitals);
  const auto colon = std::min(capitals.find(':'), capitals.size());
  const Rule* const rule = find_rule(capitals.substr(0, colon));
  if (rule == nullptr) return {};
  if (colon == capitals.size()) return explain_rule(*rule, schemas, width);
  for (const RuleField& f : rule->fields)
    if (in_capitals(f.name) == capitals.substr(colon + 1))
      return explain_rule(*rule, schemas, width,
                          std::string(capitals.substr(0, colon)) + ":" + f.name);
  return {};
}

/// "DK1": a family of rules; "X": rules of the team.
std::string rule_family(const std::string& topic, std::size_t width) {
  if (!topic.starts_with("DK") && !topic.starts_with('X')) return {};
  if (topic.size() > 4) return {};
  std::string list;
  std::size_t count = 0;
  RuleId first = RuleId::none;
  for (const Rule& r : all_rules()) {
    const std::string_view id = id_text(r.id);
    if (!id.starts_with(topic)) continue;
    if (count == 0) first = r.id;
    list += behind(fmt::format("  {:<7}{:<8}", id, to_string(r.severity())), r.title, width);
    ++count;
  }
  if (count == 0) return {};
  return fmt::format(
      "{}: {} {} ({})\n"
      "\n"
      "{}\n"
      "Show one of them: deck explain {}\n",
      topic, count, count == 1 ? "rule" : "rules", topic == "DK" ? "all" : family_of(first), list,
      id_text(first));
}

/// "/INTER": keywords that start with it, one line each.
std::string keywords_below(const std::string& capitals, const SchemaSet& schemas,
                           std::size_t width) {
  const std::string above = (capitals.starts_with('/') ? capitals : "/" + capitals) + "/";
  std::vector<const Schema*> below;
  for (const Schema* s : contacts_first(schemas))
    if (in_capitals(s->keyword).starts_with(above)) below.push_back(s);
  if (below.empty()) return {};
  std::string list;
  for (const Schema* s : below) {
    constexpr std::size_t margin = 29;
    const std::string text = wrapped(s->doc, margin, width);
    const std::string head = fmt::format("  {:<{}} ", s->keyword, margin - 3);
    list += text.size() <= margin  ? head.substr(0, head.find_last_not_of(' ') + 1) + "\n"
            : head.size() > margin ? fmt::format("  {}\n", s->keyword) + text
                                   : head + text.substr(margin);
  }
  return fmt::format(
      "Keywords that begin with {}\n"
      "\n"
      "{}\n"
      "Show one of them: deck explain {}\n",
      above, list, below.front()->keyword);
}

/// "Igap 3", "Igap=3", "TYPE7.Igap = 3": the page of the field with that value marked.
std::string field_with_value(std::string_view topic, const SchemaSet& schemas, std::size_t width) {
  const auto end = std::min(topic.find_first_of(" ="), topic.size());
  const auto begin = std::min(topic.find_first_not_of(" =", end), topic.size());
  const std::string_view name = topic.substr(0, end);
  const IntegerCell value = read_integer(topic.substr(begin));
  const std::string wanted = in_capitals(name.substr(name.rfind('.') + 1));
  const Field* field = nullptr;
  for (const Schema* s : contacts_first(schemas))
    if (const std::string own = field_named(*s, wanted); field == nullptr && !own.empty())
      field = s->find_field(own);
  if (field == nullptr || begin == topic.size() || value.status != NumberStatus::ok) return {};
  std::string page = explain_topic(name, schemas, width);
  const std::string number = std::to_string(value.value);
  const auto& legal = field->values;
  if (!legal.empty() && std::find(legal.begin(), legal.end(), value.value) == legal.end())
    return fmt::format("{} is no legal value of {}\n\n{}", number, field->name, page);
  bool marked = false;  // in a figure, which is set in by four blanks; else in the list
  for (std::size_t at = 0; (at = page.find("  " + number + "  ", at + 1)) != page.npos;)
    if (page.compare(page.rfind('\n', at) + 1, 4, "    ") == 0) page[at] = '>', marked = true;
  const auto row = page.find("\n  legal "), end_of_row = page.find('\n', row + 1);
  for (const char* const behind : {",", "\n"})
    if (const auto at = page.find(" " + number + behind, row); !marked && at < end_of_row)
      page.insert(at + 1, ">"), marked = true;
  return page;
}

}  // namespace

std::vector<const Schema*> contacts_first(const SchemaSet& schemas) {
  std::vector<const Schema*> out;
  for (const char* name : contact_keywords)
    if (const Schema* s = schemas.find(name)) out.push_back(s);
  const std::size_t first = out.size();
  for (const Schema* s : schemas.all())
    if (std::find(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(first), s) ==
        out.begin() + static_cast<std::ptrdiff_t>(first))
      out.push_back(s);
  return out;
}

std::string field_help(const Field& field, const SchemaSet& schemas, std::size_t width) {
  if (width == 0) width = usual_page_width;
  std::string out;
  bool figure = false;
  for (const std::string& text : field.help) {
    const bool line = text.starts_with('|');
    if (!out.empty() && !(line && figure)) out += "\n";
    out += line ? "    " + text.substr(1) + "\n" : wrapped(text, 2, width);
    figure = line;
  }
  if (field.help_of.empty()) return out;
  const Schema* other = schemas.find(field.help_of);
  if (other == nullptr) return out;
  for (const CardSchema& card : other->cards)
    for (const Field& f : card.fields)
      if (f.name == field.name && !f.help.empty())
        return out + (out.empty() ? "" : "\n") + field_help(f, schemas, width);
  return out;
}

std::string explain_topic(std::string_view topic, const SchemaSet& schemas, std::size_t width) {
  const std::string capitals = in_capitals(to_selector(topic));
  if (capitals.empty()) return {};
  if (std::string page = rule_page(capitals, schemas, width); !page.empty()) return page;
  if (width == 0) width = usual_page_width;
  if (std::string page = rule_family(capitals, width); !page.empty()) return page;
  if (const auto number = message_number(topic)) return explain_message(*number, schemas, width);
  if (std::string page = field_with_value(topic, schemas, width); !page.empty()) return page;
  if (const auto dot = topic.rfind('.'); dot != topic.npos)
    if (const Schema* s = keyword_named(schemas, topic.substr(0, dot)))
      if (const std::string field = field_named(*s, topic.substr(dot + 1)); !field.empty())
        return field_with_help(*s, field, schemas, width);
  // A contact field has priority, then a keyword, then any other field.
  const Schema* keyword = keyword_named(schemas, topic);
  const bool of_contact =
      std::any_of(std::begin(contact_keywords), std::end(contact_keywords), [&](const char* name) {
        const Schema* s = schemas.find(name);
        return s != nullptr && !field_named(*s, topic).empty();
      });
  if (of_contact) return field_everywhere(topic, schemas, width);
  const std::string below = keywords_below(capitals, schemas, width);
  if (!below.empty()) {
    const Schema* own = schemas.find(topic.starts_with('/') ? capitals : "/" + capitals);
    return own != nullptr ? explain_keyword(*own, {}, width) + "\n" + below : below;
  }
  if (keyword != nullptr && (topic.starts_with('/') || schemas.find("/" + capitals) != nullptr))
    return explain_keyword(*keyword, {}, width);
  if (std::string page = field_everywhere(topic, schemas, width); !page.empty()) return page;
  if (keyword == nullptr) keyword = header_named(schemas, topic);
  if (keyword != nullptr) return explain_keyword(*keyword, {}, width);
  return topic.starts_with('/') ? std::string() : messages_about(topic, schemas, width);
}

std::vector<std::string> similar_topics(std::string_view topic, const SchemaSet& schemas) {
  std::vector<std::string> rules;
  for (const Rule& r : all_rules()) {
    rules.emplace_back(id_text(r.id));
    rules.push_back(r.name);
  }
  if (const std::string rule = closest_word(topic, rules); !rule.empty()) return {rule};
  const std::string wanted =
      in_capitals(topic.substr(topic.find('.') == topic.npos ? 0 : topic.rfind('.') + 1));
  std::map<std::string, std::size_t> found;
  const auto consider = [&](const std::string& name) {
    const std::size_t d = edit_distance(wanted, in_capitals(name));
    if (d <= std::max<std::size_t>(1, wanted.size() / 3)) found.try_emplace(name, d);
  };
  for (const Schema* s : contacts_first(schemas)) {
    if (!s->keyword.starts_with("/INTER/")) continue;
    consider(s->keyword.substr(s->keyword.rfind('/') + 1));
    for (const CardSchema& card : s->cards)
      for (const Field& f : card.fields) consider(f.name);
  }
  for (const Schema* s : schemas.all()) consider(s->keyword);
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [name, d] : found) sorted.emplace_back(d, name);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::string> out;
  for (std::size_t i = 0; i < std::min<std::size_t>(sorted.size(), 3); ++i)
    out.push_back(sorted[i].second);
  return out;
}

}  // namespace deck
