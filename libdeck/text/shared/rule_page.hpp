// The form of a page in schemas/rules. Private to the library.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/text.hpp"

namespace deck {

/// Severity of "error", "warning" and "info".
std::optional<Severity> severity_of(std::string_view text);

/// Rules X001 to X999 of a team have this plus their number as RuleId, without enumerator.
inline constexpr int first_team_id = 1000;
constexpr bool is_team_rule(RuleId id) { return id_number(id) >= first_team_id; }

/// Positions of values by case (0: page) and key, and of sections by heading.
using PagePlaces = std::map<std::pair<std::size_t, std::string>, Position>;

/// A rule page of a team.
struct RulePage {
  std::string path;
  Rule rule;
  PagePlaces places;
  /// "rules/X101.md:7:4: what" for a key or section.
  std::string problem(const std::string& key, const std::string& what, std::size_t of = 0) const;
};

/// Adds the rules of these pages to all_rules() of this thread for the lifetime of the result.
[[nodiscard]] std::shared_ptr<void> use_rules(const std::vector<RulePage>& own);

}  // namespace deck

namespace deck::detail {

/// Headings of a page, in the order of the page and of `deck explain`.
namespace heading {
inline constexpr std::string_view problem = "What is wrong";
inline constexpr std::string_view why = "Why it matters";
inline constexpr std::string_view solver = "What the reference solver does";
inline constexpr std::string_view source = "Known from";  ///< shown by `deck explain` only
inline constexpr std::string_view fix = "How to fix";
inline constexpr std::string_view bad = "Fires on";
inline constexpr std::string_view good = "Stays silent on";
inline constexpr std::string_view ignore = "When to ignore";
}  // namespace heading

/// Parses "error 497"; nullopt: another form.
std::optional<ReferenceMessage> reference_message(std::string_view text);

/// Adds the message before the last full stop: "It stops (error 79)."
std::string with_message(std::string text, const std::optional<ReferenceMessage>& message);

/// Parses the page `name` ("DK203.md"). Errors have line, column, text read and text expected.
/// Pages of a team (X101) may lack any section.
Result<Rule> parse_rule_page(std::string_view name, std::string_view text,
                             PagePlaces* places = nullptr);

}  // namespace deck::detail
