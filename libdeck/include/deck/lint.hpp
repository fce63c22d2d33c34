// Lint: checks a deck against all rules. Returns sorted findings, after suppressions, baseline and
// configured severities, and a list of the checks that were not made, with reasons.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"

namespace deck {

/// Family of a rule by the leading digit of its id: "syntax, columns, version" for DK0xx, and so
/// on.
std::string_view family_of(RuleId id);
/// True if `selector` names the finding: "all", an id ("DK104") or its beginning ("DK1"), a field
/// of a rule ("DK201:Igap"), or the id that this field had as a rule of its own ("DK202").
bool selects(std::string_view selector, RuleId id, std::string_view field = {});
/// With the id of a rule in place of its name: "DK201:Istf" for "unknown-flag-value:Istf". Every
/// other text stays as it is.
std::string to_selector(std::string_view text);
/// True if the selector, with the id or the name of a rule, means a finding that a rule can have.
bool known_selector(std::string_view selector);
/// "DK202 is now DK201:Igap", for the id of a rule that has become the field of another one; empty
/// for every other selector.
std::string renamed_selector(std::string_view selector);

/// The explain page of a rule as plain text.
std::string explain_rule(const Rule& rule, const SchemaSet& schemas);
/// The page of a keyword, or of one of its fields if `field` is not empty: columns per version,
/// type, legal values, default, dimension, notes. Empty string: no such field.
std::string explain_keyword(const Schema& schema, std::string_view field = {});

/// One field of an interface as the rules see it; integers are exact in `value`.
struct FieldView {
  std::string_view name = {};
  double value = 0;        ///< what the reference solver uses (working units)
  double input = 0;        ///< what the card says (working units)
  bool has_input = false;  ///< the cell exists and is not blank
  Origin origin = Origin::built_in;
  Span span = {};
  std::string_view text = {};    ///< the cell as written
  const Field* field = nullptr;  ///< its schema; nullptr: no such cell on the card
};

/// One /INTER block of a type with a schema, decoded; effective values where the model knows them.
struct ContactCard {
  const Block* block = nullptr;
  DecodedBlock decoded;
  const InterBase* inter = nullptr;  ///< nullptr: LAGMUL and other types without typed struct
  int type = 0;                      ///< 7, 10, 11, 19; 0 for the others
  std::vector<FieldView> fields;

  const FieldView* find(std::string_view name) const;
  /// Effective value; 0 if there is no such field.
  double value(std::string_view name) const;
  /// value() as an id.
  std::int64_t id(std::string_view name) const { return static_cast<std::int64_t>(value(name)); }
  /// value() of a flag, with 1000 ("explicitly nothing") as 0.
  std::int64_t flag(std::string_view name) const;
  /// Value on the card; 0 if blank or absent.
  double input(std::string_view name) const;
  /// The card has a non-zero value there.
  bool given(std::string_view name) const { return input(name) != 0; }
  /// The value bounds something: 1e30 and its like are the solver's own "no bound", written out.
  bool bounds(std::string_view name) const;
  /// Columns of the field, or the header where the card has none.
  Span span(std::string_view name) const;
  /// "Gapmin = 1.5" as written on the card, or with the effective value where the cell is blank.
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
  std::vector<ContactCard> frictions;   ///< /FRICTION blocks, of type 0, fields as written
  std::vector<DecodedBlock> histories;  ///< /TH blocks
  /// Other blocks with ids whose target the solver asks for (Field::missing, empty, required).
  std::vector<DecodedBlock> loads;
  /// Definitions by kind ("inter", "sensor", "funct", "surf", ...) and id (submodel offset added).
  std::map<std::string_view, std::multimap<std::int64_t, const Block*>> defined;
  /// Ids that decoded cells refer to, for node groups, surfaces, lines and frictions.
  std::map<std::string_view, std::set<std::int64_t>> referenced;
  const EngineFiles* engine = nullptr;  ///< those beside the deck
  bool any_load_acts = false;  ///< one of `loads` at least acts on something (Field::acts_on)

