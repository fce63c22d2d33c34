// The text of `deck gaps`: one row per interface, clean ones in one line, nothing wider than asked.
#include <algorithm>

#include "base/shared/shown_text.hpp"
#include "deck/report.hpp"
#include "deck/verdict.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

/// Two plates 0.4 apart: interface 1 and the TYPE19 2 penetrate, the gaps of 3, 4 and 5 are
/// smaller.
std::string several() {
  Plates p;
  p.card = "Gapmin=0.5\n/SURF/PART/2\nupper\n         2";
  for (const char* id : {"3", "4", "5"})
    p.card += std::string("\n@/INTER/TYPE7/") + id + " grnd_IDs=2 surf_IDm=1 Gapmin=0.1";
  p.card += "\n@/INTER/TYPE19/2 surf_IDs=2 surf_IDm=1 Gapmin=0.5";
  return plates(p);
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::string text_of(const Inspected& d, const GapsTextOptions& options = {}) {
  return gaps_text(d.deck, d.scene, d.view, options);
}

TEST(GapsText, HasOneRowPerInterfaceAndCleanOnesInOneLine) {
  const Inspected d(several());
  const std::string text = text_of(d);
  EXPECT_NE(text.find("3 clean interfaces: 3, 4, 5\n"), std::string::npos) << text;
  EXPECT_EQ(count_of(text, "TYPE19"), 1u) << text;
  EXPECT_EQ(text.find("reversed"), std::string::npos) << text;
}

TEST(GapsText, FitsTheTerminalAndKeepsEveryIdWhole) {
  const Inspected d(several());
  GapsTextOptions options;
  for (const bool verbose : {false, true})
    for (const std::size_t width : {60u, 80u, 120u}) {
      options.verbose = verbose;
      options.width = width;
      const std::string text = folded(text_of(d, options), width);
      for (std::size_t at = 0; at < text.size();) {
        const auto nl = std::min(text.find('\n', at), text.size());
        EXPECT_LE(display_width(text.substr(at, nl - at)), width) << text.substr(at, nl - at);
        at = nl + 1;
      }
      EXPECT_NE(text.find("  1 2 3 4"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace deck::test
