// The member "ties" of deck/gaps documents.
#pragma once
#include "deck/contact/scene.hpp"
#include "report/shared/json.hpp"

namespace deck::detail {

/// `all`: every secondary node; else those that are not tied, or tied from outside their segment.
void write_ties(JsonWriter& json, const Scene& scene, bool all);

}  // namespace deck::detail
