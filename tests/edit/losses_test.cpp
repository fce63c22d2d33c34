// What conversions report: every value that changes, with its place, old and new text, and why.
#include <gmock/gmock.h>

#include "deck/edit/convert.hpp"
#include "edit/shared/changed_values.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using edit_test::Whole;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const char* const words[] = {"kept", "approximated", "dropped", "undecided"};

/// "kept memory_0000.rad:8:1-10 /KEYWORD/1 field: old -> new (note)".
std::vector<std::string> said(const std::vector<LossEntry>& losses) {
  std::vector<std::string> out;
  for (const LossEntry& l : losses) {
    std::string line =
        std::string(words[static_cast<int>(l.loss)]) + " " + l.file + ":" + std::to_string(l.line);
    if (l.column != 0) line += ":" + std::to_string(l.column) + "-" + std::to_string(l.end_column);
    line += " " + l.keyword + "/" + std::to_string(l.id);
    if (!l.field.empty()) line += " " + l.field;
    out.push_back(line + ": " + l.old_text + " -> " + l.new_text + " (" + l.note + ")");
  }
  return out;
}

std::string deck_text(const std::string& body) {
  const std::string units = "                  kg                  mm                  ms\n";
  return "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n" + units + units + body + "/END\n";
}

/// Lines 7 to 12: a sensor and an interface card.
const char* const cards =
    "/SENSOR/TIME/4\nlate\n                12.5\n"
    "/GRNOD/NODE/5\ng\n         1         2\n";

/// The bytes of a line, from column `first` to `last`, both counted from 1.
Span columns(const Whole& w, std::uint64_t line, std::uint64_t first, std::uint64_t last) {
  const std::string_view bytes = w.deck.sources[0].bytes();
  std::uint64_t at = 0;
  for (std::uint64_t k = 1; k < line; ++k) at = bytes.find('\n', at) + 1;
  return Span{0, static_cast<std::uint32_t>(last - first + 1), at + first - 1};
}

std::vector<std::string> changed(const std::vector<std::tuple<int, int, int, const char*>>& edits,
                                 std::vector<LossEntry> known = {}) {
  const auto w = Whole::text(deck_text(cards));
  Rewrite rewrite;
  rewrite.losses = std::move(known);
  for (const auto& [line, first, last, text] : edits)
    rewrite.edits.push_back(
        {columns(*w, static_cast<std::uint64_t>(line), static_cast<std::uint64_t>(first),
                 static_cast<std::uint64_t>(last)),
         text});
  add_changed_values(w->context(), "--option", rewrite);
  return said(rewrite.losses);
}

TEST(ChangedValues, NameFieldColumnsAndBothTexts) {
  EXPECT_THAT(
      changed({{9, 17, 20, "25.0"}}),
      ElementsAre("kept memory_0000.rad:9:1-20 /SENSOR/TIME/4 Tdelay: 12.5 -> 25.0 (--option)"));
  EXPECT_THAT(changed({{9, 17, 20, "12.5"}}), IsEmpty()) << "nothing changes";
}

TEST(ChangedValues, OfAFewDigitsAreTheWholeValue) {
  EXPECT_THAT(
      changed({{9, 18, 18, "3"}}),
      ElementsAre("kept memory_0000.rad:9:1-20 /SENSOR/TIME/4 Tdelay: 12.5 -> 13.5 (--option)"));
  EXPECT_THAT(
      changed({{9, 20, 20, "75"}}),
      ElementsAre("kept memory_0000.rad:9:1-20 /SENSOR/TIME/4 Tdelay: 12.5 -> 12.75 (--option)"));
}

TEST(ChangedValues, WiderEditsKeepTheirColumns) {
  EXPECT_THAT(
      changed({{9, 1, 20, "                25.0"}}),
      ElementsAre("kept memory_0000.rad:9:1-20 /SENSOR/TIME/4 Tdelay: 12.5 -> 25.0 (--option)"));
  EXPECT_THAT(changed({{8, 1, 4, "soon"}}),
              ElementsAre("kept memory_0000.rad:8:1-4 /SENSOR/TIME/4: late -> soon (--option)"));
  EXPECT_THAT(changed({{10, 13, 13, "9"}}),
              ElementsAre("kept memory_0000.rad:10:13-13 /GRNOD/NODE/5: 5 -> 9 (--option)"));
  EXPECT_THAT(changed({{2, 2, 6, "OTHER"}}), ElementsAre(HasSubstr(": BEGIN -> OTHER (--option)")));
}

