// Topics of `deck explain`: rules and families, keywords, fields, solver messages by number or
// words.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/text.hpp"

namespace deck {

/// Default width of a page in columns.
constexpr std::size_t usual_page_width = 92;

/// A line of a page: `head`, then `text` in the columns after it.
std::string behind(const std::string& head, std::string_view text, std::size_t width);

/// The page for user input in any case: "DK254", "DK1", "/INTER/TYPE7", "TYPE7", "TYPE7.Gapmin",
/// "Gapmin", "611", "ERROR 611", "initial penetrations"; numbers are messages. `width`: largest
/// line length of tables (0: default). Empty: unknown topic.
std::string explain_topic(std::string_view topic, const SchemaSet& schemas, std::size_t width = 0);

/// Pages of deck/lint.hpp with a width (0: default). Example cards are folded only with a width.
/// `selector`: fields of the rule to show.
std::string explain_rule(const Rule& rule, const SchemaSet& schemas, std::size_t width,
                         std::string_view selector = "all");
std::string explain_keyword(const Schema& schema, std::string_view field, std::size_t width);

/// Topics with a similar spelling, nearest first; at most three.
std::vector<std::string> similar_topics(std::string_view topic, const SchemaSet& schemas);

/// Keywords, the evaluated contacts first.
std::vector<const Schema*> contacts_first(const SchemaSet& schemas);

/// Purpose of a field and solver behaviour, with figures; empty: no text.
std::string field_help(const Field& field, const SchemaSet& schemas, std::size_t width = 0);

/// An entry of schemas/messages.
struct SolverMessage {
  int number = 0;
  Severity severity = Severity::error;
  std::string title;                ///< one line
  std::string means;                ///< meaning for the deck
  std::string action;               ///< advice
  std::vector<std::string> called;  ///< words of the message that people search for
};

/// All entries by number. Parsed at the first call, then constant.
const std::vector<SolverMessage>& solver_messages();
/// nullptr: no entry; rules or cells may still know the number.
const SolverMessage* find_solver_message(int number);

/// Summary of a message: from its entry, else from the first rule that reports it. Unknown texts
/// are empty.
struct MessageSummary {
  std::string title, means, action;
};
MessageSummary summary_of_message(int number);

/// The page of a message: entry, rules that report it, related cells. Empty: unknown.
std::string explain_message(int number, const SchemaSet& schemas, std::size_t width);

/// The number in "611", "ERROR 611" or "WARNING ID :    343", in any case; nullopt: none.
std::optional<int> message_number(std::string_view text);

/// Messages, rules and fields with all words of `text` in title, text or help, one line each;
/// numbers and short words are ignored. Empty: none.
std::string messages_about(std::string_view text, const SchemaSet& schemas, std::size_t width);

}  // namespace deck
