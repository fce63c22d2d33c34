// The bulk reader against decode(): same values, same findings, whatever the lines look like, and
// the same for every number of threads.
#include "model/bulk/bulk.hpp"

#include <gmock/gmock.h>

#include <random>

#include "deck/rule_id.hpp"
#include "keyword/reading.hpp"

namespace deck {
namespace {

using namespace testing_support;
using detail::element_blocks;
using detail::node_blocks;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Bulk {
  explicit Bulk(Deck from, int threads = 1, int per_rule = 1000)
      : deck(std::move(from)), findings(per_rule) {
    for (const Block& b : deck.blocks)
      if (b.keyword == "/PART") model.part_of_id.emplace(b.id.value + deck.offset_of(b, "part"), 0);
    detail::read_nodes(deck, node_blocks(deck), model.nodes, model.node_blocks, findings, threads);
    detail::read_elements(deck, element_blocks(deck), model, findings, threads);
  }
  Deck deck;
  Model model;
  Findings findings;
};

Bulk bulk(const std::string& body, const std::string& version = "2024") {
  return Bulk(read(deck_of(body, version)));
}

std::string ids(std::initializer_list<std::int64_t> values) {
  std::string line;
  for (const std::int64_t v : values) {
    const std::string text = v == 0 ? "" : std::to_string(v);
    line += std::string(10 - text.size(), ' ') + text;
  }
  return line + "\n";
}

/// Nodes 1 … n along a space curve, so that no four of them lie in a plane.
std::string nodes(int n) {
  std::string text = "/NODE\n";
  for (int i = 1; i <= n; ++i) {
    char line[128];
    std::snprintf(line, sizeof line, "%10d%20d%20d%20d\n", i, i, i * i, i * i * i);
    text += line;
  }
  return text;
}

std::vector<std::int64_t> corner_ids(const Model& m, const Elements& f, std::size_t e) {
  std::vector<std::int64_t> all;
  for (int k = 0; k < f.width; ++k) all.push_back(m.node_id(f.of(e)[k]));
  return all;
}

// ---- nodes --------------------------------------------------------------------------------------

TEST(BulkNodes, KeepDeckOrderAcrossBlocksCommentsAndIncludes) {
  const Bulk b = bulk("/NODE\n" + ids({7}) + "# c\n$ c\n" + ids({3}) +
                      "/PART/1\nt\n/NODE\n/NODE\n" + ids({9}));
  EXPECT_THAT(b.model.nodes.id, ElementsAre(7, 3, 9));
  ASSERT_EQ(b.model.node_blocks.size(), 3u);
  EXPECT_EQ(b.model.node_blocks[0].count, 2u);
  EXPECT_EQ(b.model.node_blocks[1].count, 0u);
  EXPECT_EQ(b.model.node_blocks[2].first, 2u);
  EXPECT_EQ(b.model.nodes.map.find(9), 2u);
  EXPECT_EQ(b.model.nodes.map.find(8), no_index);
  EXPECT_TRUE(b.findings.all().empty());
}

TEST(BulkNodes, TakeUnitsAndSubmodelOffsets) {
  const std::string line =
      "         1                 1.5                 -2.                 3.\n";
  const std::string unit = "                  kg                   m                   s\n";
  const Bulk b = bulk("/UNIT/5\nt\n" + unit + "/NODE/5\n" + line + "//SUBMODEL/1\n\n" +
                      ids({100, 200}) + "/NODE\n" + line + "//ENDSUB\n/NODE/6\n" + ids({2}));
  EXPECT_THAT(b.model.nodes.id, ElementsAre(1, 201, 2));
  EXPECT_DOUBLE_EQ(b.model.nodes.x[0], 1500);
  EXPECT_EQ(b.model.nodes.x[1], 1.5);
  EXPECT_EQ(b.model.nodes.y[1], -2);
  EXPECT_EQ(b.model.nodes.z[1], 3);
  EXPECT_TRUE(b.findings.all().empty())
      << "the unit system 6 that is missing is the model's finding";
}

TEST(BulkNodes, BlankLinesAreNodesOfIdZeroAndBadIdsAreNamed) {
  const Bulk b = bulk("/NODE\n" + ids({1}) + "\n   \n" + ids({-4}) + "                  1.0\n");
  EXPECT_THAT(b.model.nodes.id, ElementsAre(1, 0, 0, -4, 0));
  EXPECT_EQ(count(b.findings, RuleId::DK036), 2u);
  EXPECT_EQ(count(b.findings, RuleId::DK037), 2u);
  EXPECT_EQ(b.deck.sources.position(first(b.findings, RuleId::DK036)->span).line, 9u);
}

TEST(BulkNodes, TwoLinesTogetherAsLongAsTheOneBeforeStayTwo) {
  const std::string longer =
      "         1                 1.5                 -2.                 3.\n";
  const std::string shorter = "         2                 2.5\n";
  const std::string rest = "         3                 3.5    -4.5\n";
  ASSERT_EQ(shorter.size() + rest.size(), longer.size());
  const Bulk b = bulk("/NODE\n" + longer + shorter + rest + longer);
  EXPECT_THAT(b.model.nodes.id, ElementsAre(1, 2, 3, 1));
  EXPECT_THAT(b.model.nodes.x, ElementsAre(1.5, 2.5, 3.5, 1.5));
  EXPECT_THAT(b.model.nodes.y, ElementsAre(-2, 0, -4.5, -2));
  EXPECT_TRUE(b.findings.all().empty());
}

TEST(BulkNodes, TheLastLineNeedsNoNewline) {
  auto deck = read_deck_text("x", banner + begin() + "/NODE\n         5                  2.",
                             SchemaSet::built_in());
  const Bulk b(std::move(*deck));
  EXPECT_THAT(b.model.nodes.id, ElementsAre(5));
  EXPECT_THAT(b.model.nodes.x, ElementsAre(2));
}

// ---- elements -----------------------------------------------------------------------------------

TEST(BulkElements, EveryFamilyTakesItsNodes) {
  const Bulk b =
      bulk(nodes(9) + "/PART/4\nt\n/SHELL/4\n" + ids({1, 1, 2, 3, 4}) + "/SH3N/4\n" +
           ids({1, 1, 2, 3}) + "/TRUSS/4\n" + ids({1, 5, 6}) + "/BEAM/5\n" + ids({1, 5, 6, 7}) +
           ids({2, 5, 6}) + "/SPRING/4\n" + ids({1, 5, 6}) + "/QUAD/4\n" + ids({1, 1, 2, 3, 4}) +
           "/TRIA/4\n" + ids({1, 1, 2, 3}) + "/SHELL/4\n" + ids({2, 4, 3, 2, 1}));
  const Model& m = b.model;
  EXPECT_THAT(corner_ids(m, m.shell4, 0), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(corner_ids(m, m.shell4, 1), ElementsAre(4, 3, 2, 1));
  EXPECT_THAT(corner_ids(m, m.shell3, 0), ElementsAre(1, 2, 3));
  EXPECT_THAT(corner_ids(m, m.truss, 0), ElementsAre(5, 6));
  EXPECT_THAT(corner_ids(m, m.beam, 0), ElementsAre(5, 6, 7));
  EXPECT_THAT(corner_ids(m, m.beam, 1), ElementsAre(5, 6, 0));
  EXPECT_THAT(corner_ids(m, m.spring, 0), ElementsAre(5, 6, 0, 0, 0, 0));
  EXPECT_THAT(corner_ids(m, m.quad, 0), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(corner_ids(m, m.tria, 0), ElementsAre(1, 2, 3));
  EXPECT_EQ(m.shell4.part[0], 0u);
  EXPECT_EQ(m.beam.part[0], no_index);
  EXPECT_TRUE(m.shell4.thickness.empty());
  ASSERT_EQ(m.element_blocks.size(), 8u);
  EXPECT_EQ(m.shell4.block[1], 6u);  // /BEAM/5 comes after the others
  EXPECT_EQ(m.element_blocks[6].first, 1u);
  EXPECT_EQ(m.element_blocks[6].count, 1u);
  EXPECT_TRUE(b.findings.all().empty());
}

TEST(BulkElements, SolidsHaveEightSlots) {
  const Bulk b =
      bulk(nodes(20) + "/BRICK/1\n" + ids({1, 1, 2, 3, 4, 5, 6, 7, 8}) + ids({2, 1, 2, 3, 4}) +
           ids({3, 1, 2, 3, 4, 5, 6}) + "/TETRA4/1\n" + ids({4, 1, 2, 3, 4}) + "/PENTA6/1\n" +
           ids({5, 1, 2, 3, 4, 5, 6}) + "/TETRA10/1\n" + ids({6}) +
           ids({1, 2, 3, 4, 5, 6, 7, 8, 9, 0}) + "/BRIC20/1\n" + ids({7, 1, 2, 3, 4, 5, 6, 7, 8}) +
           ids({9, 10, 11, 12, 13, 14, 15, 16}) + ids({17, 18, 19, 20}) + "/SHEL16/1\n" +
           ids({8, 1, 2, 3, 4, 5, 6, 7, 8}) + ids({9, 10, 11, 12}) + ids({13, 14, 15, 16}));
  const Model& m = b.model;
  ASSERT_EQ(m.solid8.size(), 8u);
  const auto corners = [&](std::size_t e) { return corner_ids(m, m.solid8, e); };
  EXPECT_THAT(corners(0), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(corners(1), ElementsAre(1, 1, 2, 2, 4, 3, 3, 4));
  EXPECT_THAT(corners(2), ElementsAre(1, 2, 3, 1, 4, 5, 6, 4));
  EXPECT_EQ(corners(3), corners(1));
  EXPECT_EQ(corners(4), corners(2));
  EXPECT_EQ(corners(5), corners(1));
  EXPECT_EQ(corners(6), corners(0));
  EXPECT_THAT(m.solid8.shape,
              ElementsAre(SolidShape::brick8, SolidShape::tetra4, SolidShape::penta6,
                          SolidShape::tetra4, SolidShape::penta6, SolidShape::tetra10,
                          SolidShape::brick20, SolidShape::thick16));
  EXPECT_EQ(m.solid8.extra[0], no_index);
  const auto mid = [&](std::size_t e, std::size_t k) {
    return m.node_id(m.solid8.extra_nodes[m.solid8.extra[e] + k]);
  };
  EXPECT_EQ(mid(5, 0), 5);
  EXPECT_EQ(mid(5, 5), 0);
  EXPECT_EQ(mid(6, 0), 9);
  EXPECT_EQ(mid(6, 11), 20);
  EXPECT_EQ(mid(7, 7), 16);
  EXPECT_EQ(m.solid8.extra_nodes.size(), 6u + 12u + 8u);
  EXPECT_TRUE(b.findings.all().empty());
}

TEST(BulkElements, UnknownNodesAreErrorsAtTheirColumns) {
  const Bulk b =
      bulk(nodes(4) + "/SHELL/1\n" + ids({1, 1, 2, 99, 4}) + ids({2, 1, 2, 3}) + "/TETRA10/1\n" +
           ids({3}) + ids({1, 2, 3, 77, 88}) + "/BRICK/1\n" + ids({4, 1, 2, 3, 4, 0, 0, 0, 4}));
  EXPECT_EQ(b.model.shell4.nodes[2], no_index);
  EXPECT_EQ(count(b.findings, RuleId::DK101), 2u + 2u + 3u);
  const Finding& f = *first(b.findings, RuleId::DK101);
  EXPECT_EQ(f.reference->number, 78);
  EXPECT_EQ(b.deck.sources.position(f.span).column, 31u);
  EXPECT_EQ(f.id, 1);
  EXPECT_THAT(f.message, HasSubstr("/SHELL 1: N3 names node 99"));
  EXPECT_THAT(b.findings.all()[1].help, HasSubstr("Write N4 = N3"));
  EXPECT_EQ(b.findings.all()[2].id, 3);
}

TEST(BulkElements, TakeSubmodelOffsetsOfTheirKind) {
  const Bulk b = bulk("//SUBMODEL/1\n\n" + ids({1000, 200, 300, 400}) + "/NODE\n" + ids({1}) +
                      ids({2}) + "/PART/7\nt\n/TRUSS/7\n" + ids({5, 1, 2}) + "//ENDSUB\n");
  EXPECT_THAT(b.model.truss.id, ElementsAre(305));
  EXPECT_THAT(corner_ids(b.model, b.model.truss, 0), ElementsAre(201, 202));
  EXPECT_EQ(b.model.truss.part[0], 0u);
}

TEST(BulkElements, OwnThicknessIsKeptInWorkingUnits) {
  const std::string thick = ids({2, 1, 2, 3, 4});
  const std::string line = thick.substr(0, 50) + std::string(48, ' ') + "2.";
  const std::string unit = "                  kg                   m                   s\n";
  const Bulk b = bulk("/UNIT/5\nt\n" + unit + nodes(4) + "/SHELL/1\n" + ids({1, 1, 2, 3, 4}) +
                      line + "\n/SHELL/1/5\n" + line + "\n/SH3N/1\n" + ids({3, 1, 2, 3}));
  ASSERT_EQ(b.model.shell4.thickness.size(), 3u);
  EXPECT_EQ(b.model.shell4.thickness[0], 0);
  EXPECT_EQ(b.model.shell4.thickness[1], 2);
  EXPECT_DOUBLE_EQ(b.model.shell4.thickness[2], 2000);
  EXPECT_TRUE(b.model.shell3.thickness.empty());
  EXPECT_EQ(count(b.findings, RuleId::DK039), 1u);
}

TEST(BulkElements, TriangleThicknessIsWhatStandsInColumns91To100) {
  const std::string head = ids({1, 1, 2, 3}).substr(0, 40) + std::string(40, ' ');
  const auto line = [&](const std::string& behind_80) { return head + behind_80 + "\n"; };
  const Bulk b = bulk(nodes(3) + "/SH3N/1\n" + line(std::string(17, ' ') + "1.5") + line("1.25") +
                      line("     1.2500000000000") + line("          2.5") +
                      line("      45.0       2.5") + line("      45.0"));  // the angle before it
  EXPECT_THAT(b.model.shell3.thickness, ElementsAre(1.5, 0.0, 0.0, 2.5, 2.5, 0.0));
  EXPECT_EQ(count(b.findings, RuleId::DK038), 2u);
  EXPECT_EQ(b.deck.sources.position(first(b.findings, RuleId::DK038)->span).column, 81u);
}

TEST(BulkElements, AnUnfinishedElementAtTheEndOfABlockIsLeftOutAndNamed) {
  const Bulk b = bulk(nodes(4) + "/TETRA10/1\n" + ids({1}) + ids({1, 2, 3, 4}) + ids({2}) +
                      "/TETRA4/1\n" + ids({3, 1, 2, 3, 4}));
  EXPECT_THAT(b.model.solid8.id, ElementsAre(1, 3));
  EXPECT_EQ(count(b.findings, RuleId::DK029), 1u);
}

TEST(BulkElements, ItemsMayCrossIncludesButNotBlocks) {
  const Bulk b = bulk(nodes(4) + "/TETRA10/1\n" + ids({1}) + "#include /no/such/file\n# c\n" +
                      ids({1, 2, 3, 4}));
  EXPECT_THAT(b.model.solid8.id, ElementsAre(1));
}

// ---- against decode() ---------------------------------------------------------------------------

std::string random_line(std::mt19937_64& random, int node_count) {
  static const char* const odd[] = {"abc",    "1.5",    "1.5.2", "nan",         "1e999",
                                    "1e-999", "4e-320", "12x",   "-7",          "0",
                                    "1.5-3",  "2d3",    "+4",    "99999999999", "3000000000",
                                    ".",      "-",      "1 2",   "&P",          "&NONE"};
  std::string line(random() % 8 == 0 ? 120 : 100, ' ');
  for (std::size_t c = 0; c < 10; ++c) {
    std::string text = std::to_string(random() % static_cast<std::uint64_t>(node_count) + 1);
    if (random() % 12 == 0) text = odd[random() % std::size(odd)];
    if (random() % 9 == 0) text.clear();
    const std::size_t at =
        10 * c + (random() % 20 ? 10 - std::min<std::size_t>(text.size(), 10) : 0);
    line.replace(at, std::min(text.size(), line.size() - at), text);
  }
  if (random() % 30 == 0) line[random() % line.size()] = '\t';
  if (random() % 30 == 0) line[random() % line.size()] = '\0';
  if (random() % 30 == 0) line[random() % line.size()] = 'Z';
  if (random() % 20 == 0) line[random() % line.size()] = ',';
  if (random() % 15 == 0) line.resize(random() % line.size());
  if (random() % 40 == 0) line.clear();
  if (random() % 40 == 0) line = "# comment";
  if (random() % 10 == 0) line += '\r';
  return line + "\n";
}

std::string random_deck(std::uint64_t seed, int items, bool wrong_nodes) {
  std::mt19937_64 random(seed);
  const char* const keywords[] = {"/NODE",     "/SHELL/1",   "/SH3N/1",   "/BRICK/1",  "/TETRA4/2",
                                  "/PENTA6/2", "/TETRA10/1", "/BRIC20/1", "/SHEL16/1", "/BEAM/1",
                                  "/SPRING/1", "/TRUSS/1",   "/QUAD/1",   "/TRIA/1"};
  std::string text = "/PARAMETER/GLOBAL/INTEGER/1\nt\nP                 3\n" + nodes(50);
  for (const char* keyword : keywords) {
    text += std::string(keyword) + "\n";
    for (int i = 0; i < items; ++i) text += random_line(random, wrong_nodes ? 60 : 50);
  }
  return text;
}

/// Reads the blocks by decode() alone, one line after the other.
struct Slow {
  std::vector<std::int64_t> node_id, element_id, element_cells;
  std::vector<double> x, y, z, shell_thickness;
  Findings findings{1 << 30};
};

Slow by_decode(const Deck& deck) {
  Slow out;
  for (const Block& block : deck.blocks) {
    if (block.schema == nullptr || !block.schema->bulk) continue;
    LineCursor cursor(deck.sources, block);
    const auto& cards = block.schema->cards;
    std::vector<const CardSchema*> active;
    for (const CardSchema& card : cards)
      if (card.in_version(block.version)) active.push_back(&card);
    std::size_t k = 0;
    std::int64_t id = 0;
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      const DecodedCard card = decode_line(deck, block, *active[k], line, &out.findings);
      if (k == 0) id = card.cells[0].integer;
      if (++k < active.size()) continue;
      k = 0;
      (block.keyword == "/NODE" ? out.node_id : out.element_id).push_back(id);
      if (block.keyword == "/NODE") {
        out.x.push_back(card.cells[1].real);
        out.y.push_back(card.cells[2].real);
        out.z.push_back(card.cells[3].real);
      } else {
        for (std::size_t c = 1; c < card.cells.size(); ++c)
          out.element_cells.push_back(card.cells[c].integer);
        if (block.keyword == "/SHELL") out.shell_thickness.push_back(card.cells.back().real);
      }
    }
  }
  return out;
}

std::uint64_t bits(double v) { return std::bit_cast<std::uint64_t>(v); }

/// Nodes, 4-node shells on nodes 1 to 50 and findings of the bulk reader against decode().
void expect_as_decode(const std::string& body) {
  const std::string text = deck_of(body);
  const Deck deck = read(text);
  const Slow slow = by_decode(deck);
  const Bulk fast(read(text), 1, 1 << 30);
  const Nodes& nodes = fast.model.nodes;
  ASSERT_EQ(nodes.id, slow.node_id);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    ASSERT_EQ(bits(nodes.x[i]), bits(slow.x[i])) << i;
    ASSERT_EQ(bits(nodes.y[i]), bits(slow.y[i])) << i;
    ASSERT_EQ(bits(nodes.z[i]), bits(slow.z[i])) << i;
  }
  std::size_t elements = 0;
  for (const Elements* f :
       {&fast.model.shell4, &fast.model.shell3, &fast.model.solid8, &fast.model.quad,
        &fast.model.tria, &fast.model.truss, &fast.model.beam, &fast.model.spring})
    elements += f->size();
  EXPECT_EQ(elements, slow.element_id.size());
  const Elements& shells = fast.model.shell4;
  ASSERT_TRUE(shells.thickness.empty() || shells.thickness.size() == slow.shell_thickness.size());
  for (std::size_t e = 0; e < slow.shell_thickness.size(); ++e)
    ASSERT_EQ(bits(shells.thickness.empty() ? 0 : shells.thickness[e]),
              bits(slow.shell_thickness[e]))
        << e;
  if (nodes.size() == 50 && shells.size() == slow.element_id.size()) {
    const std::size_t cells = slow.element_cells.size() / shells.size();
    for (std::size_t e = 0; e < shells.size(); ++e)
      for (std::size_t n = 0; n < 4; ++n) {
        const std::int64_t id = slow.element_cells[e * cells + n];
        ASSERT_EQ(shells.of(e)[n], id >= 1 && id <= 50 ? static_cast<NodeIndex>(id - 1) : no_index)
            << e;
      }
  }
  for (const auto& [rule, n] : slow.findings.counts())
    EXPECT_EQ(count(fast.findings, rule), n) << id_text(rule);
  const auto messages = [](const Deck& of, const Findings& findings) {
    std::vector<std::string> out;  // of the rules that both have
    for (const Finding& d : findings.all())
      if (d.rule < RuleId::DK029) out.push_back(of.sources.where(d.span) + d.message);
    std::sort(out.begin(), out.end());
    return out;
  };
  EXPECT_EQ(messages(deck, slow.findings), messages(fast.deck, fast.findings));
}

TEST(BulkAgainstDecode, ValuesAndFindingsAreTheSame) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    expect_as_decode(random_deck(seed, 60, false));
  }
}

/// Ids of ten columns, reals of twenty, as programs write them; some lines with other characters.
std::string nearly_even_line(std::mt19937_64& random, std::size_t ids, std::size_t reals,
                             std::uint64_t largest) {
  std::string line;
  for (std::size_t i = 0; i < ids; ++i) {
    const std::string id = std::to_string(random() % largest + 1);
    line += std::string(10 - id.size(), ' ') + id;
  }
  for (std::size_t i = 0; i < reals; ++i) {
    const std::uint64_t size[] = {10, 100000, 10000000};
    char cell[64];
    std::snprintf(cell, sizeof cell, "%20.*f", static_cast<int>(random() % 8),
                  (static_cast<double>(random() % 2000001) / 1e6 - 1) *
                      static_cast<double>(size[random() % 3]));
    line += cell;
  }
  if (random() % 3 == 0) {
    constexpr std::string_view odd("  0019-+.eEd/:,;\t\r\n\0#$&\x80\xb0\xff", 26);
    for (std::size_t n = random() % 3; n < 3; ++n)
      line[random() % line.size()] = odd[random() % odd.size()];
  }
  if (random() % 40 == 0) line.resize(random() % line.size());
  return line + (random() % 40 == 0 ? "  \r\n" : "\n");
}

TEST(BulkAgainstDecode, LinesAsLongAsTheOneBeforeAreTakenByColumnsOnlyIfTheyAreEven) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    std::string body = "/NODE\n";
    for (int i = 0; i < 200; ++i)
      body += nearly_even_line(random, 1, 3, random() % 2 ? 99999999 : 9999999999);
    for (const char* keyword : {"/SHELL/1\n", "/SHELL/2\n", "/TRUSS/1\n", "/SH3N/1\n"}) {
      const std::size_t ids = keyword[1] == 'T' ? 3 : keyword[3] == '3' ? 4 : 5;
      body += keyword;
      for (int i = 0; i < 100; ++i) body += nearly_even_line(random, ids, 0, 99999999);
    }
    SCOPED_TRACE(seed);
    expect_as_decode(body);
    std::string shells = nodes(50) + "/SHELL/1\n";
    for (int i = 0; i < 300; ++i) shells += nearly_even_line(random, 5, 0, 50);
    expect_as_decode(shells);
  }
}

