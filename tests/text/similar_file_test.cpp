// Files whose name is nearly the wanted one.
#include "base/shared/paths.hpp"

#include "keyword/reading.hpp"

namespace deck {
namespace {

struct SimilarFile : testing_support::Folder {
  void SetUp() override {
    for (const char* name : {"Mesh/Front.inc", "Mesh/front_rail.inc", "a_0000.rad"})
      file(name, "x");
    std::filesystem::create_directories(dir_ / "b_0000.rad");
  }
  std::string path(const char* name) const { return (dir_ / name).string(); }
};

TEST_F(SimilarFile, IsFoundInAnotherCaseInEveryPartOfItsPath) {
  EXPECT_EQ(file_in_other_case(path("mesh/front.INC")), path("Mesh/Front.inc"));
  EXPECT_EQ(file_in_other_case(path("Mesh/Front.inc")), "") << "it is there as it is written";
  EXPECT_EQ(file_in_other_case(path("mesh/rear.inc")), "");
  EXPECT_EQ(file_in_other_case(path("mesh")), "") << "a folder is no file";
}

TEST_F(SimilarFile, DiffersInAFewLettersAndIsAFile) {
  EXPECT_EQ(similar_file(path("Mesh/frnt_rail.inc")), path("Mesh/front_rail.inc"));
  EXPECT_EQ(similar_file(path("Mesh/something_else.inc")), "");
  EXPECT_EQ(similar_file(path("c_0000.rad")), path("a_0000.rad")) << "b_0000.rad is a folder";
  EXPECT_EQ(similar_file(path("absent/a_0000.rad")), "");
}

}  // namespace
}  // namespace deck
