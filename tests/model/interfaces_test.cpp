// Effective values of interfaces and where they come from: one row a card.
#include "deck/model.hpp"
#include "deck/rule_id.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <sstream>
#include <type_traits>

#include "lint/shared/example.hpp"

namespace deck {
namespace {

/// A run of the words "implicit", "airbag", "adaptive", "thermal", "acoustics", "nodes=N".
Model model_of(const std::string& run) {
  Model m;
  m.implicit = run == "implicit";
  m.has_monitored_volume = run == "airbag";
  m.has_adaptive_mesh = run == "adaptive";
  m.has_thermal_material = run == "thermal";
  m.has_acoustics = run == "acoustics";
  if (run.starts_with("nodes=")) m.nodes.id.resize(std::stoul(run.substr(6)));
  return m;
}

/// Interfaces of a deck in the notation of examples. A line "TYPE7 Istf=4" is interface 5, a line
/// "DEFAULT/TYPE7 Istf=4" the block of defaults.
struct Cards {
  explicit Cards(const std::string& text, const std::string& run = "", int version = 2026,
                 const std::string& head = "@bare\n")
      : model(model_of(run)) {
    std::string example = "@version " + std::to_string(version) + "\n" + head;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line); example += line + "\n") {
      if (line.starts_with("DEFAULT/")) line = "@/DEFAULT/INTER/" + line.substr(8);
      if (line.starts_with("TYPE")) {
        const std::size_t word = std::min(line.find(' '), line.size());
        line = "@/INTER/" + line.substr(0, word) + "/5" + line.substr(word);
      }
    }
    auto read = read_deck_text("cards_0000.rad", example_deck(example, SchemaSet::built_in()).main,
                               SchemaSet::built_in());
    EXPECT_TRUE(read.ok());
    deck = std::move(*read);
    all = read_interfaces(deck, model, found);
  }
  Deck deck;
  Model model;
  Findings found;
  Interfaces all;
};

const char* word(Origin origin) {
  return origin == Origin::default_block ? "block"
         : origin == Origin::built_in    ? "built_in"
         : origin == Origin::geometry    ? "geometry"
                                         : to_string(origin);
}

bool is(double value, const std::string& text) {
  return value == std::strtod(text.c_str(), nullptr);
}
bool is(std::int64_t value, const std::string& text) {
  return is(static_cast<double>(value), text);
}
bool is(const std::string& value, const std::string& text) { return value == text; }

/// "name=value", then perhaps ":origin" and "<input".
struct Wanted {
  explicit Wanted(const std::string& text) {
    const auto equal = text.find('='), colon = text.find(':'), less = text.find('<');
    name = text.substr(0, equal);
    value = text.substr(equal + 1, std::min(colon, less) - equal - 1);
    if (colon != text.npos) origin = text.substr(colon + 1, less - colon - 1);
    if (less != text.npos) input = text.substr(less + 1);
  }
  std::string name, value, origin, input;
};

struct Row {
  const char* cards;   ///< once for every item of "{a,b}"
  const char* values;  ///< of the first interface
  const char* run = "";
  int version = 2026;
};

void expect_values(const std::string& cards, const Row& row) {
  if (const auto open = cards.find('{'); open != cards.npos) {
    const auto close = cards.find('}');
    std::istringstream items(cards.substr(open + 1, close - open - 1));
    for (std::string item; std::getline(items, item, ',');)
      expect_values(cards.substr(0, open) + item + cards.substr(close + 1), row);
    return;
  }
  const Cards c(cards, row.run, row.version);
  ASSERT_FALSE(c.all.all.empty()) << cards;
  std::istringstream words(row.values);
  for (std::string text; words >> text;) {
    const Wanted wanted(text);
    bool known = false;
    for_each_field(*c.all.all[0], [&](const char* name, const auto& field) {
      if (name != wanted.name) return;
      known = true;
      EXPECT_TRUE(is(field.value, wanted.value)) << cards << ": " << text << ": " << field.value;
      EXPECT_TRUE(wanted.origin.empty() || word(field.origin) == wanted.origin)
          << cards << ": " << text << ": " << word(field.origin);
      EXPECT_TRUE(wanted.input.empty() || is(field.input, wanted.input)) << cards;
    });
    EXPECT_TRUE(known) << cards << ": " << text;
  }
}

template <std::size_t n>
void expect_rows(const Row (&rows)[n]) {
  for (const Row& row : rows) expect_values(row.cards, row);
}

