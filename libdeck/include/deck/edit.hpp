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

// Rewrite: the changes that one conversion proposes (spans to replace, or a whole new text) and the
// losses. A conversion changes no file: a Rewrite is applied and written in a later step.

/// The fate of a value in a conversion.
enum class Loss : std::uint8_t {
  kept,          ///< the same meaning in the new text
  approximated,  ///< close: fewer digits, or the nearest option there is
  dropped,       ///< the new text cannot hold it
  undecided,     ///< must be decided by hand
};

/// One line of the loss report.
struct LossEntry {
  Loss loss = Loss::kept;
  bool without_effect = false;  ///< dropped, but the solver did not use it
  std::string file;             ///< as in the deck
  std::uint64_t line = 0;
  std::uint64_t column = 0, end_column = 0;  ///< of a value that changed; 0: not told
  std::string keyword;                       ///< "/INTER/TYPE7"
  std::int64_t id = 0;
  std::string field;  ///< "Irem_gap"; empty: the block as a whole
  std::string old_text, new_text;
  std::string note;  ///< why, and what to do
};

struct Rewrite {
  std::vector<TextEdit> edits;          ///< of files of the deck; never overlapping
  std::optional<std::string> new_text;  ///< instead: the whole deck as one file without includes
  std::vector<LossEntry> losses;
  std::vector<std::string> notes;     ///< for people, one line each ("length: factor 0.001")
  std::vector<std::string> refusals;  ///< "file:line:column: why"; any: nothing may be written
  bool bad_request = false;           ///< the refusals are about the request, not about the deck
};

/// New contents by path (as the deck opened it), of changed files only.
using ChangedFiles = std::map<std::string, std::string>;

/// Applies edits. A file that the deck includes twice is changed once: equal edits through both
/// includes are one. Error: edits that overlap, or that would make of one file two: every include
/// of it has to ask for the same text.
Result<ChangedFiles> apply_edits(const SourceSet& sources, const std::vector<TextEdit>& edits);
/// Applies a whole rewrite; new_text, if there is one, replaces the main file.
Result<ChangedFiles> apply_rewrite(const SourceSet& sources, const Rewrite& rewrite);

/// The texts of a LossEntry about a value.
struct LossText {
  std::string field = {}, old_text = {}, new_text = {}, note = {};
};
/// An entry about a block; an invalid `span` stands for its header.
LossEntry loss_entry(const Deck& deck, Loss loss, const Block& block, Span span,
                     LossText text = {});

/// Notes what a conversion cannot decide: an `undecided` loss if the user accepts that, a refusal
/// "file:line:column: /KEYWORD/id field: why" otherwise (the first thousand of them). An invalid
/// `place` stands for the header of the block.
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

/// A number in the deck's working units, as the library gives values; or the text of the cell, in
/// the units of the card ("0.8", "&gap"; empty: blank).
using CellValue = std::variant<std::int64_t, double, std::string>;

struct SaveOptions {
  std::string backup_suffix;        ///< not empty: a file that is replaced stays under this ending
  std::vector<std::string> others;  ///< further decks that must not change
};

/// The block with this keyword, or below it ("/PROP" finds /PROP/SHELL), and id, offsets of
/// submodels added. Other names of a keyword are the same ("/PROP/TYPE1"). Error: none, or several.
Result<const Block*> find_block(const Deck& deck, std::string_view keyword, std::int64_t id);

/// Changes of one deck. It points to the deck, which must outlive it, stays where it is and is not
/// changed itself.
/// The first change that cannot be made is kept as an error ("file:line:column: /KEYWORD/id field:
/// what was expected"): diff(), save() and save_to() then give it, and nothing is written.
///
/// A number gets the shortest text that reads back to it, right-aligned; with fewer digits where
/// the cell is too narrow, which notes() tells. Lines that are too short grow, in fixed and in free
/// format; lines that a block leaves away at its end are added. Where a cell has the value already,
/// nothing changes.
class Edit {
 public:
  explicit Edit(const LoadedDeck& loaded);
  explicit Edit(LoadedDeck&&) = delete;
  Edit(Edit&&) noexcept;
  Edit& operator=(Edit&&) noexcept;
  ~Edit();

