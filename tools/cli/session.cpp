// Writes results to files; all output files of the program are written here.
#include "session.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/shared/paths.hpp"
#include "common.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cli {
namespace {

bool starts_like(std::string_view line, std::string_view word) {
  return line.size() >= word.size() &&
         std::equal(word.begin(), word.end(), line.begin(), [](char a, char b) {
           return a == std::toupper(static_cast<unsigned char>(b));
         });
}

/// True if the text starts like a Starter deck, or if its first non-comment line is a keyword (deck
/// without head, Engine file, include).
bool looks_like_deck(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (starts_like(text, "#RADIOSS")) return true;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto first = text.substr(0, end).find_first_not_of(" \t\r");
    const std::string_view line =
        first == text.npos ? std::string_view() : text.substr(first, end - first);
    if (!line.empty() && line[0] != '#' && line[0] != '$')
      return line.size() > 1 && line[0] == '/' &&
             std::isalpha(static_cast<unsigned char>(line[1])) != 0;
    if (starts_like(line, "#INCLUDE")) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

bool file_looks_like_deck(const std::string& path) {
  constexpr std::size_t enough = std::size_t{1} << 16;
  std::ifstream in(path, std::ios::binary);
  std::string head(enough, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return looks_like_deck(is_gzip(head) ? gunzip_head(head, enough) : head);
}

bool has_content(const std::string& path, std::uint64_t size, std::string_view bytes) {
  if (size != bytes.size()) return false;
  const auto source = Source::open(path, Limits{});
  return source && (*source)->bytes() == bytes;
}

Error refused(const std::string& path, const std::string& why) {
  return config_error(path + " would be written over: " + why +
                      "; nothing was written. Name another file (does an option lack "
                      "its value?)");
}

}  // namespace

void Session::remember_read(const SourceSet& sources) {
  for (std::uint32_t f = 0; f < sources.size(); ++f)
    if (sources[f].inode() != 0)
      files_read_.emplace(Identity{sources[f].device(), sources[f].inode()}, sources[f].path());
}

void Session::remember_read(const Source& source) {
  if (source.inode() != 0)
    files_read_.emplace(Identity{source.device(), source.inode()}, source.path());
}

void Session::remember_read(const std::string& path) {
  struct stat status {};
  if (path != "-" && stat(path.c_str(), &status) == 0)
    files_read_.emplace(Identity{status.st_dev, status.st_ino}, path);
}

Result<void> Session::check_output(const std::string& path, const OutputRules& rules,
                                   std::optional<std::string_view> bytes,
                                   std::string_view origin) const {
  struct stat status {};
  if (path.empty() || path == "-") return {};
  const auto get_status = rules.follow_links ? stat : lstat;
  if (get_status(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  if (const auto read = files_read_.find({status.st_dev, status.st_ino});
      read != files_read_.end()) {
    if (rules.deck_tree)
      return config_error(path +
                          " is a file of the decks that are read; nothing was "
                          "written. Name another directory, or change them with "
                          "--in-place");
    return refused(path, read->second == path ? "this call reads it"
                                              : "this call reads it, as " + read->second);
  }
  if (rules.overwrite || (rules.ours && rules.ours(path))) return {};
  if (rules.deck_tree && is_unchanged_output(path, origin)) return {};
  if (!rules.deck_tree && !file_looks_like_deck(path)) return {};
  if (bytes && has_content(path, static_cast<std::uint64_t>(status.st_size), *bytes)) return {};
  if (rules.deck_tree)
    return config_error(path +
                        " already exists with other contents; nothing was written. Name another "
                        "directory, or add --overwrite to replace it");
  return refused(path, "it begins as a deck");
}

namespace {

/// Unique name of the place of a path; "": not a file ("-": standard output).
std::string place_of(const std::string& path) {
  if (path.empty() || path == "-") return path;
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return {};
  std::error_code ec;
  std::filesystem::path place = absolute_path(path);
  constexpr int most_links = 40;
  for (int k = 0; k < most_links && std::filesystem::is_symlink(place, ec); ++k)
    place = place.parent_path() / std::filesystem::read_symlink(place, ec);
  const std::string real = std::filesystem::weakly_canonical(place, ec).string();
  return ec ? place.string() : real;
}

Error two_outputs(const std::string& path) {
  return config_error("two outputs go to " + (path == "-" ? std::string("standard output") : path) +
                      "; nothing was written. Name another file for one of them");
}

}  // namespace

Result<void> Session::claim_outputs(const std::vector<std::string>& paths) {
  std::set<std::string> named;
  for (const std::string& path : paths) {
    if (auto allowed = check_output(path); !allowed) return allowed;
    const std::string place = place_of(path);
    if (place.empty()) continue;
    if (!named.insert(place).second) return two_outputs(path);
    if (place != "-") claimed_.emplace(place, path);
  }
  return {};
}

Result<void> Session::check_claimed() const {
  for (const auto& [place, path] : claimed_)
    if (auto allowed = check_output(path); !allowed) return allowed;
  return {};
}

int check_outputs(const CommonOptions& options, const std::vector<std::string>& paths) {
  const auto claimed = options.session->claim_outputs(paths);
  if (!claimed) print_error(options, claimed.error().message);
  return claimed ? exit_clean : exit_usage;
}

Result<void> Session::write_outputs(const std::vector<OutputFile>& files, const OutputRules& rules,
                                    const WriteOptions& options) {
  if (auto allowed = check_outputs(files, rules); !allowed) return allowed;
  return write_files_atomic(files, options);
}

Result<void> Session::check_outputs(const std::vector<OutputFile>& files,
                                    const OutputRules& rules) const {
  if (auto claimed = check_claimed(); !claimed) return claimed;
  for (const OutputFile& f : files)
    if (!claimed_.empty() && claimed_.contains(place_of(f.path))) return two_outputs(f.path);
  for (const OutputFile& f : files)
    if (auto allowed = check_output(f.path, rules, f.bytes, f.origin); !allowed) return allowed;
  return {};
}

std::string Session::no_standard_output() const {
  return std::string("cannot write standard output") +
         (errno == 0 ? "" : std::string(": ") + std::strerror(errno)) +
         (wrote_decks_ ? "; the decks were written" : "");
}

Result<void> Session::write_standard_output(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() &&
      std::fflush(stdout) == 0)
    return {};
  told_of_standard_output_ = true;
  return Error{Error::Code::io, no_standard_output()};
}

bool Session::flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  if (!told_of_standard_output_)
    std::fputs(("deck: error: " + no_standard_output() + "\n").c_str(), stderr);
  return false;
}

Result<void> Session::write_output(const std::string& path, std::string_view bytes) {
  if (path == "-") return write_standard_output(bytes);
  if (auto claimed = check_claimed(); !claimed) return claimed;
  if (auto allowed = check_output(path, {}, bytes); !allowed) return allowed;
  return write_file_atomic(path, bytes);
}

Result<void> Session::write_output(const std::string& path, const MakeText& make) {
  const WritePieces pieces = [&](const WritePiece& write) {
    Result<void> written;
    const std::string rest = make([&](std::string& text) {
      if (written) written = write(text);
      text.clear();
    });
    if (written) written = write(rest);
    return written;
  };
  if (path == "-")
    return pieces([this](std::string_view bytes) { return write_standard_output(bytes); });
  if (auto claimed = check_claimed(); !claimed) return claimed;
  if (auto allowed = check_output(path); !allowed) return allowed;
  return write_file_atomic(path, pieces);
}

}  // namespace deck::cli