TEST(InterfaceValues, OfType7) {
  expect_rows({
      {"TYPE7",
       "Istf=1000:built_in Igap=1000 Inacti=1000 Iform=1 Irem_gap=1 Irem_i2=3 IBC=000 VISF=0 "
       "%mesh_size=0 Gapmin=0:geometry Stmin=0 Stmax=1e30"},
      {"TYPE7", "Irem_i2=1", "implicit"},
      {"/INTER/TYPE7/5\ntitle\n         1         2         4", "Istf=4 Stfac=1 Tstop=1e30"},
      // Flags that need something of the run.
      {"TYPE7 Ibag=1", "Ibag=1000:derived"},
      {"TYPE7 Ibag=1", "Ibag=1", "airbag"},
      {"TYPE7 Iadm=2", "Iadm=0"},
      {"TYPE7 Iadm=2", "Iadm=2 NRadm=3 Padm=1", "adaptive"},
      {"TYPE7 Ithe=1", "Ithe=1 Kthe=1e-30 AscaleK=1 Drad=0:geometry", "thermal"},
      {"TYPE7 Ithe=1 Rthe=3", "Kthe=3", "thermal", 120},
      {"TYPE7", "Bumult=0.3", "nodes=1500001"},
      {"TYPE7", "Bumult=0.4", "nodes=2500001"},
      {"TYPE7 Idel=-2", "Idel=-2"},
      {"TYPE7 Idel={3,-3,1000}", "Idel=1000"},
      // Gap and stiffness.
      {"TYPE7 Fscalegap=0.8 Gapmax=3", "Fscalegap=1:derived<0.8 Gapmax=1e30"},
      {"TYPE7 Igap=2 Fscalegap=0.8 Gapmax=3", "Fscalegap=0.8 Gapmax=3:card"},
      {"TYPE7 Gapmin=-1", "Gapmin=0:geometry<-1"},
      {"TYPE7 Stmin=5 Stmax=9 Istf={0,1,1000}", "Stmin=0 Stmax=1e30"},
      {"TYPE7 Stmin=5 Stmax=9 Istf={2,3,4,5}", "Stmin=5 Stmax=9"},
      // Friction brings damping, but for the incremental formulation; the filter needs a factor.
      {"TYPE7 Fric=0.1 Iform=2", "VISF=0"},
      {"TYPE7 Fric=0.9 fric_ID=7", "Fric=0.9"},
      {"TYPE7 Ifiltr=2", "Ifiltr=0<2"},
      {"TYPE7 Ifiltr=2 Xfreq=0.5", "Ifiltr=2"},
      {"TYPE7 IBCX=1 IBCZ=1", "IBC=101"},
      {"TYPE7 IBCX=2 IBCZ=1", "IBC=001"},
      // Offsets of a submodel: of options and of nodes. Zero stays zero.
      {"//SUBMODEL/1\nsub\n       100      1000\nTYPE7 Icurv=2 node_ID1=8 node_ID2=9\n//ENDSUB",
       "grnd_IDs=102 surf_IDm=101 node_ID1=1008 node_ID2=1009"},
      {"//SUBMODEL/1\nsub\n       100\nTYPE7 grnd_IDs=0\n//ENDSUB", "grnd_IDs=0 surf_IDm=101"},
  });
}

TEST(InterfaceValues, OfTypes10And11And19) {
  expect_rows({
      {"TYPE10 Stfac=0\nDEFAULT/TYPE7 Istf=4",
       "Stfac=0.2 VISs=0.05 Bumult=0.2 Tstop=1e30 Idel=0 Gap=0:geometry"},
      {"TYPE11\nDEFAULT/TYPE7 Istf=4 Igap=1", "Igap=1000 Istf=5"},
      {"TYPE11 Istf=1000\nDEFAULT/TYPE11 Istf=4", "Istf=5"},
      {"TYPE11 line_IDs=4 line_IDm=0", "line_IDm=4:derived"},
      {"TYPE11 Stmax=7", "Stmax=7"},
      {"TYPE11 Istf=1 Stmax=7", "Stmax=1e30"},
      {"TYPE11 Iform=2 Fric=0.3 VISF=0.6", "VISF=0.6"},
      {"TYPE19 surf_IDs=0 surf_IDm=4", "surf_IDs=4"},
      {"TYPE19 surf_IDs=4 surf_IDm=0", "surf_IDm=4"},
      {"TYPE19 Iedge=1", "Iedge=2<1"},
      {"TYPE19 Iedge=1\nDEFAULT/TYPE19 Iedge=1", "Iedge=1:block"},
      {"TYPE19 Igap=4", "Igap=4 Irem_gap=2"},
  });
}

