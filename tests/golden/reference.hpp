// What the comparisons with the reference solver share: where its results and decks are, a folder
// that goes with the test, the corpus' own scripts.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "folder.hpp"
#include "where.hpp"

namespace deck::test {

namespace fs = std::filesystem;

inline fs::path corpus() { return shared_dir(); }

inline int shell(const std::string& command) { return std::system(command.c_str()); }
inline std::string quote(const fs::path& path) { return "'" + path.string() + "'"; }
inline std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes the deck `plain` with gaps 2.5 times as wide to `out`. False: the script failed.
inline bool inflate(const fs::path& plain, const fs::path& out) {
  return shell("python3 " + quote(corpus() / "check" / "inflate_gaps.py") + " " + quote(plain) +
               " " + quote(out) + " 2.5 zero > /dev/null") == 0;
}

/// The deck whose reference results are in `golden`; empty if it cannot be found or made.
inline fs::path deck_for(const fs::path& golden, const Folder& scratch) {
  const std::string stem = golden.filename().string();
  const std::string name = stem.substr(0, stem.find(".json"));
  if (golden.parent_path().filename() == "params")
    return golden.parent_path() / (name + "_0000.rad");
  const fs::path base = corpus() / "corpus";
  const std::string tail = "_inflated";
  if (name.ends_with(tail)) {
    const fs::path plain =
        base / "EuroSID_II" / (name.substr(0, name.size() - tail.size()) + "_0000.rad");
    const fs::path out = scratch / (name + "_0000.rad");
    return inflate(plain, out) ? out : fs::path();
  }
  for (const auto& entry : fs::recursive_directory_iterator(base)) {
    if (!entry.is_regular_file()) continue;
    const fs::path& file = entry.path();
    if (file.filename() == name + "_0000.rad") return file;
    if (file.filename() == "model_0000.rad" && file.parent_path().filename() == name) return file;
  }
  return {};
}

}  // namespace deck::test
