// LS-DYNA contact keywords become Radioss interfaces, and every cell is accounted for.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../contact/small_deck.hpp"
#include "deck/edit/lsdyna.hpp"
#include "edit/extract_support.hpp"
#include "edit/lsdyna/read.hpp"

namespace deck {
namespace {

using edit_test::Whole;

Rewrite converted(const std::string& text, const LsDynaOptions& options = {}) {
  return contacts_from_lsdyna("crash.k", text, SchemaSet::built_in(), options);
}

/// Eight cells of ten columns.
std::string card(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& c : cells)
    line += std::string(10 - std::min<std::size_t>(c.size(), 10), ' ') + c;
  return line + "\n";
}

const LossEntry* entry(const Rewrite& r, const std::string& field) {
  for (const LossEntry& e : r.losses)
    if (e.field == field) return &e;
  return nullptr;
}
Loss loss_of(const Rewrite& r, const std::string& field) {
  const LossEntry* e = entry(r, field);
  EXPECT_NE(e, nullptr) << field;
  return e == nullptr ? Loss::undecided : e->loss;
}

/// A deck of two plates with sets 11 and 12, and the converted file included.
std::unique_ptr<Whole> in_deck(const Rewrite& r, int version = 2022) {
  EXPECT_TRUE(r.refusals.empty()) << r.refusals.front();
  test::SmallDeck d;
  for (int i = 0; i < 4; ++i) d.node(i + 1, i % 2 * 10.0, i / 2 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(i + 5, i % 2 * 9.0, i / 2 * 9.0, 1.2);
  d.shell_part(1, 1.5).shell_part(2, 2.5).shell(1, 1, 1, 2, 4, 3).shell(2, 2, 5, 6, 8, 7);
  d.add(
      "/SET/GENERAL/11\nfirst\nPART               1\n/SET/GENERAL/12\nsecond\nPART"
      "               2\n#include contacts.inc");
  std::string main = d.text();
  if (version != 2022) main.replace(main.find("2022"), 4, std::to_string(version));
  return Whole::read("main_0000.rad", {{"main_0000.rad", main}, {"contacts.inc", *r.new_text}});
}

const std::string plain = card({"11", "12", "2", "2"}) + card({"0.2"}) + card({"1.0", "1.0"});

TEST(LsDyna, SingleSurfaceBecomesType7OfASurfaceWithItself) {
  const Rewrite r = converted("*KEYWORD\n*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID\n$ comment\n" +
                              card({"77", "all of it"}) + card({"11", "0", "2"}) + card({"0.2"}) +
                              card({"1.0", "1.0"}) + "*END\n*CONTACT_AUTOMATIC_GENERAL\n");
  const auto w = in_deck(r);
  ASSERT_EQ(w->interfaces.ordered.size(), 1u);
  const InterType7& i = w->interfaces.type7.at(0);
  EXPECT_EQ(i.id, 77);
  EXPECT_EQ(i.title, "all of it");
  EXPECT_EQ(i.grnd_IDs.value, 0);
  EXPECT_EQ(i.surf_IDm.value, 11);
  EXPECT_EQ(i.Fric.value, 0.2);
  EXPECT_EQ(i.Igap.value, 1);
  EXPECT_EQ(i.Inacti.value, 6);
  EXPECT_EQ(loss_of(r, "SSID"), Loss::kept);
  EXPECT_EQ(loss_of(r, "CID"), Loss::kept);
}

TEST(LsDyna, SurfaceToSurfaceBecomesType19AndItsContactsExist) {
  const auto w = in_deck(converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + plain));
  const InterType19& i = w->interfaces.type19.at(0);
  EXPECT_EQ(i.surf_IDs.value, 11);
  EXPECT_EQ(i.surf_IDm.value, 12);
  Diagnostics diagnostics;
  const Scene scene = build_scene(w->model, w->interfaces, diagnostics);
  ASSERT_EQ(scene.contacts.size(), 3u);
  for (const Contact& c : scene.contacts) EXPECT_GT(c.penetrations.size() + c.candidates, 0u);
}

TEST(LsDyna, ChoiceOfTargetMakesTheSidesItNeeds) {
  for (const int target : {7, 10, 11, 19}) {
    LsDynaOptions options;
    options.target = target;
    const Rewrite r = converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + plain, options);
    const auto w = in_deck(r);
    ASSERT_EQ(w->interfaces.ordered.size(), 1u);
    EXPECT_EQ(w->interfaces.ordered[0]->type, target);
    Diagnostics diagnostics;
    const Scene scene = build_scene(w->model, w->interfaces, diagnostics);
    for (const Contact& c : scene.contacts) {
      EXPECT_GT(c.secondary.size() + c.secondary_edges.size(), 0u) << target;
      EXPECT_GT(c.main.size() + c.main_edges.size(), 0u) << target;
    }
    EXPECT_EQ(loss_of(r, "keyword"), Loss::approximated);
  }
}

