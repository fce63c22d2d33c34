// Text and findings: bytes of files with lines and columns, numbers in cells, Result for operations
// that can fail, findings about a deck, and the rules of these findings.
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

/// Why an operation on its input failed; `message` is complete for a human (what was read, what was
/// expected, what was tried).
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

// Reading and writing numbers in fixed-width cells, the way Radioss Starter decks spell them:
// blanks around, E/e/D/d exponents, exponents without a letter ("1.5-3"), an optional plus sign.

enum class NumberStatus : std::uint8_t {
  ok,
  blank,              ///< nothing but blanks: the value is absent
  implicit_exponent,  ///< "1.5-3": read as 1.5e-3
  trailing_text,      ///< a number, then something else; value is the leading number
  not_a_number,       ///< no number at all; the reference solver takes 0
  not_finite,         ///< "nan", "inf": so is the value
  overflow,           ///< beyond the type's range
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

/// Reads one real cell; correctly rounded. Never looks outside `cell`.
RealCell read_real(std::string_view cell);
/// Reads one integer cell.
IntegerCell read_integer(std::string_view cell);

/// The text of `value` with the most significant digits that fit `width` columns, always with a
/// decimal point or an exponent: fixed form where that reads well (1e-4 … 1e10), scientific form
/// elsewhere, and whichever fits when only one does ("12345678901234567e-30" saves the column of
/// the point). Never more digits than are needed to read the same value back. nullopt: not even one
/// digit fits, or the value is not finite. `exact` tells whether reading the text gives `value`
/// back.
struct FormattedReal {
  std::string text;
  bool exact = false;
};
std::optional<FormattedReal> format_real(double value, int width);
/// nullopt if it does not fit.
std::optional<std::string> format_integer(std::int64_t value, int width);

/// Shortest text that reads back to `number`, with a point or an exponent.
std::string shortest(double number);

// Source: the bytes of one file, read whole and never modified, with line and column on demand.
// Files up to Limits::map_threshold are read into memory; larger ones are mapped, and pages that
// were converted already can be given back so that a deck need not fit into memory twice.

/// Bounds on what a hostile or broken deck may cost: an argument everywhere, with safe defaults.
struct Limits {
  std::uint64_t total_bytes = std::uint64_t{64} << 30;    ///< all files of the include tree
  std::uint64_t map_threshold = std::uint64_t{32} << 20;  ///< larger files are mapped, not read
  std::uint64_t stdin_bytes = std::uint64_t{4} << 30;     ///< standard input has no size to check
  std::uint64_t unpacked_bytes = std::uint64_t{4} << 30;  ///< text of packed files, kept in memory
  std::uint64_t unpacked_ratio = 100;  ///< more text than this times the file (and 64 MiB): no deck
  int include_depth = 100;             ///< the reference solver stops at about 10
  int files = 10000;
  std::size_t blocks = 20'000'000;
  int findings_per_rule = 1000;  ///< further ones are counted, not kept
  int expression_steps = 10000;  ///< parameter expressions
  std::uint64_t selection_bytes = std::uint64_t{4}
                                  << 30;              ///< members of all groups, surfaces, sets
  std::uint64_t pair_bytes = std::uint64_t{2} << 30;  ///< the list of pairs of one contact
};

/// A stretch of bytes of one file. Line and column are computed when a person wants to see them.
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
  /// Opens a regular file; "-" reads standard input. Errors: missing, directory, FIFO, device,
  /// unreadable, over the limit — with the system's reason.
  static Result<std::unique_ptr<Source>> open(const std::string& path, const Limits& limits);
  /// As open(), but unpacks a file that is packed with gzip, see unpack().
  static Result<std::unique_ptr<Source>> open_text(const std::string& path, const Limits& limits);
  static std::unique_ptr<Source> from_bytes(std::string name, std::string bytes);
  /// Returns `source`; if it is packed with gzip, bytes() is then the unpacked text.
  /// Errors: damaged, cut off, over the limit.
  static Result<std::unique_ptr<Source>> unpack(std::unique_ptr<Source> source,
                                                const Limits& limits);
  ~Source();
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  const std::string& path() const { return path_; }  ///< as it was asked for
  std::string_view bytes() const { return bytes_; }
  /// The bytes on disk; they differ from bytes() if the file is packed.
  std::string_view on_disk() const { return packed_ ? packed_bytes_ : bytes_; }
  bool packed() const { return packed_; }
  std::uint64_t device() const { return device_; }
  std::uint64_t inode() const { return inode_; }

