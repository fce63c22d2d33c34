// Reads folders for names that differ from a wanted one in a few letters, or in their case.
#include "text/shared/similar_file.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/shared/spelling.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

/// Names in a folder, sorted; of a very large one only some.
std::vector<std::string> names_in(const fs::path& folder) {
  constexpr std::size_t most = 10'000;
  std::vector<std::string> names;
  std::error_code bad;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, bad);
  for (const fs::directory_iterator none; !bad && entry != none && names.size() < most;
       entry.increment(bad))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string file_in_other_case(const std::string& path) {
  std::error_code bad;
  fs::path found;
  for (const fs::path& part : fs::path(path)) {
    fs::path next = found / part;
    if (!fs::exists(next, bad)) {
      const std::string wanted = in_capitals(part.string());
      const std::vector<std::string> names = names_in(found);
      const auto same = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
        return in_capitals(name) == wanted;
      });
      if (same == names.end()) return {};
      next = found / *same;
    }
    found = std::move(next);
  }
  const bool other = fs::is_regular_file(found, bad) && found != fs::path(path);
  return other ? found.string() : std::string();
}

std::string similar_file(const std::string& path) {
  const fs::path wanted(path);
  std::vector<std::string> files = names_in(wanted.parent_path());
  std::erase_if(files, [&](const std::string& name) {
    std::error_code bad;
    return !fs::is_regular_file(wanted.parent_path() / name, bad);
  });
  const std::string close = closest_word(wanted.filename().string(), files);
  return close.empty() ? close : (wanted.parent_path() / close).string();
}

}  // namespace deck