TEST(LsDyna, SoftNamesTheTypeAsTheReferenceReaderDoes) {
  const auto w = in_deck(converted("*CONTACT_AUTOMATIC_GENERAL\n" + plain + card({"-11"})));
  EXPECT_EQ(w->interfaces.ordered.at(0)->type, 11);
}

TEST(LsDyna, NodesToSurfaceUsesTheNodeSet) {
  const Rewrite r = converted("*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n" +
                              card({"12", "1", "4", "3"}) + card({"0.2"}) + card({"1"}));
  const auto w = in_deck(r);
  const InterType7& i = w->interfaces.type7.at(0);
  EXPECT_EQ(i.grnd_IDs.value, 12);
  EXPECT_EQ(i.surf_IDm.value, 90000001);
  EXPECT_NE(r.new_text->find("/SURF/PART/EXT/90000001\npart 1\n         1\n"), std::string::npos);
  // Edges of a node set do not exist.
  LsDynaOptions options;
  options.target = 11;
  EXPECT_EQ(in_deck(converted("*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n" +
                                  card({"12", "1", "4", "3"}) + card({"0.2"}) + card({"1"}),
                              options))
                ->interfaces.ordered.at(0)
                ->type,
            7);
}

TEST(LsDyna, AllPartsAndAllPartsButSome) {
  const Rewrite r = converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"0", "0", "5"}) +
                              card({"0.2"}) + card({"1"}) + "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" +
                              card({"12", "0", "6"}) + card({"0.2"}) + card({"1"}));
  const auto w = in_deck(r);
  ASSERT_EQ(w->interfaces.type7.size(), 2u);
  Diagnostics diagnostics;
  const Scene scene = build_scene(w->model, w->interfaces, diagnostics);
  EXPECT_EQ(scene.contacts.at(0).main.size(), 2u);
  EXPECT_EQ(scene.contacts.at(1).main.size(), 1u);
  LsDynaOptions old;
  old.version = 2019;
  EXPECT_EQ(loss_of(converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"0", "0", "5"}) +
                                  card({"0.2"}) + card({"1"}),
                              old),
                    "SSID"),
            Loss::undecided);
}

TEST(LsDyna, TiedBecomesType10WithoutRebound) {
  const Rewrite r =
      converted("*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET_ID\n" + card({"5", "glue"}) +
                card({"11", "12", "2", "2"}) + card({"0.3"}) + card({"1", "1", "-2.0", "-4.0"}));
  const auto w = in_deck(r);
  const InterType10& i = w->interfaces.type10.at(0);
  EXPECT_EQ(i.ITIED.value, 1);
  EXPECT_EQ(i.Gap.value, 3.0);
  EXPECT_EQ(loss_of(r, "FS"), Loss::dropped);
  EXPECT_EQ(loss_of(r, "SST"), Loss::approximated);
  EXPECT_EQ(loss_of(r, "option"), Loss::approximated);
}