  /// Id of a reference as the model knows it (submodel offset added).
  std::int64_t resolved(const Block& block, std::string_view kind, std::int64_t id) const {
    return deck.shifted_id(block, kind, id);
  }
  std::string_view text(const Span& span) const { return deck.sources.text(span); }
};

struct LintOptions;

/// Takes findings of one rule; fills in what the rule's page already says.
class Reporter {
 public:
  /// `options`: fields that they switch off are not reported.
  explicit Reporter(Findings& sink, const LintOptions* options = nullptr)
      : sink_(&sink), options_(options) {}
  /// Returns the finding; valid until the next report. If enough findings of this rule are kept
  /// already (then it is only counted) or the field is switched off, changes to it have no effect.
  Finding& report(const Rule& rule, Span span, std::string message);
  /// As above, about a block.
  Finding& report(const Rule& rule, const Block& block, Span span, std::string message);
  /// As above, about a field; rules without fields ignore `field`.
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

/// Reads the document that `deck gaps --json` wrote; of a list of decks the one called `deck_path`,
/// else the first. Error: no such document, with what was expected; or one of a deck of which an
/// include was missing (Error::Code::io).
Result<GapBaseline> read_earlier_gaps(std::string path, std::string_view json,
                                      std::string_view deck_path);

/// A baseline identifies a finding by this key, without its message and line.
struct FindingKey {
  std::string rule, file, entity, field;  ///< "DK201", absolute path, "/INTER/TYPE7/3", "Istf"
  friend auto operator<=>(const FindingKey&, const FindingKey&) = default;
};
FindingKey finding_key(const Deck& deck, const Finding& finding);
/// Accepted findings: of each as often as there are numbers, up to which Finding::amount may be.
using AcceptedFindings = std::map<FindingKey, std::vector<double>>;

/// None of the settings reaches the findings of a gate (is_gate_rule): what a team has agreed on is
/// switched off in [gate] alone.
struct LintOptions {
  std::vector<std::string> select;  ///< selectors, with ids or names; empty: all
  std::vector<std::string> ignore;
  std::map<std::string, Severity> severity;                                        ///< per selector
  std::vector<std::pair<std::string, std::vector<std::string>>> per_file_ignores;  ///< glob, rules
  AcceptedFindings baseline;                                                       ///< of this deck
  bool gated = false;  ///< `extra` also holds a gate: it runs whatever is selected
  int findings_per_rule = Limits{}.findings_per_rule;
};

struct NotChecked {
  std::string what, why;
};

/// The name of the rules DK3 and DK4 in NotChecked.
inline constexpr std::string_view geometry_rules =
    "geometry: penetrations, gaps against mesh size, contact time step";

/// Reports rules of RuleStage::extra (geometry), and returns the checks that it did not make.
using ExtraCheck = std::function<std::vector<NotChecked>(const LintContext&, Reporter&)>;

struct LintResult {
  std::vector<Finding> findings;            ///< sorted by file, line, column, rule
  std::vector<std::string> fingerprints;    ///< one per finding
  std::map<RuleId, std::uint64_t> counts;   ///< per rule, kept or not
  std::map<RuleId, std::uint64_t> dropped;  ///< per rule: found but not kept
  std::uint64_t errors = 0, warnings = 0, infos = 0;
  std::uint64_t suppressed = 0, baselined = 0;
  std::map<FindingKey, std::uint64_t> stale;  ///< baseline entries that no finding has
  std::vector<NotChecked> not_checked;
};

/// Runs all rules that need no contacts; `extra` adds those that do (see check_geometry).
LintResult run_lint(const LoadedDeck& loaded, const LintOptions& options = {},
                    const std::vector<ExtraCheck>& extra = {});
/// Adds to findings() the errors that only rules find and that stop the solver. Call it before a
/// verdict about contacts, best after the scene is made. Adds nothing if an include is missing,
/// because the missing file may have the missing entity.
void report_solver_errors(LoadedDeck& loaded);

/// Rule, entity and the text of the card with runs of blanks made one: stays the same when lines
/// move. Sixteen hexadecimal digits.
std::string fingerprint(const Deck& deck, const Finding& finding);

}  // namespace deck
