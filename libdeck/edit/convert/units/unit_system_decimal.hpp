// Numbers of a deck times a unit factor, as decimal text: powers of ten move the point and keep
// every digit, other factors are computed and rounded once. Private to unit conversion.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "deck/keyword/deck.hpp"

namespace deck::detail {

/// new value = old value * factor.
struct UnitFactor {
  std::optional<int> power;  ///< the factor is 10^power exactly
  long double value = 1;
  bool one() const { return power && *power == 0; }
  UnitFactor inverse() const;
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

/// `cell` times `factor` with the most significant digits that fit `width` columns, spelled as the
/// cell is: 210.0 becomes 0.21 and comes back as 210.0. nullopt: the cell holds no plain number, or
/// the result does not fit or is out of range.
std::optional<ScaledText> scale_text(std::string_view cell, int width, const UnitFactor& factor);

}  // namespace deck::detail
