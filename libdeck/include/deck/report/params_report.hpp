// The effective values of all interfaces, for people and for programs: what the card says, what the
// solver uses, and where that came from.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/model/interfaces.hpp"
#include "deck/model/model.hpp"

namespace deck {

/// What the geometry says about one elementary contact of an interface. TYPE19 has up to three.
struct DerivedGap {
  const InterBase* inter = nullptr;
  std::string_view role;  ///< "primary", "reversed", "edges"
  double gapmin = 0;
  double drad = 0;
};

struct ParamsInput {
  std::string_view path;  ///< of the deck, as given
  const Deck* deck = nullptr;
  const Model* model = nullptr;
  const Interfaces* interfaces = nullptr;
  /// In processing order; empty: the geometry was not evaluated, derived values are unknown.
  std::vector<DerivedGap> gaps;
};

struct ParamsTextOptions {
  bool color = false;
  bool changed_only = false;  ///< leave out fields whose value stands on the card
};

/// One table per interface.
std::string params_text(const ParamsInput& input, const ParamsTextOptions& options = {});
/// The document of `deck params --json` (schemas/output/params.schema.json).
std::string params_json(const ParamsInput& input);

}  // namespace deck
