// TYPE19 taken apart: the geometry stage finds the same contacts in the new interfaces.
#include "deck/edit.hpp"

#include <gmock/gmock.h>

#include "contact/meshes.hpp"
#include "edit/support.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::unique_ptr<Whole> expanded(const Whole& before) {
  const Rewrite r = expand_type19(before.context());
  EXPECT_TRUE(r.refusals.empty()) << joined(r.refusals);
  return before.after(r);
}

void expect_same_scene(const Whole& before, const Whole& after, const std::string& what) {
  EXPECT_EQ(edit_test::changed_figure(before, after, "--expand-type19"), "") << what;
}

/// Two plates of 2 x 2 shells, `distance` apart, and one more sheet folded onto the lower one.
SmallDeck plates(double distance) {
  SmallDeck d;
  d.shell_part(1, 1.5).shell_part(2, 1.0);
  for (int sheet = 0; sheet < 2; ++sheet)
    add_sheet(d, sheet + 1, 1 + 4 * sheet, 100 * sheet + 1, 2, 2, [&](int i, int j) {
      return std::array{10.0 * i + 2.5 * sheet, 10.0 * j + 1.5 * sheet, sheet * distance};
    });
  return d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {1, 2});
}

std::string with(const std::string& cards) { return plates(0.75).add(cards).text(); }

TEST(ExpandType19, EveryFlagGivesTheSameContacts) {
  for (const char* flags : {"Istf=1 Stfac=12.5",
                            "Istf=2",
                            "Istf=3",
                            "Istf=4",
                            "Istf=5",
                            "Istf=1000 Stfac=0.5",
                            "Igap=1",
                            "Igap=2 Fscalegap=0.5 Gapmax=0.6",
                            "Igap=3 %mesh_size=0.01",
                            "Igap=3",
                            "Igap=4 Fscalegap=0.8",
                            "Igap=1000 Gapmin=1.0",
                            "Inacti=1 Gapmin=2.0",
                            "Inacti=2 Gapmin=2.0",
                            "Inacti=3 Gapmin=1.0",
                            "Inacti=5 Igap=1",
                            "Inacti=6 Igap=2",
                            "Irem_gap=2 Gapmin=30.0",
                            "Gapmin=1.5 Fric=0.2 Iform=2",
                            "Tstart=1.0 Tstop=2.0 IBCX=1",
                            "Ifric=1 C1=0.1 C5=0.2",
                            "Ifric=2 C6=0.3"})
    for (const char* sides : {"surf_IDs=1 surf_IDm=2 ", "surf_IDs=3 surf_IDm=0 ",
                              "surf_IDs=0 surf_IDm=3 ", "surf_IDs=3 surf_IDm=3 "}) {
      const auto before = open_text(with(std::string("@/INTER/TYPE19/5 ") + sides + flags));
      const auto after = expanded(*before);
      expect_same_scene(*before, *after, std::string(sides) + flags);
      EXPECT_THAT(after->main_text(), Not(HasSubstr("unused")));
    }
}

TEST(ExpandType19, DefaultsSetsAndShortBlocksGiveTheSameContactsToo) {
  const std::string sides = "@/INTER/TYPE19/5 surf_IDs=1 surf_IDm=2 Gapmin=1.0",
                    defaults_7 = "@/DEFAULT/INTER/TYPE7 Inacti=5 Iform=2\n",
                    defaults_19 = "@/DEFAULT/INTER/TYPE19 Istf=4 Igap=1 Iedge=1 Inacti=5\n";
  const std::string sets =
      "/SET/GENERAL/41\ns\nPART               1\n/SET/GENERAL/42\ns\nPART               2\n"
      "@/INTER/TYPE19/5 surf_IDs=41 surf_IDm=42 Igap=1";
  for (const std::string& cards :
       {defaults_19 + sides, sets, defaults_7 + "/INTER/TYPE19/5\nt\n         1         2"}) {
    const auto before = open_text(with(cards));
    expect_same_scene(*before, *expanded(*before), cards);
  }
  std::string scaled = with(sides);
  scaled.replace(scaled.find("      2022"), 10, "      2024");
  // Columns 41-60 of the second line.
  scaled.insert(scaled.find('\n', scaled.find("Fscalegap")) + 1, std::string(56, ' ') + "0.85");
  const auto before = open_text(scaled);
  ASSERT_EQ(before->interfaces.type19.at(0).Edge_scale_gap.value, 0.85);
  expect_same_scene(*before, *expanded(*before), "scaled edge gap");
}

TEST(ExpandType19, DefaultCardsOfTheOtherTypesHaveNoEffect) {
  const auto before = open_text(
      with("@/DEFAULT/INTER/TYPE7 Istf=2 Igap=3 Idel=1 Irem_gap=2 Irem_i2=1 Inacti=5 Iform=2\n"
           "@/DEFAULT/INTER/TYPE11 Istf=3 Igap=3 Idel=1 Irem_gap=2 Inacti=5 Iform=2\n"
           "@/INTER/TYPE19/5 surf_IDs=1 surf_IDm=2 Gapmin=1.0"));
  const auto after = expanded(*before);
  EXPECT_EQ(after->interfaces.type7.at(0).Irem_i2.value, 3);
  EXPECT_EQ(after->interfaces.type11.at(0).Iform.value, 1);
  EXPECT_EQ(after->interfaces.type11.at(0).Idel.value, 1000);
  expect_same_scene(*before, *after, "default cards");
}

