// Writers of lint results: for people, and for the machines that read JSON, SARIF, JUnit, GitHub
// and GitLab. Pure functions from results to text.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/lint.hpp"
#include "deck/model.hpp"
#include "deck/verdict.hpp"

namespace deck {

/// One deck with its findings.
struct LintedDeck {
  std::string path;            ///< as given
  const Deck* deck = nullptr;  ///< nullptr: could not be read
  const LintResult* result = nullptr;
  std::string error;  ///< why it could not be read
  const Interfaces* interfaces =
      nullptr;                          ///< nullptr: not formed, so nothing says what was left out
  const Deck* of_interfaces = nullptr;  ///< whose blocks they are of, where it is not `deck`
  std::optional<Verdict> verdict = {};  ///< nullopt: none was made
};

/// What lint says of a deck. `contacts`: what its geometry found; `contacts_left_out`: they were
/// too many for a quick look.
Verdict lint_verdict(const LintedDeck& deck, std::optional<ContactFacts> contacts = {},
                     bool contacts_left_out = false);

/// The verdict that was made, else that of its findings.
inline Verdict verdict_of(const LintedDeck& deck) {
  return deck.verdict ? *deck.verdict : lint_verdict(deck);
}

struct HumanOptions {
  bool color = false;
  bool ruler = false;                 ///< a line with column numbers above the card
  int per_rule = 10;                  ///< findings shown per rule, 0: all
  bool group = true;                  ///< more than three of a rule: the first in full, then places
  bool remarks_of_every_deck = true;  ///< what nearly every deck with a contact has
  bool quiet = false;                 ///< only the findings, no summary and no "not checked"
  std::size_t width = 0;  ///< columns of a line; 0: any, card lines are cut all the same
};

/// rustc-like text.
std::string lint_human(const std::vector<LintedDeck>& decks, const HumanOptions& options);
/// One line a finding: "file:line:column: DK171 error: message".
std::string lint_concise(const std::vector<LintedDeck>& decks);
/// One line a rule over all decks: how many findings, how many of them have a fix.
std::string lint_statistics(const std::vector<LintedDeck>& decks, bool color = false,
                            std::size_t width = 0);
/// The JSON of `deck lint --format json`; one document for one deck, a list under "decks" for more.
std::string lint_json(const std::vector<LintedDeck>& decks);
/// SARIF 2.1.0 with every rule in the driver. With `source_root` (the top of a work tree, absolute)
/// files below it are named relative to it, as forges know them; without it as they were given.
std::string lint_sarif(const std::vector<LintedDeck>& decks, const SchemaSet& schemas,
                       const std::string& source_root = {});
/// Workflow commands (::error file=…), worst first.
std::string lint_github(const std::vector<LintedDeck>& decks, const std::string& source_root = {});
std::string lint_junit(const std::vector<LintedDeck>& decks);
/// GitLab code quality.
std::string lint_gitlab(const std::vector<LintedDeck>& decks, const std::string& source_root = {});

/// All rules: a table whose lines have at most `width` columns (0: any), and JSON.
std::string rules_table(bool color, std::size_t width = 0);
std::string rules_json();

namespace detail {

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
std::string details(const Finding& d);
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

}  // namespace detail

}  // namespace deck
