// Shared by the steps of unit conversion.
// A cell of dimension mass^m length^l time^t becomes its number times M^m L^l T^t, with the factors
// M, L, T between old and new units. Exceptions, each in its step: numbers that the solver reads in
// working units; scales, whose blank means 1; functions without a scale, whose points change;
// parameters used with two dimensions. An undecided cell refuses the conversion, or with `partial`
// its whole block stays.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/edit.hpp"
#include "edit/cells.hpp"

namespace deck::detail {

/// new value = old value * factor.
struct UnitFactor {
  std::optional<int> power;  ///< set if the factor is exactly 10^power
  long double value = 1;
  bool one() const { return power && *power == 0; }
  UnitFactor inverse() const;
  std::string text() const;  ///< "1e-3", "0.0254"
};

/// Factors of base units and of their products.
class UnitFactors {
 public:
  UnitFactors(const UnitSystem& from, const UnitSystem& to);
  UnitFactor of(const Dimension& dimension) const;
  const UnitFactor& mass() const { return base_[0]; }
  const UnitFactor& length() const { return base_[1]; }
  const UnitFactor& time() const { return base_[2]; }

 private:
  UnitFactor base_[3];
};

/// A number in other units.
struct ScaledText {
  std::string text;
  bool exact = false;  ///< converting back gives the old value
};

/// `cell` times `factor` with as many digits as fit `width` columns: 210.0 becomes 0.21 and comes
/// back as 210. nullopt: no plain number, no room, or out of range.
std::optional<ScaledText> scale_text(std::string_view cell, int width, const UnitFactor& factor);

/// Working units follow input units: numbers in working units change.
inline bool working_units_change(const Deck& deck, const UnitSystem& target,
                                 const UnitsOptions& options) {
  return !options.keep_working && deck.begin.input == deck.begin.working &&
         !(deck.begin.working == target);
}

struct UnitConversion {
  UnitConversion(const LoadedDeck& c, const UnitSystem& t, const UnitsOptions& o)
      : context(c),
        deck(c.deck()),
        target(t),
        options(o),
        factors(c.deck().begin.input, t),
        working_changes(working_units_change(c.deck(), t, o)),
        cells(deck.sources, out.edits) {}

  const LoadedDeck& context;
  const Deck& deck;
  const UnitSystem& target;
  const UnitsOptions& options;
  UnitFactors factors;
  bool working_changes;
  Rewrite out;

  /// Reports a cell that cannot be converted: a refusal, or with `partial` a loss, and the whole
  /// block stays.
  void undecided(const Block& block, Span place, std::string field, std::string why);
  void convert(const CellPlace& place, const UnitFactor& factor);
  /// Overload for columns first..last of a line in fixed columns.
  void convert(const Block& block, const Line& line, int first, int last, std::string_view field,
               const UnitFactor& factor) {
    convert({&block, line.columns(first, last), field, line, first, last}, factor);
  }
  CellEdits cells;

  struct ParameterUse : CellPlace {
    Dimension dimension;
    double value = 0;
  };
  std::map<std::string, std::vector<ParameterUse>, std::less<>> parameter_uses;

  /// Id of a function or table in a block.
  struct FunctionUse : CellPlace {
    std::int64_t id = 0;
    std::vector<Dimension> points;  ///< dimension of the points, by axis
  };
  std::vector<FunctionUse> function_uses;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::string>
      copies;                  ///< of functions, by place
  std::int64_t last_copy = 0;  ///< id of the last one

  /// Range of a block in `out`; with `partial` some blocks are removed again.
  struct Share {
    std::size_t edits = 0, edits_end = 0, losses = 0, losses_end = 0;
  };
  std::multimap<const Block*, Share> shares;
  /// Opens the share of a block; the destructor closes it.
  class OpenShare {
   public:
    OpenShare(UnitConversion& c, const Block& block);
    OpenShare(const OpenShare&) = delete;
    OpenShare& operator=(const OpenShare&) = delete;
    ~OpenShare();

   private:
    UnitConversion& c_;
    const Block& block_;
    Share share_;
  };
  std::set<const Block*> left;
  /// Removes the edits of blocks in `left`.
  void leave_blocks();

  std::uint64_t changed_cells = 0, own_unit_blocks = 0;
  /// Exponents of mass, length and time -> factor, for the notes.
  std::map<std::array<int, 3>, UnitFactor> used_factors;
  void note_dimension(const Dimension& d, const UnitFactor& factor) {
    used_factors.try_emplace({d.mass, d.length, d.time}, factor);
  }
};

/// Converts /BEGIN, or /UNIT/LENGTH ... of old versions. False: refused.
bool convert_begin(UnitConversion& conversion);
void convert_blocks(UnitConversion& conversion);
/// Converts definitions of parameters used by converted cells; a parameter with several meanings
/// stays, and its cells get numbers.
void convert_parameters(UnitConversion& conversion);

/// Converts points of functions whose axes have no scale. A function used in several units gets a
/// copy per unit.
void convert_functions(UnitConversion& conversion);

}  // namespace deck::detail
