// Pages of rules held against the fields that there are. Private to the lint stage and the build.
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

/// Reports where the predicates of cells on the page of the rule are true. Reads them anew, which
/// takes less than looking at one interface; read_rule_page() lets only pages pass that can be
/// read.
void check_cells(const LintContext& context, const Rule& rule, Reporter& reporter);

/// The schema of a keyword; nullptr: there is none.
using FindSchema = std::function<const Schema*(const std::string& keyword)>;

/// A page whose conditions and texts name fields that there are. Error: place, what was read, what
/// was expected. The build reads schemas/rules with it, and read_rules() the pages of a team.
Result<RulePage> read_rule_page(const std::string& path, std::string_view text,
                                const FindSchema& find);

}  // namespace deck::detail
