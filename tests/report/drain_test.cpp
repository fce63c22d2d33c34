// Documents that leave while they are made are the ones that are made as a whole.
#include <gtest/gtest.h>

#include <string>

#include "contact/small_deck.hpp"
#include "deck/contacts.hpp"
#include "deck/report.hpp"
#include "report/html/stream.hpp"
#include "report/page.hpp"

namespace deck::test {
namespace {

/// Two plates of n by n shells, 0.5 apart, gap 1: every upper node penetrates.
SmallDeck plates(int n) {
  SmallDeck d;
  for (int sheet = 0; sheet < 2; ++sheet)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        d.node(1 + i + (n + 1) * (j + (n + 1) * sheet), 5.0 * i + sheet, 5.0 * j + sheet,
               0.5 * sheet);
  d.shell_part(1, 1).shell_part(2, 1);
  for (int sheet = 0; sheet < 2; ++sheet)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = 1 + i + (n + 1) * (j + (n + 1) * sheet);
        d.shell(1 + sheet, 1 + i + n * (j + n * sheet), a, a + 1, a + n + 2, a + n + 1);
      }
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2});
}

TEST(LargeDocuments, LeaveInPiecesThatAreTheWhole) {
  const Built b(plates(48).add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"));
  const SceneView view = make_view(b.scene);
  ASSERT_GT(view.penetrations.size(), 2000u);
  for (const bool csv : {false, true}) {
    const auto document = [&](const TextDrain& drain) {
      return csv ? gaps_csv(b.deck, b.scene, view, drain)
                 : gaps_json("x", b.deck, b.scene, view, true, nullptr, nullptr, drain);
    };
    std::string text;
    int pieces = 0;
    const std::string rest = document([&](std::string& piece) {
      text += piece;
      piece.clear();
      ++pieces;
    });
    const std::string whole = document({});
    EXPECT_EQ(text + rest, whole);
    EXPECT_EQ(pieces > 0, whole.size() > (std::size_t{1} << 20)) << whole.size();
    EXPECT_TRUE(csv || pieces > 0) << whole.size();
  }
}

TEST(PackedText, IsTheSameInPiecesAndHoldsWhatWasPacked) {
  std::string bytes;
  for (unsigned i = 0; i < 300000; ++i) bytes += static_cast<char>(i * i * 2654435761u >> 24);
  detail::PackedText packed;
  for (std::size_t at = 0; at < bytes.size(); at += 977)
    packed.add(std::string_view(bytes).substr(at, 977));
  const std::string text = packed.finish();
  EXPECT_EQ(text, detail::packed_text(bytes));
  EXPECT_EQ(PageBlock(text).bytes(), bytes);
  EXPECT_EQ(detail::packed_text("").size() % 4, 0u);
}

}  // namespace
}  // namespace deck::test
