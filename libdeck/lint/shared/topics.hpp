// What `deck explain` can be asked: rules and families of rules, keywords, fields with or without
// their keyword, and messages of the reference solver by number or by words.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/schema.hpp"
#include "deck/text/rule.hpp"

namespace deck {

/// Columns of a page where nothing says how many there are.
constexpr std::size_t usual_page_width = 92;

/// The page about what a person typed, in any case: "DK254", "DK1", "/INTER/TYPE7", "TYPE7",
/// "TYPE7.Gapmin", "Gapmin", "611", "ERROR 611",
/// "initial penetrations"; a number that is a message and a rule gives both. Lines of tables are no
/// longer than `width` (0: the usual). Empty: nothing is known.
std::string explain_topic(std::string_view topic, const SchemaSet& schemas, std::size_t width = 0);

/// The pages of deck/lint/rule.hpp, as wide as `width` (0: the usual). Cards of examples are
/// continued on further lines only where a width is given. Of the fields of a rule those that
/// `selector` names.
std::string explain_rule(const Rule& rule, const SchemaSet& schemas, std::size_t width,
                         std::string_view selector = "all");
std::string explain_keyword(const Schema& schema, std::string_view field, std::size_t width);

/// Topics that are spelled nearly so, the nearest first; at most three.
std::vector<std::string> similar_topics(std::string_view topic, const SchemaSet& schemas);

/// What completion offers: rules, and contact keywords with their fields.
std::vector<std::string> common_topics(const SchemaSet& schemas);

/// Keywords, the four contacts that are evaluated first.
std::vector<const Schema*> contacts_first(const SchemaSet& schemas);

/// What a field is for and what the solver does with it, with figures; empty where no schema has a
/// text about it.
std::string field_help(const Field& field, const SchemaSet& schemas, std::size_t width = 0);

}  // namespace deck
