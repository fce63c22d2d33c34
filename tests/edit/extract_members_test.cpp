// What an extracted interface takes along, read from the nodes, elements and blocks that are left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "../contact/small_deck.hpp"
#include "deck/edit/convert.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using edit_test::Whole;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Three plates one above the other: nodes 1 to 4 with shell 1 of part 1, 5 to 8 with shell 2 of
/// part 2, 9 to 12 with shell 3 of part 3. Only the first two are of the interface.
test::SmallDeck plates() {
  test::SmallDeck d;
  for (int p = 0; p < 3; ++p)
    for (int i = 0; i < 4; ++i) d.node(4 * p + i + 1, i % 2 * 10.0, i / 2 * 10.0, 1.0 * p);
  d.shell_part(1, 1.0).shell_part(2, 1.0).shell_part(3, 1.0);
  for (int p = 0; p < 3; ++p) d.shell(p + 1, p + 1, 4 * p + 1, 4 * p + 2, 4 * p + 4, 4 * p + 3);
  return d;
}
test::SmallDeck touching() {
  return plates()
      .group("/GRNOD/PART/1", {1})
      .group("/SURF/PART/1", {2})
      .add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1");
}

std::unique_ptr<Whole> extracted(const Whole& before, std::vector<std::int64_t> ids = {1}) {
  const Rewrite r = extract_contacts(before.context(), ids);
  EXPECT_THAT(r.refusals, IsEmpty());
  return before.after(r);
}
std::unique_ptr<Whole> extracted(const test::SmallDeck& d) {
  return extracted(*Whole::text(d.text()));
}
std::vector<std::int64_t> parts_of(const Whole& w) {
  std::vector<std::int64_t> out;
  for (const Part& p : w.model.parts) out.push_back(p.id);
  return out;
}

TEST(ExtractMembers, LeaveOutWhatTheInterfaceDoesNotSee) {
  const auto w = extracted(touching());
  EXPECT_THAT(w->model.nodes.id, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(w->model.shell4.id, ElementsAre(1, 2));
  EXPECT_THAT(parts_of(*w), ElementsAre(1, 2));
}

TEST(ExtractMembers, RangesKeepTheNodesTheyCover) {
  for (const auto& [keyword, ids, kept] :
       {std::tuple{"/GRNOD/GENE/1", std::vector{9, 10}, std::vector<std::int64_t>{9, 10, 11, 12}},
        std::tuple{"/GRNOD/GENE/1", std::vector{2, 3}, std::vector<std::int64_t>{1, 2, 3, 4}},
        std::tuple{"/GRNOD/NODE/1", std::vector{11}, std::vector<std::int64_t>{9, 10, 11, 12}}}) {
    const auto w = extracted(plates()
                                 .group(keyword, ids)
                                 .group("/SURF/PART/1", {2})
                                 .add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1"));
    std::vector<std::int64_t> all = kept;
    for (const std::int64_t n : {5, 6, 7, 8}) all.push_back(n);
    std::sort(all.begin(), all.end());
    // The shell at a node of the group is there to decide its gap.
    EXPECT_EQ(w->model.nodes.id, all) << keyword << ids[0];
  }
}

TEST(ExtractMembers, SelectionsByMaterialAndProperty) {
  // All parts have material 1; properties have the numbers of the parts.
  const auto by = [](const char* keyword, int id) {
    return parts_of(*extracted(plates()
                                   .group(keyword, {id})
                                   .group("/SURF/PART/1", {2})
                                   .add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1")));
  };
  EXPECT_THAT(by("/GRNOD/MAT/1", 1), ElementsAre(1, 2, 3));
  EXPECT_THAT(by("/GRNOD/PROP/1", 3), ElementsAre(2, 3));
  EXPECT_THAT(by("/GRNOD/PROP/1", 1), ElementsAre(1, 2));
  EXPECT_THAT(by("/GRNOD/PART/1", 3), ElementsAre(2, 3));
}

TEST(ExtractMembers, BoxesOfSurfacesKeepEverything) {
  const std::string box =
      "/BOX/RECTA/1\nb\n\n                -1.0                -1.0                 0.5\n"
      "                11.0                11.0                 1.5";
  const auto w = extracted(plates()
                               .add(box)
                               .group("/GRNOD/PART/1", {1})
                               .group("/SURF/BOX/1", {1})
                               .add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1"));
  EXPECT_THAT(parts_of(*w), ElementsAre(1, 2, 3));
}

TEST(ExtractMembers, SetsThatRangeOverElements) {
  const auto members = [](const std::string& clauses) {
    return extracted(plates()
                         .add("/SET/GENERAL/1\ns\n" + clauses)
                         .group("/SURF/PART/1", {2})
                         .add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1"))
        ->model.shell4.id;
  };
  EXPECT_THAT(members("SHELL              3"), ElementsAre(2, 3));
  EXPECT_THAT(members("SHELL_G            1         2         1"), ElementsAre(1, 2));
  EXPECT_THAT(members("SHELL_G            2         3         1"), ElementsAre(2, 3));
  EXPECT_THAT(members("PART_G             3         9         1"), ElementsAre(2, 3));
  EXPECT_THAT(members("NODE_G             9        10         1"), ElementsAre(2, 3));
  EXPECT_THAT(members("ALL"), ElementsAre(1, 2, 3));
}

TEST(ExtractMembers, SwitchesOfTheRunStay) {
  const auto w = extracted(touching()
                               .add("/ANALY\n         0")
                               .add("/IOFLAG\n         1")
                               .add("/SPMD\n         0")
                               .add("/AMS\n         1")
                               .add("@/BCS/2 Tx=1 grnod_ID=1"));
  const std::string text = w->main_text();
  for (const char* kept : {"/ANALY\n", "/IOFLAG\n", "/SPMD\n", "/BEGIN\n"})
    EXPECT_THAT(text, HasSubstr(kept));
  for (const char* gone : {"/AMS\n", "/BCS/2"}) EXPECT_THAT(text, Not(HasSubstr(gone)));
}

TEST(ExtractMembers, FailureOfAKeptMaterialStaysAndOfAnotherGoes) {
  const std::string second = "/MAT/ELAST/5\nm\n               1e-06\n               100.0\n";
  const auto w = extracted(touching().add(second + "/FAIL/JOHNSON/1\n/FAIL/JOHNSON/5"));
  EXPECT_THAT(w->main_text(), HasSubstr("/FAIL/JOHNSON/1\n"));
  EXPECT_THAT(w->main_text(), Not(HasSubstr("/FAIL/JOHNSON/5")));
  EXPECT_THAT(w->main_text(), Not(HasSubstr("/MAT/ELAST/5")));
}

TEST(ExtractMembers, TransformationsOfOtherSubmodelsAndNodes) {
  const auto w =
      extracted(touching()
                    .group("/GRNOD/PART/3", {3})
                    .add("/TRANSFORM/TRA/1\nt\n         3                 0.0                 0.0"
                         "                 5.0")
                    .add("/TRANSFORM/TRA/2\nt\n         1                 0.0                 0.0"
                         "                 0.0"));
  EXPECT_THAT(w->main_text(), HasSubstr("/TRANSFORM/TRA/2"));
  EXPECT_THAT(w->main_text(), Not(HasSubstr("/TRANSFORM/TRA/1")));
}

}  // namespace
}  // namespace deck
