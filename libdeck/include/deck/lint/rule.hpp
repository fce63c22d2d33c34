// What the lint stage does with rules: selectors of the command line and the configuration, and the
// pages of `deck explain`.
#pragma once
#include <string>
#include <string_view>

#include "deck/keyword/schema.hpp"
#include "deck/text/rule.hpp"

namespace deck {

/// Family of a rule by the leading digit of its id: "syntax, columns, version" for DK0xx, and so
/// on.
std::string_view family_of(RuleId id);
/// True if `selector` names the finding: "all", an id ("DK104") or its beginning ("DK1"), a field
/// of a rule ("DK201:Igap"), or the id that this field had as a rule of its own ("DK202").
bool selects(std::string_view selector, RuleId id, std::string_view field = {});
/// True if the selector names a finding that a rule can have.
bool known_selector(std::string_view selector);
/// "DK202 is now DK201:Igap", for the id of a rule that has become the field of another one; empty
/// for every other selector.
std::string renamed_selector(std::string_view selector);

/// The explain page of a rule as plain text.
std::string explain_rule(const Rule& rule, const SchemaSet& schemas);
/// The page of a keyword, or of one of its fields if `field` is not empty: columns per version,
/// type, legal values, default, dimension, notes. Empty string: no such field.
std::string explain_keyword(const Schema& schema, std::string_view field = {});

}  // namespace deck