TEST(LsDyna, ATiedContactTakesSmallDistancesAndIgnoresIgnore) {
  const auto tied = [](const std::string& a, const std::string& b) {
    return converted("*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET\n" + card({"11", "12", "2", "2"}) +
                     card({"0"}) + card({"1", "1", a, b}) + card({"1"}) + card({"0"}) +
                     card({"0", "1"}));
  };
  const Rewrite small = tied("-0.5", "-0.25");
  ASSERT_NE(entry(small, "SST"), nullptr);
  EXPECT_EQ(in_deck(small)->interfaces.type10.at(0).Gap.value, 0.375);
  bool in_gap = false;
  for (const LossEntry& e : small.losses)
    if (e.field == "MST") in_gap = e.note == "in Gap" && e.loss == Loss::approximated;
  EXPECT_TRUE(in_gap);
  EXPECT_EQ(loss_of(small, "IGNORE"), Loss::dropped);
  EXPECT_EQ(loss_of(tied("0", "0"), "MST"), Loss::kept);
}

TEST(LsDyna, SoftAndDepthSayWhatTheyAskFor) {
  const auto with = [](const char* soft, const char* depth) {
    return converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"11", "0", "2"}) +
                     card({"0.1"}) + card({"1"}) + card({soft, "", "", "", "", depth}));
  };
  EXPECT_EQ(loss_of(with("0", "2"), "SOFT"), Loss::approximated);
  EXPECT_EQ(loss_of(with("1", "2"), "SOFT"), Loss::dropped);
  EXPECT_EQ(loss_of(with("2", "2"), "SOFT"), Loss::dropped);
  for (const char* edges : {"5", "13", "15", "23", "25", "33", "35", "45", "55"})
    EXPECT_EQ(loss_of(with("1", edges), "DEPTH"), Loss::dropped) << edges;
  for (const char* nodes : {"1", "2", "3", "4", "6", "44"})
    EXPECT_EQ(loss_of(with("1", nodes), "DEPTH"), Loss::approximated) << nodes;
}

TEST(LsDyna, IgnoreOneReducesTheGapByThePenetrationAlone) {
  for (const auto& [ignore, inacti] : {std::pair{"1", 5}, {"2", 5}, {"0", 6}}) {
    const Rewrite r =
        converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"11", "0", "2"}) + card({"0.1"}) +
                  card({"1"}) + card({"1"}) + card({"0"}) + card({"0", ignore}));
    EXPECT_EQ(in_deck(r)->interfaces.type7.at(0).Inacti.value, inacti) << ignore;
    const LossEntry* e = entry(r, "IGNORE");
    ASSERT_NE(e, nullptr) << ignore;
    EXPECT_EQ(e->note.find("margin") == std::string::npos, inacti == 5) << e->note;
  }
}

TEST(LsDyna, FrictionThatDoesNotDecayAccountsForItsOtherCells) {
  const Rewrite r = converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"11", "0", "2"}) +
                              card({"0.2", "0.2", "5.0"}) + card({"1"}));
  EXPECT_EQ(loss_of(r, "FD"), Loss::kept);
  EXPECT_EQ(loss_of(r, "DC"), Loss::kept);
  EXPECT_EQ(in_deck(r)->interfaces.type7.at(0).Fric.value, 0.2);
}

TEST(LsDyna, LinesBehindTheLastCardAreLeftToAPersonTenOfThemAtMost) {
  for (const int lines : {1, 10, 12}) {
    std::string text = "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"11", "0", "2"}) +
                       card({"0.2"}) + card({"1"});
    for (int k = 0; k < 7; ++k) text += card({"0"});
    for (int k = 0; k < lines; ++k) text += card({std::to_string(7000 + k)});
    int undecided = 0;
    for (const LossEntry& e : converted(text).losses)
      undecided += e.note == "a line after the last optional card";
    EXPECT_GE(undecided, std::min(lines, 10) - 1) << lines;
    EXPECT_LE(undecided, 10);
  }
}

