// Values set by name: in the cell, in free format, on lines that are not there, in include trees.
// Cards laid out by their schema; edits that are joined or refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "deck/deck.hpp"
#include "deck/edit.hpp"
#include "deck/keyword.hpp"
#include "deck/rule_id.hpp"
#include "deck/text.hpp"
#include "edit/shared/layout.hpp"
#include "edit/support.hpp"
#include "keyword/reading.hpp"
#include "text/shared/edits.hpp"

namespace deck {
namespace {

using testing_support::Folder;

const std::string mesh =
    "/NODE\n"
    "         1                 0.0                 0.0                 0.0\n"
    "         2                10.0                 0.0                 0.0\n"
    "         3                10.0                10.0                 0.0\n"
    "         4                 0.0                10.0                 0.0\n"
    "         5                 5.0                 5.0                 0.5\n"
    "/PART/1\nplate\n         2         1\n"
    "/MAT/LAW1/1\nsteel\n             7.85E-6\n               210.0                 0.3\n"
    "/PROP/SHELL/2\nshell\n\n\n         5                           1.2\n"
    "/SHELL/1\n         1         1         2         3         4\n"
    "/GRNOD/NODE/1\nnodes\n         5\n"
    "/SURF/PART/1\nplate\n         1\n";

/// A TYPE7 whose lines are all there: flags, gap, stiffness, friction, inactive ones.
const std::string contact =
    "/INTER/TYPE7/3\ncontact\n"
    "         1         1         4                   2\n"
    "                 1.0                10.0\n"
    "\n"
    "                 1.0                 0.1                0.50\n"
    "                   6                 0.0\n"
    "         0\n";

std::string all(const std::string& body, const std::string& version = "2024") {
  return testing_support::deck_of(body, version);
}

class EditTest : public Folder {
 protected:
  LoadedDeck open(const std::string& text) {
    auto loaded = load(file("car_0000.rad", text));
    EXPECT_TRUE(loaded.ok());
    return std::move(*loaded);
  }
  /// The lines that a patch takes out and puts in, without its head.
  static std::string changes(Edit& edit) {
    const auto patch = edit.diff();
    if (!patch) return "error: " + patch.error().message;
    std::string out;
    for (std::size_t at = 0; at < patch->size();) {
      const std::size_t nl = std::min(patch->find('\n', at), patch->size() - 1);
      const std::string line = patch->substr(at, nl - at);
      if ((line.starts_with('-') && !line.starts_with("---")) ||
          (line.starts_with('+') && !line.starts_with("+++")))
        out += line + "\n";
      at = nl + 1;
    }
    return out;
  }
  static std::string error_of(const Edit& edit) {
    return edit.status() ? std::string() : edit.status().error().message;
  }
  static double thickness(const LoadedDeck& deck) {
    return decode(deck.deck(), **find_block(deck.deck(), "/PROP", 2)).real("Thick");
  }
  std::string content(const std::string& path) const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(EditTest, ANumberGoesIntoItsCellAndMovesNothingElse) {
  const LoadedDeck deck = open(all(mesh + contact));
  Edit edit(deck);
  edit.set(deck.interfaces().find(3), "Gapmin", 0.8);
  EXPECT_EQ(changes(edit),
            "-                 1.0                 0.1                0.50\n"
            "+                 1.0                 0.1                 0.8\n");
  const auto after = edit.read();
  ASSERT_TRUE(after.ok());
  EXPECT_EQ(after->interfaces().type7[0].Gapmin.value, 0.8);
  EXPECT_EQ(deck.interfaces().type7[0].Gapmin.value, 0.5) << "the deck itself stays";
}

TEST_F(EditTest, TheLastValueOfACellCounts) {
  const LoadedDeck deck = open(all(mesh + contact));
  Edit edit(deck);
  const InterBase* inter = deck.interfaces().find(3);
  edit.set(inter, "Gapmin", 0.8).set(inter, "Gapmin", 0.9).set(inter, "Gapmin", 0.5);
  EXPECT_EQ(changes(edit), "");
  edit.set(inter, "Gapmin", 0.25).set(inter, "Fric", 0.2);
  EXPECT_EQ(changes(edit),
            "-                 1.0                 0.1                0.50\n"
            "+                 1.0                 0.2                0.25\n");
}

TEST_F(EditTest, MissingLinesAreAdded) {
  const std::string cut = contact.substr(0, contact.find("                   6"));
  for (const char* end : {"\n", "\r\n"}) {
    std::string text = all(mesh + cut);
    if (end[0] == '\r')
      for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 2))
        text.insert(at, "\r");
    const LoadedDeck deck = open(text);
    Edit edit(deck);
    edit.set("/INTER", 3, "Ifric", 1).set("/INTER", 3, "Inacti", 6).set("/INTER", 3, "C1", 0.125);
    EXPECT_EQ(error_of(edit), "");
    const auto after = edit.read();
    ASSERT_TRUE(after.ok());
    const InterType7& inter = after->interfaces().type7[0];
    EXPECT_EQ(inter.Inacti.value, 6);
    EXPECT_EQ(inter.Ifric.value, 1);
    EXPECT_EQ(inter.C1.value, 0.125);
    EXPECT_EQ(inter.Gapmin.value, 0.5);
    const std::string written(after->deck().sources[0].bytes());
    EXPECT_EQ(std::count(written.begin(), written.end(), '\r') > 0, end[0] == '\r');
  }
}

TEST_F(EditTest, FreeFormatKeepsItsCommasAndGetsThoseItNeeds) {
  const LoadedDeck deck =
      open(all(mesh + "/INTER/TYPE7/3\ncontact\n1,1,4,,2\n1.0,10.0\n\n1.0,0.1,0.5\n"
                      "                   6                 0.0\n         0\n"));
  Edit edit(deck);
  edit.set("/INTER", 3, "Gapmin", 0.8).set("/INTER", 3, "Tstop", 0.25);
  edit.set("/INTER", 3, "Stfac", 2.0);
  EXPECT_EQ(changes(edit), "-1.0,0.1,0.5\n+2.,0.1,0.8,,0.25\n");
  edit.set("/INTER", 3, "Fric", std::string(99, '1'));
  EXPECT_NE(error_of(edit).find(":38:4: /INTER/TYPE7/3 Fric:"), std::string::npos)
      << error_of(edit);
}

TEST_F(EditTest, NumbersAreInWorkingUnits) {
  const std::string meters =
      "/UNIT/7\nmeters\n                  kg                   m                   s\n";
  std::string text = contact;
  text.replace(0, text.find('\n'), "/INTER/TYPE7/3/7");
  const LoadedDeck deck = open(all(meters + mesh + text));
  ASSERT_EQ(deck.interfaces().type7[0].Gapmin.value, 500);
  Edit edit(deck);
  edit.set("/INTER", 3, "Gapmin", 0.8);
  EXPECT_EQ(changes(edit),
            "-                 1.0                 0.1                0.50\n"
            "+                 1.0                 0.1              0.0008\n");
  EXPECT_EQ(edit.read()->interfaces().type7[0].Gapmin.value, 0.8);
  Edit text_edit(deck);
  text_edit.set("/INTER", 3, "Gapmin", "0.0008");
  EXPECT_EQ(*text_edit.diff(), *edit.diff());
}

TEST_F(EditTest, ErrorsNameThePlaceAndWhatWasExpectedAndNothingIsWritten) {
  const LoadedDeck deck = open(all(mesh + contact));
  const double inf = std::numeric_limits<double>::infinity();
  const struct {
    const char* field;
    CellValue value;
    const char* message;
  } wrong[] = {
      {"Gapmin", inf, "car_0000.rad:38:41: /INTER/TYPE7/3 Gapmin: infinity and not-a-number"},
      {"Gapmin", std::nan(""), "infinity and not-a-number"},
      {"Gapmin", "0,8", "expected a number, not '0,8'"},
      {"Gapmin", "&gap", "there is no parameter with a number called gap"},
      {"Igap", 2.5, "car_0000.rad:35:41: /INTER/TYPE7/3 Igap: expected a whole number"},
      {"gapmim", 1.0, "did you mean Gapmin?"},
      {"C1", 1.0, "the card has this cell only if Ifric is"},
      {"grnd_IDs", 2147483648.0, "expected a whole number of 32 bits, not 2147483648.0"},
      {"grnd_IDs", -2147483648.0, "expected a whole number of 32 bits, not -2147483648.0"},
      {"Gapmin", -5.0, "-5.0 is no legal value"},
      {"Igap", 7, "7.0 is no legal value (deck explain Igap)"},
      {"grnd_IDs", -2147483647.0, "'-2147483647' is longer than the 10 columns"},
      {"Gapmin", "1.2345678901234567890", "is longer than the 20 columns"},
      {"IBCX", 0.5, "expected 0 or 1"},
  };
  for (const auto& w : wrong) {
    Edit edit(deck);
    edit.set("/INTER", 3, w.field, w.value).set("/INTER", 3, "Fric", 0.3);
    EXPECT_NE(error_of(edit).find(w.message), std::string::npos) << w.field << error_of(edit);
    EXPECT_FALSE(edit.diff().ok());
    EXPECT_FALSE(edit.save().ok());
    EXPECT_FALSE(edit.save_to((dir_ / "out").string()).ok());
  }
  EXPECT_FALSE(std::filesystem::exists(dir_ / "out"));
  Edit none(deck);
  none.set(deck.interfaces().find(4), "Gapmin", 1.0);
  EXPECT_NE(error_of(none).find("no such interface"), std::string::npos);
  Edit absent(deck);
  absent.set("/PROP", 9, "Thick", 1.0);
  EXPECT_NE(error_of(absent).find("there is no /PROP with id 9"), std::string::npos);
}

TEST_F(EditTest, AnyBlockIsFoundByKeywordAndId) {
  const LoadedDeck deck = open(all(mesh + contact));
  Edit edit(deck);
  edit.set("/PROP/TYPE1", 2, "Thick", 1.5).set("/MAT", 1, "Rho_I", 7.9e-6);
  EXPECT_EQ(error_of(edit), "");
  const auto after = edit.read();
  ASSERT_TRUE(after.ok());
  EXPECT_EQ(thickness(*after), 1.5);
  EXPECT_TRUE(find_block(deck.deck(), "/PROP/SHELL", 2).ok());
  EXPECT_EQ(find_block(deck.deck(), "/INTER/TYPE1", 3).ok(), false);
}

TEST_F(EditTest, NodesMoveAlsoAfterOtherChanges) {
  const LoadedDeck deck = open(all(mesh + contact));
  Edit edit(deck);
  edit.set("/INTER", 3, "Ifric", 2).set("/INTER", 3, "C6", 0.5);
  edit.move_node(5, {5, 5, 0.75}).move_node(1, {0, 0, 0});
  const auto after = edit.read();
  ASSERT_TRUE(after.ok()) << error_of(edit);
  EXPECT_EQ(after->model().nodes.z[4], 0.75);
  EXPECT_EQ(after->interfaces().type7[0].C6.value, 0.5);
  EXPECT_NE(changes(edit).find(
                "+         5                 5.0                 5.0                0.75\n"),
            std::string::npos);
  edit.move_node(77, {});
  EXPECT_NE(error_of(edit).find("there is no node 77"), std::string::npos);
}

TEST_F(EditTest, DigitsThatACellCannotHoldAreTold) {
  const LoadedDeck deck = open(all(mesh + contact));
  Edit edit(deck);
  edit.set("/INTER", 3, "Gapmin", 1.2345678901234567e-100);
  EXPECT_EQ(error_of(edit), "");
  ASSERT_EQ(edit.notes().size(), 1u);
  EXPECT_NE(edit.notes()[0].find("20 columns hold no more digits"), std::string::npos)
      << edit.notes()[0];
  EXPECT_NEAR(edit.read()->interfaces().type7[0].Gapmin.input, 1.2345678901234567e-100, 1e-112);
}

TEST_F(EditTest, SavesAnIncludeTreeInPlaceAndElsewhere) {
  const std::string main = file("car_0000.rad", all(mesh + "#include sub/contact.inc\n"));
  const std::string included = file("sub/contact.inc", contact);
  const auto deck = load(main);
  ASSERT_TRUE(deck.ok());
  Edit edit(*deck);
  edit.set(deck->interfaces().find(3), "Gapmin", 0.8);
  const std::string out = (dir_ / "out").string();
  const auto written = edit.save_to(out);
  ASSERT_TRUE(written.ok()) << written.error().message;
  EXPECT_EQ(written->size(), 2u);
  EXPECT_EQ(content(out + "/car_0000.rad"), content(main));
  EXPECT_NE(content(out + "/sub/contact.inc"), content(included));
  EXPECT_EQ(load(out + "/car_0000.rad")->interfaces().type7[0].Gapmin.value, 0.8);
  EXPECT_TRUE(edit.save_to(out).ok()) << "written before, and nobody changed it";
  file("out/sub/contact.inc", "mine\n");
  EXPECT_NE(edit.save_to(out).error().message.find("is there already"), std::string::npos);
  EXPECT_EQ(content(out + "/sub/contact.inc"), "mine\n");
  EXPECT_TRUE(edit.save_to(out, true).ok());
  EXPECT_FALSE(edit.save_to(dir_.string(), true).ok()) << "files of the deck itself";

  SaveOptions options;
  options.backup_suffix = ".orig";
  const auto saved = edit.save(options);
  ASSERT_TRUE(saved.ok()) << saved.error().message;
  EXPECT_EQ(*saved, std::vector<std::string>{included});
  EXPECT_EQ(content(included + ".orig"), contact);
  EXPECT_EQ(load(main)->interfaces().type7[0].Gapmin.value, 0.8);
  EXPECT_FALSE(edit.save().ok()) << "the files are no longer what was read";
}

TEST_F(EditTest, AnIncludeThatAnotherDeckHasIsNotChangedForOne) {
  const std::string main = file("car_0000.rad", all(mesh + "#include contact.inc\n"));
  const std::string included = file("contact.inc", contact);
  const std::string other = file("van_0000.rad", all(mesh + "#include contact.inc\n"));
  const auto deck = load(main);
  Edit edit(*deck);
  edit.set("/INTER", 3, "Gapmin", 0.8);
  const auto saved = edit.save();
  ASSERT_FALSE(saved.ok());
  EXPECT_NE(saved.error().message.find(other), std::string::npos) << saved.error().message;
  EXPECT_EQ(content(included), contact);
}

TEST_F(EditTest, EngineFilesBesideTheDeckAreNoPartOfIt) {
  LoadedDeck deck = open(all(mesh + contact));
  file("car_0001.rad", "/RUN/car/1\n1.0\n");
  ASSERT_EQ(read_engine_files(deck.deck(), {}).files.size(), 1u);
  Edit edit(deck);
  edit.set("/INTER", 3, "Ifric", 2).set("/INTER", 3, "C6", 0.5);
  EXPECT_EQ(error_of(edit), "");
  EXPECT_EQ(edit.save_to((dir_ / "out").string())->size(), 1u);
}

TEST_F(EditTest, BlocksComeAndGo) {
  const LoadedDeck deck = open(all(mesh + "# the contact\n" + contact + "# the end\n"));
  Edit edit(deck);
  edit.insert("/FUNCT/7\nload\n                 0.0                 1.0\n");
  edit.erase(deck.interfaces().find(3)->block);
  edit.set("/PROP", 2, "Thick", 1.5);
  const auto after = edit.read();
  ASSERT_TRUE(after.ok()) << error_of(edit);
  EXPECT_EQ(after->interfaces().ordered.size(), 0u);
  EXPECT_TRUE(find_block(after->deck(), "/FUNCT", 7).ok());
  EXPECT_NE(after->deck().sources[0].bytes().find("# the contact\n# the end\n/FUNCT/7\n"),
            std::string_view::npos);
  EXPECT_EQ(thickness(*after), 1.5);
  edit.set(deck.interfaces().find(3), "Gapmin", 1.0);
  EXPECT_NE(error_of(edit).find("was removed before"), std::string::npos);
}

TEST_F(EditTest, AnInsertedBlockGetsItsLinesFromTheFieldsThatAreSet) {
  const LoadedDeck deck = open(all(mesh + contact));
  Edit edit(deck);
  edit.erase(*edit.find("/INTER", 3)).insert("/INTER/TYPE7/3\nsecond\n/INTER/TYPE7/4\nthird\n");
  edit.set("/INTER", 4, "Inacti", 6).set("/INTER", 3, "Gapmin", 0.5).set("/INTER", 3, "IBC", "101");
  edit.erase(*edit.find("/INTER", 4)).set("/INTER", 3, "Fric", 0.25);
  const auto after = edit.read();
  ASSERT_TRUE(after.ok()) << error_of(edit);
  ASSERT_EQ(after->interfaces().type7.size(), 1u);
  const InterType7& inter = after->interfaces().type7[0];
  EXPECT_EQ(inter.id, 3);
  EXPECT_EQ(inter.Gapmin.value, 0.5);
  EXPECT_EQ(inter.Fric.value, 0.25);
  EXPECT_FALSE(edit.find("/INTER", 4).ok());
}

TEST_F(EditTest, TheLargestThatFitsIsTaken) {
  const LoadedDeck deck = open(all(mesh + contact));
  for (const auto& [field, value, text] :
       {std::tuple<const char*, CellValue, const char*>{"grnd_IDs", 2147483647.0, "2147483647"},
        {"grnd_IDs", -999999999.0, "-999999999"},
        {"Igap", "0000000002", "0000000002"},
        {"Gapmin", "1.234567890123456789", "1.234567890123456789"}}) {
    Edit edit(deck);
    edit.set("/INTER", 3, field, value);
    EXPECT_NE(changes(edit).find(text), std::string::npos) << error_of(edit);
  }
}

using testing_support::deck_of;
using testing_support::read;

const Block& block(const Deck& deck, std::string_view keyword) {
  for (const Block& b : deck.blocks)
    if (b.header.starts_with(keyword)) return b;
  throw std::runtime_error("no such block");
}

TEST(NewCard, IsReadWithoutAFindingAndWithAllItsLines) {
  for (const char* keyword : {"/INTER/TYPE7", "/INTER/TYPE10", "/INTER/TYPE11", "/INTER/TYPE19",
                              "/FRICTION", "/MAT/ELAST", "/PROP/SHELL"})
    for (const int version : {51, 110, 140, 2019, 2024, 2026}) {
      const Schema* schema = SchemaSet::built_in().find(keyword);
      ASSERT_NE(schema, nullptr);
      const std::string card = new_card(*schema, std::string(keyword) + "/7", version, "mine");
      const Deck deck = read(deck_of(card, std::to_string(version)));
      Findings findings;
      const DecodedBlock decoded = decode(deck, block(deck, keyword), &findings);
      EXPECT_EQ(findings.all().size(), 0u) << card << findings.all()[0].message;
      EXPECT_EQ(decoded.title, "mine");
      for (const DecodedCard& line : decoded.cards) EXPECT_FALSE(line.missing()) << card;
    }
}

TEST(SetCell, SaysWhyNot) {
  const Deck deck = read(deck_of("/INTER/TYPE7/3\nt\n1,2,4\n"));
  const Block& b = block(deck, "/INTER/TYPE7");
  EXPECT_NE(set_cell(deck, b, "Igap", "3").error().message.find("free format"), std::string::npos);
  EXPECT_NE(set_cell(deck, b, "Nosuch", "3").error().message.find("no field"), std::string::npos);
  EXPECT_NE(set_cell(deck, b, "Gapmin", "3").error().message.find("not there"), std::string::npos);
  const Deck fixed = read(deck_of("/INTER/TYPE7/3\nt\n         1         2         4\n"));
  const auto wide = set_cell(fixed, block(fixed, "/INTER/TYPE7"), "Igap", "12345678901");
  ASSERT_FALSE(wide.ok());
  EXPECT_NE(wide.error().message.find("longer than the 10 columns"), std::string::npos);
}

using namespace testing_support;

/// An edit meant for what one include holds would change the others with it.
TEST(ApplyEditsOfADeck, NeedAllCopiesOfAFileToAgree) {
  SourceSet sources;
  sources.add(Source::from_bytes("main", "M"));
  for (int copy = 0; copy < 2; ++copy) sources.add(Source::from_bytes("part", "abc"));
  const TextEdit first{Span{1, 1, 0}, "X"}, second{Span{2, 1, 0}, "X"}, other{Span{2, 1, 0}, "Y"};
  const auto same = apply_edits(sources, {first, second});
  ASSERT_TRUE(same.ok()) << same.error().message;
  EXPECT_EQ(same->size(), 1u);
  EXPECT_EQ(same->at("part"), "Xbc");
  for (const auto& edits : {std::vector{first, other}, {first}, {second}}) {
    const auto refused = apply_edits(sources, edits);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("part"), std::string::npos);
  }
  // Replaced by what stands there: nothing changes anywhere.
  const Span whole{1, 0, 1};
  EXPECT_TRUE(apply_edits(sources, {{whole, std::string(sources.text(whole))}})->empty());
}

