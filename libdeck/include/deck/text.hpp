// Text and findings: files with lines and columns, numbers in cells, Result, findings and their
// rules.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "deck/rule_id.hpp"

namespace deck {

// Result<T>: a value, or an Error with the reason. Bad input never throws an exception.

/// Reason of a failure. `message` is a complete sentence: text read and text expected.
struct Error {
  enum class Code { io, limit, syntax, config, internal } code = Code::io;
  std::string message;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit by design
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT
  explicit operator bool() const { return state_.index() == 0; }
  bool ok() const { return state_.index() == 0; }
  T& value() { return std::get<0>(state_); }
  const T& value() const { return std::get<0>(state_); }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), ok_(false) {}  // NOLINT
  explicit operator bool() const { return ok_; }
  bool ok() const { return ok_; }
  const Error& error() const { return error_; }

 private:
  Error error_;
  bool ok_ = true;
};

// Numbers in fixed-width cells of a Starter deck: blanks around, E/e/D/d exponents, exponents
// without a letter ("1.5-3"), optional plus sign.

enum class NumberStatus : std::uint8_t {
  ok,
  blank,              ///< only blanks
  implicit_exponent,  ///< "1.5-3": read as 1.5e-3
  trailing_text,      ///< a number, then other text; value is the leading number
  not_a_number,       ///< no number; the solver uses 0
  not_finite,         ///< "nan", "inf"; value is the same
  overflow,           ///< too large for the type
  underflow,          ///< not zero, but rounds to zero
};

struct RealCell {
  double value = 0;
  NumberStatus status = NumberStatus::blank;
};
struct IntegerCell {
  std::int64_t value = 0;
  NumberStatus status = NumberStatus::blank;
};

/// Reads one real cell, correctly rounded. Reads no byte outside `cell`.
RealCell read_real(std::string_view cell);
IntegerCell read_integer(std::string_view cell);

/// Formats `value` with as many significant digits as fit into `width` columns, but no more than
/// are needed to read it back. The text has a decimal point or an exponent: fixed form from 1e-4 to
/// 1e10, else scientific form; the other form if only that one fits ("12345678901234567e-30" saves
/// the column of the point). `exact`: reading the text gives `value`. nullopt: no digit fits, or
/// not finite.
struct FormattedReal {
  std::string text;
  bool exact = false;
};
std::optional<FormattedReal> format_real(double value, int width);
/// nullopt if it does not fit.
std::optional<std::string> format_integer(std::int64_t value, int width);

/// Shortest text that reads back to `number`; it has a decimal point or an exponent.
std::string shortest(double number);

// Source: the unmodified bytes of one file; computes lines and columns on demand. Files above
// Limits::map_threshold are mapped; release() frees pages that are no longer needed.

/// Limits of memory and work for hostile or broken decks. The defaults are safe.
struct Limits {
  std::uint64_t total_bytes = std::uint64_t{64} << 30;    ///< all files of the include tree
  std::uint64_t map_threshold = std::uint64_t{32} << 20;  ///< larger files are mapped, not read
  std::uint64_t stdin_bytes = std::uint64_t{4} << 30;     ///< standard input has no known size
  std::uint64_t unpacked_bytes = std::uint64_t{4} << 30;  ///< text of packed files, kept in memory
  std::uint64_t unpacked_ratio = 100;  ///< limit of text / packed size, above 64 MiB
  int include_depth = 100;             ///< the solver stops at about 10
  int files = 10000;
  std::size_t blocks = 20'000'000;
  int findings_per_rule = 1000;  ///< further findings are counted, not listed
  int expression_steps = 10000;  ///< parameter expressions
  std::uint64_t selection_bytes = std::uint64_t{4}
                                  << 30;              ///< members of all groups, surfaces, sets
  std::uint64_t pair_bytes = std::uint64_t{2} << 30;  ///< the list of pairs of one contact
};

/// A range of bytes of one file.
struct Span {
  static constexpr std::uint32_t no_file = 0xffffffffu;
  std::uint32_t file = no_file;  ///< index into SourceSet
  std::uint32_t length = 0;
  std::uint64_t offset = 0;
  bool valid() const { return file != no_file; }
  friend bool operator==(const Span&, const Span&) = default;
};

/// 1-based position as an editor shows it. Columns count bytes: a tab is one column.
struct Position {
  std::uint64_t line = 0, column = 0;
};

