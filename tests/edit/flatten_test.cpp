// Flattening: one file that is read as the many were.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "contact/meshes.hpp"
#include "deck/edit.hpp"
#include "edit/support.hpp"

namespace deck {
namespace {

using edit_test::Whole;

/// Coordinates by id: the solver's order of nodes follows their files.
std::map<std::int64_t, std::array<double, 2>> places(const Model& model) {
  std::map<std::int64_t, std::array<double, 2>> out;
  for (NodeIndex n = 0; n < model.nodes.size(); ++n)
    out[model.nodes.id[n]] = {model.nodes.x[n], model.nodes.y[n]};
  return out;
}

const std::string head = testing_support::banner + testing_support::begin();
const std::string node1 =
    "         1                 1.0                 0.0                 0.0\n";
const std::string node2 =
    "         2                 2.0                 0.0                 0.0\n";
const std::string node3 =
    "         3                 3.0                 0.0                 0.0\n";

std::unique_ptr<Whole> tree(Whole::Files files) { return Whole::read("main_0000.rad", files); }

std::string flat(const Whole& w, bool mark = false) {
  const Rewrite r = flatten(w.context(), {.mark = mark});
  EXPECT_TRUE(r.refusals.empty()) << r.refusals.front();
  return r.new_text.value_or("");
}

TEST(Flatten, MarksNameTheFile) {
  const auto w = tree({{"main_0000.rad", head + "/NODE\n#include sub/a.inc\n/END\n"},
                       {"sub/a.inc", "/NODE\n" + node1 + "#INCLUDE 'b.inc' +\n+\n"},
                       {"sub/b.inc", "/NODE\n" + node2}});
  EXPECT_EQ(flat(*w, true), head + "/NODE\n## #include sub/a.inc\n/NODE\n" + node1 +
                                "## #INCLUDE 'b.inc' +\n## +\n/NODE\n" + node2 +
                                "## end of b.inc\n## end of sub/a.inc\n/END\n");
}

TEST(Flatten, IncludesBecomeTheLinesThatCountOfThem) {
  struct Case {
    const char* what;
    std::string main, a, b, expected;
  };
  const std::string cut1 = node1.substr(0, node1.size() - 1);
  const Case cases[] = {
      {"a missing last line end is added", "/NODE\n#include a.inc\n" + node3,
       "# c\t \r\n/NODE\n" + cut1, "", "/NODE\n# c\t \r\n/NODE\n" + cut1 + "\r\n" + node3},
      {"/END and #enddata go with what follows", "#include a.inc\n#include b.inc\n",
       "/NODE\n" + node1 + "/END\n" + node3, "/NODE\n" + node2 + "#enddata\n/NODE\n" + node3,
       "/NODE\n" + node1 + "/NODE\n" + node2},
      {"lines before the first keyword stay outside",
       "/NODE\n" + node1 + "#include a.inc\n" + node3 + "#include b.inc\n",
       "# half a block\n" + node2, node2 + "#include a.inc\n/TITLE\nnote\n",
       "/NODE\n" + node1 + "# half a block\n#" + node2 + node3 + "#" + node2 + "# half a block\n#" +
           node2 + "/TITLE\nnote\n"},
      {"a comment mark makes no directive", "/NODE\n" + node1 + "#include a.inc\n",
       "include nothing\nEndData\n/TITLE\nnote\n", "",
       "/NODE\n" + node1 + "# include nothing\n# EndData\n/TITLE\nnote\n"}};
  for (const Case& c : cases) {
    const auto w =
        tree({{"main_0000.rad", head + c.main + "/END\nbehind\n"}, {"a.inc", c.a}, {"b.inc", c.b}});
    EXPECT_EQ(flat(*w), head + c.expected + "/END\nbehind\n") << c.what;
  }
}

TEST(Flatten, BeginOfAnIncludeBecomesAComment) {
  const auto w = tree({{"main_0000.rad", head + "#include a.inc\n/NODE\n" + node2 + "/END\n"},
                       {"a.inc", "/BEGIN\nsub\n      2024\n\n\n/NODE\n" + node1}});
  const Rewrite r = flatten(w->context(), {.mark = false});
  ASSERT_TRUE(r.refusals.empty()) << r.refusals.front();
  EXPECT_EQ(*r.new_text, head + "#/BEGIN\n#sub\n#      2024\n#\n#\n/NODE\n" + node1 + "/NODE\n" +
                             node2 + "/END\n");
  ASSERT_EQ(r.losses.size(), 1u);
  EXPECT_EQ(r.losses[0].loss, Loss::dropped);
}

TEST(Flatten, IncludeOfAnotherVersionWithTheSameColumnsIsTaken) {
  const auto w = tree({{"main_0000.rad", head + "#include a.inc\n/NODE\n" + node2 + "/END\n"},
                       {"a.inc", "/BEGIN\nsub\n       110\n\n\n/NODE\n" + node1 +
                                     "/FXBODY/1\nr\n         7\n/FXBODY/2\nr\n         7\n"
                                     "/RBODY/1\nr\n         7\n"}});
  const Rewrite r = flatten(w->context());
  ASSERT_TRUE(r.refusals.empty()) << r.refusals.front();
  std::size_t undecided = 0;
  for (const LossEntry& e : r.losses) undecided += e.loss == Loss::undecided ? 1 : 0;
  EXPECT_EQ(undecided, 1u);  // /FXBODY, once; /RBODY is described in every version
}

const std::string coordinate = "         9                &gap                 0.0\n";
std::string local(const std::string& value, const char* scope = "LOCAL") {
  return std::string("/PARAMETER/") + scope + "/REAL/1\np\n       gap" +
         std::string(20 - value.size(), ' ') + value + "\n";
}

TEST(Flatten, NodesAreWhereTheyWere) {
  const struct {
    const char* what;
    std::string main, a;
    std::map<std::int64_t, std::array<double, 2>> expected;
  } cases[] = {
      {"behind the /END of an include no block is open",
       "#include a.inc\n\n" + node2,
       "/NODE\n" + node1 + "/END\n",
       {{1, {1, 0}}}},
      {"a submodel has its offset and its units",
       "/NODE\n" + node1 + "//SUBMODEL/1\nsub\n       100\n#include a.inc\n//ENDSUB\n",
       "/BEGIN\nsub\n      2024\n                  kg                   m                   s\n"
       "                  kg                   m                   s\n/NODE\n" +
           node2,
       {{1, {1, 0}}, {102, {2000, 0}}}},
      {"what only another file defines is undefined",
       "#include a.inc\n/NODE\n" + coordinate,
       local("2.5"),
       {{9, {0, 0}}}}};
  for (const auto& c : cases) {
    const auto w = tree({{"main_0000.rad", head + c.main + "/END\n"}, {"a.inc", c.a}});
    EXPECT_EQ(places(w->model), c.expected) << c.what;
    const auto after = w->after(flatten(w->context()));
    EXPECT_EQ(after->deck.includes.size(), 0u);
    EXPECT_EQ(places(after->model), c.expected) << c.what;
  }
}

TEST(Flatten, LocalParametersThatWouldMeetGetNewNames) {
  const auto w = tree(
      {{"main_0000.rad", head + local("1.5", "GLOBAL") + "#include a.inc\n#include b.inc\n/NODE\n" +
                             coordinate + "/END\n"},
       {"a.inc", local("2.5") + "/NODE\n         1                &gap               -&gap\n" +
                     "#include c.inc\n"},
       {"b.inc", local("3.5") + "/PARAMETER/LOCAL/REAL_EXPR/2\ntwice\ntwice     2*gap+&gap\n" +
                     "/NODE\n         2                &gap              &twice\n"},
       {"c.inc", "/NODE\n         3                &gap                 0.0\n"}});
  const std::map<std::int64_t, std::array<double, 2>> expected = {
      {1, {2.5, -2.5}}, {2, {3.5, 10.5}}, {3, {2.5, 0}}, {9, {1.5, 0}}};
  ASSERT_EQ(places(w->model), expected);
  const Rewrite r = flatten(w->context());
  const auto after = w->after(r);
  EXPECT_EQ(after->deck.includes.size(), 0u);
  EXPECT_EQ(places(after->model), expected);
  EXPECT_EQ(r.notes.size(), 3u);  // two new names and the number of includes
}

/// Any cutting of a deck into files comes together again to the same bytes.
TEST(Flatten, RandomCutsComeTogetherAgain) {
  std::mt19937 random(3);
  test::SmallDeck small;
  for (int k = 0; k < 2; ++k)
    test::add_sheet(small, k + 1, k + 1, 4 * k + 1, 1, 1, [k](int i, int j) {
      return std::array{(10.0 - k) * i, (10.0 - k) * j, 1.0 * k};
    });
  const std::string whole = small.shell_part(1, 1.5)
                                .shell_part(2, 2.5)
                                .group("/SURF/PART/1", {1})
                                .group("/GRNOD/PART/2", {2})
                                .add("@/INTER/TYPE7/1 Igap=1 Istf=4 Inacti=5")
                                .text();
  std::vector<std::string> blocks;  // the banner, /BEGIN, …, /END
  for (std::size_t at = 0; at < whole.size();) {
    const auto next = std::min(whole.find("\n/", at), whole.size() - 1) + 1;
    blocks.push_back(whole.substr(at, next - at));
    at = next;
  }
  for (int round = 0; round < 30; ++round) {
    Whole::Files files;
    int count = 0;
    // Cuts blocks [begin, end) into text and includes.
    const std::function<std::string(std::size_t, std::size_t, int)> cut =
        [&](std::size_t begin, std::size_t end, int depth) {
          std::string text;
          while (begin < end) {
            const std::size_t n = 1 + random() % (end - begin);
            if (depth < 3 && random() % 2 == 0) {
              const std::string name = "part" + std::to_string(++count) + ".inc";
              files[name] = cut(begin, begin + n, depth + 1);
              text += "#include " + name + "\n";
            } else {
              for (std::size_t i = begin; i < begin + n; ++i) text += blocks[i];
            }
            begin += n;
          }
          return text;
        };
    files["main_0000.rad"] = blocks[0] + blocks[1] + cut(2, blocks.size() - 1, 0) + blocks.back();
    const auto w = tree(files);
    if (w->deck.includes.empty()) continue;
    const Rewrite r = flatten(w->context(), {.mark = false});
    ASSERT_TRUE(r.refusals.empty()) << r.refusals.front();
    ASSERT_EQ(*r.new_text, whole);
    const Rewrite marked = flatten(w->context());
    EXPECT_EQ(edit_test::changed_figure(*w, *w->after(marked), "--flatten"), "");
  }
}

}  // namespace
}  // namespace deck
