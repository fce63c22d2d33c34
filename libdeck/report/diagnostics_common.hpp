// What the writers of lint results share. Private to the report stage.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "deck/model/coverage.hpp"
#include "deck/report/diagnostics.hpp"

namespace deck::detail {

/// 1-based place of a span; a finding without a place is at line 1, column 1 of the deck.
struct Place {
  std::string file;
  std::uint64_t line = 1, column = 1, end_column = 1;
  bool known = false;
};
Place place_of(const LintedDeck& deck, const Span& span);

const char* severity_name(Severity severity);
/// "Fix: ..." and what the reference solver does, as sentences for formats without own fields.
std::string details(const Diagnostic& d);
/// Path as SARIF and GitHub want it: relative, with forward slashes, no "./".
std::string relative_path(std::string_view path);

/// What the contact rules covered; nullopt where no interfaces were formed.
std::optional<Coverage> coverage_of(const LintedDeck& linted);

}  // namespace deck::detail
