// Decks built from text with their contacts: what the tests of reports and of verdicts look at.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "contact/small_deck.hpp"
#include "deck/contacts.hpp"

namespace deck::test {

/// A deck with model, interfaces and contacts. Stays at its address.
struct Inspected {
  explicit Inspected(const std::string& text)
      : loaded(LoadedDeck::from(
            std::move(*read_deck_text("test_0000.rad", text, SchemaSet::built_in())))) {}
  Inspected(const Inspected&) = delete;
  Inspected& operator=(const Inspected&) = delete;

  LoadedDeck loaded;
  const Deck& deck = loaded.deck();
  const Model& model = loaded.model();
  const Scene& scene = loaded.scene();
  const Interfaces& interfaces = loaded.interfaces();
  SceneView view = make_view(scene);
};

/// What the plates differ in.
struct Plates {
  double height = 0.4;  ///< of the upper one
  std::string card = "Gapmin=0.5";
  std::string before = {};  ///< blocks in front of the others
};

/// Two sheets of one element each, nodes 1..4 and 5..8, parts 1 and 2, nodes of the upper one
/// against the lower one in interface 1.
inline std::string plates(const Plates& p = {}) {
  SmallDeck d;
  if (!p.before.empty()) d.add(p.before);
  for (int k = 0; k < 2; ++k) {
    const double z = k == 0 ? 0 : p.height;
    d.node(4 * k + 1, 2 * k, 2 * k, z).node(4 * k + 2, 10 - 2 * k, 2 * k, z);
    d.node(4 * k + 3, 10 - 2 * k, 10 - 2 * k, z).node(4 * k + 4, 2 * k, 10 - 2 * k, z);
  }
  d.shell_part(1, 1.0).shell_part(2, 1.0).shell(1, 1, 1, 2, 3, 4).shell(2, 2, 5, 6, 7, 8);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2});
  return d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 " + p.card).text();
}

}  // namespace deck::test