TEST(LsDyna, ATiedContactWithoutADistanceSaysThatTheDistancesDiffer) {
  const Rewrite r = converted("*CONTACT_TIED_NODES_TO_SURFACE\n" + card({"11", "12", "4", "2"}) +
                              card({}) + card({}));
  const auto about_gap = std::count_if(r.losses.begin(), r.losses.end(), [](const LossEntry& e) {
    return e.loss == Loss::approximated && e.new_text == "Gap = 0";
  });
  EXPECT_EQ(about_gap, 1);
}

TEST(LsDyna, NoIdIsUsedTwiceInTheFilesOfOneCall) {
  const std::string one = "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"13", "0", "3"}) +
                          card({"0.2"}) + card({"1.0", "1.0"});
  // The second file gives an id that the first would take for a contact without one.
  const std::string other = "*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID\n" + card({"1", "one"}) +
                            card({"14", "0", "3"}) + card({"0.2"}) + card({"1.0", "1.0"});
  const auto both = contacts_from_lsdyna({{"a.k", one}, {"b.k", other}}, SchemaSet::built_in());
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NE(both[0].new_text->find("/INTER/TYPE7/2\n"), std::string::npos) << *both[0].new_text;
  EXPECT_NE(both[0].new_text->find("/SURF/PART/EXT/90000001\n"), std::string::npos);
  EXPECT_NE(both[1].new_text->find("/INTER/TYPE7/1\n"), std::string::npos) << *both[1].new_text;
  EXPECT_NE(both[1].new_text->find("/SURF/PART/EXT/90000002\n"), std::string::npos);
}

TEST(LsDyna, DecayingFrictionIsTheSameLaw) {
  const Rewrite r =
      converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + card({"11", "12", "2", "2"}) +
                card({"0.4", "0.1", "2.5"}) + card({"1", "1", "0", "0", "1", "1", "0.5"}));
  const auto w = in_deck(r);
  const InterType19& i = w->interfaces.type19.at(0);
  EXPECT_EQ(i.Ifric.value, 4);
  EXPECT_EQ(i.Fric.value, 0.2);
  EXPECT_EQ(i.C1.value, 0.05);
  EXPECT_EQ(i.C2.value, 2.5);
  for (const char* f : {"FS", "FD", "DC", "FSF"}) EXPECT_EQ(loss_of(r, f), Loss::kept) << f;
}

TEST(LsDyna, FrictionThatNeedsADecision) {
  for (const char* fs : {"-1.0", "2.0", "abc", "&unknown"}) {
    const Rewrite r = converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"11", "0", "2"}) +
                                card({fs, "7"}) + card({"1"}));
    EXPECT_EQ(loss_of(r, "FS"), Loss::undecided) << fs;
    EXPECT_EQ(in_deck(r)->interfaces.type7.at(0).Fric.value, 0);
  }
}

TEST(LsDyna, TimesStiffnessThicknessAndDamping) {
  const Rewrite r =
      converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + card({"11", "12", "2", "2"}) +
                card({"0", "0", "0", "0", "20.0", "1", "1.5", "80.0"}) +
                card({"2.0", "3.0", "1.0", "2.0", "1.5", "1.5"}));
  const auto w = in_deck(r);
  const InterType19& i = w->interfaces.type19.at(0);
  EXPECT_EQ(i.Tstart.value, 1.5);
  EXPECT_EQ(i.Tstop.value, 80.0);
  EXPECT_EQ(i.Stfac.value, 3.0);
  EXPECT_EQ(i.Gapmin.value, 1.5);
  EXPECT_EQ(i.Igap.value, 1000);
  EXPECT_EQ(i.VISs.value, 0.2);
  EXPECT_EQ(loss_of(r, "SFS"), Loss::dropped);
  EXPECT_EQ(loss_of(r, "PENCHK"), Loss::dropped);
  EXPECT_EQ(loss_of(r, "SFST"), Loss::kept);
}