TEST(BulkElements, CellsBehindTheEndOfALineAreThoseOfNoOtherLine) {
  // A brick as long as the tetrahedron before it has four nodes, too.
  const std::string brick = ids({1, 1, 2, 3, 4, 5, 6, 7, 8}), tetra = ids({2, 1, 2, 3, 5});
  const Bulk solids = bulk(nodes(8) + "/BRICK/1\n" + brick + brick + "/TETRA4/1\n" + tetra + tetra +
                           "/BRICK/1\n" + tetra);
  ASSERT_EQ(solids.model.solid8.size(), 5u);
  EXPECT_EQ(solids.model.solid8.shape[0], SolidShape::brick8);
  EXPECT_EQ(solids.model.solid8.shape[4], SolidShape::tetra4);
}

TEST(BulkElements, NodesAreFoundHoweverTheirIdsAreSpread) {
  for (const std::int64_t step : {1, 2, 1000000}) {
    for (const bool twice : {false, true}) {
      std::string body = "/NODE\n";
      for (std::int64_t i = 0; i < 20; ++i) body += ids({5 + i * step});
      if (twice) body += ids({5 + 3 * step}) + ids({5 + 20 * step});
      body += "/TRUSS/1\n";
      for (std::int64_t id = 3; id < 30; ++id) body += ids({id, 5 + (id - 4) * step, 5 + 4 * step});
      const Bulk b = bulk(body);
      const Nodes& nodes = b.model.nodes;
      ASSERT_EQ(b.model.truss.size(), 27u);
      for (std::size_t e = 0; e < 27; ++e) {
        const std::int64_t id = 5 + (static_cast<std::int64_t>(e) - 1) * step;
        const auto at = std::find(nodes.id.begin(), nodes.id.end(), id);
        EXPECT_EQ(b.model.truss.of(e)[0], at == nodes.id.end() || id <= 0
                                              ? no_index
                                              : static_cast<NodeIndex>(at - nodes.id.begin()))
            << step << ' ' << twice << ' ' << e;
        EXPECT_EQ(b.model.truss.of(e)[1], 4u);
      }
    }
  }
  // Of two nodes of one id it is the first, even if the other stands where counting ends up.
  const Bulk twice =
      bulk("/NODE\n" + ids({5}) + ids({7}) + ids({7}) + "/TRUSS/1\n" + ids({1, 5, 7}));
  EXPECT_EQ(twice.model.truss.of(0)[1], 1u);
  // The offset of a submodel makes no id of what is none.
  const Bulk shifted =
      bulk("/NODE\n" + ids({99}) + ids({100}) + "//SUBMODEL/1\n\n" + ids({100, 100}) + "/NODE\n" +
           ids({1}) + "/TRUSS/1\n" + ids({1, 0, 1}) + ids({2, -1, 1}) + "//ENDSUB\n");
  ASSERT_EQ(shifted.model.truss.size(), 2u);
  for (const std::size_t e : {0, 1}) {
    EXPECT_EQ(shifted.model.truss.of(e)[0], no_index);
    EXPECT_EQ(shifted.model.truss.of(e)[1], 2u);
  }
}

