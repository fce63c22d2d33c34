// Edits of decks: rewriting cells and blocks, fixes of contacts, conversions of whole decks.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/keyword.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/point3.hpp"
#include "deck/text.hpp"

namespace deck {

// Rewrite: proposed changes of a conversion (spans to replace, or a new text) with their losses. It
// changes no file: apply it, then write the result.

/// Result of a conversion for one value.
enum class Loss : std::uint8_t {
  kept,          ///< the same meaning in the new text
  approximated,  ///< fewer digits, or the nearest option
  dropped,       ///< cannot be expressed in the new text
  undecided,     ///< needs a decision by the user
};

/// One line of the loss report.
struct LossEntry {
  Loss loss = Loss::kept;
  bool without_effect = false;  ///< dropped, but the solver ignored it
  std::string file;             ///< as in the deck
  std::uint64_t line = 0;
  std::uint64_t column = 0, end_column = 0;  ///< of a changed value; 0: unknown
  std::string keyword;                       ///< "/INTER/TYPE7"
  std::int64_t id = 0;
  std::string field;  ///< "Irem_gap"; empty: the whole block
  std::string old_text, new_text;
  std::string note;  ///< reason, and what the user should do
};

struct Rewrite {
  std::vector<TextEdit> edits;          ///< of files of the deck, without overlaps
  std::optional<std::string> new_text;  ///< instead of edits: the deck as one file
  std::vector<LossEntry> losses;
  std::vector<std::string> notes;     ///< for the user, one line each ("length: factor 0.001")
  std::vector<std::string> refusals;  ///< "file:line:column: reason"; if any: write nothing
  bool bad_request = false;           ///< the refusals concern the request, not the deck
};

/// New contents of changed files, by path as the deck opened it.
using ChangedFiles = std::map<std::string, std::string>;

/// Applies edits. A file that is included twice is changed once; both includes must ask for the
/// same text. Errors: overlapping edits; different texts for one file.
Result<ChangedFiles> apply_edits(const SourceSet& sources, const std::vector<TextEdit>& edits);
/// Applies a rewrite; its new_text, if any, replaces the main file.
Result<ChangedFiles> apply_rewrite(const SourceSet& sources, const Rewrite& rewrite);

/// Texts of a LossEntry about a value.
struct LossText {
  std::string field = {}, old_text = {}, new_text = {}, note = {};
};
/// Makes an entry about a block; an invalid `span` means its header.
LossEntry loss_entry(const Deck& deck, Loss loss, const Block& block, Span span,
                     LossText text = {});

/// Adds an `undecided` loss if the user accepts that, else a refusal "file:line:column: /KEYWORD/id
/// field: reason" (at most 1000). An invalid `place` means the header of the block.
void leave_undecided(Rewrite& out, const Deck& deck, const Block& block, Span place,
                     std::string field, std::string why, bool accepted);

// Edit: changes values of a deck by field name, shows the changes as a patch, writes the files. Use
// it to change a deck from a program.
//
//   deck::Edit edit(*loaded);
//   edit.set(loaded->interfaces().find(3), "Gapmin", 0.8);
//   edit.set("/PROP", 2, "Thick", 1.5).move_node(1001, {0, 0, 12.5});
//   if (const auto saved = edit.save(); !saved) ...saved.error().message

class EditSet;
class LoadedDeck;
struct Block;
struct Deck;
struct InterBase;

/// A number in working units, or the text of the cell in units of the card ("0.8", "&gap"; empty:
/// blank).
using CellValue = std::variant<std::int64_t, double, std::string>;

struct SaveOptions {
  std::string backup_suffix;        ///< not empty: keeps replaced files with this suffix
  std::vector<std::string> others;  ///< further decks that must not change
};

/// Finds a block by keyword and id (submodel offset added). "/PROP" also finds /PROP/SHELL; aliases
/// such as "/PROP/TYPE1" work. Error: no such block, or several.
Result<const Block*> find_block(const Deck& deck, std::string_view keyword, std::int64_t id);

/// Collects changes of one deck. The deck must outlive the Edit and not move; it is not changed.
/// After the first impossible change, diff(), save() and save_to() return its error
/// ("file:line:column: /KEYWORD/id field: what was expected") and write nothing.
///
/// A number becomes the shortest text that reads back to it, right-aligned; in narrow cells it
/// loses digits, see notes(). Short lines and missing last lines of a block are extended, in fixed
/// and free format. A cell that has the value already is not changed.
class Edit {
 public:
  explicit Edit(const LoadedDeck& loaded);
  explicit Edit(LoadedDeck&&) = delete;
  Edit(Edit&&) noexcept;
  Edit& operator=(Edit&&) noexcept;
  ~Edit();

