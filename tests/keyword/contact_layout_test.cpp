// Layouts of contact keywords: number of lines, dimensions of friction coefficients.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include "deck/keyword.hpp"

namespace deck {
namespace {

using ::testing::ElementsAre;

constexpr int all_versions[] = {51,   90,   100,  110,  120,  130,  140,  2017, 2018,
                                2019, 2020, 2021, 2022, 2023, 2024, 2025, 2026};
std::vector<int> versions_from(int first) {
  std::vector<int> versions;
  for (const int version : all_versions)
    if (version >= first) versions.push_back(version);
  return versions;
}

using Values = std::map<std::string, std::int64_t>;

const Schema& schema(std::string_view keyword) {
  const auto* found = SchemaSet::built_in().find(keyword);
  if (!found) throw std::runtime_error("no schema " + std::string(keyword));
  return *found;
}

bool holds(const std::vector<Condition>& conditions, const Values& values) {
  for (const auto& condition : conditions) {
    const auto it = values.find(condition.field);
    if (!condition.accepts(it == values.end() ? 0 : it->second)) return false;
  }
  return true;
}

/// Names of the cards of one block, repetition not followed.
std::vector<std::string> cards(std::string_view keyword, int version, const Values& values = {}) {
  std::vector<std::string> names;
  for (const auto& card : schema(keyword).cards)
    if (card.in_version(version) && holds(card.when, values)) names.push_back(card.name);
  return names;
}

Dimension dimension(std::string_view keyword, std::string_view name, const Values& values) {
  const auto& field = *schema(keyword).find_field(name);
  for (const auto& [when, dim] : field.dimension_when)
    if (holds(when, values)) return dim;
  return field.dimension;
}

// ---- Number of lines after the title

TEST(InterLayout, NumberOfLines) {
  struct Row {
    const char* keyword;
    Values values;
    int from, until;
    std::size_t lines;
  };
  constexpr int now = 2026;
  const Row rows[] = {
      {"/INTER/TYPE7", {}, 51, now, 6},
      {"/INTER/TYPE7", {{"Icurv", 1}}, 51, now, 7},
      {"/INTER/TYPE7", {{"Icurv", 2}}, 51, now, 7},
      {"/INTER/TYPE7", {{"Icurv", 3}}, 51, now, 6},
      {"/INTER/TYPE7", {{"Ifric", 1}}, 51, now, 7},
      {"/INTER/TYPE7", {{"Ifric", 2}}, 51, now, 8},
      {"/INTER/TYPE7", {{"Ifric", 4}}, 51, now, 8},
      {"/INTER/TYPE7", {{"Iadm", 1}}, 51, now, 6},
      {"/INTER/TYPE7", {{"Iadm", 2}}, 51, 51, 6},
      {"/INTER/TYPE7", {{"Iadm", 2}}, 90, now, 7},
      {"/INTER/TYPE7", {{"Ithe", 1}}, 51, 90, 6},
      {"/INTER/TYPE7", {{"Ithe", 2}}, 90, 90, 7},
      {"/INTER/TYPE7", {{"Ithe", 1}}, 100, 120, 7},
      {"/INTER/TYPE7", {{"Ithe", 1}}, 130, now, 8},
      {"/INTER/TYPE10", {}, 51, now, 3},
      {"/INTER/TYPE11", {}, 51, 100, 3},
      {"/INTER/TYPE11", {}, 110, 2017, 4},
      {"/INTER/TYPE11", {}, 2018, now, 5},
      {"/INTER/TYPE11", {{"Ithe", 1}}, 110, 130, 4},
      {"/INTER/TYPE11", {{"Ithe", 2}}, 140, 2017, 6},
      {"/INTER/TYPE11", {{"Ithe", 1}}, 2018, now, 7},
      {"/INTER/TYPE19", {{"Icurv", 0}}, 90, 90, 7},
      {"/INTER/TYPE19", {{"Icurv", 1}}, 90, now, 7},
      {"/INTER/TYPE19", {{"Icurv", 2}}, 90, 90, 6},
      {"/INTER/TYPE19", {}, 100, now, 6},
      {"/INTER/TYPE19", {{"Icurv", 2}}, 100, now, 7},
      {"/INTER/TYPE19", {{"Icurv", 3}}, 100, now, 6},
      {"/INTER/TYPE19", {{"Ifric", 1}}, 100, now, 7},
      {"/INTER/TYPE19", {{"Ifric", 2}}, 100, now, 8},
      {"/INTER/TYPE19", {{"Ithe", 1}}, 100, 2020, 6},
      {"/INTER/TYPE19", {{"Ithe", 1}}, 2021, now, 8},
      {"/INTER/LAGMUL/TYPE7", {}, 51, 51, 6},
      {"/INTER/LAGMUL/TYPE7", {}, 90, 90, 8},
      {"/INTER/LAGMUL/TYPE7", {}, 100, now, 6},
  };
  for (const Row& r : rows)
    for (const int version : versions_from(r.from))
      if (version <= r.until) {
        EXPECT_EQ(cards(r.keyword, version, r.values).size(), r.lines)
            << r.keyword << " " << version << " "
            << (r.values.empty() ? "" : r.values.begin()->first);
      }
}

/// The lines of a default block: names of their cells with their last columns, "-" for a blank one.
std::vector<std::string> default_lines(int type, int version, const Values& values = {}) {
  std::vector<std::string> out;
  for (const auto& card : schema("/DEFAULT/INTER/TYPE" + std::to_string(type)).cards) {
    if (!card.in_version(version) || !holds(card.when, values)) continue;
    std::string line;
    for (const auto& field : card.fields) {
      if (!field.in_version(version)) continue;
      EXPECT_EQ(field.last - field.first, 9) << field.name;
      line += (line.empty() ? "" : " ") + field.name + " " + std::to_string(field.last);
    }
    out.push_back(card.blank() ? "-" : line);
  }
  return out;
}

TEST(DefaultInterLayout, LinesPerTypeAndVersion) {
  const std::string tie = "Ignore 30 Spotflag 40 Isearch 60 Idel 70";
  const std::string t7 = "Istf 30 Igap 50 Ibag 70 Idel 80", removal = "Irem_gap 90 Irem_i2 100";
  const std::string t11 = "Istf 30 Igap 50 Idel 80",
                    t11_new = "Istf 30 Igap 50 Irem_gap 70 Idel 80";
  const std::string edge = "Istf 30 Igap 50 Iedge 60 Ibag 70 Idel 80";
  const std::string gap24 = "Igap0 50 Ipen0 60", t25 = "Istf 30 Igap 50 Irem_i2 60 Idel 80";
  for (const int version : versions_from(51)) {
    SCOPED_TRACE(version);
    EXPECT_THAT(default_lines(2, version), ElementsAre("-", tie));
    EXPECT_THAT(default_lines(2, version, {{"Spotflag", 27}}), ElementsAre("-", tie, "Istf 70"));
    EXPECT_THAT(default_lines(7, version),
                ElementsAre("-", t7, "-", removal, "-", "Inacti 40", "Iform 50"));
    EXPECT_THAT(default_lines(11, version),
                ElementsAre("-", version < 2020 ? t11 : t11_new, "Iform 90", "-", "Inacti 40"));
    if (version < 2020)
      EXPECT_THAT(default_lines(19, version),
                  ElementsAre("-", (version < 2018 ? t7 : edge) + " Icurv 90", "-", "-", "-",
                              "Inacti 40", "Iform 50"));
    else
      EXPECT_THAT(default_lines(19, version),
                  ElementsAre("-", edge, "-", removal, "-", "Inacti 40", "Iform 50"));
    EXPECT_THAT(default_lines(24, version),
                ElementsAre("-",
                            version < 2017   ? "Istf 30"
                            : version < 2018 ? "Istf 30 Idel 80"
                                             : "Istf 30 Irem_i2 60 Idel 80",
                            version < 2017 ? "-" : "Iedge 40", gap24, "-", "Inacti 40", "-"));
    EXPECT_THAT(default_lines(25, version),
                ElementsAre("-",
                            version < 2019   ? t11
                            : version < 2021 ? t25
                                             : t25 + " Iedge 90",
                            "-", version < 2019 ? "Igap0 50" : "Igap0 50 Ishape 60", "-",
                            "Inacti 40", "-"));
  }
}

TEST(ContactDimensions, FrictionCoefficientsFollowTheLaw) {
  const Dimension p_inv{-1, 1, 2, 0}, p_inv2{-2, 2, 4, 0}, pv_inv{-1, 0, 3, 0}, v_inv{0, -1, 1, 0},
      v_inv2{0, -2, 2, 0}, v{0, 1, -1, 0}, one{};
  const std::map<int, std::array<Dimension, 6>> table = {
      {1, {p_inv, v_inv, pv_inv, p_inv2, v_inv2, one}},
      {2, {p_inv2, v_inv, p_inv, v_inv, one, v_inv}},
      {3, {one, one, one, one, v, v}},
      {4, {one, v_inv, one, one, one, one}}};
  for (const char* keyword : {"/INTER/TYPE7", "/INTER/TYPE19", "/FRICTION"})
    for (const auto& [law, expected] : table)
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(dimension(keyword, fmt::format("C{}", i + 1), {{"Ifric", law}}), expected[i])
            << keyword << " Ifric " << law << " C" << i + 1;
}

}  // namespace
}  // namespace deck
