// Runs the program `deck` in a directory of its own, for tests of its command line.
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "folder.hpp"
#include "where.hpp"

namespace deck::testing_support {

namespace fs = std::filesystem;

inline std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}
inline std::size_t count_files(const fs::path& dir) {
  std::size_t n = 0;
  for (const auto& e : fs::recursive_directory_iterator(dir)) n += e.is_regular_file() ? 1 : 0;
  return n;
}

inline constexpr const char* begin =
    "#RADIOSS STARTER\n/BEGIN\nrun\n      2022\n"
    "                  Mg                  mm                   s\n"
    "                  Mg                  mm                   s\n";
inline constexpr const char* contact =
    "/INTER/TYPE10/2\ntied\n         1         2\n"
    "                                                         1.0\n\n";

/// Runs `deck` in a directory of its own.
class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(binary())) GTEST_SKIP() << "no " << binary();
  }
  static fs::path binary() { return test::binary_dir() / "tools" / "deck"; }
  /// Exit code; what it prints is in out() and err().
  int deck(const std::string& arguments) const {
    return shell("'" + binary().string() + "' " + arguments);
  }
  /// The same of any command; `deck` is this build's.
  int shell(const std::string& what) const {
    const std::string command = "cd '" + dir_.string() + "' && PATH='" +
                                binary().parent_path().string() + "':\"$PATH\"; ( " + what +
                                " ) > '" + (dir_ / "stdout").string() + "' 2> '" +
                                (dir_ / "stderr").string() + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string out() const { return read(dir_ / "stdout"); }
  std::string err() const { return read(dir_ / "stderr"); }
  const test::Folder folder_;
  const fs::path dir_ = folder_.path();
};

}  // namespace deck::testing_support