TEST(InterfaceValues, OfType2) {
  expect_rows({
      {"TYPE2 Stfac=0",
       "Ignore=1000:built_in Spotflag=5:built_in Isearch=2:built_in Idel2=1000:built_in "
       "Iproj=1:built_in Stfac=0 Visc=0 Rupt=0 Max_N_Dist=0"},
      {"TYPE2", "Spotflag=4:built_in", "acoustics"},
      {"TYPE2\nDEFAULT/TYPE2 Spotflag=28 Isearch=1 Ignore=3",
       "Spotflag=28:block Isearch=1:block Ignore=3:block"},
      {"TYPE2 Spotflag=1000 Isearch=1000 Ignore=1000\n"
       "DEFAULT/TYPE2 Spotflag=28 Isearch=1 Ignore=3",
       "Spotflag=5:derived Isearch=2:derived Ignore=1000:card"},
      {"TYPE2 Idel2=2 Spotflag={5,1,25,26,27,28}", "Idel2=2"},
      {"TYPE2 Idel2=2 Spotflag={2,4,20,22,24,29,30}", "Idel2=1000"},
      {"TYPE2 Stfac=0 Level=4 Spotflag={25,26,27,28}", "Level=0 Stfac=1 Visc=0.05 Istf=2"},
      {"TYPE2 Spotflag=28 Stfac=3 Visc=0.5 Istf=1000", "Stfac=3:card Visc=0.5:card Istf=2"},
      {"TYPE2 Spotflag=28 Istf=4", "Istf=4"},
      {"TYPE2 Spotflag={24,29}", "Stfac=0"},
      {"TYPE2 Spotflag=5 Level=4", "Level=4"},
      {"TYPE2 Spotflag={20,21,22}",
       "Rupt=2 Max_N_Dist=1e20 Max_T_Dist=1e20 Alpha=0 Fscalestress=1"},
      {"TYPE2 Spotflag=20 Rupt=1 Max_N_Dist=7", "Rupt=1 Max_N_Dist=7"},
      {"TYPE2 Spotflag=20 Rupt=1 Ifiltr=1", "Alpha=1"},
      {"TYPE2 Spotflag=20 Rupt=1 Ifiltr=1 Alpha=0.25", "Alpha=0.25"},
      {"TYPE2 Spotflag=20 Rupt=1 Ifiltr=1 Alpha=1.5", "Alpha=1"},
      {"TYPE2 Spotflag=20 Rupt=1 Ifiltr=1 Alpha=-0.5", "Alpha=0"},
      {"TYPE2 Spotflag=20 Rupt=1 Ifiltr=2 Alpha=1.5", "Alpha=1.5"},
  });
}

TEST(InterfaceValues, OfType24) {
  expect_rows({
      {"TYPE24 surf_ID1=1 surf_ID2=2 Stfac=0",
       "Istf=1000:built_in Idel=1000:built_in Igap0=1000:built_in Ipen0=1000:built_in "
       "Inacti=1000:built_in Irem_i2=1:built_in Iedge=1000 Stfac=1 Tstop=1e30 VISs=0.05 "
       "Gap_max_s=1e30 Gap_max_m=1e30 Stmax=1e30 Edge_angle=0 STFAC_MDT=0 Ifiltr=0"},
      {"TYPE24 Inacti={1,3,5,6}", "Inacti=5 Istf=1000"},
      {"TYPE24 Inacti={1000,-3}", "Inacti=1000 Istf=1000"},
      {"TYPE24 Inacti=-1 Istf={0,1,2,5,12,1000}", "Inacti=-1 Istf=4:derived"},
      {"TYPE24 Inacti=-2 Istf={0,4}", "Inacti=-2 Istf=2"},
      {"TYPE24 Istf=10", "Istf=0"},
      {"TYPE24 Inacti=3 Istf=14", "Inacti=5:derived Istf=4:derived"},
      {"TYPE24\nDEFAULT/TYPE24 Inacti=3 Istf=4", "Inacti=5:block Istf=4:block"},
      {"TYPE24 surf_ID1=1 surf_ID2=2 Iedge=1", "Iedge=1 Edge_angle=135"},
      {"TYPE24 surf_ID1=1 surf_ID2=2 Iedge=2 Edge_angle=90", "Iedge=2 Edge_angle=90"},
      {"TYPE24 surf_ID1=1 surf_ID2=2 Iedge=1000", "Iedge=1000 Edge_angle=0"},
      {"TYPE24 surf_ID1=1 surf_ID2=2 Iedge=-1", "Iedge=-1 Edge_angle=135"},
      {"TYPE24 surf_ID2=2 grnd_IDs=1 Iedge=1", "Iedge=1000 Edge_angle=0"},
      {"TYPE24 Stmin=2 Stmax=7 Istf={2,3,4,5,-1,12}", "Stmin=2 Stmax=7"},
      {"TYPE24 Stmin=2 Stmax=7 Istf={0,1,1000,11}", "Stmin=0 Stmax=1e30"},
      {"TYPE24 {Istf=7,IPSTIF=1}", "IPSTIF=1 STFAC_MDT=0.1"},
      {"TYPE24 {Istf=7,IPSTIF=1} STFAC_MDT=0.5", "IPSTIF=1 STFAC_MDT=0.5"},
      {"TYPE24 IPSTIF=2", "IPSTIF=2 STFAC_MDT=0"},
      {"TYPE24 Tpressfit=3 Inacti={-1,-2}", "Tpressfit=3"},
      {"TYPE24 Tpressfit=3 Inacti=5", "Tpressfit=0"},
      {"TYPE24 Ifiltr=2", "Ifiltr=0"},
      {"TYPE24 Ifiltr=2 Xfreq=3", "Ifiltr=2"},
      {"TYPE24 Idel={1000,3,-3,5}", "Idel=1000"},
      {"TYPE24 Idel=-2", "Idel=-2"},
  });
}