class Source {
 public:
  /// Opens a regular file; "-" is standard input. Errors: missing, directory, FIFO, device,
  /// unreadable, over the limit; the message has the system's reason.
  static Result<std::unique_ptr<Source>> open(const std::string& path, const Limits& limits);
  /// open(), then unpack().
  static Result<std::unique_ptr<Source>> open_text(const std::string& path, const Limits& limits);
  static std::unique_ptr<Source> from_bytes(std::string name, std::string bytes);
  /// Unpacks a gzip file: bytes() is then the unpacked text. Other files are returned unchanged.
  /// Errors: damaged, cut off, over the limit.
  static Result<std::unique_ptr<Source>> unpack(std::unique_ptr<Source> source,
                                                const Limits& limits);
  ~Source();
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  const std::string& path() const { return path_; }  ///< as passed to open()
  std::string_view bytes() const { return bytes_; }
  /// The bytes on disk: not equal to bytes() for packed files.
  std::string_view on_disk() const { return packed_ ? packed_bytes_ : bytes_; }
  bool packed() const { return packed_; }
  std::uint64_t device() const { return device_; }
  std::uint64_t inode() const { return inode_; }

  /// Line and column of a byte offset (0 to size, inclusive). Thread-safe.
  Position position(std::uint64_t offset) const;
  /// The line with the byte `offset`, without its line end.
  std::string_view line_at(std::uint64_t offset) const;
  /// Returns pages of a mapped file up to `end` to the system, in stretches of 8 MiB, if bytes from
  /// `begin` on are read no more. They stay readable: the system reads them again.
  void release(std::uint64_t begin, std::uint64_t end) const;

 private:
  Source() = default;
  std::string path_;
  std::string storage_, unpacked_;
  std::string_view bytes_, packed_bytes_;
  bool packed_ = false;
  void* map_ = nullptr;
  std::size_t map_size_ = 0;
  std::uint64_t device_ = 0, inode_ = 0;
  mutable std::mutex mutex_;
  mutable std::vector<std::uint64_t>
      checkpoints_;  // lines before every 64 KiB boundary seen so far
};

/// All files of a deck. Index 0 is the main file.
class SourceSet {
 public:
  std::uint32_t add(std::unique_ptr<Source> source);
  const Source& operator[](std::uint32_t file) const { return *sources_[file]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(sources_.size()); }
  std::string_view text(const Span& span) const;
  Position position(const Span& span) const;
  /// "file:line:column"
  std::string where(const Span& span) const;

 private:
  std::vector<std::unique_ptr<Source>> sources_;
};

// Finding: a message about a deck, with its place. The library returns findings and prints nothing.

