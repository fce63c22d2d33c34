// Diagnostic: one finding about the input, with its place. Everything the library has to say about
// a deck is one of these; they are printed elsewhere.
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
/// "error", "warning", "info": the words of all outputs and of the configuration.
constexpr const char* to_string(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

/// Id of a rule: RuleId::DK104 is defined in deck/text/rule_id.hpp, which grows with every rule.
enum class RuleId : std::uint16_t;
/// "DK104"; empty for RuleId::none.
std::string_view id_text(RuleId id);
/// 104: the leading digits say what a rule is about.
constexpr int id_number(RuleId id) { return static_cast<int>(id); }

/// Replace the bytes of `span` by `text`. An empty span inserts.
struct TextEdit {
  Span span;
  std::string text;
};

/// A proposed repair. Safe fixes keep what the reference solver does with the deck; that of DK511
/// alone gives values back the effect that the deck states.
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
  RuleId rule{};      ///< stable
  std::string field;  ///< of a rule about several fields: which one ("Istf"); else empty
  Severity severity = Severity::error;
  Span span;
  std::string message;              ///< what was read and what was expected
  std::string reference_behaviour;  ///< what the reference solver does with it
  std::string help;                 ///< how to fix it
  std::optional<ReferenceMessage> reference;
  std::string keyword;  ///< entity the finding is about, e.g. "/INTER/TYPE7"; may be empty
  std::int64_t id = 0;
  /// How bad it is, where a number says so: larger is worse. A baseline accepts no more than it
  /// has.
  std::optional<double> amount = {};
  std::vector<std::pair<Span, std::string>> notes;  ///< related places
  std::optional<Fix> fix;
};
/// What a finding is called, and what selects it: "DK104", with its field "DK201:Istf".
std::string finding_name(const Diagnostic& diagnostic);

/// Collects diagnostics with a bound per rule: a million broken lines cost a million counts, not a
/// million messages.
class Diagnostics {
 public:
  explicit Diagnostics(int per_rule = Limits{}.diagnostics_per_rule) : per_rule_(per_rule) {}

  /// Counts one finding of `rule`; true while it is worth forming the message for add().
  bool wants(RuleId rule);
  /// Keeps a diagnostic for which wants() said true.
  Diagnostic& add(Diagnostic d);
  /// wants() and add() in one step, for rare findings.
  void report(Diagnostic d);
  /// Counts `n` further findings of `rule` without messages.
  void count(RuleId rule, std::uint64_t n);
  /// True if wants() would say false.
  bool saturated(RuleId rule) const;
  /// Adds what another collector (of a parallel part) has found.
  void merge(Diagnostics&& other);

  const std::vector<Diagnostic>& all() const { return kept_; }
  std::vector<Diagnostic>& all() { return kept_; }
  /// Findings per rule, kept or not.
  const std::map<RuleId, std::uint64_t>& counts() const { return counts_; }
  std::uint64_t dropped(RuleId rule) const;

 private:
  int per_rule_;
  std::vector<Diagnostic> kept_;
  std::map<RuleId, std::uint64_t> counts_;
};

}  // namespace deck