  /// Sets a field by its manual name. `occurrence`: repetition of the line, from 0. A null pointer
  /// is an error of the edit.
  Edit& set(const InterBase* inter, std::string_view field, const CellValue& value);
  Edit& set(const Block* block, std::string_view field, const CellValue& value, int occurrence = 0);
  Edit& set(std::string_view keyword, std::int64_t id, std::string_view field,
            const CellValue& value, int occurrence = 0);
  /// Moves a node to coordinates in working units. Error if its line does not set its position
  /// (/CNODE, /TRANSFORM).
  Edit& move_node(std::int64_t id, const Point3<double>& to);
  /// Adds blocks (whole lines, the first one a keyword) at the end of the main file. set() adds
  /// their missing lines.
  Edit& insert(std::string_view blocks);
  /// Removes a block with its lines. Comments after its last line are kept.
  Edit& erase(const Block* block);
  /// Finds a block as find_block() does, inserted blocks included. A pointer to an inserted block
  /// is valid until the next change.
  Result<const Block*> find(std::string_view keyword, std::int64_t id);

  /// The error that diff(), save() and save_to() would return.
  Result<void> status() const;
  /// Values that lost digits, one sentence each.
  const std::vector<std::string>& notes() const;
  /// The changed deck, read from memory.
  Result<LoadedDeck> read();

  /// The changes as a patch for git apply.
  Result<std::string> diff();
  /// Replaces the changed files in place, all or none, only if they are still as read; packed files
  /// stay packed. Returns their paths. Error: another deck in that folder, or one of `others`,
  /// includes a changed file.
  Result<std::vector<std::string>> save(const SaveOptions& options = {});
  /// Writes all files of the deck below another directory. Error: a different file exists there
  /// (unless `overwrite`), or it is a file of the deck itself.
  Result<std::vector<std::string>> save_to(const std::string& directory, bool overwrite = false);
  /// All files of the deck with their new contents, for other ways of writing.
  Result<EditSet> files();

