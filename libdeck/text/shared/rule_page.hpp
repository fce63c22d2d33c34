// The form of a page in schemas/rules. Private to the library.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "deck/text.hpp"

namespace deck::detail {

/// Headings of a page, in the order in which they stand there and in `deck explain`.
namespace heading {
inline constexpr std::string_view problem = "What is wrong";
inline constexpr std::string_view why = "Why it matters";
inline constexpr std::string_view solver = "What the reference solver does";
inline constexpr std::string_view source = "Known from";  ///< in `deck explain` only
inline constexpr std::string_view fix = "How to fix";
inline constexpr std::string_view bad = "Fires on";
inline constexpr std::string_view good = "Stays silent on";
inline constexpr std::string_view ignore = "When to ignore";
}  // namespace heading

/// What the solver does, with the message in front of the last full stop: "It stops (error 79)."
std::string with_message(std::string text, const std::optional<ReferenceMessage>& message);

/// The rule of the page `name` ("DK203.md"); an error says the line that breaks the form.
Result<Rule> parse_rule_page(std::string_view name, std::string_view text);

}  // namespace deck::detail
