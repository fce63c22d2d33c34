// What `deck gaps` says of ties: a table of interfaces, and one of the nodes that are not tied.
#pragma once
#include <string>

#include "deck/keyword/deck.hpp"
#include "deck/report/gaps.hpp"

namespace deck::detail {

/// One row an interface; those that lose nothing in one line, unless `verbose`. Empty: no ties.
std::string tie_table(const Scene& scene, const GapsTextOptions& options);
/// Nodes that are not tied: which segment is nearest, how far it is, how far the solver looks.
std::string untied_text(const Deck& deck, const Scene& scene, const GapsTextOptions& options);

}  // namespace deck::detail
