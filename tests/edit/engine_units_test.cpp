// Engine files beside a deck that gets other units: each time of each keyword, and what stays.
#include <gmock/gmock.h>

#include <fstream>

#include "deck/edit/convert.hpp"
#include "deck/keyword/engine_file.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using testing::IsEmpty;

const std::string kg_mm_ms = "                  kg                  mm                  ms\n";
std::string deck_text(const std::string& body, const std::string& work = kg_mm_ms) {
  return "#RADIOSS STARTER\n/BEGIN\nrun\n      2024         0\n" + kg_mm_ms + work + body +
         "/END\n";
}

class EngineUnits : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "deck-units-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    dir_ = name;
    write("car_0000.rad", deck_text(""));
  }
  void TearDown() override { std::filesystem::remove_all(dir_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name, std::ios::binary) << text;
  }

  /// What becomes of the Engine file, or the refusals, of the file.
  std::string after(const std::string& engine, const char* target = "kg,mm,s",
                    bool accept = false) {
    write("car_0001.rad", engine);
    auto deck = read_deck((dir_ / "car_0000.rad").string(), SchemaSet::built_in());
    EXPECT_TRUE(deck.ok());
    const EngineFiles files = read_engine_files(*deck);
    out_ = {};
    engine_to_units(*deck, files, parse_unit_system(target).value(), options_, accept, out_);
    if (!out_.refusals.empty()) return "refused";
    auto changed = apply_rewrite(deck->sources, out_);
    EXPECT_TRUE(changed.ok());
    for (const auto& [path, text] : *changed)
      if (path.ends_with("car_0001.rad")) return text;
    return engine;
  }
  std::vector<std::string> notes(Loss loss) const {
    std::vector<std::string> out;
    for (const LossEntry& e : out_.losses)
      if (e.loss == loss)
        out.push_back(e.file.substr(e.file.rfind('/') + 1) + ":" + std::to_string(e.line) + " " +
                      e.keyword + ": " + e.note);
    return out;
  }

  std::filesystem::path dir_;
  UnitsOptions options_;
  Rewrite out_;
};

TEST_F(EngineUnits, EveryTimeOfEveryKeyword) {
  EXPECT_EQ(after("/RUN/car/1\n 10.0\n"), "/RUN/car/1\n 0.01\n");
  for (const auto& [keyword, before, now] : {std::tuple{"/TFILE", "2.5", "0.0025"},
                                             {"/RFILE", "5000", "5000"},
                                             {"/ANIM/DT", "0. 2.5 4.5", "0. 0.0025 0.0045"},
                                             {"/ANIM/DT", "1.5, 2.5", "0.0015, 0.0025"},
                                             {"/ANIM/VECT/CONT", "12 13", "12 13"},
                                             {"/H3D/DT", "1.5 2.5 4.5", "0.0015 0.0025 0.0045"},
                                             {"/H3D/PART", "1 2", "1 2"},
                                             {"/OUTP/DT", "1.5 2.5", "0.0015 0.0025"},
                                             {"/STATE/DT", "1.5 2.5", "0.0015 0.0025"},
                                             {"/DYNAIN/DT", "1.5 2.5", "0.0015 0.0025"},
                                             {"/DT/NODA/CST", "0.67 2.5", "0.67 0.0025"},
                                             {"/DTIX", "1.5 2.5", "0.0015 0.0025"},
                                             {"/PRINT/-100", "3.0", "3.0"},
                                             {"/STOP", "1.5 2.5 3.5 1 1", "1.5 2.5 3.5 1 1"},
                                             {"/DEL/SHELL", "1 2 3", "1 2 3"},
                                             {"/RBODY/ON", "1 2 3", "1 2 3"},
                                             {"/BCS/TRA/XYZ", "1 2 3", "1 2 3"}}) {
    SCOPED_TRACE(keyword);
    const std::string head = std::string(keyword) + "\n";
    EXPECT_EQ(after(head + before + "\n"), head + now + "\n");
    EXPECT_THAT(out_.refusals, IsEmpty());
    EXPECT_THAT(notes(Loss::undecided), IsEmpty());
  }
}

TEST_F(EngineUnits, TimesStayWhereTheWorkingUnitsStay) {
  options_.keep_working = true;
  EXPECT_EQ(after("/TFILE\n1.0\n/NEWTHING\n3.0\n"), "/TFILE\n1.0\n/NEWTHING\n3.0\n");
  EXPECT_THAT(out_.losses, IsEmpty());
  options_.keep_working = false;
  write("car_0000.rad",
        deck_text("", "                  Mg                  mm                   s\n"));
  EXPECT_EQ(after("/TFILE\n1.0\n"), "/TFILE\n1.0\n");
}

}  // namespace
}  // namespace deck
