// Differences of keywords whose cells are made for the tests: cells of some versions, defaults,
// products, lists of ids, repeated lines; and of springs of old versions.
#include <gmock/gmock.h>

#include "deck/text/number.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const SchemaSet& with_own_keywords() {
  static const SchemaSet set = [] {
    SchemaSet made = SchemaSet::built_in();
    for (const char* text :
         {R"({"keyword": "/OWN", "kind": "other", "doc": "d", "cards": [{"name": "c", "fields": [
             {"name": "New", "cols": [1, 10], "type": "int", "versions": [2023, null],
              "default": "3", "doc": "d"},
             {"name": "Old", "cols": [1, 10], "type": "real", "versions": [41, 2022],
              "default": "2.5", "doc": "d"},
             {"name": "Gone", "cols": [11, 20], "type": "int", "versions": [41, 2022],
              "default": "4", "doc": "d"},
             {"name": "Off", "cols": [21, 30], "type": "int", "ignored": true, "doc": "d"},
             {"name": "Name", "cols": [31, 40], "type": "text", "doc": "d"},
             {"name": "Limit", "cols": [41, 60], "type": "real", "over": {"field": "Scale"},
              "doc": "d"},
             {"name": "Scale", "cols": [61, 80], "type": "real", "doc": "d"}]}]})",
          R"({"keyword": "/OWNNODES", "kind": "other", "doc": "d", "cards": [{"name": "l",
             "repeat": "ids", "fields": [
             {"name": "Id", "cols": [1, 10], "type": "id", "ref": "node", "doc": "d"}]}]})",
          R"({"keyword": "/OWNNUMBERS", "kind": "other", "doc": "d", "cards": [{"name": "l",
             "repeat": "ids", "fields": [
             {"name": "N", "cols": [1, 10], "type": "int", "doc": "d"}]}]})",
          R"({"keyword": "/OWNROWS", "kind": "other", "doc": "d", "cards": [{"name": "r",
             "repeat": "rows", "fields": [
             {"name": "P", "cols": [1, 10], "type": "int", "doc": "d"},
             {"name": "Q", "cols": [11, 20], "type": "real", "doc": "d"}]}]})",
          R"({"keyword": "/OWNLIST", "kind": "other", "doc": "d", "cards": [{"name": "l",
             "repeat": "ids", "fields": [
             {"name": "W", "cols": [1, 10], "type": "real", "doc": "d"}]}]})"}) {
      const auto added = made.add_json("own", text);
      EXPECT_TRUE(added) << added.error().message;
    }
    return made;
  }();
  return set;
}

std::string value_text(const DiffValue& v) {
  if (const auto* n = std::get_if<std::int64_t>(&v)) return std::to_string(*n);
  if (const auto* x = std::get_if<double>(&v)) return shortest(*x);
  if (const auto* t = std::get_if<std::string>(&v)) return "'" + *t + "'";
  return "-";
}

std::string line_of(const LoadedDeck& d, const Span& span) {
  const Position p = d.deck().sources.position(span);
  return fmt::format("{}:{}", p.line, p.column);
}

/// The small deck of nodes that the text follows, read with the keywords above.
struct Own {
  Own(const std::string& blocks, int version, int first)
      : loaded(LoadedDeck::from(std::move(*read_deck_text(
            "own_0000.rad",
            example_deck(fmt::format("@version {}\n@bare\n/NODE\n{:>10}{:>20}{:>20}{:>20}\n"
                                     "{:>10}{:>20}{:>20}{:>20}\n{}",
                                     version, first + 1, 0., 0., 0., first + 2, 7., 0., 0., blocks),
                         with_own_keywords())
                .main,
            with_own_keywords())))) {}
  LoadedDeck loaded;
};

struct Compared {
  DeckDiff diff;
  std::vector<std::string> said;    ///< "Field: old -> new +gained -lost"
  std::vector<std::string> places;  ///< "line:column line:column"
};

