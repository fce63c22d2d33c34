// Normal forms of paths, taken from their text in one pass.
#include "base/shared/paths.hpp"

#include <filesystem>

namespace deck {

std::string normal_path(std::string_view path) {
  std::string out;
  if (path.empty()) return out;
  out.reserve(path.size());
  const bool rooted = path.front() == '/';
  if (rooted) out += '/';
  const std::size_t root = out.size();
  std::size_t names = 0;   // in `out`, behind its leading ".."
  bool directory = false;  // whether what was read last can only be one
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
      if (names == 0) continue;  // above the root is the root
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

}  // namespace deck
