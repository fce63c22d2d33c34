// Normal forms of paths in one pass over the text, and search for similar names in a folder.
#include "base/shared/paths.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/shared/words.hpp"

namespace deck {

std::string normal_path(std::string_view path) {
  std::string out;
  if (path.empty()) return out;
  out.reserve(path.size());
  const bool rooted = path.front() == '/';
  if (rooted) out += '/';
  const std::size_t root = out.size();
  std::size_t names = 0;   // names in `out` after its leading ".."
  bool directory = false;  // true if the last component can only be a directory
  for (std::size_t at = 0; at < path.size();) {
    if (path[at] == '/') {
      directory = true;
      ++at;
      continue;
    }
    const std::string_view part = path.substr(at, std::min(path.find('/', at), path.size()) - at);
    at += part.size();
    directory = part == "." || part == "..";
    if (part == ".") continue;
    if (part == ".." && (names > 0 || rooted)) {
      if (names == 0) continue;  // ".." of the root is the root
      --names;
      const std::size_t cut = out.rfind('/');
      out.resize(cut == out.npos || cut < root ? root : cut);
      continue;
    }
    if (out.size() > root) out += '/';
    out += part;
    if (part != "..") ++names;
  }
  if (out.empty()) return ".";
  if (directory && names > 0) out += '/';
  return out;
}

std::string absolute_path(const std::string& path) {
  if (path.starts_with('/')) return normal_path(path);
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(path, failed);
  return normal_path(failed ? path : whole.string());
}

std::string_view parent_path(std::string_view path) {
  const std::size_t cut = path.rfind('/');
  if (cut == path.npos) return {};
  return path.substr(0, cut == 0 ? 1 : cut);
}

namespace {

namespace fs = std::filesystem;

/// Sorted names in a folder; of a very large folder only some.
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