Compared compared(const std::string& a, const std::string& b, int version_a = 2022,
                  int version_b = 2022, MatchBy match = MatchBy::id, int first_b = 0) {
  const Own x(a, version_a, 0), y(b, version_b, first_b);
  Compared out;
  out.diff = diff_decks({x.loaded}, {y.loaded}, match);
  for (const Change& c : out.diff.changes) {
    std::string text = c.field + ": " + value_text(c.old_value) + " -> " + value_text(c.new_value);
    for (const std::int64_t id : c.gained) text += fmt::format(" +({})", id);
    for (const std::int64_t id : c.lost) text += fmt::format(" -({})", id);
    out.said.push_back(text);
    out.places.push_back(line_of(x.loaded, c.a) + " " + line_of(y.loaded, c.b));
  }
  return out;
}

std::string own(const std::string& old, const std::string& gone = "", const std::string& off = "",
                const std::string& name = "", const std::string& limit = "",
                const std::string& scale = "") {
  return fmt::format("/OWN/5\nt\n{:>10}{:>10}{:>10}{:<10}{:>20}{:>20}", old, gone, off, name, limit,
                     scale);
}

/// What another version cannot say is no difference where it is what the solver takes anyway.
TEST(DiffVersions, ACellThatOneVersionLacksCountsUnlessItIsItsDefault) {
  const auto said = [](const std::string& a, const std::string& b) {
    return compared(a, b, 2022, 2023).said;
  };
  EXPECT_THAT(said(own("2.5", "4"), own("3")), IsEmpty());
  EXPECT_THAT(said(own(""), own("")), IsEmpty());
  EXPECT_THAT(said(own("2.5", "4"), own("4")), ElementsAre("New: - -> 4"));
  EXPECT_THAT(said(own("2.0", "4"), own("3")), ElementsAre("Old: 2.0 -> -"));
  EXPECT_THAT(said(own("2.5", "2"), own("3")), ElementsAre("Gone: 2 -> -"));
  EXPECT_THAT(compared(own("4"), own("2.5", "4"), 2023, 2022).said, ElementsAre("New: 4 -> -"));
  EXPECT_THAT(compared(own("3"), own("2.0", "5"), 2023, 2022).said,
              ElementsAre("Old: - -> 2.0", "Gone: - -> 5"));
}

TEST(DiffCells, OfEachTypeAreComparedInTheirOrder) {
  const Compared c =
      compared(own("1.0", "2", "3", "ab", "5.0", "6.0"), own("1.5", "3", "4", "cd", "7.0", "6.0"));
  EXPECT_THAT(c.said, ElementsAre("Old: 1.0 -> 1.5", "Gone: 2 -> 3", "Name: 'ab' -> 'cd'",
                                  "Limit: 5.0 -> 7.0"));
  // Six lines of /BEGIN, three of nodes, header and title: the card is line 12.
  EXPECT_THAT(c.places, ElementsAre("12:1 12:1", "12:11 12:11", "12:31 12:31", "12:41 12:41"));
  EXPECT_THAT(c.diff.notes, ElementsAre(HasSubstr("1 value differs that the reference solver does "
                                                  "not use: no difference in itself")));
  const Compared blank = compared(own("", "2"), own("1.0"));
  EXPECT_THAT(blank.said, ElementsAre("Gone: 2 -> -", "Old: - -> 1.0"));
  EXPECT_THAT(blank.places, ElementsAre("12:11 10:1", "10:1 12:1"));
}

/// The solver multiplies Limit by Scale, and a blank Scale is 1.
TEST(DiffCells, OfAProductAreShownAsTheProductWhereTheyAreAlike) {
  const auto said = [](const char* limit_a, const char* scale_a, const char* limit_b,
                       const char* scale_b) {
    return compared(own("", "", "", "", limit_a, scale_a), own("", "", "", "", limit_b, scale_b))
        .said;
  };
  EXPECT_THAT(said("-4.0", "2.0", "-4.0", "3.0"),
              ElementsAre("Limit: -8.0 -> -12.0", "Scale: 2.0 -> 3.0"));
  EXPECT_THAT(said("-4.0", "2.0", "-5.0", "2.0"), ElementsAre("Limit: -4.0 -> -5.0"));
  EXPECT_THAT(said("-4.0", "3.0", "-6.0", "2.0"), ElementsAre("Scale: 3.0 -> 2.0"));
  EXPECT_THAT(said("-4.0", "", "-4.0", "3.0"),
              ElementsAre("Limit: -4.0 -> -12.0", "Scale: - -> 3.0"));
  EXPECT_THAT(said("-6.0", "", "-3.0", "2.0"), ElementsAre("Scale: - -> 2.0"));
}

