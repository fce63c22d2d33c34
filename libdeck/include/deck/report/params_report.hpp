// The effective values of all interfaces, for people and for programs: what the card says, what the
// solver uses, and where that came from.
#pragma once
#include <string>
#include <string_view>

#include "deck/contact/scene.hpp"
#include "deck/model/interfaces.hpp"
#include "deck/model/model.hpp"

namespace deck {

struct ParamsInput {
  std::string_view path;  ///< of the deck, as given
  const Deck* deck = nullptr;
  const Model* model = nullptr;
  /// Values of Origin::geometry are unknown where the interface is not resolved.
  const Interfaces* interfaces = nullptr;
  /// Says what the parts of a TYPE19 have where they differ from the interface; may be missing.
  const Scene* scene = nullptr;
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
