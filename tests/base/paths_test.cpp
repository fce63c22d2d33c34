// Paths taken from their text are those of std::filesystem; files with nearly the wanted name.
#include "base/shared/paths.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "keyword/reading.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

/// A path of a few parts, with everything that cancels out. Not separators alone, of which the
/// standard library keeps two.
std::string random_path(std::mt19937& random) {
  static const std::vector<std::string> parts{"a", "bc", ".", "..", "..", "", ".d", "..e", "f."};
  std::string path = random() % 3 == 0 ? "/" : "";
  for (std::size_t n = random() % 7; n > 0; --n) {
    path += parts[random() % parts.size()];
    if (n > 1 || random() % 3 == 0) path += '/';
  }
  return path.find_first_not_of('/') == path.npos ? path.substr(0, 1) : path;
}

TEST(Paths, AreThoseOfTheStandardLibrary) {
  std::mt19937 random(7);
  for (int i = 0; i < 200000; ++i) {
    const std::string path = random_path(random), normal = normal_path(path);
    ASSERT_EQ(normal, fs::path(path).lexically_normal().string()) << path;
    ASSERT_EQ(parent_path(normal), fs::path(normal).parent_path().string()) << normal;
    if (i % 100 != 0) continue;
    std::error_code failed;
    const fs::path whole = fs::absolute(path, failed);
    ASSERT_EQ(absolute_path(path), (failed ? fs::path(path) : whole).lexically_normal().string())
        << path;
  }
}

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
