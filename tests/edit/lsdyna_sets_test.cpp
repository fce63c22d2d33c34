// Sets, parts and included files of LS-DYNA: what a contact names becomes a block of the deck with
// the same members.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "../contact/small_deck.hpp"
#include "deck/edit/lsdyna.hpp"
#include "deck/model/selection.hpp"
#include "edit/extract_support.hpp"

namespace deck {
namespace {

using edit_test::Whole;

/// Cells of `width` columns.
std::string card(const std::vector<std::string>& cells, std::size_t width = 10) {
  std::string line;
  for (const std::string& c : cells)
    line += std::string(width - std::min(c.size(), width), ' ') + c;
  return line + "\n";
}

const std::string values = card({"0.2"}) + card({"1.0", "1.0"});
std::string nodes_to_surface(const std::string& sides) {
  return "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n" + sides + values;
}
std::string single_surface(const std::string& side) {
  return "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + side + values;
}

Rewrite converted(const std::string& text, int version = 2022) {
  LsDynaOptions options;
  options.version = version;
  return contacts_from_lsdyna("crash.k", text, SchemaSet::built_in(), options);
}

/// Two plates, parts 1 and 2 of one shell each, nodes 1 to 4 and 5 to 8, and the converted file.
std::unique_ptr<Whole> in_deck(const Rewrite& r) {
  EXPECT_TRUE(r.refusals.empty()) << r.refusals.front();
  test::SmallDeck d;
  for (int i = 0; i < 4; ++i) d.node(i + 1, i % 2 * 10.0, i / 2 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(i + 5, i % 2 * 9.0, i / 2 * 9.0, 1.2);
  d.shell_part(1, 1.5).shell_part(2, 2.5).shell(1, 1, 1, 2, 4, 3).shell(2, 2, 5, 6, 8, 7);
  d.add("#include contacts.inc");
  return Whole::read("main_0000.rad", {{"main_0000.rad", d.text()}, {"contacts.inc", *r.new_text}});
}

std::vector<std::int64_t> ids_of(const Whole& w, const std::vector<NodeIndex>& nodes) {
  std::vector<std::int64_t> out;
  for (const NodeIndex n : nodes) out.push_back(w.model.node_id(n));
  std::sort(out.begin(), out.end());
  return out;
}
using Ids = std::vector<std::int64_t>;

/// Nodes of the secondary side of the first TYPE7.
Ids secondary(const Whole& w) {
  const NodeSet* set = w.model.selections->node_group(w.interfaces.type7.at(0).grnd_IDs.value);
  return set == nullptr ? Ids{} : ids_of(w, set->nodes);
}
/// Nodes of the segments of the main side of the first TYPE7.
Ids main_nodes(const Whole& w) {
  const Surface* s = w.model.selections->surface(w.interfaces.type7.at(0).surf_IDm.value);
  std::vector<NodeIndex> nodes;
  if (s != nullptr)
    for (const Segment& segment : s->segments)
      nodes.insert(nodes.end(), segment.nodes.begin(), segment.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return ids_of(w, nodes);
}

bool doubts(const Rewrite& r, const std::string& words) {
  return std::any_of(r.losses.begin(), r.losses.end(), [&](const LossEntry& e) {
    return e.loss == Loss::undecided && e.note.find(words) != std::string::npos;
  });
}

const std::string sides = card({"7", "7", "4", "2"});  // node set 7 against part set 7
const std::string node_set = "*SET_NODE_LIST_TITLE\nrow\n" + card({"7"}) + card({"5", "6", "8"});
const std::string part_set = "*SET_PART_LIST\n" + card({"7"}) + card({"1"});

TEST(LsDynaSets, ListsOfNodesAndPartsBecomeAGroupAndASurfaceOfTheirIds) {
  const Rewrite r = converted(nodes_to_surface(sides) + node_set + part_set);
  const auto w = in_deck(r);
  EXPECT_EQ(w->interfaces.type7.at(0).grnd_IDs.value, 7);
  EXPECT_EQ(w->interfaces.type7.at(0).surf_IDm.value, 7);
  EXPECT_EQ(secondary(*w), (Ids{5, 6, 8}));
  EXPECT_EQ(main_nodes(*w), (Ids{1, 2, 3, 4}));
  EXPECT_NE(r.new_text->find("/GRNOD/NODE/7\nrow\n"), std::string::npos) << *r.new_text;
}

TEST(LsDynaSets, ThatAreInTheFilesNeedNoWordAboutIds) {
  const auto says = [](const Rewrite& r) {
    return std::any_of(r.notes.begin(), r.notes.end(), [](const std::string& n) {
      return n.find("named by their ids") != std::string::npos;
    });
  };
  EXPECT_FALSE(says(converted(nodes_to_surface(sides) + node_set + part_set)));
  EXPECT_TRUE(says(converted(nodes_to_surface(sides) + node_set)));
}

TEST(LsDynaSets, OfSegmentsKeepTheirTriangles) {
  const Rewrite r = converted(single_surface(card({"3", "0", "0"})) + "*SET_SEGMENT\n" +
                              card({"3"}) + card({"1", "2", "4", "3"}) +
                              card({"5", "6", "8", "8"}) + card({"5", "8", "7", "0"}));
  const auto w = in_deck(r);
  const Surface* s = w->model.selections->surface(3);
  ASSERT_NE(s, nullptr);
  EXPECT_EQ(s->segments.size(), 3u);
  EXPECT_EQ(std::count_if(s->segments.begin(), s->segments.end(),
                          [](const Segment& g) { return g.nodes[2] == g.nodes[3]; }),
            2);
}

TEST(LsDynaSets, OfShellsAreTheSurfaceOfThese) {
  const Rewrite r =
      converted(single_surface(card({"4", "0", "1"})) + "*SET_SHELL\n" + card({"4"}) + card({"2"}));
  EXPECT_EQ(main_nodes(*in_deck(r)), (Ids{5, 6, 7, 8}));
}

TEST(LsDynaSets, GivenByRangesHaveEveryIdThatExistsInThem) {
  const std::string ranges =
      "*SET_NODE_LIST_GENERATE\n" + card({"7"}) + card({"2", "3", "6", "99"});
  EXPECT_EQ(secondary(*in_deck(converted(nodes_to_surface(sides) + ranges + part_set))),
            (Ids{2, 3, 6, 7, 8}));
}

TEST(LsDynaSets, GivenByRangesAreLeftToAPersonWhereTheVersionHasNoSets) {
  const std::string ranges = "*SET_NODE_LIST_GENERATE\n" + card({"7"}) + card({"2", "3"});
  EXPECT_TRUE(doubts(converted(nodes_to_surface(sides) + ranges + part_set, 2018), "/SET/GENERAL"));
}

TEST(LsDynaSets, GivenByColumnsTakeTheFirstOfEachLine) {
  const std::string column = "*SET_NODE_COLUMN\n" + card({"7"}) + card({"5", "1.0"}) + card({"6"});
  EXPECT_EQ(secondary(*in_deck(converted(nodes_to_surface(sides) + column + part_set))),
            (Ids{5, 6}));
}

TEST(LsDynaSets, OfSetsHaveTheMembersOfAll) {
  const std::string sets = "*SET_NODE_ADD\n" + card({"7"}) + card({"8", "9"}) + "*SET_NODE\n" +
                           card({"8"}) + card({"5", "6"}) + "*SET_NODE_ADD\n" + card({"9"}) +
                           card({"8", "10"}) + "*SET_NODE\n" + card({"10"}) + card({"7"});
  EXPECT_EQ(secondary(*in_deck(converted(nodes_to_surface(sides) + sets + part_set))),
            (Ids{5, 6, 7}));
}

TEST(LsDynaSets, ThatContainThemselvesAreLeftToAPerson) {
  const std::string sets =
      "*SET_NODE_ADD\n" + card({"7"}) + card({"8"}) + "*SET_NODE_ADD\n" + card({"8"}) + card({"7"});
  EXPECT_TRUE(doubts(converted(nodes_to_surface(sides) + sets + part_set), "missing or adds"));
}

TEST(LsDynaSets, ToBeCollectedAreOneSet) {
  const std::string sets = "*SET_NODE_LIST_COLLECT\n" + card({"7"}) + card({"5"}) +
                           "*SET_NODE_LIST_COLLECT_TITLE\nmore\n" + card({"7"}) + card({"6"});
  EXPECT_EQ(secondary(*in_deck(converted(nodes_to_surface(sides) + sets + part_set))), (Ids{5, 6}));
}

TEST(LsDynaSets, DefinedTwiceAreLeftToAPerson) {
  EXPECT_TRUE(doubts(converted(nodes_to_surface(sides) + node_set + node_set + part_set),
                     "more than once"));
}

TEST(LsDynaSets, WithCellsThatAreNoIdsAreLeftToAPerson) {
  const std::string bad = "*SET_NODE_LIST\n" + card({"7"}) + card({"5", "six"});
  EXPECT_TRUE(doubts(converted(nodes_to_surface(sides) + bad + part_set), "'six' in it is no id"));
}

TEST(LsDynaSets, InAFormThatIsNotReadAreLeftToAPerson) {
  const std::string general = "*SET_NODE_GENERAL\n" + card({"7"}) + "ALL\n";
  EXPECT_TRUE(doubts(converted(nodes_to_surface(sides) + general + part_set), "not read"));
}

TEST(LsDynaSets, OfTwoKindsWithOneIdAreTwoSurfaces) {
  const Rewrite r =
      converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + card({"7", "7", "0", "2"}) + values +
                "*SET_SEGMENT\n" + card({"7"}) + card({"5", "6", "8", "7"}) + part_set);
  const auto w = in_deck(r);
  const InterType19& i = w->interfaces.type19.at(0);
  EXPECT_NE(i.surf_IDs.value, i.surf_IDm.value);
  EXPECT_EQ(w->model.selections->surface(i.surf_IDs.value)->segments.size(), 1u);
  EXPECT_EQ(w->model.selections->surface(i.surf_IDm.value)->segments.size(), 1u);
}

TEST(LsDynaSets, NamedTwiceAreOneBlock) {
  const Rewrite r = converted(single_surface(card({"7", "0", "2"})) +
                              single_surface(card({"7", "0", "2"})) + part_set);
  const auto first = r.new_text->find("/SURF/PART/EXT");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(r.new_text->find("/SURF/PART/EXT", first + 1), std::string::npos) << *r.new_text;
}

TEST(LsDynaSets, OfSeveralFilesOfACallHaveNoIdTwice) {
  const std::string text = single_surface(card({"7", "0", "2"})) + part_set;
  const std::vector<Rewrite> both =
      contacts_from_lsdyna({{"a.k", text}, {"b.k", text}}, SchemaSet::built_in());
  EXPECT_NE(both[0].new_text->find("/SURF/PART/EXT/7\n"), std::string::npos);
  EXPECT_EQ(both[1].new_text->find("/SURF/PART/EXT/7\n"), std::string::npos);
  EXPECT_NE(both[1].new_text->find("/SURF/PART/EXT/9"), std::string::npos);
}

TEST(LsDynaSets, OfExemptPartsLeaveTheOthers) {
  const Rewrite r = converted(single_surface(card({"7", "0", "6"})) + part_set);
  EXPECT_EQ(main_nodes(*in_deck(r)), (Ids{5, 6, 7, 8}));
}

TEST(LsDynaSets, WithAPartThatIsNotThereSaySo) {
  const std::string parts = "*PART\nfirst\n" + card({"1", "1", "1"}) + "second\n" + card({"2"});
  EXPECT_FALSE(doubts(converted(single_surface(card({"1", "0", "3"})) + parts), "part"));
  EXPECT_TRUE(doubts(converted(single_surface(card({"9", "0", "3"})) + parts), "no such part"));
  const std::string set = "*SET_PART\n" + card({"7"}) + card({"1", "9"});
  EXPECT_TRUE(doubts(converted(single_surface(card({"7", "0", "2"})) + parts + set), "part 9"));
}

TEST(LsDynaSets, SayNothingOfMissingPartsWhereNotAllPartsWereRead) {
  const std::string part = "*PART\nfirst\n" + card({"1", "1", "1"});
  const std::string contact = single_surface(card({"9", "0", "3"}));
  for (const char* other : {"*PART_CONTACT\nbumper\n         9         1         1\n       0.2\n",
                            "*INCLUDE_TRANSFORM\nwheel.k\n", "*INCLUDE\nbody.k\n"})
    EXPECT_FALSE(doubts(converted(contact + part + other), "no such part")) << other;
}

TEST(LsDynaSets, ReadLongCardsCommasAndParameters) {
  const std::string text = "*KEYWORD LONG=Y\n*PARAMETER\n" + card({"I first", "5"}, 20) +
                           "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n" +
                           card({"7", "7", "4", "2"}, 20) + card({"0.2"}, 20) + card({"1.0"}, 20) +
                           "*SET_NODE_LIST\n" + card({"7"}, 20) + card({"&first", "6"}, 20) +
                           "*SET_PART_LIST\n7\n1,2\n";
  const auto w = in_deck(converted(text));
  EXPECT_EQ(secondary(*w), (Ids{5, 6}));
  EXPECT_EQ(main_nodes(*w).size(), 8u);
}

/// Files by name.
class LsDynaIncludes : public testing::Test {
 protected:
  Rewrite convert(const std::string& main) {
    LsDynaOptions options;
    options.include = [this](std::string_view name, std::string_view) -> Result<LsDynaFile> {
      const auto it = files_.find(name);
      if (it == files_.end()) return Error{Error::Code::io, "there is no such file"};
      return LsDynaFile{it->first, it->second};
    };
    return contacts_from_lsdyna("crash.k", main, SchemaSet::built_in(), options);
  }
  std::map<std::string, std::string, std::less<>> files_;
};

TEST_F(LsDynaIncludes, HoldSetsContactsAndParametersOfTheModel) {
  files_["sets.k"] = "*KEYWORD\n" + node_set + "*INCLUDE\nparts.k\n*END\nnothing\n";
  files_["parts.k"] = part_set + "*PARAMETER\n" + card({"R fric", "0.35"});
  files_["contact.k"] =
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n" + sides + card({"&fric"}) + card({"1"});
  const auto w = in_deck(convert("*KEYWORD\n*INCLUDE\nsets.k\ncontact.k\n*END\n"));
  EXPECT_EQ(w->interfaces.type7.at(0).Fric.value, 0.35);
  EXPECT_EQ(secondary(*w), (Ids{5, 6, 8}));
  EXPECT_EQ(main_nodes(*w), (Ids{1, 2, 3, 4}));
}

TEST_F(LsDynaIncludes, MayHaveNamesOverSeveralLines) {
  files_["a/long/name.k"] = node_set + part_set;
  EXPECT_EQ(secondary(*in_deck(convert("*INCLUDE\na/long +\n/name.k\n" + nodes_to_surface(sides)))),
            (Ids{5, 6, 8}));
}

TEST_F(LsDynaIncludes, NameTheFileOfAContactInTheReport) {
  files_["contact.k"] = "$\n" + nodes_to_surface(sides);
  const Rewrite r = convert("*INCLUDE\ncontact.k\n");
  ASSERT_FALSE(r.losses.empty());
  EXPECT_EQ(r.losses.front().file, "contact.k");
  EXPECT_EQ(r.losses.front().line, 2u);
}

TEST_F(LsDynaIncludes, ThatAreMissingAreLeftToAPersonOnce) {
  const Rewrite r = convert("*INCLUDE\nnowhere.k\n" + nodes_to_surface(sides));
  EXPECT_EQ(std::count_if(r.losses.begin(), r.losses.end(),
                          [](const LossEntry& e) { return e.keyword == "*INCLUDE"; }),
            1);
  EXPECT_TRUE(doubts(r, "no such file"));
}

TEST_F(LsDynaIncludes, OfThemselvesEnd) {
  files_["a.k"] = "*INCLUDE\nb.k\n";
  files_["b.k"] = "*INCLUDE\na.k\n";
  EXPECT_TRUE(doubts(convert("*INCLUDE\na.k\n" + nodes_to_surface(sides)), "includes itself"));
}

TEST_F(LsDynaIncludes, MayNestAsDeepAsTheLimitsSay) {
  const int most = Limits{}.include_depth;
  for (const int deep : {most, most + 1}) {
    files_.clear();
    for (int i = 1; i < deep; ++i)
      files_["f" + std::to_string(i) + ".k"] = "*INCLUDE\nf" + std::to_string(i + 1) + ".k\n";
    files_["f" + std::to_string(deep) + ".k"] = "*KEYWORD\n";
    EXPECT_EQ(doubts(convert("*INCLUDE\nf1.k\n" + nodes_to_surface(sides)), "too many files"),
              deep > most);
  }
}

TEST_F(LsDynaIncludes, ThatGrowWithoutBoundEnd) {
  for (int i = 0; i < 40; ++i) {
    const std::string next = "f" + std::to_string(i + 1) + ".k\n";
    files_["f" + std::to_string(i) + ".k"] = "*INCLUDE\n" + next + next;
  }
  files_["f40.k"] = "";
  EXPECT_TRUE(doubts(convert("*INCLUDE\nf0.k\n" + nodes_to_surface(sides)), "too many files"));
}

}  // namespace
}  // namespace deck
