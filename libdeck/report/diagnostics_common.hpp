// What the writers of lint results share. Private to the report stage.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "deck/model/interfaces.hpp"
#include "report/shared/diagnostics.hpp"

namespace deck::detail {

/// 1-based place of a span; a finding without a place is at line 1, column 1 of the deck.
struct Place {
  std::string file;
  std::uint64_t line = 1, column = 1, end_column = 1;
  bool known = false;
  /// "car.rad:3:1", or the file alone.
  std::string text() const;
};
Place place_of(const LintedDeck& deck, const Span& span);

/// "Fix: ..." and what the reference solver does, as sentences for formats without own fields.
std::string details(const Diagnostic& d);
/// The directory that a forge knows files by: the top of a work tree. Empty: files as given.
class SourceRoot {
 public:
  explicit SourceRoot(std::string root) : root_(std::move(root)) {}
  const std::string& path() const { return root_; }
  /// A file below the root relative to it, with forward slashes; any other one by its absolute
  /// path; standard input as "-".
  std::string place(std::string_view file) const;

 private:
  std::string root_;
};

/// What the contact rules covered; nullopt where no interfaces were formed.
std::optional<Coverage> coverage_of(const LintedDeck& linted);

}  // namespace deck::detail