TEST(Overlay, ThatIncludesItselfIsReportedAsACycle) {
  const std::map<std::string, std::string> overlay = {{"a.inc", "#include a.inc\n"},
                                                      {"m_0000.rad", deck_of("#include a.inc\n")}};
  ReadOptions options;
  options.overlay = &overlay;
  const auto deck = read_deck("m_0000.rad", SchemaSet::built_in(), options);
  ASSERT_TRUE(deck.ok());
  EXPECT_EQ(count(deck->findings, RuleId::DK005), 1u);
}

/// A random cell of a contact block and a random value for it that fits.
struct SingleEdit {
  std::string field, text;
  std::size_t block = 0, card = 0, cell = 0;
  Span line;
  int first = 0, last = 0;
};

std::vector<SingleEdit> every_numeric_cell(const Deck& deck) {
  std::vector<SingleEdit> all;
  for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
    const Block& block = deck.blocks[b];
    if (block.schema == nullptr || !block.schema->keyword.starts_with("/INTER/")) continue;
    const DecodedBlock decoded = decode(deck, block);
    for (std::size_t c = 0; c < decoded.cards.size(); ++c) {
      const DecodedCard& card = decoded.cards[c];
      if (card.missing() || card.free_format) continue;
      for (std::size_t k = 0; k < card.cells.size(); ++k) {
        const Cell& cell = card.cells[k];
        if (cell.field->type == FieldType::text || cell.field->type == FieldType::flag) continue;
        all.push_back({cell.field->name, "", b, c, k, card.line.whole(), cell.field->first,
                       cell.field->last});
      }
    }
  }
  return all;
}