TEST(DiffCells, OfListsOfIdsGoBySignAndCounterpart) {
  const auto nodes = [](const char* ids) { return std::string("/OWNNODES/6\nt\n") + ids; };
  const std::string base = nodes("        -1         2");
  EXPECT_THAT(compared(base, nodes("         2        -1")).said, IsEmpty());
  EXPECT_THAT(compared(base, nodes("         1         2")).said,
              ElementsAre("Id: - -> - +(1) -(-1)"));
  // By position node 1 is node 11 of the other deck; 99, which is no node, stays 99.
  const auto moved = [&](const char* ids) {
    return compared(nodes("        -1         2        99"), nodes(ids), 2022, 2022,
                    MatchBy::position, 10)
        .said;
  };
  EXPECT_THAT(moved("       -11        12        99"), IsEmpty());
  EXPECT_THAT(moved("        11        12        98"),
              ElementsAre("Id: - -> - +(11) +(98) -(-1) -(99)"));
  const auto numbers = [](const char* ids) { return std::string("/OWNNUMBERS/6\nt\n") + ids; };
  EXPECT_THAT(compared(numbers("         1        -2"), numbers("        -2         1")).said,
              IsEmpty());
  const Compared other = compared(numbers("         1        -2"), numbers("         2         1"),
                                  2022, 2022, MatchBy::position, 10);
  EXPECT_THAT(other.said, ElementsAre("N: - -> - +(2) -(-2)"));
  EXPECT_THAT(other.places, ElementsAre("10:1 10:1"));
}

TEST(DiffCells, OfRepeatedLinesAndListsHaveTheirNumber) {
  EXPECT_THAT(compared("/OWNROWS/6\nt\n         1       2.0\n         3       4.0",
                       "/OWNROWS/6\nt\n         1       2.5\n         5       4.0\n"
                       "         7       8.0")
                  .said,
              ElementsAre("Q: 2.0 -> 2.5", "P [2]: 3 -> 5", "P [3]: - -> 7", "Q [3]: - -> 8.0"));
  EXPECT_THAT(compared("/OWNLIST/6\nt\n       1.0       2.0       3.0",
                       "/OWNLIST/6\nt\n       1.0       2.5       3.0       4.0")
                  .said,
              ElementsAre("W (2): 2.0 -> 2.5", "W (4): - -> 4.0"));
}

TEST(DiffWords, AreEqualAsNumbersInWhateverForm) {
  const auto said = [](const char* a, const char* b) {
    return compared(std::string("/UNHEARDOF/4\n") + a, std::string("/UNHEARDOF/4\n") + b).said;
  };
  EXPECT_THAT(said("x 1e3 -2", "x 1000 -2.0"), IsEmpty());
  EXPECT_THAT(said("1+3", "1000."), IsEmpty()) << "an exponent without its letter";
  EXPECT_THAT(said("1\t,2", " 1 2 "), IsEmpty());
  EXPECT_THAT(said("x", "y"), ElementsAre("(undescribed text): 'x' -> 'y'"));
  EXPECT_THAT(said("1", "x"), ElementsAre("(undescribed text): '1' -> 'x'"));
  EXPECT_THAT(said("x", "1"), ElementsAre("(undescribed text): 'x' -> '1'"));
  const Compared c = compared("/UNHEARDOF/4\nab 10\ncd", "/UNHEARDOF/4\nab  11\ncd");
  EXPECT_THAT(c.said, ElementsAre("(undescribed text): '10' -> '11'"));
  EXPECT_THAT(c.places, ElementsAre("11:4 11:5"));
  EXPECT_THAT(compared("/UNHEARDOF/4\nab", "/UNHEARDOF/4\nab cd").places, ElementsAre("10:1 11:4"));
}

