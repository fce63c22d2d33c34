// What the steps of unit conversion share. Private to unit conversion.
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
  std::optional<int> power;  ///< the factor is 10^power exactly
  long double value = 1;
  bool one() const { return power && *power == 0; }
  UnitFactor inverse() const;
  std::string text() const;  ///< "1e-3", "0.0254"
};

/// Factors of the base units and of everything made of them.
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
  bool exact = false;  ///< converting the text back gives the old value
};

/// `cell` times `factor` with the most significant digits that fit `width` columns: 210.0 becomes
/// 0.21 and comes back as 210. nullopt: the cell holds no plain number, or the result does not fit
/// or is out of range.
std::optional<ScaledText> scale_text(std::string_view cell, int width, const UnitFactor& factor);

/// The working units follow the input units: everything that is in working units gets new numbers.
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

  /// Something that cannot be converted: a refusal, or with `partial` an undecided loss; the block
  /// then stays as it is as a whole.
  void undecided(const Block& block, Span place, std::string field, std::string why);
  /// Multiplies the number in a cell.
  void convert(const CellPlace& place, const UnitFactor& factor);
  /// The same for the cell in columns first..last of a line in fixed columns.
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

  /// An id of a function or table in a block.
  struct FunctionUse : CellPlace {
    std::int64_t id = 0;
    std::vector<Dimension> points;  ///< dimension that the points themselves carry, axis by axis
  };
  std::vector<FunctionUse> function_uses;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::string>
      copies;                  ///< of functions, by place
  std::int64_t last_copy = 0;  ///< id of the last one

  /// What a block added to `out`, and with `partial` the blocks that stay as they are.
  struct Share {
    std::size_t edits = 0, edits_end = 0, losses = 0, losses_end = 0;
  };
  std::multimap<const Block*, Share> shares;
  /// The share of a block that begins here; the destructor closes it.
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
  /// Takes the edits of the blocks in `left` out again.
  void leave_blocks();

  std::uint64_t changed_cells = 0, own_unit_blocks = 0;
  /// Exponents of mass, length and time -> factor, for the notes.
  std::map<std::array<int, 3>, UnitFactor> used_factors;
  void note_dimension(const Dimension& d, const UnitFactor& factor) {
    used_factors.try_emplace({d.mass, d.length, d.time}, factor);
  }
};

/// /BEGIN, or the /UNIT/LENGTH ... of old versions. False: refused.
bool convert_begin(UnitConversion& conversion);
/// The cells of all blocks.
void convert_blocks(UnitConversion& conversion);
/// The definitions of the parameters that converted cells use; where a parameter stands for more
/// than one thing, the cells get numbers.
void convert_parameters(UnitConversion& conversion);

/// The points of functions whose axes have no scale; a function that is read in several units gets
/// a copy for each.
void convert_functions(UnitConversion& conversion);

}  // namespace deck::detail
