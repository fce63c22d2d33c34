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

/// Of "error", "warning" and "info".
std::optional<Severity> severity_of(std::string_view text);

/// Rules of a team are X001 to X999; their RuleId has no enumerator and is this plus the number.
inline constexpr int first_team_id = 1000;
constexpr bool is_team_rule(RuleId id) { return id_number(id) >= first_team_id; }

/// Where a page has the value of a key, by case (0: of the page) and key; a section, by its
/// heading.
using PagePlaces = std::map<std::pair<std::size_t, std::string>, Position>;

/// A page of a team.
struct RulePage {
  std::string path;
  Rule rule;
  PagePlaces places;
  /// "rules/X101.md:7:4: what", of a key or section.
  std::string problem(const std::string& key, const std::string& what, std::size_t of = 0) const;
};

/// As long as the result lives, all_rules() of this thread, and all that goes by it, has the rules
/// of these pages as well.
[[nodiscard]] std::shared_ptr<void> use_rules(const std::vector<RulePage>& own);

}  // namespace deck

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

/// Of "error 497"; nullopt: not of that form.
std::optional<ReferenceMessage> reference_message(std::string_view text);

/// What the solver does, with the message in front of the last full stop: "It stops (error 79)."
std::string with_message(std::string text, const std::optional<ReferenceMessage>& message);

/// The rule of the page `name` ("DK203.md"); an error says line and column, what was read and what
/// was expected. In a page of a team (X101) every section may be absent.
Result<Rule> parse_rule_page(std::string_view name, std::string_view text,
                             PagePlaces* places = nullptr);

}  // namespace deck::detail