/// Version 51 has no cell that scales the abscissa of a spring: its points are lengths in working
/// units. The ordinate counts times A, a force.
TEST(DiffFunctions, PointsWithoutAScaleHaveTheDimensionOfTheirAxis) {
  const auto deck = [](const char* length, const std::string& x, const char* version) {
    std::string text =
        example_deck(std::string("@version ") + version +
                         "\n@bare\n@/PROP/SPRING/7 Mass=0.1 A=2.0 fct_ID11=5\n/FUNCT/5\nf\n"
                         "                 0.0                 1.0\n" +
                         std::string(20 - x.size(), ' ') + x + "                 3.0",
                     SchemaSet::built_in())
            .main;
    auto at = text.find("mm");
    at = text.find("mm", at + 2);  // working units come second
    text.replace(at, 2, length);
    return text;
  };
  const auto said = [](const std::string& a, const std::string& b) {
    const Inspected x(a), y(b);
    const DeckDiff diff = diff_decks(x.side(), y.side(), MatchBy::id);
    std::vector<std::string> out;
    for (const Change& c : diff.changes) out.push_back(c.keyword + " " + c.field);
    return out;
  };
  EXPECT_THAT(said(deck("mm", "5.0", "51"), deck("mm", "5.0", "51")), IsEmpty());
  EXPECT_THAT(said(deck("mm", "5.0", "51"), deck(" m", "0.005", "51")), IsEmpty());
  EXPECT_THAT(said(deck("mm", "5.0", "51"), deck(" m", "0.006", "51")), ElementsAre("/FUNCT X [2]"))
      << "6 mm are not 5 mm";
  // Where the version has the cell, a blank one is 1 in the units of the block.
  EXPECT_THAT(said(deck("mm", "5.0", "2022"), deck(" m", "5.0", "2022")), IsEmpty());
}

std::vector<std::string> said_of(const std::string& a, const std::string& b,
                                 MatchBy match = MatchBy::id) {
  const Inspected x(a), y(b);
  std::vector<std::string> out;
  for (const Change& c : diff_decks(x.side(), y.side(), match).changes) {
    std::string text = fmt::format("{}/{} {}: {} -> {}", c.keyword, c.id, c.field,
                                   value_text(c.old_value), value_text(c.new_value));
    for (const std::int64_t id : c.gained) text += fmt::format(" +({})", id);
    for (const std::int64_t id : c.lost) text += fmt::format(" -({})", id);
    out.push_back(text);
  }
  return out;
}

struct Spring {
  const char *k = "", *a = "2.0", *b = "4.0", *e = "6.0", *scale = "";
  std::string f = "1.0 3.0";  ///< ordinates of function 5
  const char* second = "6";   ///< the function that E1 scales
  bool last_line = true;      ///< the line of E1 and AScale1
};

std::string function(int id, const std::string& y) {
  return fmt::format("/FUNCT/{}\nf\n{:>20}{:>20}\n{:>20}{:>20}\n", id, "0.0",
                     y.substr(0, y.find(' ')), "5.0", y.substr(y.find(' ') + 1));
}

std::string deck_of(const Spring& s) {
  std::string text =
      fmt::format("/PROP/SPRING/7\ns\n{:>20}\n{:>20}{:>20}{:>20}{:>20}\n{:>10}{:>20}\n", "0.1", s.k,
                  "", s.a, s.b, "5", s.second);
  if (s.last_line) text += fmt::format("{:>20}{:>20}{:>20}\n", "", s.e, s.scale);
  return example_deck("@bare\n" + text + function(5, s.f) + function(6, "1.0 2.0"),
                      SchemaSet::built_in())
      .main;
}

/// The force is f(x) (A + B ln + E g): A may go over into f if B and E follow it.
TEST(DiffSprings, CoefficientsCountByWhatTheyAreToTheFirst) {
  const std::string base = deck_of({});
  const char* const doubled = "2.0 6.0";
  const std::vector<std::string> first = {"/PROP/SPRING/7 A: 2.0 -> 1.0"};
  EXPECT_THAT(said_of(base, deck_of({.a = "1.0", .b = "2.0", .e = "3.0", .f = doubled})),
              IsEmpty());
  EXPECT_EQ(said_of(base, deck_of({.a = "1.0", .b = "4.0", .e = "3.0", .f = doubled})), first);
  EXPECT_EQ(said_of(base, deck_of({.a = "1.0", .b = "2.0", .e = "6.0", .f = doubled})), first);
  EXPECT_EQ(said_of(base, deck_of({.a = "1.0", .b = "2.0", .e = "3.0"})), first);
  EXPECT_THAT(said_of(base, deck_of({.f = "1.0 4.0"})), ElementsAre("/FUNCT/5 Y [2]: 3.0 -> 4.0"));
  EXPECT_THAT(said_of(base, deck_of({.b = "5.0"})), ElementsAre("/PROP/SPRING/7 B: 4.0 -> 5.0"));
  // K / A is a stiffness of contacts.
  EXPECT_EQ(said_of(deck_of({.k = "3.0"}),
                    deck_of({.k = "3.0", .a = "1.0", .b = "2.0", .e = "3.0", .f = doubled})),
            first);
  // Without a second function E scales nothing.
  const auto alone = [&](const char* e) {
    return said_of(deck_of({.second = ""}),
                   deck_of({.a = "1.0", .b = "2.0", .e = e, .f = doubled, .second = ""}));
  };
  EXPECT_THAT(alone("3.0"), IsEmpty());
  EXPECT_THAT(alone("6.0"), IsEmpty());
  EXPECT_THAT(alone("5.0"), ElementsAre("/PROP/SPRING/7 E1: 6.0 -> 5.0"));
}