TEST(InterfaceValues, OfType25) {
  expect_rows({
      {"TYPE25",
       "Istf=1000:built_in Idel=1000:built_in Iedge=1000:built_in Igap0=1000:built_in "
       "Inacti=1000:built_in Ithick=1000:built_in Igap=1 Irem_i2=1 Ishape=1 IVIS2=1 Gap_scale=1 "
       "Gap_max_s=1e30 VISs=0.05 Edge_angle=0 Stmax=1e30 THICK_S_SCALE=0"},
      {"TYPE25\nDEFAULT/TYPE25 Igap=2 Inacti=-1", "Igap=2:block Inacti=-1 Istf=4:derived"},
      {"TYPE25 Inacti=3", "Inacti=5"},
      {"TYPE25 Inacti=-5", "Inacti=1000"},
      {"TYPE25", "Inacti=-1 Istf=4", "implicit"},
      {"TYPE25 Inacti=5", "Inacti=5", "implicit"},
      {"TYPE25 Igap=3", "Igap=3 Ishape=2 %mesh_size=0.4"},
      {"TYPE25 Igap=2", "%mesh_size=0 Ishape=1"},
      {"TYPE25 Igap=5", "THICK_S_SCALE=1 THICK_M_SCALE=1"},
      {"TYPE25 IVIS2=5", "VISs=1"},
      {"TYPE25 IVIS2=5 VISs=0.5", "VISs=0.5"},
      {"TYPE25 Iedge=1", "Edge_angle=135"},
      {"TYPE25 Ithe=1", "Ithe=1 AscaleK=1", "thermal"},
      {"TYPE25", "AscaleK=0", "thermal"},
      {"TYPE25 Ithe=1", "Ithe=0"},
  });
  EXPECT_EQ(level_of(1, 2), 2);
  EXPECT_EQ(level_of(1, 1), 1);
  EXPECT_EQ(level_of(0, 2), 3);
}

/// `line` with `text` ending in `column`.
std::string with(std::string line, int column, const std::string& text) {
  if (static_cast<int>(line.size()) < column) line.resize(static_cast<std::size_t>(column), ' ');
  line.replace(static_cast<std::size_t>(column) - text.size(), text.size(), text);
  return line;
}
std::string at(int column, const std::string& text) { return with("", column, text); }

TEST(InterfaceDefaults, DefaultCardWithoutItsBlankLinesDoesNothing) {
  const std::string flags[] = {with(at(30, "4"), 50, "3"), at(90, "2"), at(40, "6"), at(50, "2")};
  std::string block = "/DEFAULT/INTER/TYPE7\n";
  for (const std::string& line : flags) block += line + "\n";
  const Row unread{"", "Istf=1000 Igap=1000 Inacti=1000 Irem_gap=1 Iform=1"};
  expect_values(block + "TYPE7", unread);
  // Text on these lines counts for nothing, comments are no lines.
  const Row read{"", "Istf=4 Irem_gap=2 Inacti=6 Iform=1"};
  expect_values("/DEFAULT/INTER/TYPE7\nmy defaults\n" + flags[0] + "\n         1\n" + flags[1] +
                    "\n# no line\n0\n" + flags[2] + "\nTYPE7",
                read);
}