TEST(BulkAgainstDecode, CountsDoNotDependOnHowManyMessagesAreKept) {
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    const std::string text = deck_of(random_deck(seed, 60, true));
    const Bulk all(read(text), 1, 1 << 30), few(read(text), 1, 3), none(read(text), 1, 0);
    EXPECT_GT(count(all.findings, RuleId::DK101), 10u);
    EXPECT_EQ(all.findings.counts(), few.findings.counts());
    EXPECT_EQ(all.findings.counts(), none.findings.counts());
    EXPECT_TRUE(none.findings.all().empty());
    // Kept are the first ones of every rule.
    std::map<RuleId, int> kept;
    std::size_t next = 0;
    for (const Finding& d : all.findings.all()) {
      if (kept[d.rule]++ >= 3) continue;
      ASSERT_LT(next, few.findings.all().size());
      EXPECT_EQ(d.message, few.findings.all()[next++].message);
    }
  }
}

/// Equal bit by bit: a NaN of a cell is equal to itself.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return bits(x) == bits(y); });
}

bool same(const Elements& a, const Elements& b) {
  return a.id == b.id && a.part == b.part && a.nodes == b.nodes && same(a.thickness, b.thickness) &&
         a.shape == b.shape && a.extra == b.extra && a.extra_nodes == b.extra_nodes &&
         a.block == b.block && a.width == b.width;
}

