// The directive #include: its path over continued lines, the places where the file may lie, and
// what a path that leads nowhere was probably meant to be.
#include "keyword/include_file.hpp"

#include <algorithm>
#include <filesystem>

#include "keyword/reader.hpp"

namespace deck::detail {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return text;
}

/// The path of a file that differs from `path` in the case of its letters only; empty: none.
std::string other_case(const std::string& path) {
  constexpr int most_entries = 10'000;
  std::error_code bad;
  fs::path found;
  for (const fs::path& part : fs::path(path)) {
    fs::path next = found / part;
    if (!fs::exists(next, bad)) {
      const std::string wanted = lower(part.string());
      next.clear();
      fs::directory_iterator entry(found.empty() ? fs::path(".") : found, bad);
      const fs::directory_iterator none;
      for (int n = 0; !bad && entry != none && n < most_entries; ++n, entry.increment(bad)) {
        const std::string name = entry->path().filename().string();
        if (lower(name) == wanted && (next.empty() || found / name < next)) next = found / name;
      }
      if (next.empty()) return {};
    }
    found = std::move(next);
  }
  const bool other = fs::is_regular_file(found, bad) && found != fs::path(path);
  return other ? found.string() : std::string();
}

}  // namespace

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

std::vector<std::string> include_candidates(const std::string& written,
                                            const std::vector<std::string>& directories) {
  std::vector<std::string> all;
  const auto consider = [&](const fs::path& p) {
    std::string text = p.lexically_normal().string();
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(std::move(text));
  };
  const fs::path path(written);
  if (path.is_absolute())
    consider(path);
  else
    for (const std::string& directory : directories) consider(fs::path(directory) / path);
  return all;
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
    if (const std::string other = other_case(path); !other.empty())
      return "the case of letters counts in file names: '" + other + "' is there";
  return backslash ? "write the path with '/': '" + written + "'" : std::string();
}

}  // namespace deck::detail