TEST(InterfaceDefaults, DefaultCardFillsBlankFlags) {
  expect_rows({
      {"TYPE7\nDEFAULT/TYPE7 Istf=4 Igap=1 Ibag=1 Idel=2 Irem_gap=2 Irem_i2=1 Inacti=6 Iform=2",
       "Istf=4:block Igap=1:block Ibag=1:block Idel=2:block Irem_gap=2:block Irem_i2=1:block "
       "Inacti=6:block Iform=2:block",
       "airbag"},
      {"DEFAULT/TYPE7 Istf=4\nTYPE7", "Istf=4:block"},
      {"TYPE7 Istf=1000\nDEFAULT/TYPE7 Istf=4", "Istf=1000:card"},
      {"TYPE7\nDEFAULT/TYPE7 Irem_gap=1000 Irem_i2=1000 Iform=1000",
       "Irem_gap=1 Irem_i2=3 Iform=1:block"},
      {"TYPE7 Irem_gap=1000 Irem_i2=1000 Iform=1000\n"
       "DEFAULT/TYPE7 Irem_gap=2 Irem_i2=1 Iform=2",
       "Irem_gap=1 Irem_i2=3 Iform=1:derived"},
  });
  // Also flags that the version has no cell for.
  const Row row{"", "Irem_gap=2 Irem_i2=1", "", 110};
  expect_values("/DEFAULT/INTER/TYPE7\n\n\n\n" + with(at(90, "2"), 100, "1") + "\n\n\n\nTYPE7",
                row);
}

TEST(InterfaceDefaults, OfASecondBlockOrASubmodelAreNotTaken) {
  const Cards twice("DEFAULT/TYPE7 Istf=4\nDEFAULT/TYPE7 Istf=2\nTYPE7");
  EXPECT_EQ(twice.all.type7.at(0).Istf.value, 4);
  EXPECT_EQ(twice.all.defaults.size(), 1u);
  ASSERT_EQ(twice.found.all().size(), 1u);
  EXPECT_EQ(twice.found.all()[0].rule, RuleId::DK504);
  EXPECT_EQ(twice.found.all()[0].reference->number, 1073);
  const Cards inside("//SUBMODEL/1\nsub\n\nDEFAULT/TYPE7 Istf=4\n//ENDSUB\nTYPE7");
  EXPECT_EQ(inside.all.type7.at(0).Istf.value, 1000);
  EXPECT_TRUE(inside.found.counts().contains(RuleId::DK503));
}

TEST(InterfaceFields, HaveTheirPlaceInTheText) {
  const Cards c("TYPE7 IBCX=1 IBCZ=1\nDEFAULT/TYPE7 Inacti=6");
  EXPECT_EQ(c.deck.sources.text(c.all.type7.at(0).Inacti.span), "         6");
  EXPECT_EQ(c.deck.sources.text(c.all.type7.at(0).IBC.span), "1 1");
}

TEST(InterfaceFriction, FrictionBlockReplacesTheCard) {
  const Row row{"", "Ifric=4 Ifiltr=3 Xfreq=0.05 Fric=0.2:derived<0.9 VISF=1 C1=0.4 C2=0.01"};
  expect_values("TYPE7 Fric=0.9 Ifric=1 Xfreq=0.3 fric_ID=7\n/FRICTION/7\nlaw\n" +
                    with(with(with(at(10, "4"), 20, "3"), 40, "0.05"), 50, "1") + "\n" +
                    with(at(20, "0.4"), 40, "0.01") + "\n" + at(40, "0.2"),
                row);
}

TEST(InterfaceFriction, PairsOfPartsHaveTheirOwnValues) {
  // The first pair is orthotropic, the last one has no friction and so no damping.
  const Cards c("/FRICTION/7\nlaw\n\n\n\n" + with(with(at(10, "3"), 20, "4"), 60, "1") + "\n\n" +
                at(40, "0.1") + "\n\n" + at(40, "0.2") + "\n" + at(40, "13") + "\n" +
                at(20, "0.7") + "\n" + at(40, "0.3") + "\n" + at(40, "14") + "\n\n\n");
  const Friction* f = c.all.friction(7);
  ASSERT_NE(f, nullptr);
  ASSERT_EQ(f->pairs.size(), 3u);
  EXPECT_EQ(f->values.VISF, 0.0);
  EXPECT_EQ(f->pairs[0].grpart_ID1, 3);
  EXPECT_EQ(f->pairs[0].values.Fric, 0.1);
  EXPECT_EQ(f->pairs[0].second.Fric, 0.2);
  EXPECT_EQ(f->pairs[1].part_ID2, 13);
  EXPECT_EQ(f->pairs[1].values.C[0], 0.7);
  EXPECT_EQ(f->pairs[1].values.Fric, 0.3);
  EXPECT_EQ(f->pairs[1].values.VISF, 1.0);
  EXPECT_EQ(f->pairs[2].values.VISF, 0.0);
}

