// Broken decks: conversions refuse or report, and what they write can be read again.
#include <gtest/gtest.h>

#include <random>

#include "../contact/small_deck.hpp"
#include "deck/edit.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using edit_test::Whole;

std::string rich_deck() {
  test::SmallDeck d;
  for (int i = 0; i < 4; ++i) d.node(i + 1, i % 2 * 10.0, i / 2 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(i + 5, i % 2 * 9.0, i / 2 * 9.0, 1.0);
  d.shell_part(1, 1.5).shell_part(2, 2.5).solid_part(3).beam_part(4, 2.0);
  d.shell(1, 1, 1, 2, 4, 3).shell(2, 2, 5, 6, 8, 7).brick(3, 3, {1, 2, 4, 3, 5, 6, 8, 7});
  d.bar("BEAM", 4, 4, 1, 2, 3);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/EXT/3", {3}).group("/GRNOD/PART/2", {2, -1});
  d.group("/GRNOD/GENE/3", {1, 4}).group("/SUBSET/1", {2}).group("/LINE/EDGE/1", {1});
  d.add(
      "/SET/GENERAL/9\nset\nPART               1         2\nNODE_GD            1         3"
      "         1\nSEG                1         1         2         4         3\nRBODY"
      "              1\nPLANE                      1.0                 2.0                 3.0\n"
      "                     1.0                 2.0                 4.0");
  d.add("/PARAMETER/GLOBAL/REAL/1\np\ngap                        0.5");
  d.add("/PARAMETER/LOCAL/REAL_EXPR/2\np\ntwo       2*gap+&gap");
  d.add("/UNIT/5\nm\n                  kg                   m                   s");
  d.add(
      "//SUBMODEL/1\nsub\n       100\n/NODE/5\n         1                 1.0\n/GRNOD/NODE/1\ng\n"
      "         1\n//ENDSUB");
  d.add("/CNODE/0.1\n        20                 1.0                 0.0                 0.0");
  d.add("/TETRA10/3\n        30\n         1         2         3         5");
  d.add(
      "/TRANSFORM/TRA/1\nt\n         2                 0.0                 0.0                 "
      "0.1");
  d.add("@/INTER/TYPE7/1 Gapmin=&gap Igap=1 Inacti=5 Istf=1 Stfac=7 Ifric=1 C1=3");
  d.add("@/INTER/TYPE19/2 surf_IDs=9 surf_IDm=3 Igap=1");
  d.add("@/INTER/TYPE11/3 line_IDs=1 Igap=1");
  d.add("/RBODY/1\nr\n         5\n/THING/7\n  1 2 3.5 &gap\n#include a.inc\n#include a.inc");
  return d.text();
}

void convert_all(const std::string& main, const std::string& include) {
  const auto w = Whole::read("main_0000.rad", {{"main_0000.rad", main}, {"a.inc", include}});
  if (w->deck.sources.size() == 0) return;
  const auto check = [&](const Rewrite& r) {
    if (!r.refusals.empty()) return;
    const auto changed = apply_rewrite(w->deck.sources, r);
    if (!changed) return;  // contradicting edits of a file that is included twice
    Whole::Files files = w->files;
    for (const auto& [path, text] : *changed) files[path] = text;
    ReadOptions options;
    options.overlay = &files;
    EXPECT_TRUE(read_deck("main_0000.rad", SchemaSet::built_in(), options).ok());
  };
  for (const bool partial : {false, true}) {
    check(to_units(w->context(), *parse_unit_system("Mg,0.0254,s"), {.partial = partial}));
    RenumberOptions options;
    options.partial = partial;
    options.rules = {*parse_renumber_rule("all+1000")};
    check(renumber(w->context(), options));
    options.rules = {*parse_renumber_rule("node=1"), *parse_renumber_rule("element=5")};
    check(renumber(w->context(), options));
  }
  check(flatten(w->context()));
  std::vector<std::int64_t> ids;
  for (const InterBase* i : w->interfaces.ordered) ids.push_back(i->id);
  check(extract_contacts(w->context(), ids));
}

TEST(BrokenDecks, ConversionsNeverHurt) {
  const std::string good = rich_deck();
  const std::string include =
      "/PARAMETER/LOCAL/REAL/1\np\ngap                        0.7\n/NODE\n        50"
      "                &gap\n/END\n";
  convert_all(good, include);
  std::mt19937 random(51);
  for (int round = 0; round < 400; ++round) {
    std::string main = good, other = include;
    std::string& text = round % 4 == 0 ? other : main;
    for (int k = static_cast<int>(random() % 10); k >= 0; --k) {
      const std::size_t at = random() % (text.size() + 1);
      switch (random() % 6) {
        case 0:
          text.insert(at, 1, static_cast<char>(random() % 256));
          break;
        case 1:
          text.erase(at, random() % 30);
          break;
        case 2:
          text.insert(at, text.substr(random() % (text.size() + 1), random() % 80));
          break;
        case 3:
          text.insert(at, ",");
          break;
        case 4:
          text.insert(at, "\n");
          break;
        default:
          if (at < text.size()) text[at] = "0123456789-&/#.e"[random() % 16];
      }
    }
    convert_all(main, other);
  }
}

}  // namespace
}  // namespace deck
