// How the contact decisions of a scene were taken, for the reports of gaps and cycle. Private to
// the report stage.
#pragma once
#include <string>

#include "deck/contact/scene.hpp"
#include "report/shared/json.hpp"

namespace deck {

/// Where the solver's arithmetic decides otherwise about contact, or with `always`: one sentence,
/// and a table of the first `rows` differences, fitted to `width`. Else "".
std::string decisions_text(const Scene& scene, std::size_t rows, bool always, bool color,
                           std::size_t width);

}  // namespace deck
