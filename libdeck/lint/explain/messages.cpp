// Catalogue of solver messages, and the pages of `deck explain` for a number or words.
#include "lint/shared/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/shared/embedded.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "lint/check.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {
namespace solver_message {
namespace {

bool reports(const Rule& rule, int number) {
  return std::any_of(rule.messages.begin(), rule.messages.end(),
                     [&](const ReferenceMessage& m) { return m.number == number; });
}

/// True if a text names the message: "error 612", "warns (614)".
bool names(std::string_view text, int number) {
  const std::string digits = std::to_string(number);
  for (std::size_t at = text.find(digits); at != text.npos; at = text.find(digits, at + 1)) {
    const std::size_t end = at + digits.size();
    if (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0)) continue;
    if (end + 1 < text.size() && text[end] == '.' &&
        std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0)
      continue;
    const std::string_view before = text.substr(0, at);
    for (const std::string_view word :
         {"error ", "errors ", "warning ", "warnings ", "message ", "messages ", "("})
      if (before.ends_with(word)) return true;
  }
  return false;
}

std::string rules_of(int number, std::size_t width) {
  std::string out;
  for (const Rule& r : all_rules()) {
    const bool own = reports(r, number);
    if (!own && !names(r.solver, number) && !names(r.title, number)) continue;
    out += fmt::format("\n{}: {}\n", id_text(r.id), r.title);
    if (own)
      out += fmt::format("  deck lint reports this {} of the solver as {}\n",
                         r.message(number).severity == Severity::error ? "error" : "warning",
                         id_text(r.id));
    if (!r.problem.empty()) out += wrapped(r.problem, 2, width);
    if (!r.solver.empty()) out += wrapped("Solver: " + r.solver, 2, width);
    if (!r.fix.empty()) out += wrapped("Fix: " + r.fix, 2, width);
  }
  return out;
}

std::string cells_of(int number, const SchemaSet& schemas, std::size_t width) {
  std::string out;
  for (const Schema* s : contacts_first(schemas)) {
    for (const detail::Limit* limit : detail::limits_of(*s))
      if (limit->message.number == number)
        out += wrapped(fmt::format("{}{}{}: {}", s->keyword, limit->field.empty() ? "" : ".",
                                   limit->field, limit->says.empty() ? "its value" : limit->says),
                       2, width);
    for (const CardSchema& card : s->cards)
      for (const Field& f : card.fields) {
        const auto says = [&](const std::optional<int>& n, const char* why) {
          if (n && *n == number)
            out += wrapped(fmt::format("{}.{}: {}", s->keyword, f.name, why), 2, width);
        };
        says(f.missing, "the named entity does not exist");
        says(f.empty, "the named entity has no members");
        says(f.required, "the cell is 0 or blank");
      }
  }
  return out;
}

/// Searchable words of a text in lower case, without a plural s.
std::set<std::string> words_of(std::string_view text) {
  static const std::set<std::string> small = {"there", "are", "is",    "in",      "of",  "the",
                                              "a",     "an",  "and",   "or",      "to",  "id",
                                              "error", "for", "where", "warning", "with"};
  std::set<std::string> out;
  std::string word;
  const auto end = [&] {
    if (small.contains(word)) word.clear();
    if (word.size() > 3 && word.back() == 's') word.pop_back();
    if (!word.empty() && word.find_first_not_of("0123456789") != word.npos) out.insert(word);
    word.clear();
  };
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0)
      word += static_cast<char>(std::tolower(byte));
    else
      end();
  }
  end();
  return out;
}

std::string list_line(std::string_view name, const char* severity, const std::string& title,
                      std::size_t width) {
  return behind(fmt::format("  {:<8} {:<7} ", name, severity), title, width);
}

}  // namespace
}  // namespace solver_message

const std::vector<SolverMessage>& solver_messages() {
  static const std::vector<SolverMessage> messages = [] {
    std::vector<SolverMessage> out;
    for (const detail::EmbeddedFile& file : detail::embedded_messages()) {
      const auto json = nlohmann::json::parse(file.text);
      for (const auto& entry : json.at("messages")) {
        SolverMessage m;
        m.number = entry.at("number").get<int>();
        m.severity = *severity_of(entry.at("severity").get<std::string>());
        m.title = entry.at("title").get<std::string>();
        m.means = entry.at("means").get<std::string>();
        m.action = entry.at("do").get<std::string>();
        m.called = entry.value("called", std::vector<std::string>());
        out.push_back(std::move(m));
      }
    }
    std::sort(out.begin(), out.end(),
              [](const SolverMessage& a, const SolverMessage& b) { return a.number < b.number; });
    return out;
  }();
  return messages;
}