TEST(DiffSprings, AScaleWhoseLineIsMissingIsOne) {
  const Spring without{.e = "", .last_line = false};
  EXPECT_THAT(said_of(deck_of(without), deck_of({.e = "1.0", .scale = "1.0"})), IsEmpty());
  EXPECT_THAT(said_of(deck_of(without), deck_of({.e = "1.0", .scale = "2.0"})),
              ElementsAre("/PROP/SPRING/7 AScale1: 1.0 -> 2.0"));
  EXPECT_THAT(said_of(deck_of({.e = "3.0"}), deck_of(without)),
              ElementsAre("/PROP/SPRING/7 E1: 3.0 -> 1.0"));
}

/// Six rows of coefficients: the third one is that of the functions with a 3 at their end.
TEST(DiffSprings, EachRowHasItsOwnFunctions) {
  const auto deck = [](const std::string& cells, const char* y) {
    return example_deck("@bare\n@/PROP/SPR_BEAM/7 Mass=0.1 Inertia=0.1 fct_ID13=5 fct_ID23=6 " +
                            cells + "\n" + function(5, y) + function(6, "1.0 2.0"),
                        SchemaSet::built_in())
        .main;
  };
  const std::string base = deck("A1=2.0 A3=2.0 B3=4.0 E3=6.0", "1.0 3.0");
  EXPECT_THAT(said_of(base, deck("A1=2.0 A3=1.0 B3=2.0 E3=3.0", "2.0 6.0")), IsEmpty());
  EXPECT_THAT(said_of(base, deck("A1=1.0 A3=1.0 B3=2.0 E3=3.0", "2.0 6.0")),
              ElementsAre("/PROP/SPR_BEAM/7 A1: 2.0 -> 1.0"));
  EXPECT_THAT(said_of(base, deck("A1=2.0 A3=1.0 B3=3.0 E3=3.0", "2.0 6.0")),
              ElementsAre("/PROP/SPR_BEAM/7 A3: 2.0 -> 1.0", "/PROP/SPR_BEAM/7 B3: 4.0 -> 3.0"));
  EXPECT_THAT(said_of(deck("K3=5.0 A3=2.0", "1.0 3.0"), deck("K3=5.0 A3=1.0", "2.0 6.0")),
              ElementsAre("/PROP/SPR_BEAM/7 A3: 2.0 -> 1.0"));
  EXPECT_THAT(said_of(deck("K1=5.0 A3=2.0", "1.0 3.0"), deck("K1=5.0 A3=1.0", "2.0 6.0")),
              ElementsAre("/PROP/SPR_BEAM/7 A3: 2.0 -> 1.0"))
      << "the second function counts by A3 as well";
}

/// Two shells and a triangle around node 3, and a group of them.
std::string sheet(const std::string& group, int first = 0) {
  SmallDeck d;
  const auto id = [&](int n) { return first + n; };
  d.node(id(1), 0, 0, 0).node(id(2), 4, 0, 0).node(id(3), 4, 3, 0).node(id(4), 0, 3, 0);
  d.node(id(5), 9, 0, 0).node(id(6), 9, 3, 0).shell_part(1, 1).shell_part(2, 1);
  d.shell(1, id(11), id(1), id(2), id(3), id(4)).shell(2, id(12), id(2), id(5), id(6), id(3));
  d.shell3(2, id(13), id(3), id(4), id(6));
  return d.add(group).text();
}