enum class Severity : std::uint8_t { error, warning, info };
/// "error", "warning", "info": used in all outputs and in the configuration.
constexpr const char* to_string(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

/// Id of a rule. deck/rule_id.hpp has an enumerator for every number: RuleId::DK104.
enum class RuleId : std::uint16_t;
/// "DK104"; empty for RuleId::none.
std::string_view id_text(RuleId id);
/// 104 for DK104. The leading digit is the family of the rule.
constexpr int id_number(RuleId id) { return static_cast<int>(id); }

/// Replaces the bytes of `span` by `text`. An empty span inserts.
struct TextEdit {
  Span span;
  std::string text;
};

/// A proposed repair. A safe fix does not change the solver's behaviour (exception DK511: it
/// restores the values that the deck states).
struct Fix {
  std::string title;
  bool safe = false;
  std::vector<TextEdit> edits;
};

/// The solver's own message for a finding.
struct ReferenceMessage {
  int number = 0;
  Severity severity = Severity::error;
};

struct Finding {
  RuleId rule{};
  std::string field;  ///< for rules about several fields: "Istf"; else empty
  Severity severity = Severity::error;
  Span span;
  std::string message;              ///< what was read and what was expected
  std::string reference_behaviour;  ///< the solver's behaviour
  std::string help;                 ///< how to fix it
  std::optional<ReferenceMessage> reference;
  std::string keyword;  ///< entity the finding is about, e.g. "/INTER/TYPE7"; may be empty
  std::int64_t id = 0;
  /// Measure of severity, larger is worse, if there is one. A baseline accepts up to its own
  /// amount.
  std::optional<double> amount = {};
  std::vector<std::pair<Span, std::string>> notes;  ///< related places
  std::optional<Fix> fix;
};
/// Name and selector of a finding: "DK104", or with its field "DK201:Istf".
std::string finding_name(const Finding& finding);

/// Collects findings, at most `per_rule` of each rule; further ones are counted only.
class Findings {
 public:
  explicit Findings(int per_rule = Limits{}.findings_per_rule) : per_rule_(per_rule) {}

  /// Counts one finding of `rule`. Returns true if add() should follow with the message.
  bool wants(RuleId rule);
  /// Adds a finding after wants() returned true.
  Finding& add(Finding d);
  /// wants() and add() in one step, for rare findings.
  void report(Finding d);
  /// Counts `n` further findings of `rule` without messages.
  void count(RuleId rule, std::uint64_t n);
  /// True if wants() would return false.
  bool saturated(RuleId rule) const;
  /// Adds the findings of another collector, for example of another thread.
  void merge(Findings&& other);

  const std::vector<Finding>& all() const { return kept_; }
  std::vector<Finding>& all() { return kept_; }
  /// Number of findings per rule, including those that were not kept.
  const std::map<RuleId, std::uint64_t>& counts() const { return counts_; }
  std::uint64_t dropped(RuleId rule) const;

 private:
  int per_rule_;
  std::vector<Finding> kept_;
  std::map<RuleId, std::uint64_t> counts_;
};

// Rule: one kind of finding, with a stable id and a page (schemas/rules). A finding has its own
// message; its other texts come from the page or from Overrides.

/// The part of the library that finds the violations of a rule.
enum class RuleStage : std::uint8_t {
  reading,  ///< bytes to blocks, cells to values
  model,    ///< nodes, elements, groups, interfaces
  check,    ///< a check of the lint stage
  extra,    ///< the extra checks of run_lint (geometry)
  gate,     ///< bounds that a team has set (lint/shared/gate.hpp)
  linter,   ///< the linter itself: suppressions, baseline
};

enum class Fixable : std::uint8_t { no, safe, unsafe };

/// One field of a rule about several fields, with the texts that differ for it.
struct RuleField {
  std::string name;           ///< "Istf"
  RuleId was = RuleId::none;  ///< former rule of this field alone; else the rule's own id
  std::optional<Severity> severity = {};  ///< if it differs from that of the rule
  std::string note = {};                  ///< when, or why; empty: no note
  std::string solver = {}, fix = {};      ///< empty: that of the rule
};

/// The page of a rule. `bad` and `good` are example decks in the notation of
/// lint/shared/example.hpp; the tests run them.
struct Rule {
  RuleId id = RuleId::none;  ///< never reused
  std::string name;          ///< "renard-curve": unique, accepted wherever an id is
  std::string title;         ///< one line
  /// Severities of its findings. The first is the usual one; the page explains the others.
  std::vector<Severity> severities;
  RuleStage stage = RuleStage::check;
  std::string problem;  ///< the problem
  std::string why;      ///< consequences; formula
  std::string solver;   ///< the solver's behaviour
  /// The solver's messages for it, the usual one first. Empty: the solver prints none.
  std::vector<ReferenceMessage> messages;
  std::string fix;     ///< how to repair it
  std::string ignore;  ///< when the finding may be ignored; empty: never
  Fixable fixable = Fixable::no;
  bool absence = false;  ///< something is missing, which a missing include may have
  std::string bad, good;
  /// Interface types that the rule applies to (19: to some part of a TYPE19). Empty: not about
  /// these types.
  std::vector<int> types;
  std::vector<RuleField> fields;  ///< fields that it can report; empty: no fields
  /// The source of the claims in `solver`: a run, a record, ...; empty: no claim.
  std::string source;
  /// Keys of a rule written as a predicate of cells (lint/cell_rule.hpp): one map for the page, one
  /// per case. Empty: the rule is a function.
  std::vector<std::map<std::string, std::string, std::less<>>> cells;
  /// Lists for exceptions by key: covers, only_where, zeros, flag, except (lint/lint.cpp,
  /// lint/checks/values.cpp).
  std::map<std::string, std::vector<std::string>, std::less<>> exceptions;

  Severity severity() const { return severities.front(); }
  /// nullptr: the rule does not report this field.
  const RuleField* field(std::string_view field_name) const;
  /// True if `item` is in the list `key` of `exceptions`.
  bool lists(std::string_view key, std::string_view item) const;
  /// The solver's message of that number. The page must have it.
  ReferenceMessage message(int number) const;
};

/// All rules, ordered by id. Parsed at the first call, then constant.
const std::vector<Rule>& all_rules();
/// Finds a rule by id or name. nullptr: no such rule.
const Rule* find_rule(std::string_view id_or_name);
/// The rule of an id; the id must not be RuleId::none.
const Rule& rule_of(RuleId id);
/// The rule that replaced the rule of this former id ("DK202"). nullptr: no such id.
const Rule* find_successor(std::string_view id);

/// Differences of a finding from its page: another severity or solver message (0: the solver prints
/// none), and texts for this case only.
struct Overrides {
  std::string_view field = {};  ///< for rules with fields
  std::optional<Severity> severity = {};
  std::optional<int> message = {};
  std::string solver = {};  ///< empty: as on the page
  std::string fix = {};     ///< empty: as on the page
};

/// Makes a finding with the texts of its rule's page.
Finding make_finding(RuleId id, Span span, std::string message, Overrides overrides = {});

/// Rules of a gate: bounds that a team sets. A finding of these makes the exit code 1 whatever
/// --fail-on says; none of them is an error of the deck.
inline constexpr RuleId gate_rules[] = {RuleId::DK370, RuleId::DK371, RuleId::DK372, RuleId::DK373,
                                        RuleId::DK374, RuleId::DK375, RuleId::DK376};
constexpr bool is_gate_rule(RuleId rule) {
  for (const RuleId gate : gate_rules)
    if (gate == rule) return true;
  return false;
}

}  // namespace deck
