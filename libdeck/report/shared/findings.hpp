// Writers of lint results: text, JSON, SARIF, JUnit, GitHub and GitLab.
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
  const Deck* deck = nullptr;  ///< nullptr: unreadable
  const LintResult* result = nullptr;
  std::string error;                       ///< reason if unreadable
  const Interfaces* interfaces = nullptr;  ///< nullptr: not built, so omissions are unknown
  const Deck* of_interfaces = nullptr;     ///< deck of these interfaces, if not `deck`
  std::optional<Verdict> verdict = {};     ///< nullopt: none was made
};

/// Verdict of lint on a deck. `contacts`: result of its geometry; `contacts_left_out`: too many for
/// a quick check.
Verdict lint_verdict(const LintedDeck& deck, std::optional<ContactFacts> contacts = {},
                     bool contacts_left_out = false);

/// The given verdict, else that of its findings.
inline Verdict verdict_of(const LintedDeck& deck) {
  return deck.verdict ? *deck.verdict : lint_verdict(deck);
}

struct HumanOptions {
  bool color = false;
  bool ruler = false;                 ///< a line with column numbers above the card
  int per_rule = 10;                  ///< findings shown per rule, 0: all
  bool group = true;                  ///< more than three per rule: the first in full, then places
  bool remarks_of_every_deck = true;  ///< remarks of nearly every deck with a contact
  bool quiet = false;                 ///< findings only, without summary and "not checked"
  std::size_t width = 0;              ///< columns of a line; 0: any, but card lines are cut
};

/// rustc-like text.
std::string lint_human(const std::vector<LintedDeck>& decks, const HumanOptions& options);
/// One line per finding: "file:line:column: DK171 error: message".
std::string lint_concise(const std::vector<LintedDeck>& decks);
/// One line per rule over all decks: number of findings, number fixable.
std::string lint_statistics(const std::vector<LintedDeck>& decks, bool color = false,
                            std::size_t width = 0);
/// The JSON of `deck lint --format json`: one document, or a list under "decks" for several.
std::string lint_json(const std::vector<LintedDeck>& decks);
/// SARIF 2.1.0 with every rule in the driver. Files below `source_root` (absolute top of a work
/// tree) are named relative to it, as on GitHub and GitLab; without it as given.
std::string lint_sarif(const std::vector<LintedDeck>& decks, const SchemaSet& schemas,
                       const std::string& source_root = {});
/// Workflow commands (::error file=…), worst first.
std::string lint_github(const std::vector<LintedDeck>& decks, const std::string& source_root = {});
std::string lint_junit(const std::vector<LintedDeck>& decks);
/// GitLab code quality.
std::string lint_gitlab(const std::vector<LintedDeck>& decks, const std::string& source_root = {});

/// All rules: a table with lines of at most `width` columns (0: any), and JSON.
std::string rules_table(bool color, std::size_t width = 0);
std::string rules_json();

namespace detail {

/// 1-based place of a span; without span: line 1, column 1 of the deck.
struct Place {
  std::string file;
  std::uint64_t line = 1, column = 1, end_column = 1;
  bool known = false;
  /// "car.rad:3:1", or the file only.
  std::string text() const;
};
Place place_of(const LintedDeck& deck, const Span& span);

/// "Fix: ..." and the solver's behaviour as sentences, for formats without such fields.
std::string details(const Finding& d);
/// Root of file names on a forge: top of a work tree. Empty: files as given.
class SourceRoot {
 public:
  explicit SourceRoot(std::string root) : root_(std::move(root)) {}
  const std::string& path() const { return root_; }
  /// Files below the root relative to it, with forward slashes; others by absolute path; standard
  /// input as "-".
  std::string place(std::string_view file) const;

 private:
  std::string root_;
};

/// Coverage of the contact rules; nullopt without interfaces.
std::optional<Coverage> coverage_of(const LintedDeck& linted);

}  // namespace detail

}  // namespace deck