bool decides_layout(const Deck& deck, const SingleEdit& e) {
  for (const CardSchema& card : deck.blocks[e.block].schema->cards)
    for (const Condition& condition : card.when)
      if (condition.field == e.field) return true;
  return false;
}

TEST(SingleFieldEdit, ChangesOnlyItsColumnsAndReadsBackTheSame) {
  std::mt19937_64 random(42);
  int edits = 0;
  for (const std::string& path : test::sample_decks()) {
    const auto deck = read_deck(path, SchemaSet::built_in());
    ASSERT_TRUE(deck.ok());
    const auto cells = every_numeric_cell(*deck);
    if (cells.empty()) continue;
    for (int round = 0; round < 60; ++round) {
      SingleEdit e = cells[random() % cells.size()];
      if (decides_layout(*deck, e)) continue;
      const DecodedBlock before = decode(*deck, deck->blocks[e.block]);
      const Field& field = *before.cards[e.card].cells[e.cell].field;
      const int width = e.last - e.first + 1;
      const double real = std::ldexp(static_cast<double>(random() % 100000) - 5e4,
                                     static_cast<int>(random() % 60) - 30);
      const auto integer = static_cast<std::int64_t>(random() % 10000);
      const bool is_real = field.type == FieldType::real;
      e.text = is_real ? format_real(real, width)->text : *format_integer(integer, width);
      CellWriter edit(deck->sources);
      edit.set(e.line, e.first, e.last, e.text);
      const auto changed = apply_edits(deck->sources, edit.release_edits());
      ASSERT_TRUE(changed.ok()) << changed.error().message;
      ReadOptions options;
      options.overlay = &*changed;
      const auto again = read_deck(path, SchemaSet::built_in(), options);
      ASSERT_TRUE(again.ok());
      const DecodedBlock after = decode(*again, again->blocks[e.block]);
      const Cell& cell = after.cards[e.card].cells[e.cell];
      if (is_real)
        EXPECT_EQ(cell.real, read_real(e.text).value) << path << " " << e.field;
      else
        EXPECT_EQ(cell.integer, integer) << path << " " << e.field;
      for (const auto& [file, text] : *changed) {
        const std::string old(deck->sources[e.line.file].bytes());
        ASSERT_EQ(file, deck->sources[e.line.file].path());
        // Up to the cell, and behind the line, nothing moved.
        const std::uint64_t begin = e.line.offset + static_cast<std::uint64_t>(e.first - 1);
        const std::uint64_t keep = std::min<std::uint64_t>(begin, e.line.offset + e.line.length);
        EXPECT_EQ(text.substr(0, keep), old.substr(0, keep));
        const std::uint64_t old_end = std::min<std::uint64_t>(
            e.line.offset + static_cast<std::uint64_t>(e.last), old.find('\n', e.line.offset));
        const std::string rest = old.substr(old_end);
        EXPECT_EQ(text.substr(text.size() - rest.size()), rest);
      }
      ++edits;
    }
  }
  EXPECT_GT(edits, 300);
}

}  // namespace
}  // namespace deck