TEST(LsDyna, ThicknessScaleBecomesFscalegap) {
  const Rewrite r = converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"11", "0", "2"}) +
                              card({"0"}) + card({"1", "1", "0", "0", "0.7", "0.7"}));
  const auto w = in_deck(r);
  EXPECT_EQ(w->interfaces.type7.at(0).Igap.value, 2);
  EXPECT_EQ(w->interfaces.type7.at(0).Fscalegap.value, 0.7);
  EXPECT_EQ(loss_of(r, "SFST"), Loss::kept);
}

TEST(LsDyna, ThicknessOfOneSideNeedsADecision) {
  const Rewrite r =
      converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + card({"11", "12", "2", "2"}) +
                card({"0"}) + card({"1", "1", "0", "2.0"}));
  EXPECT_EQ(loss_of(r, "MST"), Loss::undecided);
}

TEST(LsDyna, MppAndOptionalCardsAreReadInTheirOrder) {
  const Rewrite r = converted(
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE_MPP_ID\n" + card({"9", "title"}) +
      card({"1", "100", "", "4"}) + card({"&", "1", "0.9"}) + card({"11", "0", "2"}) +
      card({"0.1"}) + card({"1"}) + card({"1", "0.2", "", "1.1", "3", "5"}) + card({"0.5", "1"}) +
      card({"2", "1"}) + card({"1"}) + card({"1"}) + card({"1"}) + card({"", "1"}));
  const auto w = in_deck(r);
  EXPECT_EQ(w->interfaces.type7.at(0).Inacti.value, 5);
  EXPECT_EQ(w->interfaces.type7.at(0).Fric.value, 0.1);
  EXPECT_EQ(loss_of(r, "DEPTH"), Loss::dropped);
  EXPECT_EQ(loss_of(r, "PENMAX"), Loss::dropped);
  EXPECT_EQ(loss_of(r, "SHLOFF"), Loss::dropped);
  EXPECT_EQ(loss_of(r, "BCKT"), Loss::dropped);
  EXPECT_EQ(loss_of(r, "CHKSEGS"), Loss::dropped);
  EXPECT_EQ(entry(r, "PENMAX")->line, 9u);
}

TEST(LsDyna, CommaAndLongFormatsReadTheSame) {
  const std::string comma =
      "*contact_automatic_surface_to_surface_id\n5,with, "
      "commas\n11,12,2,2\n.4,.1,2.5\n1,1,,,1.5,1.5\n";
  const auto wide = [](const std::vector<std::string>& cells) {
    std::string line;
    for (const std::string& c : cells) line += std::string(20 - c.size(), ' ') + c;
    return line + "\n";
  };
  const std::string longer = "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID+\n" +
                             wide({"5"}).substr(0, 20) + "with, commas\n" +
                             wide({"11", "12", "2", "2"}) + wide({"0.4", "0.1", "2.5"}) +
                             wide({"1", "1", "", "", "1.5", "1.5"});
  const std::string columns = "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n" +
                              card({"5"}).substr(0, 10) + "with, commas\n" +
                              card({"11", "12", "2", "2"}) + card({"0.4", "0.1", "2.5"}) +
                              card({"1", "1", "", "", "1.5", "1.5"});
  EXPECT_EQ(*converted(comma).new_text, *converted(columns).new_text);
  EXPECT_EQ(*converted(longer).new_text, *converted(columns).new_text);
  EXPECT_EQ(
      *converted("*KEYWORD LONG=Y\n" + longer.substr(0, 40) + "\n" + longer.substr(42)).new_text,
      *converted(columns).new_text);
}

TEST(LsDyna, ParametersAreReplaced) {
  const Rewrite r = converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"&sid", "0", "2"}) +
                              card({"&mu"}) + card({"-&neg"}) + "*PARAMETER\n" +
                              card({"R mu", "0.35", "I sid", "11"}) + "R neg,-2.0\n");
  const auto w = in_deck(r);
  EXPECT_EQ(w->interfaces.type7.at(0).Fric.value, 0.35);
  EXPECT_EQ(w->interfaces.type7.at(0).surf_IDm.value, 11);
  EXPECT_EQ(w->interfaces.type7.at(0).Stfac.value, 2.0);
  EXPECT_EQ(entry(r, "FS")->old_text, "&mu");
}

