// What `deck explain` can be asked: rules and families of rules, keywords, fields with or without
// their keyword, and messages of the reference solver by number or by words.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/text.hpp"

namespace deck {

/// Columns of a page where nothing says how many there are.
constexpr std::size_t usual_page_width = 92;

/// A line of a page: `head`, then `text` in the columns behind it.
std::string behind(const std::string& head, std::string_view text, std::size_t width);

/// The page about what a person typed, in any case: "DK254", "DK1", "/INTER/TYPE7", "TYPE7",
/// "TYPE7.Gapmin", "Gapmin", "611", "ERROR 611", "initial penetrations"; a number is that of a
/// message. Lines of tables are no longer than `width` (0: the usual). Empty: nothing is known.
std::string explain_topic(std::string_view topic, const SchemaSet& schemas, std::size_t width = 0);

/// The pages of deck/lint.hpp, as wide as `width` (0: the usual). Cards of examples are
/// continued on further lines only where a width is given. Of the fields of a rule those that
/// `selector` names.
std::string explain_rule(const Rule& rule, const SchemaSet& schemas, std::size_t width,
                         std::string_view selector = "all");
std::string explain_keyword(const Schema& schema, std::string_view field, std::size_t width);

/// Topics that are spelled nearly so, the nearest first; at most three.
std::vector<std::string> similar_topics(std::string_view topic, const SchemaSet& schemas);

/// Keywords, the four contacts that are evaluated first.
std::vector<const Schema*> contacts_first(const SchemaSet& schemas);

/// What a field is for and what the solver does with it, with figures; empty where no schema has a
/// text about it.
std::string field_help(const Field& field, const SchemaSet& schemas, std::size_t width = 0);

/// An entry of schemas/messages.
struct SolverMessage {
  int number = 0;
  Severity severity = Severity::error;
  std::string title;                ///< one line
  std::string means;                ///< what the solver found
  std::string action;               ///< what to do about it
  std::vector<std::string> called;  ///< words of the message itself that people search for
};

/// All that have an entry, by number. Parsed when first asked for; never changes.
const std::vector<SolverMessage>& solver_messages();
/// nullptr: no entry; a rule or a cell may know the number all the same.
const SolverMessage* find_solver_message(int number);

/// What is said of a message in one place: from its entry, else from the first rule that reports
/// it. Texts are empty where nothing is known.
struct MessageSummary {
  std::string title, means, action;
};
MessageSummary summary_of_message(int number);

/// The page of a message: its entry, the rules that report it, the cells it is about. Empty:
/// nothing is known.
std::string explain_message(int number, const SchemaSet& schemas, std::size_t width);

/// The number in "611", "ERROR 611" or "WARNING ID :    343", in any case; nullopt: it is none.
std::optional<int> message_number(std::string_view text);

/// The messages and rules that have all words of `text` in their titles or their wording, one line
/// each; numbers and small words do not count. Empty: there are none.
std::string messages_about(std::string_view text, std::size_t width);

}  // namespace deck
