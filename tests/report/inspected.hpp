// Decks built from text with their contacts: what the tests of show, diff and params look at.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "contact/small_deck.hpp"
#include "deck/contact/scene.hpp"
#include "inspect/shared/diff.hpp"
#include "report/shared/diff.hpp"
#include "report/shared/params_report.hpp"
#include "report/shared/show.hpp"

namespace deck::test {

/// A deck with model, interfaces and contacts. Stays at its address.
struct Inspected {
  explicit Inspected(const std::string& text)
      : loaded(LoadedDeck::from(
            std::move(*read_deck_text("test_0000.rad", text, SchemaSet::built_in())))) {}
  Inspected(const Inspected&) = delete;
  Inspected& operator=(const Inspected&) = delete;

  DiffSide side() const { return {loaded, &view}; }
  ParamsInput params() const { return {loaded, &scene}; }
  EntityView look(const std::string& what) const {
    const auto entity = find_entity(deck, model, what);
    EXPECT_TRUE(entity.ok()) << (entity.ok() ? "" : entity.error().message);
    return view_entity(deck, model, interfaces, entity.ok() ? *entity : Entity{});
  }

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
  std::string before = {};       ///< blocks in front of the others
  int first = 0;                 ///< added to all ids
  std::vector<int> upper = {2};  ///< parts of the node group
};

/// Two sheets of one element each, nodes 1..4 and 5..8, parts 1 and 2, nodes of the upper one
/// against the lower one in interface 1.
inline std::string plates(const Plates& p = {}) {
  const int f = p.first;
  SmallDeck d;
  if (!p.before.empty()) d.add(p.before);
  for (int k = 0; k < 2; ++k) {
    const double z = k == 0 ? 0 : p.height;
    d.node(f + 4 * k + 1, 2 * k, 2 * k, z).node(f + 4 * k + 2, 10 - 2 * k, 2 * k, z);
    d.node(f + 4 * k + 3, 10 - 2 * k, 10 - 2 * k, z).node(f + 4 * k + 4, 2 * k, 10 - 2 * k, z);
  }
  d.shell_part(f + 1, 1.0).shell_part(f + 2, 1.0);
  d.shell(f + 1, f + 1, f + 1, f + 2, f + 3, f + 4).shell(f + 2, f + 2, f + 5, f + 6, f + 7, f + 8);
  std::vector<int> upper;
  for (const int id : p.upper) upper.push_back(f + id);
  d.group(("/SURF/PART/" + std::to_string(f + 1)).c_str(), {f + 1});
  d.group(("/GRNOD/PART/" + std::to_string(f + 2)).c_str(), upper);
  d.add("@/INTER/TYPE7/" + std::to_string(f + 1) + " grnd_IDs=" + std::to_string(f + 2) +
        " surf_IDm=" + std::to_string(f + 1) + " " + p.card);
  return d.text();
}

/// Totals of a contact in which no two numbers are the same.
inline ContactTotals distinct_totals() {
  ContactTotals t;
  t.count = {51, 52, 53};
  t.tied = {54, 55, 0};
  t.on_segment = {56, 57, 58};
  t.crossed_elements = 59;
  t.solver_errors = 60;
  t.acted = 61;
  t.max_depth = 0.1875;
  t.max_ratio = 0.3125;
  return t;
}

}  // namespace deck::test
