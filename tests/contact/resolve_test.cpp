// What the mesh decides is handed back to the interfaces.
#include "deck/contacts.hpp"

#include <gtest/gtest.h>

#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

/// A plate of 10 x 10 with thickness 2 and nodes above it, with some interface.
SmallDeck plate(const std::string& card) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(101, 3, 4, 5).node(102, 6, 4, 5).shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101, 102}).group("/LINE/SURF/1", {1});
  return d.add(card);
}

TEST(Resolve, GivesABlankGapTheDefaultOfTheMeshAndLeavesThatOfTheCardAlone) {
  Built b(plate("@/INTER/TYPE7/1\n@/INTER/TYPE7/2 Gapmin=0.5\n@/INTER/TYPE10/3"));
  const EffectiveReal &blank = b.interfaces.type7.at(0).Gapmin,
                      &given = b.interfaces.type7.at(1).Gapmin;
  EXPECT_EQ(std::tuple(blank.origin, blank.value), std::tuple(Origin::geometry, 0.0));
  EXPECT_TRUE(waits_for_geometry(b.interfaces));
  b.loaded.mesh_values();
  EXPECT_EQ(std::tuple(blank.value, blank.before_geometry()), std::tuple(2.0, 0.0));
  EXPECT_EQ(std::tuple(given.origin, given.value, given.before_geometry()),
            std::tuple(Origin::card, 0.5, 0.5));
  EXPECT_EQ(b.interfaces.type10.at(0).Gap.value, 2);
  EXPECT_TRUE(b.interfaces.type7.at(0).resolved);
  EXPECT_FALSE(waits_for_geometry(b.interfaces));
}

TEST(Resolve, TellsThePartsOfAType19Apart) {
  Built b(plate("@/INTER/TYPE19/1 Edge_scale_gap=0.5"));
  b.loaded.mesh_values();
  const InterType19& inter = b.interfaces.type19.at(0);
  EXPECT_EQ(inter.Gapmin.value, geometry_value(*first_contact(b.scene, inter), "Gapmin"));
  EXPECT_EQ(first_contact(b.scene, inter)->role, ContactRole::primary);
}

TEST(Resolve, ASecondSceneOfResolvedInterfacesIsTheFirst) {
  Built b(plate("@/INTER/TYPE7/1 Igap=2 Fscalegap=0.7"));
  b.loaded.mesh_values();
  Diagnostics findings;
  const Scene again = build_scene(b.model, b.interfaces, findings);
  EXPECT_EQ(again.contacts.at(0).gapmin, b.contact().gapmin);
  EXPECT_EQ(again.contacts.at(0).gapmin_origin, GapminOrigin::scaled_thickness);
}

TEST(Resolve, InterfacesOutsideTheSceneStayOpen) {
  Built b(plate("@/INTER/TYPE7/1\n@/INTER/TYPE7/2"));
  SceneOptions options;
  options.only = {2};
  Diagnostics ignored;
  Interfaces interfaces = read_interfaces(b.deck, b.model, ignored);
  resolve(interfaces, build_scene(b.model, interfaces, ignored, options));
  EXPECT_FALSE(interfaces.type7.at(0).resolved);
  EXPECT_TRUE(interfaces.type7.at(1).resolved);
  EXPECT_TRUE(waits_for_geometry(interfaces));
}

}  // namespace
}  // namespace deck::test