  /// A field by the manual's name, of a block of the deck. `occurrence`: which one, from 0, where a
  /// line with it repeats. A null pointer is an error of the edit.
  Edit& set(const InterBase* inter, std::string_view field, const CellValue& value);
  Edit& set(const Block* block, std::string_view field, const CellValue& value, int occurrence = 0);
  Edit& set(std::string_view keyword, std::int64_t id, std::string_view field,
            const CellValue& value, int occurrence = 0);
  /// Coordinates in working units. Error where the line of the node does not say where it is
  /// (/CNODE, /TRANSFORM).
  Edit& move_node(std::int64_t id, const Point3<double>& to);
  /// Adds blocks, whole lines that begin with a keyword, at the end of the main file. Lines that
  /// they leave away come when their fields are set.
  Edit& insert(std::string_view blocks);
  /// Removes a block with its lines; comments after its last line stay.
  Edit& erase(const Block* block);
  /// The block with this keyword and id, as find_block() has it, in the deck with what was
  /// inserted. One that was inserted is there until the next change.
  Result<const Block*> find(std::string_view keyword, std::int64_t id);

  /// The error that diff(), save() and save_to() would give.
  Result<void> status() const;
  /// Values that lost digits, one sentence each.
  const std::vector<std::string>& notes() const;
  /// The deck as it will be, read from memory.
  Result<LoadedDeck> read();

  /// The changes as a patch that git apply takes.
  Result<std::string> diff();
  /// Replaces the files that change where they are, packed ones packed; all of them or none, and
  /// only if they still are what was read. Gives their paths. Error: another deck in the folder of
  /// such a file, or one of `others`, includes it.
  Result<std::vector<std::string>> save(const SaveOptions& options = {});
  /// Writes all files of the deck below another directory. Error: a file that is there and differs,
  /// unless `overwrite`; a file of the deck itself in any case.
  Result<std::vector<std::string>> save_to(const std::string& directory, bool overwrite = false);
  /// All files of the deck with what they shall hold, for writing them in other ways.
  Result<EditSet> files();

 private:
  class State;
  std::unique_ptr<State> state_;
};

// Repairs of initial penetrations and of ties that lose nodes: options and results of all
// strategies, and the strategies that change an interface card (a smaller gap, Inacti, Fpenmax, a
// larger dsearch). Strategies that move nodes are not public (edit/shared/depenetrate.hpp).
//
// A strategy changes no file: it returns a Rewrite, with the penetrations before and after it. To
// count those after it, the strategy reads the deck with the proposed text and evaluates it.

struct FixOptions {
  int threads = 1;
  std::vector<std::int64_t> interfaces;  ///< ids to treat; empty: all
  /// TYPE10 ties what lies within its gap: that is no penetration, and untreated unless this is
  /// set. No other fix may loosen a tie, or make one.
  bool ties = false;
  /// Called with what is being done and (done, total); total 0: unknown. May be empty.
  std::function<void(std::string_view step, std::size_t done, std::size_t total)> progress;
};

/// Initial penetrations of one interface, all its contacts together. Lengths in working units.
struct FixCount {
  std::uint64_t pairs = 0;
  std::uint64_t nodes = 0;       ///< distinct secondary nodes or edges
  std::uint64_t untreated = 0;   ///< pairs about which the solver does nothing, or stops
  std::uint64_t on_surface = 0;  ///< pairs at distance 0
  double deepest = 0;
};

