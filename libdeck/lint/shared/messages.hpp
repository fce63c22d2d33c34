// Messages of the reference solver by their numbers: what each means and what to do about it, and
// the rules and cells that report the same.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/schema.hpp"
#include "deck/text/diagnostic.hpp"

namespace deck {

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
