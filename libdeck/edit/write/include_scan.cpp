// Looks for #include in files, and unites decks that share one.
#include "edit/shared/include_scan.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <set>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "deck/text/source.hpp"
#include "keyword/shared/include_file.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

std::optional<FileIdentity> regular_file(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino};
}

}  // namespace

std::vector<std::string> included_names(std::string_view text) {
  std::vector<std::string> out;
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    const auto end = std::min(text.find('\n', at), text.size());
    if (!detail::is_include(text.substr(at, end - at))) continue;
    std::uint64_t pos = at;
    std::string path = detail::include_path(text, pos);
    std::replace(path.begin(), path.end(), '\\', '/');
    if (!path.empty() && path.size() <= detail::longest_path) out.push_back(std::move(path));
  }
  return out;
}

const IncludeScan::Text& IncludeScan::read(const File& file) {
  const auto [it, is_new] = read_.try_emplace(file.identity);
  if (is_new)
    if (const auto source = Source::open_text(file.path, Limits{}))
      it->second = {included_names((*source)->bytes()), content_hash((*source)->on_disk())};
  return it->second;
}

std::vector<IncludeScan::File> IncludeScan::files(const std::string& deck) {
  std::vector<File> out;
  std::set<std::string> seen;
  const auto identity = regular_file(deck);
  if (!identity) return out;
  const std::string main_directory(parent_path(deck));
  out.push_back({deck, *identity});
  seen.insert(normal_path(deck));
  for (std::size_t i = 0; i < out.size() && out.size() < 10000; ++i) {
    std::vector<std::string> directories = {std::string(parent_path(out[i].path)), main_directory};
    directories.insert(directories.end(), include_paths_.begin(), include_paths_.end());
    const Text& text = read(out[i]);
    out[i].contents = text.contents;
    for (const std::string& name : text.names) {
      detail::IncludeCandidates places(name, directories);
      while (const std::string* path = places.next()) {
        const auto found = regular_file(*path);
        if (!found) continue;
        if (seen.insert(*path).second) out.push_back({*path, *found});
        break;
      }
    }
  }
  return out;
}

std::vector<std::vector<std::size_t>> sharing_groups(
    const std::vector<std::vector<IncludeScan::File>>& files_of_decks) {
  std::vector<std::size_t> first(files_of_decks.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto root = [&](std::size_t d) {
    while (first[d] != d) d = first[d] = first[first[d]];
    return d;
  };
  std::map<FileIdentity, std::size_t> owner;
  for (std::size_t d = 0; d < files_of_decks.size(); ++d)
    for (const IncludeScan::File& file : files_of_decks[d]) {
      const auto [it, is_new] = owner.emplace(file.identity, d);
      const std::size_t a = root(it->second), b = root(d);
      first[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::size_t, std::size_t> group_of;
  for (std::size_t d = 0; d < files_of_decks.size(); ++d) {
    const auto [it, is_new] = group_of.emplace(root(d), groups.size());
    if (is_new) groups.emplace_back();
    groups[it->second].push_back(d);
  }
  return groups;
}

}  // namespace deck