TEST(InterfaceUnits, ValuesAreInWorkingUnits) {
  // Of a deck in kg, m, s with the working units kg, mm, ms.
  const auto type7 = [](const std::string& fields) {
    const Cards c("TYPE7 " + fields + "\n/END", "", 2022,
                  "@deck\n#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n"
                  "                  kg                   m                   s\n"
                  "                  kg                  mm                  ms\n");
    return c.all.type7.at(0);
  };
  const InterType7 t = type7("Igap=2 Fscalegap=0.5 Gapmax=0.25 Stfac=2 Gapmin=0.5 Tstart=8");
  EXPECT_EQ(t.Fscalegap.value, 0.5);
  EXPECT_DOUBLE_EQ(t.Gapmax.value, 250.0);
  EXPECT_DOUBLE_EQ(t.Gapmin.value, 500.0);
  EXPECT_DOUBLE_EQ(t.Tstart.value, 8000.0);
  EXPECT_EQ(t.Stfac.value, 2.0) << "a factor, not a stiffness";
  EXPECT_DOUBLE_EQ(type7("Istf=1 Stfac=2").Stfac.value, 2e-6) << "a stiffness";
}

TEST(Interfaces, AreTakenByIdAndStayInPlaceWhenMoved) {
  Cards c("@/INTER/TYPE19/3\nTYPE7\n@/INTER/TYPE10/1\n@/INTER/LAGMUL/TYPE7/8\n@/INTER/TYPE2/2");
  ASSERT_EQ(c.all.ordered.size(), 3u) << "without ties";
  EXPECT_EQ(c.all.all.size(), 4u);
  EXPECT_EQ(c.all.ordered[0]->type, 10);
  EXPECT_EQ(c.all.ordered[1]->type, 19);
  EXPECT_EQ(c.all.ordered[2]->id, 5);
  const Interfaces moved = std::move(c.all);
  EXPECT_EQ(moved.ordered[2], &moved.type7[0]);
  static_assert(!std::is_copy_constructible_v<Interfaces>);
}

// ---- structs and schemas say the same ----------------------------------------------------------

template <class Inter>
std::set<std::string> struct_fields() {
  std::set<std::string> names;
  const Inter inter;
  inter.for_each([&](const char* name, const auto&) { names.insert(name); });
  return names;
}

TEST(InterfaceFields, DefaultCardsNameFieldsOfTheirType) {
  for (const auto& [keyword, fields] :
       {std::pair{"/DEFAULT/INTER/TYPE7", struct_fields<InterType7>()},
        {"/DEFAULT/INTER/TYPE11", struct_fields<InterType11>()},
        {"/DEFAULT/INTER/TYPE19", struct_fields<InterType19>()},
        {"/DEFAULT/INTER/TYPE24", struct_fields<InterType24>()},
        {"/DEFAULT/INTER/TYPE25", struct_fields<InterType25>()}})
    for (const CardSchema& card : SchemaSet::built_in().find(keyword)->cards)
      for (const Field& field : card.fields)
        EXPECT_TRUE(fields.contains(field.name)) << keyword << " " << field.name;
}

TEST(InterfaceTypes, NameFieldsOfTheirSchemas) {
  for (const InterfaceTraits* t : interface_types) {
    const Schema* const schema = SchemaSet::built_in().find(t->keyword);
    ASSERT_NE(schema, nullptr) << t->keyword;
    for (const InterfaceTraits::Side& side : {t->secondary, t->main}) {
      const Field* const field = schema->find_field(side.field);
      ASSERT_NE(field, nullptr) << t->keyword << ' ' << side.field;
      EXPECT_EQ(field->ref, side.refers_to) << t->keyword << ' ' << side.field;
    }
    EXPECT_TRUE(t->gap.empty() || schema->find_field(t->gap) != nullptr) << t->keyword;
  }
}

}  // namespace
}  // namespace deck
