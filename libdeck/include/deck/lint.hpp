// Lint: checks a deck against all rules. Returns sorted findings after suppressions, baseline and
// configured severities, and a list of checks that were not made, with reasons.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"

namespace deck {

/// Family of a rule by the leading digit of its id: "syntax, columns, version" for DK0xx.
std::string_view family_of(RuleId id);
/// True if `selector` selects the finding: "all", an id ("DK104"), the start of an id ("DK1"), a
/// field of a rule ("DK201:Igap"), or the former id of that field ("DK202").
bool selects(std::string_view selector, RuleId id, std::string_view field = {});
/// Replaces a rule name by its id: "unknown-flag-value:Istf" gives "DK201:Istf". Returns any other
/// text unchanged.
std::string to_selector(std::string_view text);
/// True if some finding can match the selector, which may have ids or names.
bool known_selector(std::string_view selector);
/// "DK202 is now DK201:Igap" for the id of a rule that became a field of another rule; else empty.
std::string renamed_selector(std::string_view selector);

/// The explain page of a rule as plain text.
std::string explain_rule(const Rule& rule, const SchemaSet& schemas);
/// The page of a keyword, or of the field `field`: columns per version, type, legal values,
/// default, dimension, notes. Empty result: no such field.
std::string explain_keyword(const Schema& schema, std::string_view field = {});

/// One field of an interface as rules see it. `value` represents ids and flags exactly.
struct FieldView {
  std::string_view name = {};
  double value = 0;        ///< effective value (working units)
  double input = 0;        ///< value on the card (working units)
  bool has_input = false;  ///< the cell exists and is not blank
  Origin origin = Origin::built_in;
  Span span = {};
  std::string_view text = {};    ///< the cell as written in the deck
  const Field* field = nullptr;  ///< its schema; nullptr: no such cell on the card
};

/// One decoded /INTER block of a type with a schema, with effective values if the model has them.
struct ContactCard {
  const Block* block = nullptr;
  DecodedBlock decoded;
  const InterBase* inter = nullptr;  ///< nullptr: LAGMUL and other types without typed struct
  int type = 0;                      ///< 7, 10, 11, 19; 0 for the others
  std::vector<FieldView> fields;

  const FieldView* find(std::string_view name) const;
  /// Effective value; 0 if there is no such field.
  double value(std::string_view name) const;
  std::int64_t id(std::string_view name) const { return static_cast<std::int64_t>(value(name)); }
  /// value() of a flag; 1000 ("explicitly nothing") becomes 0.
  std::int64_t flag(std::string_view name) const;
  /// Value on the card; 0 if blank or absent.
  double input(std::string_view name) const;
  /// True if the card has a non-zero value.
  bool given(std::string_view name) const { return input(name) != 0; }
  /// True if the value is a real limit: 1e30 and larger values mean "no limit" to the solver.
  bool bounds(std::string_view name) const;
  /// Columns of the field; the header if the card does not have it.
  Span span(std::string_view name) const;
  /// "Gapmin = 1.5": text of the card, or the effective value if the cell is blank.
  std::string show(std::string_view name) const;
};

/// The data that rules may read.
class LintContext {
 public:
  const Deck& deck;
  const SchemaSet& schemas;
  const Model* model;
  const Interfaces* interfaces;
  Selections* selections;
  const LoadedDeck* loaded;
  std::vector<ContactCard> contacts;
  std::vector<DecodedBlock> defaults;   ///< /DEFAULT/INTER blocks
  std::vector<ContactCard> frictions;   ///< /FRICTION blocks: type 0, values as written
  std::vector<DecodedBlock> histories;  ///< /TH blocks
  /// Other blocks with ids whose target must exist for the solver (Field::missing, empty,
  /// required).
  std::vector<DecodedBlock> blocks_with_checked_ids;
  /// Definitions by kind ("inter", "sensor", "funct", "surf", ...) and id (submodel offset added).
  std::map<std::string_view, std::multimap<std::int64_t, const Block*>> defined;
  /// Ids that decoded cells refer to, for node groups, surfaces, lines and frictions.
  std::map<std::string_view, std::set<std::int64_t>> referenced;
  /// All integers in blocks without described cards. Each may be a reference.
  std::unordered_set<std::int64_t> possible_ids_in_raw_blocks;
  const EngineFiles* engine = nullptr;  ///< Engine files beside the deck
  bool any_load_acts = false;           ///< some of these blocks has a target (Field::acts_on)

