// Values on interface cards, /DEFAULT/INTER/TYPEn and /FRICTION, in working units and with submodel
// offsets, before rules of the solver.
#pragma once
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/model.hpp"

namespace deck::detail {

class InterfaceCard {
 public:
  InterfaceCard(const Deck& deck, const Block& block)
      : deck_(deck), decoded_(decode(deck, block)) {}

  /// Id, title and place. `type`: of the keyword.
  void head(int type, InterBase& out) const;
  void read(std::string_view field, EffectiveInt& out) const;
  void read(std::string_view field, EffectiveReal& out) const;
  /// IBC: IBCX, IBCY, IBCZ as three digits.
  void read(std::string_view field, EffectiveText& out) const;
  /// Reads every field of an interface.
  template <class Inter>
  void read_all(Inter& out) const {
    out.for_each([this](std::string_view name, auto& field) { this->read(name, field); });
  }
  const DecodedBlock& decoded() const { return decoded_; }

 private:
  const Cell* find(std::string_view field) const;
  template <class Value, class F>
  void read_cell(std::string_view field, Effective<Value>& out, F&& value_of) const;
  const Deck& deck_;
  DecodedBlock decoded_;
};

/// The default blocks that the solver uses: outside of submodels, the first of each type. Reports
/// the others.
std::vector<DefaultInter> read_defaults(const Deck& deck, Findings& findings);

/// All /FRICTION blocks with effective values, in the solver's order.
std::vector<Friction> read_frictions(const Deck& deck);

}  // namespace deck::detail
