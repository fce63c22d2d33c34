// Unit conversion: a deck in another unit system — the same model, every value of known dimension
// with another number in front of it.
#pragma once
#include <string_view>

#include "deck/edit/rewrite.hpp"
#include "deck/keyword/engine_file.hpp"

namespace deck {

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

}  // namespace deck