  /// Adds the submodel offset to an id, as the model has it.
  std::int64_t resolved(const Block& block, std::string_view kind, std::int64_t id) const {
    return deck.shifted_id(block, kind, id);
  }
  std::string_view text(const Span& span) const { return deck.sources.text(span); }
};

struct LintOptions;

/// Collects findings of rules and adds the texts of the rule's page.
class Reporter {
 public:
  /// Drops findings of fields that `options` switches off.
  explicit Reporter(Findings& sink, const LintOptions* options = nullptr)
      : sink_(&sink), options_(options) {}
  /// Returns the finding, valid until the next report. If the finding is only counted
  /// (findings_per_rule) or its field is switched off, changes to it have no effect.
  Finding& report(const Rule& rule, Span span, std::string message);
  /// Overload for a finding about a block.
  Finding& report(const Rule& rule, const Block& block, Span span, std::string message);
  /// Overload for a finding about a field. Rules without fields ignore `field`.
  Finding& report(const Rule& rule, std::string_view field, const Block& block, Span span,
                  std::string message);

 private:
  Finding& unseen() { return unseen_ = Finding{}; }
  Finding unseen_;
  Findings* sink_;
  const LintOptions* options_;
};

/// Version of the document of `deck gaps --json`. Version 2 lists ties apart from penetrations.
inline constexpr int gaps_version = 2;

/// Reads the document of `deck gaps --json`. If it has several decks: the one named `deck_path`,
/// else the first. Errors: not such a document; a document of a deck with a missing include
/// (Error::Code::io).
Result<GapBaseline> read_earlier_gaps(std::string path, std::string_view json,
                                      std::string_view deck_path);

/// Identifies a finding in a baseline, independent of message and line.
struct FindingKey {
  std::string rule, file, entity, field;  ///< "DK201", absolute path, "/INTER/TYPE7/3", "Istf"
  friend auto operator<=>(const FindingKey&, const FindingKey&) = default;
};
FindingKey finding_key(const Deck& deck, const Finding& finding);
/// Accepted findings: one number per accepted finding, the largest accepted Finding::amount.
using AcceptedFindings = std::map<FindingKey, std::vector<double>>;

/// Settings of a lint run. They do not apply to findings of a gate (is_gate_rule); only the [gate]
/// table of the configuration switches those off.
struct LintOptions {
  std::vector<std::string> select;  ///< selectors, with ids or names; empty: all
  std::vector<std::string> ignore;
  std::map<std::string, Severity> severity;                                        ///< per selector
  std::vector<std::pair<std::string, std::vector<std::string>>> per_file_ignores;  ///< glob, rules
  AcceptedFindings baseline;                                                       ///< of this deck
  bool gated = false;  ///< `extra` has a gate: it runs even if no rule of it is selected
  int findings_per_rule = Limits{}.findings_per_rule;
};

struct NotChecked {
  std::string what, why;
};

/// Text in NotChecked for the rules DK3xx and DK4xx.
inline constexpr std::string_view geometry_rules =
    "geometry: penetrations, gaps against mesh size, contact time step";

/// Reports rules of RuleStage::extra (geometry). Returns the checks that it could not make.
using ExtraCheck = std::function<std::vector<NotChecked>(const LintContext&, Reporter&)>;

struct LintResult {
  std::vector<Finding> findings;            ///< sorted by file, line, column, rule
  std::vector<std::string> fingerprints;    ///< one per finding
  std::map<RuleId, std::uint64_t> counts;   ///< per rule, including dropped ones
  std::map<RuleId, std::uint64_t> dropped;  ///< per rule: found but not listed
  std::uint64_t errors = 0, warnings = 0, infos = 0;
  std::uint64_t suppressed = 0, baselined = 0;
  std::map<FindingKey, std::uint64_t> stale;  ///< baseline entries without a finding
  std::vector<NotChecked> not_checked;
};

/// Runs all rules that need no contacts. `extra` adds the others (see check_geometry).
LintResult run_lint(const LoadedDeck& loaded, const LintOptions& options = {},
                    const std::vector<ExtraCheck>& extra = {});
/// Adds to findings() the errors that only rules find and that stop the solver. Call it before the
/// verdict, best after scene(). Adds nothing if an include is missing: the missing file may define
/// the missing entity.
void report_solver_errors(LoadedDeck& loaded);

/// Hash of rule, entity and card text (runs of blanks count as one blank). It stays equal when
/// lines move. 16 hexadecimal digits.
std::string fingerprint(const Deck& deck, const Finding& finding);

}  // namespace deck
