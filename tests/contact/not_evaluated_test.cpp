// Contacts that are not judged: something that the deck asks for is not evaluated here, and an
// answer would be invented.
#include "contact/small_deck.hpp"
#include "deck/rule_id.hpp"

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

/// Evaluated, and the number of findings that say why not.
std::pair<bool, std::size_t> judged(const Built& b) {
  std::size_t said = 0;
  for (const Diagnostic& d : b.diagnostics.all()) said += d.rule == RuleId::DK380;
  return {b.scene.contacts.at(0).evaluated, said};
}
constexpr std::pair<bool, std::size_t> yes{true, 0}, no{false, 1};

TEST(NotEvaluated, SidesOfSetsGroupsPartsAndTransformsThatAreNot) {
  const auto set = [](const std::string& clauses) { return "/SET/GENERAL/9\nset\n" + clauses; };
  const std::string part = "PART               2\n", unknown = "PART_C             2\n",
                    contact = "@/INTER/TYPE7/1 Gapmin=1 grnd_IDs=",
                    groups =
                        "/GRNOD/GRNOD/7\ng\n         9\n/SURF/SURF/8\ns\n         9\n"
                        "/GRNOD/GRNOD/6\ng\n         7\n",
                    particle =
                        "/PROP/SHELL/3\np\n\n\n                 1.0\n"
                        "/PART/3\np\n         3         1\n/SPHCEL/3\n        31\n",
                    move = "                 0.0                 0.0                -4.5\n\n";
  const std::pair<std::string, std::pair<bool, std::size_t>> cases[] = {
      {set(part) + contact + "9", yes},
      {set(part + "RBODY              5\n") + contact + "9", no},
      {set("PART_B             2\n") + contact + "9", no},
      {set(part) + groups + contact + "6", yes},
      {set(unknown) + groups + contact + "6", no},
      {set(unknown) + groups + "@/INTER/TYPE19/1 surf_IDs=8 Gapmin=1", no},
      {set(unknown) + groups + contact + "2", yes},
      {particle + "/GRNOD/PART/9\ng\n         2\n" + contact + "9", yes},
      {particle + "/GRNOD/PART/9\ng\n         3\n" + contact + "9", no},
      {"/TRANSFORM/TRA/1\nmove\n         2" + move + contact + "2", yes},
      {"/TRANSFORM/POSITION/1\nmove\n         2" + move + contact + "2", no}};
  for (const auto& [cards, wanted] : cases)
    EXPECT_EQ(judged(Built(squares(5).node(31, 5, 5, 0.5).add(cards))), wanted) << cards;
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

}  // namespace
}  // namespace deck::test
