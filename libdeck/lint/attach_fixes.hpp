// Repairs for findings of the reading stage, which knows nothing of edits. Private to the lint
// stage.
#pragma once
#include "deck/lint/lint.hpp"

namespace deck::detail {

/// Gives `d` a fix where its rule has a mechanical one and it has none yet.
void attach_fix(const LintContext& context, Diagnostic& d);

}  // namespace deck::detail
