// The card of one interface: fills typed fields with what the cells say, in working units and with
// submodel offsets, before any rule of the solver is applied.
#pragma once
#include <string_view>

#include "deck/keyword/decode.hpp"
#include "deck/model/interfaces.hpp"

namespace deck::detail {

class InterfaceCard {
 public:
  InterfaceCard(const Deck& deck, const Block& block)
      : deck_(deck), decoded_(decode(deck, block)) {}

  /// Id, title and place. `type` is that of the keyword.
  void head(int type, InterBase& out) const;
  void read(std::string_view field, EffectiveInt& out) const;
  void read(std::string_view field, EffectiveReal& out) const;
  /// IBC: the cells IBCX, IBCY, IBCZ as three digits.
  void read(std::string_view field, EffectiveText& out) const;
  /// Every field of an interface struct.
  template <class Inter>
  void read_all(Inter& out) const {
    out.for_each([this](std::string_view name, auto& field) { this->read(name, field); });
  }
  const DecodedBlock& decoded() const { return decoded_; }

 private:
  const Cell* find(std::string_view field) const;
  const Deck& deck_;
  DecodedBlock decoded_;
};

/// Submodel offset applied: only ids above 0 are shifted.
std::int64_t shifted_id(const Deck& deck, const Block& block, std::string_view kind,
                        std::int64_t id);

}  // namespace deck::detail