const SolverMessage* find_solver_message(int number) {
  const auto& all = solver_messages();
  const auto it =
      std::lower_bound(all.begin(), all.end(), number,
                       [](const SolverMessage& m, int wanted) { return m.number < wanted; });
  return it != all.end() && it->number == number ? &*it : nullptr;
}

MessageSummary summary_of_message(int number) {
  if (const SolverMessage* m = find_solver_message(number)) return {m->title, m->means, m->action};
  for (const Rule& r : all_rules())
    if (solver_message::reports(r, number)) return {r.title, r.problem, r.fix};
  for (const detail::Limit& limit : detail::all_limits())
    if (limit.message.number == number)
      return {fmt::format("{}{}{}", limit.keyword, limit.field.empty() ? "" : ".", limit.field),
              limit.says, limit.fix};
  return {};
}

std::string explain_message(int number, const SchemaSet& schemas, std::size_t width) {
  if (number <= 0) return {};
  if (width == 0) width = usual_page_width;
  const SolverMessage* own = find_solver_message(number);
  const std::string rules = solver_message::rules_of(number, width);
  const std::string cells = solver_message::cells_of(number, schemas, width);
  if (own == nullptr && rules.empty() && cells.empty()) return {};
  std::string out = fmt::format("Message {} of the reference solver", number);
  if (own != nullptr)
    out += fmt::format(" ({}): {}\n", to_string(own->severity), own->title) +
           wrapped(own->means, 2, width) + wrapped("What to do: " + own->action, 2, width);
  else
    out += "\n";
  out += rules;
  if (!cells.empty()) out += "\nCells with this message\n" + cells;
  return out;
}

std::optional<int> message_number(std::string_view text) {
  std::string capitals = in_capitals(text);
  std::size_t at = 0;
  const auto skip = [&](std::string_view word) {
    const std::string_view rest = std::string_view(capitals).substr(at);
    if (rest.starts_with(word)) at += word.size();
    at = std::min(capitals.find_first_not_of(" :*", at), capitals.size());
  };
  skip("");
  for (const char* word : {"ERROR", "WARNING", "MESSAGE", "INFO", "ID"}) skip(word);
  std::string_view digits = std::string_view(capitals).substr(at);
  digits = digits.substr(0, digits.find_last_not_of(' ') + 1);
  if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != digits.npos)
    return std::nullopt;
  return static_cast<int>(read_integer(digits).value);
}

std::string messages_about(std::string_view text, const SchemaSet& schemas, std::size_t width) {
  if (width == 0) width = usual_page_width;
  const std::set<std::string> wanted = solver_message::words_of(text);
  if (wanted.empty()) return {};
  const auto fits = [&](const std::string& what) {
    const std::set<std::string> has = solver_message::words_of(what);
    return std::includes(has.begin(), has.end(), wanted.begin(), wanted.end());
  };
  std::string messages, rules, fields, first;
  for (const SolverMessage& m : solver_messages()) {
    std::string all = m.title;
    for (const std::string& words : m.called) all += " " + words;
    if (!fits(all)) continue;
    const std::string number = std::to_string(m.number);
    if (first.empty()) first = number;
    messages += solver_message::list_line(number, to_string(m.severity), m.title, width);
  }
  for (const Rule& r : all_rules()) {
    if (!fits(r.title)) continue;
    if (first.empty()) first = id_text(r.id);
    rules += solver_message::list_line(id_text(r.id), to_string(r.severity()), r.title, width);
  }
  std::set<std::string> known;  // the first that has a field of a name stands for all
  for (const Schema* s : contacts_first(schemas))
    for (const CardSchema& card : s->cards)
      for (const Field& f : card.fields)
        if (fits(fmt::format("{} {} {}", f.name, f.doc, fmt::join(f.help, " "))) &&
            known.insert(f.name).second && known.size() <= 12)
          fields += behind(fmt::format("  {:<13}", f.name), f.doc, width);
  if (first.empty() && !known.empty()) first = *known.begin();
  std::string out;
  if (!messages.empty()) out += "Messages of the reference solver with these words\n\n" + messages;
  if (!rules.empty())
    out += (out.empty() ? "" : "\n") + std::string("Rules with these words\n\n") + rules;
  if (!fields.empty())
    out += (out.empty() ? "" : "\n") + std::string("Fields with these words\n\n") + fields;
  if (!out.empty()) out += "\nShow one of them: deck explain " + first + "\n";
  return out;
}

}  // namespace deck
