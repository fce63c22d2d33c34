// A search that takes the tree of the one before finds what a search of its own finds.
#include "contact/scene/sides.hpp"

#include <gtest/gtest.h>

#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

/// A node 1.3 above a sheet, and one 0.4 above it.
SmallDeck two_above() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(8, 5, 5, 1.3).node(9, 6, 5, 0.4).shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {8, 9});
  return d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1");
}

TEST(KeptSearch, FollowsTheMarginAndTheFormOfEachSearch) {
  const Built b(two_above());
  const Contact& contact = b.contact();
  const Coordinates& x = b.scene.coordinates;
  const detail::SearchSides sides(contact, detail::SearchSides::Off::included);
  detail::KeptSearch kept;
  SearchOptions options;
  options.gap = contact.gap_rule;
  std::vector<std::size_t> found;
  for (const Form form : {Form::reference, Form::robust, Form::reference})
    for (const double margin : {0.0, 0.5, 0.1}) {
      options.form = form;
      options.margin = margin;
      const SearchResult again = sides.find(x, options, kept);
      EXPECT_EQ(again.pairs, sides.find(x, options).pairs) << margin;
      found.push_back(again.pairs.size());
    }
  EXPECT_NE(found[0], found[1]);
}

}  // namespace
}  // namespace deck::test