TEST(BulkThreads, GiveTheSameArraysAndFindings) {
  const std::string text = deck_of(random_deck(5, 4000, true));
  const Bulk one(read(text), 1, 200);
  for (const int threads : {2, 3, 8}) {
    const Bulk many(read(text), threads, 200);
    EXPECT_EQ(one.model.nodes.id, many.model.nodes.id);
    EXPECT_TRUE(same(one.model.nodes.x, many.model.nodes.x));
    for (const auto family : {&Model::shell4, &Model::shell3, &Model::solid8, &Model::spring})
      EXPECT_TRUE(same(one.model.*family, many.model.*family));
    for (std::size_t i = 0; i < one.model.element_blocks.size(); ++i)
      EXPECT_EQ(std::pair(one.model.element_blocks[i].first, one.model.element_blocks[i].count),
                std::pair(many.model.element_blocks[i].first, many.model.element_blocks[i].count));
    ASSERT_EQ(one.findings.counts(), many.findings.counts());
    for (std::size_t i = 0; i < one.findings.all().size(); ++i)
      EXPECT_EQ(one.findings.all()[i].message, many.findings.all()[i].message);
  }
}

TEST(BulkChunks, MidNodesStayWithTheirElementsOverManyChunks) {
  // Some megabytes: tetrahedra of ten nodes between hexahedra, which have none.
  std::string text = nodes(20);
  const auto tetras = [&](int from, int count) {
    text += "/TETRA10/1\n";
    for (int e = from; e < from + count; ++e)
      text += ids({e}) + ids({1, 2, 3, 4, 5 + e % 7, 6, 7, 8, 9, 10 + e % 5});
  };
  const auto bricks = [&](int from, int count) {
    text += "/BRICK/1\n";
    for (int e = from; e < from + count; ++e) text += ids({e, 1, 2, 3, 4, 5, 6, 7, 8});
  };
  bricks(1, 5000);
  tetras(5001, 6000);
  bricks(11001, 5000);
  tetras(16001, 4000);
  for (const int threads : {1, 3}) {
    const Bulk b(read(deck_of(text)), threads);
    const Elements& solids = b.model.solid8;
    ASSERT_EQ(solids.size(), 20000u);
    std::uint32_t wrong = 0, place = 0;
    for (std::uint32_t e = 0; e < solids.size(); ++e) {
      const auto id = static_cast<std::int64_t>(e) + 1;
      const bool tetra = solids.shape[e] == SolidShape::tetra10;
      wrong += solids.id[e] != id || solids.extra[e] != (tetra ? place : no_index) ? 1 : 0;
      if (!tetra) continue;
      const NodeIndex* mid = solids.extra_nodes.data() + solids.extra[e];
      wrong += b.model.node_id(mid[0]) != 5 + id % 7 || b.model.node_id(mid[5]) != 10 + id % 5;
      place += 6;
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(place, 60000u);
    EXPECT_EQ(solids.extra_nodes.size(), 60000u);
  }
}

TEST(BulkChunks, CutsNeverSplitALineOrAnItem) {
  const Deck deck = read(deck_of(random_deck(9, 300, false)));
  const auto blocks = element_blocks(deck);
  auto plans = detail::plan_blocks(deck, blocks);
  for (auto& plan : plans) plan.format = *detail::element_format(*plan.block);
  for (const std::uint64_t target : {1u, 100u, 1000u, 7777u, 1000000u}) {
    std::uint64_t bytes = 0, expected = 0;
    for (const Block* b : blocks)
      for (const FilePiece& p : b->body) expected += p.end - p.begin;
    for (const detail::Chunk& chunk : detail::cut_chunks(deck, plans, target)) {
      for (const detail::TextSegment& s : chunk.segments) {
        bytes += s.end - s.begin;
        EXPECT_EQ(deck.sources[s.file].bytes()[s.end - 1], '\n');
        EXPECT_EQ(plans[s.plan].format.kind, chunk.kind);
      }
    }
    EXPECT_EQ(bytes, expected) << target;
  }
}

// ---- orientation --------------------------------------------------------------------------------

std::string unit_cube() {
  const int at[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::string text = "/NODE\n";
  for (int i = 0; i < 8; ++i) {
    char line[128];
    std::snprintf(line, sizeof line, "%10d%20d%20d%20d\n", i + 1, at[i][0], at[i][1], at[i][2]);
    text += line;
  }
  return text;
}

TEST(OrientSolids, NegativeVolumesAreTurnedAsTheSolverDoes) {
  Bulk b = bulk(unit_cube() + "/BRICK/1\n" + ids({1, 1, 2, 3, 4, 5, 6, 7, 8}) +
                ids({2, 5, 6, 7, 8, 1, 2, 3, 4}) + "/PENTA6/1\n" + ids({3, 1, 2, 4, 5, 6, 8}) +
                ids({4, 5, 6, 8, 1, 2, 4}));
  EXPECT_EQ(detail::orient_solids(b.model), 1u);
  const auto corners = [&](std::size_t e) { return corner_ids(b.model, b.model.solid8, e); };
  EXPECT_THAT(corners(0), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(corners(1), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(corners(2), ElementsAre(1, 2, 4, 1, 5, 6, 8, 5));
  // A pentahedron stays as it is written.
  EXPECT_THAT(corners(3), ElementsAre(5, 6, 8, 5, 1, 2, 4, 1));
  EXPECT_EQ(detail::orient_solids(b.model), 0u);
}

TEST(OrientSolids, TetrasExchangeTheSecondAndFourthNodeWithTheirMidNodes) {
  // Mid-side nodes 9 … 14 lie on the edges 1-2, 2-3, 3-1, 1-4, 2-4, 3-4 of the card's numbering.
  std::string mids = "/NODE\n";
  for (int i = 9; i <= 14; ++i) mids += ids({i});
  Bulk b = bulk(unit_cube() + mids + "/TETRA4/1\n" + ids({1, 1, 2, 4, 5}) + ids({2, 1, 5, 4, 2}) +
                "/TETRA10/1\n" + ids({3}) + ids({1, 2, 4, 5, 9, 10, 11, 12, 13, 14}));
  EXPECT_EQ(detail::orient_solids(b.model), 2u);
  const auto corners = [&](std::size_t e) { return corner_ids(b.model, b.model.solid8, e); };
  // Stored 1 1 2 2 4 3 3 4 of (1, 5, 4, 2): the faces' normals point outward.
  EXPECT_THAT(corners(0), ElementsAre(1, 1, 5, 5, 2, 4, 4, 2));
  EXPECT_EQ(corners(1), corners(0));
  EXPECT_EQ(corners(2), corners(0));
  std::vector<std::int64_t> mid;
  for (const NodeIndex n : b.model.solid8.extra_nodes) mid.push_back(b.model.node_id(n));
  // 1-2 and 1-4 change places, 2-3 and 3-4 do; 3-1 and 2-4 stay.
  EXPECT_THAT(mid, ElementsAre(12, 14, 11, 9, 13, 10));
}

TEST(OrientSolids, FarFromTheOriginOrWithMissingNodesNothingChanges) {
  Bulk b = bulk(unit_cube() + "/BRICK/1\n" + ids({1, 1, 2, 3, 4, 5, 6, 7, 8}) +
                ids({2, 5, 6, 7, 8, 1, 2, 3, 99}));
  for (double& x : b.model.nodes.x) x += 1e8;
  for (double& y : b.model.nodes.y) y -= 1e9;
  EXPECT_EQ(detail::orient_solids(b.model), 0u);
}

// ---- id map -------------------------------------------------------------------------------------

/// A map of these ids against std::map, asked for `asked` too.
void expect_map(const std::vector<std::int64_t>& all, const std::vector<std::int64_t>& asked) {
  std::map<std::int64_t, std::uint32_t> expected;
  std::vector<std::uint32_t> duplicates;
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (!expected.emplace(all[i], i).second) duplicates.push_back(i);
  IdMap map;
  map.build(all);
  EXPECT_EQ(map.duplicates(), duplicates);
  for (const auto* ids : {&all, &asked})
    for (const std::int64_t id : *ids) {
      const auto it = expected.find(id);
      ASSERT_EQ(map.find(id), it == expected.end() ? no_index : it->second) << id;
    }
}

TEST(IdMap, FindsEveryIdHoweverTheyAreSpread) {
  std::mt19937_64 random(4);
  for (const std::int64_t spread : {1, 3, 1000, 1000000000}) {
    std::vector<std::int64_t> all, asked;
    for (int i = 0; i < 2000; ++i) {
      all.push_back(static_cast<std::int64_t>(random() % 2000) * spread - 5);
      asked.push_back(static_cast<std::int64_t>(random()));
    }
    expect_map(all, asked);
  }
  // Of several files, as they come, not as they count; some meet, and one repeats ids of another.
  std::vector<std::int64_t> all, asked;
  for (const std::int64_t first : {15000000LL, 1LL, -70000LL, 2000LL, 900000000000LL, 15000500LL})
    for (std::int64_t k = 0; k < 2000; ++k)
      if (random() % 4 != 0) all.push_back(first + k);
  for (const std::int64_t first : {15000000LL, 0LL, -70000LL, 900000000000LL, 7000000LL})
    for (std::int64_t id = first - 600; id < first + 5000; ++id) asked.push_back(id);
  expect_map(all, asked);
}

TEST(IdMap, FindsIdsThatCountUpAndThoseThatNearlyDo) {
  for (const std::int64_t first : {std::int64_t{-3}, std::int64_t{1}, std::int64_t{1} << 40}) {
    std::vector<std::int64_t> ids(3000);
    std::iota(ids.begin(), ids.end(), first);
    expect_map(ids, {first - 1, first + 3000, first - 3000, std::int64_t{-4}});
    for (const std::size_t at : {std::size_t{1}, std::size_t{1500}, std::size_t{2999}}) {
      std::vector<std::int64_t> twice = ids;  // one comes again, where another stood
      twice[at] = first;
      expect_map(twice, {ids[at]});
    }
  }
}

TEST(IdMap, HandlesTheEndsOfTheRange) {
  constexpr std::int64_t low = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t high = std::numeric_limits<std::int64_t>::max();
  const std::vector<std::vector<std::int64_t>> sets{{}, {high}, {low, high, 0}, {high, high - 1}};
  for (const auto& ids : sets) expect_map(ids, {low, high, 0, 1, -1});
}

}  // namespace
}  // namespace deck