TEST(ExpandType19, RefusesWhatTheNewInterfacesCannotSay) {
  // The solver stops at a TYPE19 with a scaled gap and would not stop at what it is expanded to;
  // version 130 has no cell for the flag of a TYPE7 that says the same as Igap 4.
  for (const auto& [cards, version, why] :
       {std::tuple{
            "@/DEFAULT/INTER/TYPE19 Igap=2\n@/INTER/TYPE19/5 surf_IDs=1 surf_IDm=2 Gapmin=1.0",
            "      2022", "1181"},
        {"@/INTER/TYPE19/5 surf_IDs=1 surf_IDm=2 Igap=4 Gapmin=1.0", "       130", "Irem_gap"}}) {
    std::string text = with(cards);
    text.replace(text.find("      2022"), 10, version);
    const Rewrite r = expand_type19(open_text(text)->context());
    EXPECT_THAT(joined(r.refusals), HasSubstr(why));
  }
}

TEST(ExpandType19, NewIdsAreFreeAndSurfacesAreSharedBetweenInterfaces) {
  const auto before = open_text(with(
      "/GRNOD/PART/70\ng\n         1\n/LINE/SURF/80\nl\n         1\n"
      "@/INTER/TYPE19/5 surf_IDs=1 surf_IDm=2 Igap=1\n@/INTER/TYPE7/90 grnd_IDs=70 surf_IDm=2\n"
      "@/INTER/TYPE19/6 surf_IDs=1 surf_IDm=2 Igap=1 Gapmin=0.8"));
  const auto after = expanded(*before);
  std::set<std::int64_t> ids;
  for (const InterBase* i : after->interfaces.ordered) EXPECT_TRUE(ids.insert(i->id).second);
  EXPECT_EQ(ids.size(), 7u);
  const std::string text = after->main_text();
  const auto count = [&](const std::string& what) {
    int n = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("/GRNOD/SURF/"), 2);
  EXPECT_EQ(count("/LINE/SURF/"), 3);
  expect_same_scene(*before, *after, "shared surfaces");
}

TEST(ExpandType19, CommentsAndOtherLinesStay) {
  const std::string text = with(
      "# before\n/INTER/TYPE19/5\ntitle\n# mine\n         1         2\n# two\n\n\n# gap\n"
      "                 1.0                                     1.0\n\n\n# "
      "behind\n/TH/INTER/1\nth\n");
  const std::string then = expanded(*open_text(text))->main_text();
  for (const char* comment : {"# before\n/INTER/TYPE7/5\ntitle\n# mine\n", "# two\n", "# gap\n",
                              "# behind\n/TH/INTER/1\nth\n"})
    EXPECT_THAT(then, HasSubstr(comment));
}

TEST(ExpandType19, InterfaceInASubmodelStaysThereWithItsUnits) {
  SmallDeck d = plates(0.75);
  d.add(
      "//SUBMODEL/1\n\n      1000\n/MAT/ELAST/1\nm\n               1e-06\n"
      "               200.0                 0.3\n/PROP/SHELL/1\np\n\n\n         3" +
      std::string(17, ' ') + "1.5\n/PART/1\np\n         1         1");
  d.add(
      "/NODE\n         1                 50.                  0.                  0.\n"
      "         2                 60.                  0.                  0.\n"
      "         3                 60.                 10.                  0.\n"
      "         4                 50.                 10.                  0.\n"
      "/SHELL/1\n         1         1         2         3         4\n/SURF/PART/8\ns\n         1");
  d.add("@/INTER/TYPE19/5 surf_IDs=8 surf_IDm=0 Gapmin=1.0\n//ENDSUB");
  const auto before = open_text(d.text());
  const auto after = expanded(*before);
  ASSERT_EQ(after->interfaces.type7.size(), 1u);
  EXPECT_EQ(after->interfaces.type7[0].id, 1005);
  EXPECT_EQ(after->interfaces.type7[0].surf_IDm.value, 1008);
  ASSERT_EQ(after->interfaces.type11.size(), 1u);
  EXPECT_GE(after->interfaces.type11[0].block->submodel, 0);
  expect_same_scene(*before, *after, "submodel");
}

TEST(ExpandType19, ForeignUnitsAndParametersKeepTheirValues) {
  std::string text = with(
      "/PARAMETER/GLOBAL/REAL/1\ng\ngap                     0.001\n/UNIT/3\nm\n"
      "                  kg                   m                   s\n"
      "/DEFAULT/INTER/TYPE19\n\n                             1\n\n\n\n\n\n");
  const auto end = text.find("/END");
  text.insert(end,
              "/INTER/TYPE19/5/3\nt\n         1         2\n\n\n"
              "               200.0                                    &gap\n\n\n");
  const auto before = open_text(text);
  ASSERT_EQ(before->interfaces.type19.at(0).Gapmin.value, 1.0);
  const auto after = expanded(*before);
  EXPECT_EQ(after->interfaces.type11.at(0).Gapmin.value, 1.0);
  EXPECT_EQ(after->interfaces.type7.at(1).Stfac.value, before->interfaces.type19.at(0).Stfac.value);
  EXPECT_THAT(after->main_text(), HasSubstr("&gap"));
  expect_same_scene(*before, *after, "units");
}

}  // namespace
}  // namespace deck::test
