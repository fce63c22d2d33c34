// The #include directive: path over continued lines, candidate files, hints for wrong paths.
// IncludeScan searches only for #include, to find decks that share files.

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <set>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "deck/text.hpp"
#include "keyword/shared/include_scan.hpp"
#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace fs = std::filesystem;

bool is_include(std::string_view line) {
  if (!starts_with_nocase(line, "#include")) return false;
  return line.size() == 8 || is_blank(line[8]) || line[8] == '\'' || line[8] == '"';
}

std::string include_path(std::string_view bytes, std::uint64_t& pos) {
  std::string path;
  bool more = true;
  for (bool first = true; more && pos < bytes.size(); first = false) {
    const auto nl = std::min(bytes.find('\n', pos), bytes.size());
    std::string_view line = trim_right(bytes.substr(pos, nl - pos));
    if (first) line.remove_prefix(8);
    if (!first && line.starts_with('+')) line.remove_prefix(1);
    pos = std::min(nl + 1, bytes.size());
    more = false;
    for (const std::string_view mark : {" +", "...", "&"}) {
      if (line.ends_with(mark)) {
        line.remove_suffix(mark.size());
        more = true;
        break;
      }
    }
    if (path.size() <= longest_path) path += trim(line);
    if (pos < bytes.size() && bytes[pos] == '+') more = true;
  }
  std::erase(path, '\'');
  return std::string(trim(path));
}

IncludeCandidates::IncludeCandidates(const std::string& written,
                                     const std::vector<std::string>& directories) {
  const auto consider = [&](std::string text) {
    if (std::find(all_.begin(), all_.end(), text) == all_.end()) all_.push_back(std::move(text));
  };
  if (written.starts_with('/'))
    consider(normal_path(written));
  else
    for (const std::string& directory : directories)
      consider(normal_path(directory.empty() ? written : directory + '/' + written));
  places_ = all_.size();
}

const std::string* IncludeCandidates::next() {
  if (at_ == places_ && all_.size() == places_)
    for (std::size_t i = 0; i < places_; ++i) {
      std::error_code bad;
      std::string packed = all_[i] + ".gz";
      if (fs::is_regular_file(packed, bad)) all_.push_back(std::move(packed));
    }
  return at_ < all_.size() ? &all_[at_++] : nullptr;
}

std::string include_hint(std::string written, bool backslash,
                         const std::vector<std::string>& candidates) {
  if (written.find('"') != std::string::npos) {
    std::erase(written, '"');
    return "remove the double quotes, which are part of the name for the reference solver: "
           "#include " +
           written;
  }
  for (const std::string& path : candidates)
    if (const std::string other = file_in_other_case(path); !other.empty())
      return "upper and lower case matter in file names: '" + other + "' is there";
  for (const std::string& path : candidates)
    if (const std::string other = similar_file(path); !other.empty())
      return "did you mean '" + other + "'?";
  return backslash ? "write the path with '/': '" + written + "'" : std::string();
}

}  // namespace deck::detail

namespace deck {
namespace {

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
