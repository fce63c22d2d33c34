// Rule pages checked against the schemas. Private to the lint stage and the build.
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "deck/keyword.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {
class LintContext;
class Reporter;
}  // namespace deck

namespace deck::detail {

/// Reports where the predicates on the rule's page are true. Parses them at each call, which is
/// faster than visiting one interface; read_rule_page() accepts only valid pages.
void check_cells(const LintContext& context, const Rule& rule, Reporter& reporter);

/// Returns the schema of a keyword; nullptr: none.
using FindSchema = std::function<const Schema*(const std::string& keyword)>;

/// Reads a page and checks its field names. Error: place, text read, text expected. Used by the
/// build for schemas/rules and by read_rules() for team pages.
Result<RulePage> read_rule_page(const std::string& path, std::string_view text,
                                const FindSchema& find);

}  // namespace deck::detail
