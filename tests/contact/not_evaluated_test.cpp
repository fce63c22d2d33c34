// Contacts that are not judged: something that the deck asks for is not evaluated here, and an
// answer would be invented.
#include "contact/small_deck.hpp"
#include "deck/text/rule_id.hpp"

namespace deck::test {
namespace {

/// A square of part 1, and a square of part 2 at height `z` above it.
SmallDeck squares(double z) {
  SmallDeck d;
  for (int k = 0; k < 2; ++k) {
    const double at = k * z, from = k * 2.0, to = 10 - k * 2.0;
    d.node(10 * k + 1, from, from, at).node(10 * k + 2, to, from, at);
    d.node(10 * k + 3, to, to, at).node(10 * k + 4, from, to, at);
    d.shell_part(k + 1, 1).shell(k + 1, k + 1, 10 * k + 1, 10 * k + 2, 10 * k + 3, 10 * k + 4);
  }
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2});
}

std::string clause(const char* word, int id) { return fmt::sprintf("%-10s%10d\n", word, id); }

/// Evaluated, and the number of findings that say why not.
std::pair<bool, std::size_t> judged(const Built& b, std::size_t contact = 0) {
  std::size_t said = 0;
  for (const Diagnostic& d : b.diagnostics.all()) said += d.rule == RuleId::DK380;
  return {b.scene.contacts.at(contact).evaluated, said};
}
constexpr std::pair<bool, std::size_t> yes{true, 0}, no{false, 1};

TEST(NotEvaluated, SetsWithClausesThatAreNotEvaluated) {
  const auto deck = [](const std::string& clauses) {
    return squares(5).add("/SET/GENERAL/9\nset\n" + clauses +
                          "@/INTER/TYPE7/1 grnd_IDs=9 Gapmin=1");
  };
  EXPECT_EQ(judged(Built(deck(clause("PART", 2)))), yes);
  EXPECT_EQ(judged(Built(deck(clause("PART", 2) + clause("RBODY", 5)))), no);
  EXPECT_EQ(judged(Built(deck(clause("PART_B", 2)))), no);
}

TEST(NotEvaluated, GoThroughGroupsAndSurfaces) {
  const auto deck = [](const std::string& clauses, const std::string& inter) {
    return squares(5).add("/SET/GENERAL/9\nset\n" + clauses + "/GRNOD/GRNOD/7\ng\n" +
                          clause("", 9) + "/SURF/SURF/8\ns\n         9\n" + inter);
  };
  const std::string group = "@/INTER/TYPE7/1 grnd_IDs=6 Gapmin=1";
  const std::string outer = "/GRNOD/GRNOD/6\ng\n         9\n";
  EXPECT_EQ(judged(Built(deck(clause("PART", 2), outer + group))), yes);
  EXPECT_EQ(judged(Built(deck(clause("PART_C", 2), outer + group))), no);
  EXPECT_EQ(judged(Built(deck(clause("PART_C", 2), "@/INTER/TYPE19/1 surf_IDs=8 Gapmin=1"))), no);
  EXPECT_EQ(judged(Built(deck(clause("PART_C", 2), "@/INTER/TYPE7/1 grnd_IDs=2 Gapmin=1"))), yes);
}

TEST(NotEvaluated, PartsWithParticles) {
  const auto deck = [](const char* type, int id) {
    return squares(5)
        .node(31, 5, 5, 0.5)
        .shell_part(3, 1)
        .add(std::string("/SPHCEL/3\n        31\n/GRNOD/") + type + "/9\ng\n" +
             fmt::sprintf("%10d", id) + "\n@/INTER/TYPE7/1 grnd_IDs=9 Gapmin=1");
  };
  EXPECT_EQ(judged(Built(deck("PART", 2))), yes);
  EXPECT_EQ(judged(Built(deck("PART", 3))), no);
  EXPECT_EQ(judged(Built(deck("NODE", 31))).first, true) << "its node is named";
}

TEST(NotEvaluated, SmoothedSides) {
  for (const int ists : {0, 1}) {
    std::string text = squares(5).add("@/INTER/TYPE7/1 grnd_IDs=2 Gapmin=1").text();
    const auto version = text.find("      2022");
    ASSERT_NE(version, std::string::npos);
    text.replace(version, 10, "      2026");
    // The line behind title, sides and flags, with the comments above them.
    std::size_t line = text.find("/INTER/TYPE7/1");
    for (int k = 0; k < 5; ++k) line = text.find('\n', line) + 1;
    text.replace(line, text.find('\n', line) - line, fmt::sprintf("%100d", ists));
    EXPECT_EQ(judged(Built(text)), ists == 0 ? yes : no);
  }
}

TEST(NotEvaluated, NodesThatATransformMovesWhichIsNotEvaluated) {
  const auto deck = [](const char* type, const char* group) {
    return squares(5).add(std::string("/TRANSFORM/") + type + "/1\nmove\n" + group +
                          "                 0.0                 0.0                -4.5\n\n"
                          "@/INTER/TYPE7/1 grnd_IDs=2 Gapmin=1");
  };
  EXPECT_EQ(judged(Built(deck("TRA", "         2"))), yes);
  EXPECT_FALSE(Built(deck("TRA", "         2")).scene.contacts[0].penetrations.empty());
  EXPECT_EQ(judged(Built(deck("POSITION", "         2"))), no);
}

}  // namespace
}  // namespace deck::test