TEST(LsDyna, OtherContactsAreNamedAsDropped) {
  const Rewrite r =
      converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK\n" + plain +
                "*CONTACT_FORCE_TRANSDUCER_PENALTY\n*CONTACT_AUTOMATIC_GENERAL\n" + plain);
  std::size_t dropped = 0;
  for (const LossEntry& e : r.losses)
    dropped += e.loss == Loss::dropped && e.note == "this keyword is not converted" ? 1 : 0;
  EXPECT_EQ(dropped, 2u);
  EXPECT_EQ(in_deck(r)->interfaces.ordered.size(), 1u);
}

TEST(LsDyna, NothingToConvertIsRefused) {
  EXPECT_EQ(converted("").refusals.size(), 1u);
  EXPECT_EQ(converted("*KEYWORD\n*NODE\n       1 0 0 0\n").refusals.size(), 1u);
  EXPECT_EQ(converted("*CONTACT_ENTITY\n").refusals.size(), 1u);
  LsDynaOptions bad;
  bad.target = 25;
  EXPECT_FALSE(converted("*CONTACT_AUTOMATIC_GENERAL\n" + plain, bad).refusals.empty());
  bad = {};
  bad.version = 150;
  EXPECT_FALSE(converted("*CONTACT_AUTOMATIC_GENERAL\n" + plain, bad).refusals.empty());
}

TEST(LsDyna, MissingCardsAreReported) {
  const Rewrite r = converted("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n" + card({"11", "0", "2"}));
  bool found = false;
  for (const LossEntry& e : r.losses) found |= e.note.find("1 of 3") != std::string::npos;
  EXPECT_TRUE(found);
}

TEST(LsDyna, IdsAreUniqueAndDuplicatesReported) {
  const std::string with_id = "*CONTACT_AUTOMATIC_GENERAL_ID\n" + card({"1", "/INTER"}) + plain;
  const Rewrite r = converted("*CONTACT_AUTOMATIC_GENERAL\n" + plain + with_id + with_id);
  const auto w = in_deck(r);
  std::set<std::int64_t> ids;
  for (const InterBase* i : w->interfaces.ordered) ids.insert(i->id);
  EXPECT_EQ(ids.size(), 3u);
  EXPECT_TRUE(ids.contains(1));
  EXPECT_EQ(loss_of(r, "HEADING"), Loss::approximated);
}

TEST(LsDyna, SetsOfTwoTypesUnderOneIdNeedADecision) {
  const Rewrite r = converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" +
                              card({"11", "11", "2", "0"}) + card({"0"}) + card({"1"}));
  bool found = false;
  for (const LossEntry& e : r.losses) found |= e.keyword == "*SET" && e.id == 11;
  EXPECT_TRUE(found);
}

TEST(LsDyna, CardsFollowTheColumnsOfTheVersion) {
  for (const int version : {110, 120, 130, 140, 2017, 2018, 2020, 2022, 2024, 2026})
    for (const int target : {7, 10, 11, 19}) {
      LsDynaOptions options;
      options.version = version;
      options.target = target;
      const Rewrite r =
          converted("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + card({"11", "12", "2", "2"}) +
                        card({"0.4", "0.1", "2.5"}) + card({"1", "2", "0", "0", "1.5", "1.5"}),
                    options);
      const auto w = in_deck(r, version);
      ASSERT_EQ(w->interfaces.ordered.size(), 1u);
      // Nothing is misplaced: decoding finds neither missing lines nor text between cells.
      for (const Block& b : w->deck.blocks) {
        if (b.header_span.file == 0) continue;
        Diagnostics found;
        decode(w->deck, b, &found);
        EXPECT_TRUE(found.all().empty())
            << version << " " << b.header << ": " << found.all().front().message;
      }
    }
}

