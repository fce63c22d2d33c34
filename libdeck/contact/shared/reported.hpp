// What reports say of ties, contacts and other values for an interface.
#pragma once
#include <string>

#include "deck/contacts.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"

namespace deck {

/// Parses "ID:Gapmin=2,Inacti=6".
Result<WhatIf> parse_what_if(const std::string& text);
/// Refuses values that do not fit the interface's cells, and fields it does not have.
Result<void> check_what_if(const WhatIf& w, const InterBase& inter);

/// "3 of 412 nodes are not tied", "412 nodes are tied", "not evaluated: reason".
std::string tie_count_text(const Tie& tie);
/// The nodes that are not simply tied, by reason, for a table; "-": none.
std::string losses_text(const Tie& tie);

/// Reason or way of a node's tie: one sentence; or a few words for a table.
std::string why_text(const Tie& tie, const TiedNode& node);
std::string short_reason(const Tie& tie, const TiedNode& node);

/// Solver error for a node exactly on a segment: 611, 612, or 0 where the options avoid it.
int on_surface_error(const Contact& contact);

/// Relative difference below which two depths are equal: far above the round-off of reordered sums,
/// far below changes made by a person.
inline constexpr double same_depth = 1e-6;

}  // namespace deck