TEST(DiffMembers, ASetHasFourLists) {
  const auto set = [](int part) {
    return fmt::format("/SET/GENERAL/9\ns\nPART      {:>10}", part);
  };
  EXPECT_THAT(said_of(sheet(set(1)), sheet(set(1))), IsEmpty());
  // Part 1 is shell 11; part 2 shell 12 and triangle 13, of which sides 2-3 and 3-4 are in both.
  EXPECT_THAT(said_of(sheet(set(1)), sheet(set(2))),
              ElementsAre("/SET/GENERAL/9 nodes: 4 -> 5 +(5) +(6) -(1)",
                          "/SET/GENERAL/9 segments: 1 -> 2 +(12) +(13) -(11)",
                          ::testing::StartsWith("/SET/GENERAL/9 edges: 4 -> 6 "),
                          "/SET/GENERAL/9 parts: 1 -> 1 +(2) -(1)"));
}

TEST(DiffMembers, SegmentsMayBeginAnywhereButNotRunBackwards) {
  const auto seg = [](std::initializer_list<int> n, int first = 0) {
    std::string text = "/SURF/SEG/9\ns\n         1";
    for (const int i : n) text += fmt::format("{:>10}", i == 0 ? 0 : first + i);
    return text;
  };
  const std::string base = sheet(seg({1, 2, 3, 4}));
  EXPECT_THAT(said_of(base, sheet(seg({3, 4, 1, 2}))), IsEmpty());
  EXPECT_THAT(said_of(base, sheet(seg({4, 3, 2, 1}))),
              ElementsAre(::testing::StartsWith("/SURF/SEG/9 segments: 1 -> 1 +")));
  EXPECT_THAT(said_of(base, sheet(seg({1, 2, 3, 0}))),
              ElementsAre(::testing::StartsWith("/SURF/SEG/9 segments: 1 -> 1 +")));
  const std::string three = sheet(seg({1, 2, 3, 3}));
  EXPECT_THAT(said_of(three, sheet(seg({2, 3, 1, 1}))), IsEmpty());
  EXPECT_THAT(said_of(base, sheet(seg({2, 3, 4, 1}, 100), 100), MatchBy::position), IsEmpty());
}

TEST(DiffMembers, LinesAndGroupsFollowTheirNodesAndElements) {
  const auto line = [](int a, int b) {
    return fmt::format("/LINE/SEG/9\ns\n{:>10}{:>10}{:>10}", 1, a, b);
  };
  EXPECT_THAT(said_of(sheet(line(1, 2)), sheet(line(2, 1))), IsEmpty());
  EXPECT_THAT(said_of(sheet(line(1, 2)), sheet(line(1, 3))),
              ElementsAre(::testing::StartsWith("/LINE/SEG/9 edges: 1 -> 1 +")));
  EXPECT_THAT(said_of(sheet(line(1, 2)), sheet(line(102, 101), 100), MatchBy::position), IsEmpty());
  const auto shells = [](int a, int b) {
    return fmt::format("/GRSHEL/SHEL/9\ng\n{:>10}{:>10}", a, b);
  };
  EXPECT_THAT(said_of(sheet(shells(11, 12)), sheet(shells(112, 111), 100), MatchBy::position),
              IsEmpty());
  EXPECT_THAT(said_of(sheet(shells(11, 12)), sheet(shells(112, 0), 100), MatchBy::position),
              ElementsAre("/GRSHEL/SHEL/9 elements: 2 -> 1 -(11)"));
  const auto nodes = [](int a, int b) {
    return fmt::format("/GRNOD/NODE/9\ng\n{:>10}{:>10}", a, b);
  };
  EXPECT_THAT(said_of(sheet(nodes(1, 5)), sheet(nodes(105, 101), 100), MatchBy::position),
              IsEmpty());
  EXPECT_THAT(said_of(sheet(nodes(1, 5)), sheet(nodes(106, 101), 100), MatchBy::position),
              ElementsAre("/GRNOD/NODE/9 nodes: 2 -> 2 +(106) -(5)"));
}

}  // namespace
}  // namespace deck::test