/// Every cell that is not blank has an entry, whatever stands in it.
TEST(LsDyna, EveryCellIsAccountedFor) {
  std::mt19937 random(31);
  const char* const keywords[] = {"AUTOMATIC_SINGLE_SURFACE",
                                  "AUTOMATIC_SURFACE_TO_SURFACE",
                                  "AUTOMATIC_NODES_TO_SURFACE",
                                  "AUTOMATIC_GENERAL",
                                  "AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE",
                                  "TIED_NODES_TO_SURFACE",
                                  "TIED_SURFACE_TO_SURFACE_OFFSET",
                                  "TIED_SHELL_EDGE_TO_SURFACE"};
  const char* const values[] = {"",   "",      "0",     "1",   "2",     "5",  "-1",          "0.5",
                                "11", "1e20",  "-9999", "abc", "1.5.2", "&p", "99999999999", "4",
                                "6",  "1e400", "nan"};
  for (int round = 0; round < 3000; ++round) {
    std::string text = "*CONTACT_" + std::string(keywords[random() % 8]) + "_MPP_ID\n";
    const int cards = static_cast<int>(random() % 12);
    for (int k = 0; k < cards; ++k) {
      std::vector<std::string> cells;
      for (int i = 0; i < 8; ++i) cells.emplace_back(values[random() % std::size(values)]);
      text += card(cells);
    }
    LsDynaOptions options;
    const int targets[] = {0, 7, 10, 11, 19};
    options.target = targets[random() % 5];
    const Rewrite r = converted(text, options);
    ASSERT_TRUE(r.new_text.has_value());
    const detail::DynaFile file = detail::read_dyna({"crash.k", text}, {});
    for (const detail::DynaCell& cell : file.contacts.at(0).cells) {
      if (cell.written.empty()) continue;
      const bool found = std::any_of(r.losses.begin(), r.losses.end(), [&](const LossEntry& e) {
        return e.field == cell.name && (e.line == cell.line || e.field == "CID");
      });
      ASSERT_TRUE(found) << cell.name << " = " << cell.written << "\n" << text;
    }
    std::set<std::pair<std::string, std::uint64_t>> once;
    for (const LossEntry& e : r.losses)
      if (!e.field.empty() && e.field != "option" && e.field != "keyword" &&
          e.field != "(unused columns)") {
        ASSERT_TRUE(once.emplace(e.field, e.line).second) << e.field << "\n" << text;
      }
  }
}

TEST(LsDyna, HostileTextNeverHurts) {
  std::mt19937 random(41);
  const std::string good =
      "*KEYWORD\n*PARAMETER\nRmu,0.1\n*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_MPP_ID\n" +
      card({"5", "t"}) + card({"1"}) + card({"&"}) + plain + card({"1"}) +
      "*CONTACT_TIED_NODES_TO_SURFACE+\n" + plain + "*END\n";
  for (int round = 0; round < 5000; ++round) {
    std::string text = good;
    for (int k = static_cast<int>(random() % 12); k >= 0; --k) {
      const std::size_t at = random() % (text.size() + 1);
      switch (random() % 4) {
        case 0:
          text.insert(at, 1, static_cast<char>(random() % 256));
          break;
        case 1:
          text.erase(at, random() % 30);
          break;
        case 2:
          text.insert(at, text.substr(random() % (text.size() + 1), random() % 60));
          break;
        default:
          text.insert(at, "\r\n*CONTACT_AUTOMATIC_GENERAL_ID_ID_MPP_&,,");
      }
    }
    const Rewrite r = converted(text);
    EXPECT_TRUE(r.new_text.has_value() || !r.refusals.empty());
    if (r.new_text && round % 50 == 0) in_deck(r);
  }
  EXPECT_FALSE(converted(std::string(1 << 20, ',')).refusals.empty());
  converted("*CONTACT_AUTOMATIC_GENERAL\n" + std::string(1 << 20, ','));
  converted("*CONTACT_" + std::string(1 << 20, '_'));
}

}  // namespace
}  // namespace deck
