// Baselines: accepted findings of decks. Text file with one JSON object per line, sorted, so that
// each deck has its own lines. lint: {"deck","rule","file","entity","field", "value"}; gaps:
// {"deck","interface","kind","ids","depth","gap"}. `kind`: role of the contact, or "untied" for an
// untied node. Paths are relative to the file.
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

/// Name of a file in a baseline at `path`.
std::string name_in_baseline(const std::string& file, const std::string& path);

class Baseline {
 public:
  enum class Kind : std::uint8_t { lint, gaps };

  /// An empty baseline for `path`.
  Baseline(std::string path, Kind kind) : path_(std::move(path)), kind_(kind) {}
  /// Error: a line without a deck, or an earlier format (with the command that writes a new one).
  static Result<Baseline> parse(std::string_view text, const std::string& path, Kind kind);
  /// True for the format of an earlier version, which cannot be read.
  static bool is_of_earlier_form(std::string_view text);

  const std::string& path() const { return path_; }
  bool has(const std::string& deck_path) const;
  /// Names of the decks with entries.
  std::vector<std::string> decks() const;
  /// For LintOptions::baseline. Error: an entry of the deck is not from lint.
  Result<AcceptedFindings> findings_of(const std::string& deck_path) const;
  /// Error: an entry of the deck is not from gaps.
  Result<GapBaseline> gaps_of(const std::string& deck_path) const;

  /// Replaces the entries of the deck by these findings; keeps those of other decks. Gate findings
  /// are never accepted.
  void accept(const std::string& deck_path, const Deck& deck, const LintResult& result);
  void accept(const std::string& deck_path, const Scene& scene, const SceneView& view);
  /// Replaces the entries of this deck by those of `other`.
  void replace_deck(const std::string& deck_path, const Baseline& other);
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
