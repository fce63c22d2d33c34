// Baselines: what is accepted of decks. A text file of one JSON object a line, sorted, so that a
// change of one deck is a change of its lines: of lint {"deck","rule","file","entity","field",
// "value"}, of gaps {"deck","interface","kind","ids","depth","gap"}. `kind` is the role of the
// contact, or "untied" for a node that a tie does not hold. Paths are relative to the file.
#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/lint.hpp"
#include "deck/text.hpp"

namespace deck {

inline constexpr std::uint64_t most_baseline_bytes = std::uint64_t{256} << 20;

/// How a file is called in a baseline that lies at `path`.
std::string name_in_baseline(const std::string& file, const std::string& path);

class Baseline {
 public:
  enum class Kind : std::uint8_t { lint, gaps };

  /// One without entries, which is to lie at `path`.
  Baseline(std::string path, Kind kind) : path_(std::move(path)), kind_(kind) {}
  /// Error: a line names no deck, or the text has the form of an earlier version; then with the
  /// command that writes it anew.
  static Result<Baseline> parse(std::string_view text, const std::string& path, Kind kind);
  /// True if the text is a baseline in the format of an earlier version. It cannot be read.
  static bool is_of_earlier_form(std::string_view text);

  const std::string& path() const { return path_; }
  bool has(const std::string& deck_path) const;
  /// The decks that have entries, by their names in the file.
  std::vector<std::string> decks() const;
  /// For LintOptions::baseline. Error: an entry of the deck is not one of lint.
  Result<AcceptedFindings> findings_of(const std::string& deck_path) const;
  /// Error: an entry of the deck is not one of gaps.
  Result<GapBaseline> gaps_of(const std::string& deck_path) const;

  /// Puts what was found in place of the entries of the deck; those of others stay. Findings of the
  /// gate are never accepted.
  void accept(const std::string& deck_path, const Deck& deck, const LintResult& result);
  void accept(const std::string& deck_path, const Scene& scene, const SceneView& view);
  /// Those that the other one has of this deck.
  void take(const std::string& deck_path, const Baseline& other);
  std::string text() const;

 private:
  using Lines = std::multiset<std::string>;
  const Lines& lines_of(const std::string& deck_path) const;
  Error wrong_entry(const std::string& line) const;

  std::string path_;
  Kind kind_;
  std::map<std::string, Lines> decks_;
};

}  // namespace deck