  /// Line and column of a byte offset (offset == size is allowed). Thread safe.
  Position position(std::uint64_t offset) const;
  /// The whole line holding `offset`, without its line end.
  std::string_view line_at(std::uint64_t offset) const;
  /// Gives the pages of [begin, end) back to the system if the file is mapped; the bytes stay
  /// readable (they are fetched again when touched).
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

// Finding: one finding about a deck, with its place. All messages of the library about a deck
// have this type. The library does not print them.

enum class Severity : std::uint8_t { error, warning, info };
/// "error", "warning", "info": the words of all outputs and of the configuration.
constexpr const char* to_string(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

/// Id of a rule. deck/rule_id.hpp has an enumerator for every number: RuleId::DK104.
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

struct Finding {
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
/// The name of a finding, also its selector: "DK104", with its field "DK201:Istf".
std::string finding_name(const Finding& finding);

/// Collects findings with a bound per rule: a million broken lines cost a million counts, not a
/// million messages.
class Findings {
 public:
  explicit Findings(int per_rule = Limits{}.findings_per_rule) : per_rule_(per_rule) {}

  /// Counts one finding of `rule`; true while it is worth forming the message for add().
  bool wants(RuleId rule);
  /// Keeps a finding for which wants() said true.
  Finding& add(Finding d);
  /// wants() and add() in one step, for rare findings.
  void report(Finding d);
  /// Counts `n` further findings of `rule` without messages.
  void count(RuleId rule, std::uint64_t n);
  /// True if wants() would say false.
  bool saturated(RuleId rule) const;
  /// Adds what another collector (of a parallel part) has found.
  void merge(Findings&& other);

  const std::vector<Finding>& all() const { return kept_; }
  std::vector<Finding>& all() { return kept_; }
  /// Findings per rule, kept or not.
  const std::map<RuleId, std::uint64_t>& counts() const { return counts_; }
  std::uint64_t dropped(RuleId rule) const;

 private:
  int per_rule_;
  std::vector<Finding> kept_;
  std::map<RuleId, std::uint64_t> counts_;
};

// Rule: one kind of finding, with a stable id and a page that explains it. The pages are the files
// of schemas/rules. A finding has a message of its own; its other texts come from the page, unless
// an Overrides replaces them.

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

/// A field of a rule that says the same of several, and what the page says of this field alone.
struct RuleField {
  std::string name;           ///< "Istf"
  RuleId was = RuleId::none;  ///< the rule that it had for itself once; else the rule's own id
  std::optional<Severity> severity = {};  ///< if it is not that of the rule
  std::string note = {};                  ///< when, or why; empty: nothing particular
  std::string solver = {}, fix = {};      ///< empty: as for the others
};

/// The page of a rule. All text is the project's own; `bad` and `good` are examples in the notation
/// of lint/shared/example.hpp and are run by the tests.
struct Rule {
  RuleId id = RuleId::none;  ///< never reused
  std::string name;          ///< "renard-curve": unique, accepted wherever an id is
  std::string title;         ///< one line
  /// Severities of its findings; the first is the usual one, the page names cases of the others.
  std::vector<Severity> severities;
  RuleStage stage = RuleStage::check;
  std::string problem;  ///< what is wrong
  std::string why;      ///< why it matters, formula
  std::string solver;   ///< what the reference solver does with it
  /// The reference solver's messages for it; the first one is the usual one. Empty: it has none.
  std::vector<ReferenceMessage> messages;
  std::string fix;     ///< how to repair it
  std::string ignore;  ///< when the finding may be ignored; empty: never
  Fixable fixable = Fixable::no;
  bool absence = false;  ///< says that something is absent, which a missing include may hold
  std::string bad, good;
  /// Numbers of the interface types that it is true for ("19": for some part of a TYPE19); empty:
  /// it is not about interfaces of these types.
  std::vector<int> types;
  std::vector<RuleField> fields;  ///< that its findings are about; empty: it is about none
  /// The source of the claims in `solver`: a run, a record, ...; empty: no claim.
  std::string source;
  /// Keys of a rule that is a predicate of cells (lint/cell_rule.hpp): those of the page, then
  /// those of each of its cases. Empty: another rule.
  std::vector<std::map<std::string, std::string, std::less<>>> cells;
  /// Exceptions: covers, only_where, zeros, flag, except (see lint/lint.cpp,
  /// lint/checks/values.cpp).
  std::map<std::string, std::vector<std::string>, std::less<>> exceptions;

  Severity severity() const { return severities.front(); }
  /// nullptr: the rule is not about this field.
  const RuleField* field(std::string_view field_name) const;
  /// The page has `item` in the list of that key of `exceptions`.
  bool lists(std::string_view key, std::string_view item) const;
  /// The solver's message of that number; it is on the page.
  ReferenceMessage message(int number) const;
};

/// All rules, ordered by id. Parsed when first asked for; never changes.
const std::vector<Rule>& all_rules();
/// By id or by name. nullptr: no such rule.
const Rule* find_rule(std::string_view id_or_name);
/// The page of an id that is not RuleId::none.
const Rule& rule_of(RuleId id);
/// The rule that says now what the rule of this id said ("DK202"); nullptr: there was none.
const Rule* find_successor(std::string_view id);

/// Differences of a finding from the first case of its page: another severity or message of the
/// page (0: the solver prints none), and texts for this case only.
struct Overrides {
  std::string_view field = {};  ///< of a rule that has fields
  std::optional<Severity> severity = {};
  std::optional<int> message = {};
  std::string solver = {};  ///< empty: as on the page
  std::string fix = {};     ///< likewise
};

/// A finding with what the page of its rule says.
Finding make_finding(RuleId id, Span span, std::string message, Overrides overrides = {});

/// The rules of a gate: bounds that a team sets. Whatever --fail-on says, a finding of these ends
/// with 1, and none of them is an error of the deck.
inline constexpr RuleId gate_rules[] = {RuleId::DK370, RuleId::DK371, RuleId::DK372, RuleId::DK373,
                                        RuleId::DK374, RuleId::DK375, RuleId::DK376};
constexpr bool is_gate_rule(RuleId rule) {
  for (const RuleId gate : gate_rules)
    if (gate == rule) return true;
  return false;
}

}  // namespace deck