/// One changed cell of an interface card.
struct FieldChange {
  std::string field;
  std::string old_text, new_text;       ///< as on the card; old_text is empty for a blank cell
  double old_value = 0, new_value = 0;  ///< in effect; working units
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

/// A penetration, a node that is not tied, or a whole interface (no nodes), that was not treated,
/// and why.
struct FixRefusal {
  std::int64_t interface_id = 0;
  std::vector<std::int64_t> nodes;  ///< the secondary node, or the two of an edge
  double depth = 0;                 ///< in the deck as it was read
  std::string reason;
  double distance = 0;  ///< of a node that is not tied, from its nearest segment; 0: there is none
  /// The command that goes on from here, without --interface; "DECK" stands for the deck. Empty:
  /// none in particular.
  std::string next = {};
};

/// A node that a fix ties.
struct NewlyTied {
  std::int64_t node = 0;
  std::vector<std::int64_t> segment;  ///< triangle: last repeated
  double distance = 0;
};

/// A TYPE2 that lost nodes.
struct FixedTie {
  std::int64_t id = 0;
  std::string title;
  double reach = 0;  ///< how far its nodes may be; working units
  TieCounts before, after;
  double needed = 0;             ///< farthest of the nodes that are tied now; 0: none are
  std::vector<NewlyTied> nodes;  ///< ascending ids
  std::vector<FieldChange> changes;
};

/// The solver's action on one penetration, before and after the change.
struct FixAction {
  std::int64_t interface_id = 0;
  std::vector<std::int64_t> secondary, main;  ///< node ids
  double depth = 0, gap = 0;
  PenetrationAction before = PenetrationAction::none, after = PenetrationAction::none;
  bool stops = false;  ///< the solver stops at this pair after the change
  double gap0 = 0;     ///< gap left where it is reduced
};

struct PenetrationFix {
  std::string strategy;
  Rewrite rewrite;
  std::vector<FixedInterface> interfaces;  ///< those with penetrations, before or after; by id
  std::vector<MovedNode> moved;            ///< by node id
  std::vector<FixRefusal> refused;         ///< by interface, deepest first
  std::vector<FixAction> actions;          ///< Inacti, Fpenmax: by interface, deepest first
  std::vector<FixedTie> ties;              ///< tie: those that lose nodes; by position in the deck
  std::uint64_t crossings_before = 0, crossings_after = 0;  ///< where nodes move: crossed elements
  /// Pairs and nodes that stay tied (also by TYPE2): equal before and after the fix.
  std::uint64_t tied_pairs = 0, tied_nodes = 0;
  int iterations = 0;
  bool complete = false;  ///< nothing is left of what the strategy treats
};

struct ReduceGapOptions : FixOptions {
  /// The new gap is at least this share of the present one; otherwise the interface is refused.
  double least_share = 0.5;
  /// Significant digits of the new values; they are rounded down.
  int digits = 6;
};
/// Gives every interface with penetrations the largest gap that leaves none: Gapmin where the gap
/// is constant, the better of Fscalegap and Gapmax where it follows the thickness (Igap 1 becomes 2
/// for that, which is the same with Fscalegap 1). TYPE25: the better of Gap_scale and Gap_max_s
/// with Gap_max_m; TYPE24: the latter. A cell is only ever lowered. Error: the deck cannot be read
/// again.
Result<PenetrationFix> reduce_gaps(const LoadedDeck& context, const ReduceGapOptions& options);

struct InactiOptions : FixOptions {
  std::optional<int> inacti;  ///< absent: 6; TYPE24 and TYPE25: 5
};
/// Sets Inacti where there are penetrations. Refused: values that the solver does not take or that
/// do nothing for the type, and interfaces where it would stop at a node at distance 0.
Result<PenetrationFix> set_inacti(const LoadedDeck& context, const InactiOptions& options);

struct FpenmaxOptions : FixOptions {
  /// Penetrations deeper than this share of the gap lose their node: its contact is off for the
  /// whole interface. Absent: the smallest value that drops nothing but nodes at distance 0, at
  /// which the solver would stop.
  std::optional<double> ratio;
};
/// Sets Fpenmax of TYPE7 interfaces; all other penetrations stay with Inacti.
Result<PenetrationFix> set_fpenmax(const LoadedDeck& context, const FpenmaxOptions& options);

struct TieOptions : FixOptions {
  /// Nodes farther from their segment stay as they are, working units. Absent: for each interface
  /// as far as the solver looks where dsearch and Ignore are blank, the mean side of its segments.
  std::optional<double> reach;
};
/// Raises dsearch of every TYPE2 that loses nodes to what those within reach need. A node stays as
/// it is where something else holds it (another tie, a rigid body ...) or where tying it would stop
/// the solver; dsearch then stays below what would tie it. Whatever was tied stays tied to the same
/// segment. Not treated, with the reason: Isearch 1, Ignore above 3, surfaces as secondary side.
Result<PenetrationFix> tie_nodes(const LoadedDeck& context, const TieOptions& options);

/// One strategy of several.
using FixStep = std::function<Result<PenetrationFix>(const LoadedDeck& context)>;
struct FixSequence {
  std::vector<PenetrationFix> fixes;  ///< one a step; rewrites are of the deck before that step
  ChangedFiles changed;               ///< by all steps together, against the deck as given
};
/// Each step acts on the deck with what the steps before have changed.
Result<FixSequence> fix_in_order(const LoadedDeck& context, const std::vector<FixStep>& steps);
/// The result of a fix, in pairs: those that it solves, those that it leaves though it changes
/// something for them, those that it does not treat (PenetrationFix::refused says why), and for
/// inacti and fpenmax those that the solver treats already. Together they are all penetrations. For
/// tie: nodes.
struct FixScore {
  std::uint64_t solved = 0, left = 0, not_treated = 0, treated_already = 0;
  std::uint64_t open() const { return left + not_treated; }
};
FixScore score_of(const PenetrationFix& fix);
/// The one that leaves least, of equals the first.
/// nullptr: no proposal leaves fewer than there are.
const PenetrationFix* best_of(const std::vector<PenetrationFix>& proposals);
/// The report where no proposal is taken: the penetrations of the deck as it is, and no changes.
PenetrationFix unchanged(const std::vector<PenetrationFix>& proposals);

/// Several fixes as one report: strategies by commas, before of the first, after, actions and
/// what is not treated of the last. Its rewrite is empty.
PenetrationFix combined(const std::vector<PenetrationFix>& fixes);

// Conversions of a deck: to another version, other units, other ids, one file, every TYPE19 as the
// TYPE7 and TYPE11 that the solver makes of it, or only the blocks that some interfaces need. Each
// has a loss report that lists the changes.

struct VersionOptions {
  /// Drop values that the other version has no cell for, and keep blocks whose columns there are
  /// not known as they are. Without it both are refusals.
  bool allow_loss = false;
};

/// The versions that decks can be written in: 110 to 140 and 2017 on.
bool is_target_version(int version);

/// Changes the version number of every /BEGIN to `version` (110 … 2026, 2612) and every block whose
/// layout differs between its own version and that one: cells that both have keep their text, cells
/// that only the old one has are blanked, lines are inserted, removed and moved as the new layout
/// asks. Comments stay where they are. Loss report: one `kept` per block that was changed;
/// `dropped` for a value that is not at its default and has no cell any more; `undecided` for every
/// keyword of which not every column is known in both versions, with the number of its blocks, and
/// for values that do not fit. `dropped` and `undecided` are refusals without allow_loss; a
/// smoothed surface (Ists) that would be read as a node group always is. Refused as a whole:
/// unknown target, decks older than version 100 or without /BEGIN.
Rewrite to_version(const LoadedDeck& context, int version, const VersionOptions& options = {});

struct UnitsOptions {
  /// Convert what is known and report the rest as `undecided` instead of refusing.
  bool partial = false;
  /// Only the input system changes: /BEGIN keeps the working system it has, so that the solver
  /// computes with the same numbers as before and Engine files stay valid.
  bool keep_working = false;
};

/// "kg,mm,ms" (mass, length, time; numbers are factors to kg, m, s). Error: what is wrong with it.
Result<UnitSystem> parse_unit_system(std::string_view text);

/// Rewrites every cell written in the input units of /BEGIN to `target`, and /BEGIN itself.
///
/// - Where input and working system are the same, both become `target` (unless keep_working);
///   where they differ, the working system was chosen by somebody and stays. Values that the solver
///   takes in working units (defaults of 0 or blank cells) are then written out if they depend on
///   the system; bounds such as 1e30 stay blank.
/// - Blocks with a unit id of their own, and submodels with their own /BEGIN, keep their cells:
///   they are not in the deck's units.
/// - Factors that are powers of ten move the decimal point of the text, so there and back gives the
///   same value; a value that does not survive that is `approximated` in the loss report.
/// - Refusals (with `partial`: `undecided`): unknown keywords, keywords described in part that hold
///   undescribed numbers, cells of unknown dimension that are not 0, unreadable numbers, parameters
///   that are used with several dimensions or made by expressions, functions in working units.
Rewrite to_units(const LoadedDeck& context, const UnitSystem& target,
                 const UnitsOptions& options = {});

/// Adds to `out` what becomes of the Engine files beside the deck, whose times are in working
/// units: the edits, one `kept` entry a file, and a refusal (`undecided`, if `accept`) for every
/// keyword whose cells are not known.
void engine_to_units(const Deck& deck, const EngineFiles& engine, const UnitSystem& target,
                     const UnitsOptions& options, bool accept, Rewrite& out);

/// New ids of one kind.
struct RenumberRule {
  /// "node", "shell", "sh3n", "solid", "quad", "tria", "truss", "beam", "spring", "part", "prop",
  /// "mat", "subset", "grnod" (and the other group kinds), "surf", "line", "set", "box", "funct",
  /// "sensor", "skew", "frame", "friction", "inter", "transform"; "element": all element kinds;
  /// "group": all groups, surfaces, lines and sets; "all": everything named here.
  std::string kind;
  bool compact = false;    ///< new ids follow one another from `value` on, in the order of the old
  std::int64_t value = 0;  ///< added to every id; with `compact` the first id
};

/// "node+1000", "part-50" (offset), "node=1" (compact from 1). Error: what is wrong with it.
Result<RenumberRule> parse_renumber_rule(std::string_view text);

struct RenumberOptions {
  std::vector<RenumberRule> rules;  ///< at most one for a kind
  /// Renumber what is known and report the rest as `undecided` instead of refusing.
  bool partial = false;
};

/// The order of ids of a kind stays, so groups, sorts and ties come out as before. Ids are those of
/// the whole model (submodel offsets added); written ids change by as much.
///
/// Refusals (with `partial`: `undecided`): text that no schema describes and that holds a number
/// equal to an id that changes; ids made by parameters; ids that do not fit their columns, or
/// become less than 1 (in a submodel: less than its offset plus 1) or too large; a set that a group
/// would hide under its new id; ranges that do not stay ranges.
Rewrite renumber(const LoadedDeck& context, const RenumberOptions& options);

/// Replaces every /INTER/TYPE19 by
///  * a TYPE7 that keeps id, title, lines and comments: nodes of surf_IDs on surf_IDm;
///  * for two different surfaces a second TYPE7 with the sides exchanged;
///  * a TYPE11 of the edges of both surfaces (all edges, or the free ones where
///  /DEFAULT/INTER/TYPE19
///    sets Iedge 1), unless there are none;
/// and by the /GRNOD/SURF, /LINE/SURF or /LINE/EDGE they need, with ids above all that are used.
/// Surfaces given as sets are referred to as sets on all sides. Flags that are 0 on the TYPE19 are
/// written out, so that default cards of TYPE7 and TYPE11 do not change them; other cells keep
/// their text. New blocks go in front of /END of the main file, which is where the solver processes
/// them, or behind the TYPE19 where that stands in a submodel or has another input version. Loss
/// report: one `kept` per interface; `undecided`, always a refusal, where a flag has no cell in the
/// deck's version and the other type's default is another one.
Rewrite expand_type19(const LoadedDeck& context);

struct FlattenOptions {
  bool mark = true;  ///< comment lines that name the included file, before and behind its lines
};

/// The deck without includes (Rewrite::new_text). Every line that is read stays byte for byte what
/// it was, line ends included, with these exceptions: directives become comments; the last line of
/// a file gets a line end if it has none; /END, #enddata and what follows them in an included file
/// is left out; a /BEGIN of an included file (same version, outside of submodels) becomes a
/// comment; a LOCAL parameter whose name means something else in another file gets a new name of
/// the same length. The result is read again and compared block by block.
///
/// A file of another input version is read with the version around it from now on: where that
/// changes nothing that is known, keywords described in part are `undecided` in the loss report.
///
/// Refusals: includes that cannot be read, cells that would mean something else in the version
/// around them, local parameters for which there is no free name.
Rewrite flatten(const LoadedDeck& context, const FlattenOptions& options = {});

/// One file (Rewrite::new_text) with these interfaces (ids as everywhere in reports, submodel
/// offsets added), the groups, surfaces, sets and boxes they name, every element that touches a
/// node of theirs or that such a selection is made of, and the nodes, parts, properties, materials,
/// frictions, functions, sensors, axes, transformations and switches that go with them. Kept blocks
/// and lines are copied byte for byte, in the order of the deck; ids stay.
///
/// The result is read again: effective values, segments, gaps and stiffness must be those of the
/// whole deck, and of a TYPE2 what it ties; what differs is `approximated` in the loss report.
/// Everything left out is `dropped` there, one entry a keyword.
///
/// Refusals: an id that is no interface whose card is read; a deck that cannot be flattened.
Rewrite extract_contacts(const LoadedDeck& context, std::span<const std::int64_t> interfaces);

}  // namespace deck