 private:
  class State;
  std::unique_ptr<State> state_;
};

// Repairs of initial penetrations and of ties with untied nodes: options and results of all
// strategies, and the strategies that change an interface card (smaller gap, Inacti, Fpenmax,
// larger dsearch). edit/shared/depenetrate.hpp has those that move nodes (not public).
//
// A strategy returns a Rewrite with the penetrations before and after it; it counts the latter by
// reading and evaluating the changed deck.

struct FixOptions {
  int threads = 1;
  std::vector<std::int64_t> interfaces;  ///< ids to treat; empty: all
  /// Also change TYPE10, whose pairs are ties, not penetrations. Without it, no fix adds or removes
  /// a tie.
  bool ties = false;
  /// Called with the current step and (done, total); total 0: unknown. May be empty.
  std::function<void(std::string_view step, std::size_t done, std::size_t total)> progress;
};

/// Initial penetrations of all contacts of one interface. Lengths in working units.
struct FixCount {
  std::uint64_t pairs = 0;
  std::uint64_t nodes = 0;       ///< distinct secondary nodes or edges
  std::uint64_t untreated = 0;   ///< pairs on which the solver does not act, or stops
  std::uint64_t on_surface = 0;  ///< pairs at distance 0
  double deepest = 0;
};

/// One changed cell of an interface card.
struct FieldChange {
  std::string field;
  std::string old_text, new_text;       ///< as on the card; old_text is empty for a blank cell
  double old_value = 0, new_value = 0;  ///< effective; working units
};

struct FixedInterface {
  std::int64_t id = 0;
  int type = 0;
  std::string title;
  FixCount before, after;
  std::vector<FieldChange> changes;
};

struct MovedNode {
  std::int64_t id = 0;
  std::int64_t part = 0;       ///< 0: no part
  std::array<double, 3> by{};  ///< working units
  double distance = 0;
};

/// An untreated penetration, untied node or whole interface (no nodes), with the reason.
struct FixRefusal {
  std::int64_t interface_id = 0;
  std::vector<std::int64_t> nodes;  ///< the secondary node, or the two of an edge
  double depth = 0;                 ///< in the unchanged deck
  std::string reason;
  double distance = 0;  ///< of an untied node from its nearest segment; 0: none
  /// Suggested next command, without --interface; "DECK" is the path. May be empty.
  std::string next = {};
};

/// A node that the fix ties.
struct NewlyTied {
  std::int64_t node = 0;
  std::vector<std::int64_t> segment;  ///< triangle: last repeated
  double distance = 0;
};

/// A TYPE2 with untied nodes.
struct FixedTie {
  std::int64_t id = 0;
  std::string title;
  double reach = 0;  ///< largest distance of nodes to be tied; working units
  TieCounts before, after;
  double needed = 0;             ///< largest distance of the nodes tied by the fix; 0: none
  std::vector<NewlyTied> nodes;  ///< ascending ids
  std::vector<FieldChange> changes;
};

/// The solver's action on one penetration, before and after the change.
struct FixAction {
  std::int64_t interface_id = 0;
  std::vector<std::int64_t> secondary, main;  ///< node ids
  double depth = 0, gap = 0;
  PenetrationAction before = PenetrationAction::none, after = PenetrationAction::none;
  bool stops = false;  ///< true: the solver stops at this pair after the change
  double gap0 = 0;     ///< remaining gap, where it is reduced
};

struct PenetrationFix {
  std::string strategy;
  Rewrite rewrite;
  std::vector<FixedInterface> interfaces;  ///< those with penetrations, before or after; by id
  std::vector<MovedNode> moved;            ///< by node id
  std::vector<FixRefusal> refused;         ///< by interface, deepest first
  std::vector<FixAction> actions;          ///< Inacti, Fpenmax: by interface, deepest first
  std::vector<FixedTie> ties;  ///< tie: TYPE2 with untied nodes, in the order of the deck
  std::uint64_t crossings_before = 0, crossings_after = 0;  ///< crossed elements, if nodes move
  /// Pairs and nodes that stay tied (including TYPE2): equal before and after.
  std::uint64_t tied_pairs = 0, tied_nodes = 0;
  int iterations = 0;
  bool complete = false;  ///< true: everything that the strategy treats is solved
};

struct ReduceGapOptions : FixOptions {
  /// Lower limit of new gap / present gap; below it the interface is refused.
  double least_share = 0.5;
  /// Significant digits of new values, which are rounded down.
  int digits = 6;
};
/// Sets the largest gap without penetrations on every interface that has some: Gapmin for a
/// constant gap; else the better of Fscalegap and Gapmax (Igap 1 becomes 2, which is equal for
/// Fscalegap 1). TYPE25: the better of Gap_scale and Gap_max_s with Gap_max_m; TYPE24: the latter.
/// Never increases a value. Error: the changed deck cannot be read.
Result<PenetrationFix> reduce_gaps(const LoadedDeck& context, const ReduceGapOptions& options);

struct InactiOptions : FixOptions {
  std::optional<int> inacti;  ///< absent: 6; TYPE24 and TYPE25: 5
};
/// Sets Inacti of interfaces with penetrations. Refused: values that are illegal or have no effect
/// for the type; interfaces at which the solver would then stop at a node at distance 0.
Result<PenetrationFix> set_inacti(const LoadedDeck& context, const InactiOptions& options);

struct FpenmaxOptions : FixOptions {
  /// The solver drops the node of a penetration deeper than this share of the gap, for the whole
  /// interface. Absent: the smallest value that drops only nodes at distance 0, at which the solver
  /// would stop.
  std::optional<double> ratio;
};
/// Sets Fpenmax of TYPE7 interfaces. Inacti still applies to all other penetrations.
Result<PenetrationFix> set_fpenmax(const LoadedDeck& context, const FpenmaxOptions& options);

struct TieOptions : FixOptions {
  /// Nodes with a larger distance are not tied; working units. Absent: the solver's default for a
  /// blank dsearch and Ignore, the mean side of the segments.
  std::optional<double> reach;
};
/// Increases dsearch of every TYPE2 with untied nodes as far as the nodes within reach need. Does
/// not tie nodes that something else constrains (another tie, a rigid body) or at which the solver
/// would stop; dsearch stays below their distance. Tied nodes keep their segment. Refused: Isearch
/// 1, Ignore above 3, surfaces as secondary side.
Result<PenetrationFix> tie_nodes(const LoadedDeck& context, const TieOptions& options);

/// One strategy of several.
using FixStep = std::function<Result<PenetrationFix>(const LoadedDeck& context)>;
struct FixSequence {
  std::vector<PenetrationFix> fixes;  ///< one per step; rewrites refer to the deck before that step
  ChangedFiles changed;               ///< all steps together, against the unchanged deck
};
/// Runs the steps; each one gets the deck as changed by the steps before.
Result<FixSequence> fix_in_order(const LoadedDeck& context, const std::vector<FixStep>& steps);
/// Result of a fix in pairs (tie: in nodes): solved; not treated; for inacti and fpenmax those that
/// the solver treats already. The sum is the number of penetrations.
struct FixScore {
  std::uint64_t solved = 0, not_treated = 0, treated_already = 0;
};
FixScore score_of(const PenetrationFix& fix);
/// The proposal with the fewest pairs that are not treated; of equals the first. nullptr: none
/// solves a pair.
const PenetrationFix* best_of(const std::vector<PenetrationFix>& proposals);
/// The report if no proposal is used: the penetrations of the deck, no changes.
PenetrationFix unchanged(const std::vector<PenetrationFix>& proposals);

/// Reports several fixes as one: strategies joined by commas, `before` of the first; `after`,
/// actions and refusals of the last. Its rewrite is empty.
PenetrationFix combined(const std::vector<PenetrationFix>& fixes);

// Conversions of a deck: version, units, ids, one file, TYPE19 to the TYPE7 and TYPE11 that the
// solver makes of it, extraction of interfaces. Each returns a loss report.

struct VersionOptions {
  /// Drop values without a cell in the target version, and keep blocks of unknown layout unchanged.
  /// Otherwise both are refusals.
  bool allow_loss = false;
};

/// True for the versions that can be written: 110 to 140, 2017 and later.
bool is_target_version(int version);

/// Sets the version of every /BEGIN to `version` (110 … 2026, 2612) and adapts every block whose
/// layout differs: common cells keep their text, cells of the old layout alone are blanked, lines
/// are inserted, removed and moved. Comments keep their place. Losses: `kept` per changed block;
/// `dropped` for a non-default value without a cell; `undecided` per keyword with columns unknown
/// in one of the versions (with the number of blocks), and for values that do not fit. Without
/// allow_loss `dropped` and `undecided` are refusals; a smoothed surface (Ists) that would become a
/// node group always is. Refused: unknown target, decks before version 100 or without /BEGIN.
Rewrite to_version(const LoadedDeck& context, int version, const VersionOptions& options = {});

struct UnitsOptions {
  /// Convert the known cells and report the others as `undecided` instead of refusing.
  bool partial = false;
  /// Change only the input system: /BEGIN keeps its working system, so that the solver's numbers do
  /// not change and Engine files stay valid.
  bool keep_working = false;
};

/// Reads "kg,mm,ms" (mass, length, time; numbers are factors to kg, m, s). Error: reason.
Result<UnitSystem> parse_unit_system(std::string_view text);

/// Converts every cell in the input units of /BEGIN to `target`, and /BEGIN itself.
///
/// - If input and working system are equal, both become `target` (unless keep_working); otherwise
///   the working system stays. Values that the solver takes in working units (defaults of 0 or
///   blank cells) are written out if they depend on the system; limits such as 1e30 stay blank.
/// - Not converted: blocks with their own unit id, and submodels with their own /BEGIN.
/// - Factors that are powers of ten move the decimal point of the text, so a conversion there and
///   back restores the value; otherwise the value is `approximated`.
/// - Refusals (with `partial`: `undecided`): unknown keywords, partly described keywords with
///   undescribed numbers, non-zero cells of unknown dimension, unreadable numbers, parameters with
///   several dimensions or from expressions, functions in working units.
Rewrite to_units(const LoadedDeck& context, const UnitSystem& target,
                 const UnitsOptions& options = {});

/// Adds the changes of the Engine files, whose times are in working units: edits, one `kept` entry
/// per file, and for each keyword with unknown cells a refusal (`undecided` if `accept`).
void engine_to_units(const Deck& deck, const EngineFiles& engine, const UnitSystem& target,
                     const UnitsOptions& options, bool accept, Rewrite& out);

/// Rule for the new ids of one kind.
struct RenumberRule {
  /// "node", "shell", "sh3n", "solid", "quad", "tria", "truss", "beam", "spring", "part", "prop",
  /// "mat", "subset", "grnod" (and the other group kinds), "surf", "line", "set", "box", "funct",
  /// "sensor", "skew", "frame", "friction", "inter", "transform"; "element": all element kinds;
  /// "group": all groups, surfaces, lines and sets; "all": everything named here.
  std::string kind;
  bool compact = false;    ///< new ids are consecutive from `value`, in the order of the old ids
  std::int64_t value = 0;  ///< added to every id; with `compact`: the first id
};

/// Reads "node+1000", "part-50" (offset) or "node=1" (compact from 1). Error: reason.
Result<RenumberRule> parse_renumber_rule(std::string_view text);

struct RenumberOptions {
  std::vector<RenumberRule> rules;  ///< at most one per kind
  /// Renumber the known ids and report the others as `undecided` instead of refusing.
  bool partial = false;
};

/// Changes ids and all references. Ids of a kind keep their order, so groups, sorts and ties do not
/// change. Ids include submodel offsets; written ids change by the same amount.
///
/// Refusals (with `partial`: `undecided`): undescribed text with a number equal to a changed id;
/// ids from parameters; ids that do not fit their columns, fall below 1 (in a submodel: its offset
/// plus 1) or are too large; a set that a group would hide under its new id; ranges that do not
/// stay ranges.
Rewrite renumber(const LoadedDeck& context, const RenumberOptions& options);

/// Replaces every /INTER/TYPE19 by
///  * a TYPE7 with its id, title, lines and comments: nodes of surf_IDs on surf_IDm;
///  * for two different surfaces a second TYPE7 with the sides exchanged;
///  * a TYPE11 of the edges of both surfaces (all, or the free ones if /DEFAULT/INTER/TYPE19 sets
///    Iedge 1), if there are any;
/// and by the required /GRNOD/SURF, /LINE/SURF or /LINE/EDGE with new ids above all used ones. A
/// set that is a side is referred to as a set. Flags that are 0 are written out, so that defaults
/// of TYPE7 and TYPE11 do not apply; other cells keep their text. New blocks are added before /END
/// of the main file (the solver's order), or after a TYPE19 in a submodel or of another input
/// version. Losses: `kept` per interface; `undecided`, always a refusal, if a flag has no cell in
/// the deck's version and the other type has another default.
Rewrite expand_type19(const LoadedDeck& context);

struct FlattenOptions {
  bool mark = true;  ///< adds comment lines with the name of the included file around its lines
};

/// Returns the deck as one file (Rewrite::new_text). Lines that are read stay unchanged, byte for
/// byte, except: directives become comments; a missing line end is added; /END, #enddata and the
/// text after them in an included file are removed; /BEGIN of an included file (same version,
/// outside of submodels) becomes a comment; a LOCAL parameter whose name has another meaning
/// elsewhere gets a new name of equal length. The result is read again and compared block by block.
///
/// A file of another input version is then read with the surrounding version. If no known cell
/// changes by that, its partly described keywords are `undecided`.
///
/// Refusals: unreadable includes, cells that would change their meaning, local parameters without a
/// free name.
Rewrite flatten(const LoadedDeck& context, const FlattenOptions& options = {});

/// Returns one file (Rewrite::new_text) with these interfaces (ids with submodel offsets), their
/// groups, surfaces, sets and boxes, all elements with one of their nodes or in one of these
/// selections, and the nodes, parts, properties, materials, frictions, functions, sensors, axes,
/// transformations and switches that these need. Kept lines are copied byte for byte, in the order
/// of the deck; ids do not change.
///
/// The result is read again and compared with the deck: effective values, segments, gaps,
/// stiffness, and ties of TYPE2. Differences are `approximated`; left-out blocks are `dropped`, one
/// entry per keyword.
///
/// Refusals: an id that is not an interface of a known type; a deck that cannot be flattened.
Rewrite extract_contacts(const LoadedDeck& context, std::span<const std::int64_t> interfaces);

}  // namespace deck
