// The directive #include: its path over continued lines, the places where the file may lie, and
// what a path that leads nowhere was probably meant to be.
#include "keyword/shared/include_file.hpp"

#include <algorithm>
#include <filesystem>

#include "base/shared/paths.hpp"
#include "keyword/shared/reader.hpp"
#include "text/shared/similar_file.hpp"

namespace deck::detail {
namespace fs = std::filesystem;

bool is_include(std::string_view line) {
  if (!starts_with_nocase(line, "#include")) return false;
  return line.size() == 8 || static_cast<unsigned char>(line[8]) <= ' ' || line[8] == '\'' ||
         line[8] == '"';
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
