// A deck written again: in another version, in other units, with other ids, as one file, with
// TYPE19 as what the solver makes of it, or only what some interfaces need. Loss reports say what
// changed.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "deck/keyword/engine_file.hpp"

namespace deck {

struct VersionOptions {
  /// Drop values that the other version has no cell for, and keep blocks whose columns there are
  /// not known as they are. Without it both are refusals.
  bool allow_loss = false;
};

/// The versions that decks can be written in: 110 to 140 and 2017 on.
bool is_target_version(int version);

/// Changes the version number of every /BEGIN to `version` (110 … 2026) and every block whose
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