TEST(ChangedValues, AreInTheOrderOfTheFile) {
  EXPECT_THAT(changed({{12, 20, 20, "3"}, {9, 17, 20, "1.0"}, {12, 10, 10, "4"}}),
              ElementsAre(HasSubstr("rad:9:1-20 /SENSOR/TIME/4 Tdelay: 12.5 -> 1.0"),
                          HasSubstr("rad:12:1-10 /GRNOD/NODE/5 ids: 1 -> 4"),
                          HasSubstr("rad:12:11-20 /GRNOD/NODE/5 ids: 2 -> 3")));
}

TEST(ChangedValues, GiveTheirColumnsToWhatIsToldAlready) {
  LossEntry told;
  told.file = "memory_0000.rad";
  told.line = 9;
  told.keyword = "/SENSOR/TIME";
  told.id = 4;
  told.field = "Tdelay";
  told.note = "why";
  told.new_text = "25.0";
  EXPECT_THAT(changed({{9, 17, 20, "25.0"}}, {told}),
              ElementsAre("kept memory_0000.rad:9:1-20 /SENSOR/TIME/4 Tdelay:  -> 25.0 (why)"));
  told.new_text = "other";
  told.old_text = "12.5";
  EXPECT_THAT(
      changed({{9, 17, 20, "25.0"}}, {told}),
      ElementsAre("kept memory_0000.rad:9:1-20 /SENSOR/TIME/4 Tdelay: 12.5 -> other (why)"));
  // Another value, another line, or no value at all is something else.
  told.old_text = "1";
  EXPECT_THAT(changed({{9, 17, 20, "25.0"}}, {told}), ::testing::SizeIs(2));
  told.old_text = "12.5";
  told.line = 8;
  EXPECT_THAT(changed({{9, 17, 20, "25.0"}}, {told}), ::testing::SizeIs(2));
  told.line = 9;
  told.field = "";
  EXPECT_THAT(changed({{9, 17, 20, "25.0"}}, {told}), ::testing::SizeIs(2));
}

TEST(ChangedValues, LongTextsAreCut) {
  const std::string longest(200, 'x'), more(201, 'y');
  EXPECT_THAT(changed({{8, 1, 4, longest.c_str()}}),
              ElementsAre(HasSubstr("-> " + longest + " (")));
  EXPECT_THAT(changed({{8, 1, 4, more.c_str()}}),
              ElementsAre(HasSubstr("-> " + more.substr(1) + "... (")));
}

// ---- unit systems ---------------------------------------------------------------------------

Rewrite to(const Whole& w, const char* target, const UnitsOptions& options = {}) {
  const auto units = parse_unit_system(target);
  EXPECT_TRUE(units.ok());
  return to_units(w.context(), *units, options);
}

TEST(UnitLosses, CountTheValuesOfEveryBlock) {
  const auto w = Whole::text(
      deck_text("/SENSOR/TIME/4\nlate\n                12.5\n"
                "/NODE\n         1                 1.0                 2.0                 0.0\n"
                "/UNIT/8\nu\n                  Mg                  mm                   s\n"
                "/SENSOR/TIME/5/8\nown\n                12.5\n"));
  std::vector<std::string> of_blocks;
  for (const std::string& line : said(to(*w, "kg,m,s").losses))
    if (line.find("converted)") != line.npos) of_blocks.push_back(line);
  EXPECT_THAT(of_blocks,
              ElementsAre("kept memory_0000.rad:7 /SENSOR/TIME/4:  ->  (1 value converted)",
                          "kept memory_0000.rad:10 /NODE/0:  ->  (2 values converted)"));
}

}  // namespace
}  // namespace deck
