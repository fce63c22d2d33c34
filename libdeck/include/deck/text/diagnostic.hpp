// Diagnostic: one finding about the input, with its place. Everything the library has to say about
// a deck is one of these; printing them is somebody else's job.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/source.hpp"

namespace deck {

enum class Severity : std::uint8_t { error, warning, info };

/// Replace the bytes of `span` by `text`. An empty span inserts.
struct TextEdit {
  Span span;
  std::string text;
};

/// A proposed repair. Safe fixes keep what the reference solver does with the deck.
struct Fix {
  std::string title;
  bool safe = false;
  std::vector<TextEdit> edits;
};

/// The reference solver's own message for the same finding.
struct ReferenceMessage {
  int number = 0;
  Severity severity = Severity::error;
};

struct Diagnostic {
  std::string_view rule;  ///< stable id, e.g. "DK104"; points to a string literal
  Severity severity = Severity::error;
  Span span;
  std::string message;              ///< what was read and what was expected
  std::string reference_behaviour;  ///< what the reference solver does with it
  std::string help;                 ///< how to fix it
  std::optional<ReferenceMessage> reference;
  std::string keyword;  ///< entity the finding is about, e.g. "/INTER/TYPE7"; may be empty
  std::int64_t id = 0;
  std::vector<std::pair<Span, std::string>> notes;  ///< related places
  std::optional<Fix> fix;
};

/// Collects diagnostics with a bound per rule: a million broken lines cost a million counts, not a
/// million messages.
class Diagnostics {
 public:
  explicit Diagnostics(int per_rule = Limits{}.diagnostics_per_rule) : per_rule_(per_rule) {}

  /// Counts one finding of `rule`; true while it is worth forming the message for add().
  bool wants(std::string_view rule);
  /// Keeps a diagnostic for which wants() said true.
  Diagnostic& add(Diagnostic d);
  /// wants() and add() in one step, for rare findings.
  void report(Diagnostic d);
  /// Counts `n` further findings of `rule` without messages.
  void count(std::string_view rule, std::uint64_t n);
  /// True if wants() would say false.
  bool saturated(std::string_view rule) const;
  /// Adds what another collector (of a parallel part) has found.
  void merge(Diagnostics&& other);

  const std::vector<Diagnostic>& all() const { return kept_; }
  std::vector<Diagnostic>& all() { return kept_; }
  /// Findings per rule, kept or not.
  const std::map<std::string_view, std::uint64_t>& counts() const { return counts_; }
  std::uint64_t dropped(std::string_view rule) const;

 private:
  int per_rule_;
  std::vector<Diagnostic> kept_;
  std::map<std::string_view, std::uint64_t> counts_;
};

}  // namespace deck
