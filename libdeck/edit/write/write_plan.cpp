// Completes a set of files after a kill between two renames. Trusts a note only if the present
// program could have written it: a regular file of the user, with the mode of notes, that renames
// temporaries to files of the given decks.
#include "edit/write/write_plan.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>
#include <set>
#include <sstream>

#include "base/shared/hash.hpp"
#include "deck/text.hpp"
#include "edit/shared/write.hpp"

namespace deck {
namespace detail {
namespace fs = std::filesystem;

Error io_error(const std::string& what, const std::string& path, int code) {
  return {Error::Code::io, what + " " + path + ": " + std::strerror(code)};
}

Result<std::string> follow_links(const std::string& path) {
  std::string at = path;
  for (int depth = 0; depth < 40; ++depth) {
    std::error_code ec;
    if (!fs::is_symlink(at, ec)) return at;
    const fs::path link = fs::read_symlink(at, ec);
    if (ec) return io_error("cannot read the link", at, ec.value());
    at = (fs::path(at).parent_path() / link).string();  // an absolute link replaces the whole path
  }
  return io_error("cannot write", path, ELOOP);
}

std::string directory_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

bool lies_below(const fs::path& path, const fs::path& directory) {
  const fs::path relative = path.lexically_relative(directory);
  return !relative.empty() && *relative.begin() != "..";
}

bool flush(int fd) { return fsync(fd) == 0 || errno == EINVAL || errno == EROFS; }

Result<void> flush_directory(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A directory that is writable but not readable cannot be flushed.
  if (fd < 0 && errno == EACCES) return {};
  if (fd < 0) return io_error("cannot open the directory", path, errno);
  const bool flushed = flush(fd);
  const int code = errno;
  close(fd);
  if (!flushed) return io_error("cannot flush the directory", path, code);
  return {};
}

bool lock_note(int fd) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(fd, F_SETLK, &whole) == 0;
}

namespace {

/// Hidden name next to `path`, at most 255 bytes.
std::string beside(const std::string& path, const std::string& ending) {
  const fs::path p(path);
  return (p.parent_path() / ("." + p.filename().string().substr(0, 200) + ending)).string();
}

/// Two numbers with a dash: leads to no other directory.
bool is_suffix(std::string_view text) {
  const auto dash = text.find('-');
  const auto digits = [](std::string_view s) {
    return !s.empty() && s.find_first_not_of("0123456789") == s.npos;
  };
  return dash != text.npos && digits(text.substr(0, dash)) && digits(text.substr(dash + 1));
}

constexpr std::string_view note_head = "deck unfinished 3", note_end = "end";
constexpr off_t longest_note = off_t{16} << 20;

bool may_be_note(const struct stat& status) {
  return S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
         (status.st_mode & 07777) == note_mode;
}

/// Steps of a note; nullopt if it is cut off.
std::optional<std::vector<RenameStep>> read_note(int fd, off_t size) {
  std::string text(static_cast<std::size_t>(std::min(size, longest_note)), '\0');
  if (pread(fd, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    return std::nullopt;
  std::istringstream lines(std::move(text));
  std::string line;
  if (!std::getline(lines, line) || line != note_head) return std::nullopt;
  std::vector<RenameStep> steps;
  while (std::getline(lines, line)) {
    if (line == note_end && lines.peek() == EOF) return steps;
    std::istringstream cells(line);
    RenameStep s;
    if (!(cells >> s.suffix >> std::hex >> s.old_hash >> s.new_hash) || cells.get() != '\t' ||
        !std::getline(cells, s.target) || !is_suffix(s.suffix))
      return std::nullopt;
    steps.push_back(std::move(s));
  }
  return std::nullopt;
}

/// Hash of a regular file; 0 if there is none.
std::uint64_t hash_of(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const auto source = Source::open(path, Limits{});
  return source ? content_hash((*source)->bytes()) : 0;
}

/// Does the remaining renames; none if another program has changed one of the files.
Result<std::size_t> carry_out(const std::vector<RenameStep>& steps) {
  std::vector<const RenameStep*> pending;
  for (const RenameStep& s : steps) {
    const std::uint64_t now = hash_of(s.target);
    if (now == s.old_hash && hash_of(temporary_name(s.target, s.suffix)) == s.new_hash)
      pending.push_back(&s);
    else if (now != s.new_hash)
      return std::size_t{0};
  }
  std::set<std::string> directories;
  for (const RenameStep* s : pending) {
    if (std::rename(temporary_name(s->target, s->suffix).c_str(), s->target.c_str()) != 0)
      return io_error("cannot put in place", s->target, errno);
    directories.insert(directory_of(s->target));
  }
  for (const std::string& d : directories)
    if (auto flushed = flush_directory(d); !flushed) return flushed.error();
  return pending.size();
}

/// Completes the open note.
Result<std::size_t> complete_note(const std::string& name, int fd,
                                  const std::vector<std::string>& tree) {
  struct stat status {};
  if (fd < 0 || fstat(fd, &status) != 0) return io_error("cannot read", name, errno);
  const auto steps = may_be_note(status) ? read_note(fd, status.st_size) : std::nullopt;
  if (!steps) return Error{Error::Code::config, name + " is not a whole note"};
  std::set<std::string> places;
  for (const std::string& file : tree) {
    std::error_code ec;
    places.insert(fs::canonical(file, ec).string());
  }
  for (const RenameStep& s : *steps)
    if (!places.contains(s.target))
      return Error{Error::Code::config,
                   name + " would write " + s.target + ", which is not a file of the given decks"};
  if (!lock_note(fd)) return std::size_t{0};  // its writer still runs
  const auto done = carry_out(*steps);
  if (!done) return done;
  for (const RenameStep& s : *steps) {
    unlink(temporary_name(s.target, s.suffix).c_str());
    unlink(former_name(s.target, s.suffix).c_str());
  }
  // The name may belong to the note of another writer by now.
  struct stat left {};
  if (lstat(name.c_str(), &left) == 0 && left.st_ino == status.st_ino) unlink(name.c_str());
  return done;
}

}  // namespace

std::string temporary_name(const std::string& path, const std::string& suffix) {
  return beside(path, "." + suffix + ".tmp");
}
std::string former_name(const std::string& path, const std::string& suffix) {
  return temporary_name(temporary_name(path, suffix), suffix);
}
std::string note_name(const std::string& target) { return beside(target, ".unfinished"); }

std::string suffix_of(std::string_view name) {
  if (!name.ends_with(".tmp")) return {};
  name.remove_suffix(4);
  name.remove_prefix(name.rfind('.') + 1);
  return is_suffix(name) ? std::string(name) : std::string();
}

std::string note_text(const std::vector<RenameStep>& steps) {
  std::string text = std::string(note_head) + "\n";
  for (const RenameStep& s : steps)
    text += fmt::format("{}\t{:016x}\t{:016x}\t{}\n", s.suffix, s.old_hash, s.new_hash, s.target);
  return text + std::string(note_end) + "\n";
}

}  // namespace detail

using namespace detail;

std::optional<std::string> unfinished_note(const std::string& main) {
  const auto target = follow_links(main);
  struct stat status {};
  if (!target || lstat(note_name(*target).c_str(), &status) != 0 || !may_be_note(status))
    return std::nullopt;
  return note_name(*target);
}

Result<std::size_t> complete_interrupted_write(const std::string& main,
                                               const std::vector<std::string>& tree) {
  const auto name = unfinished_note(main);
  if (!name) return std::size_t{0};
  const int note = open(name->c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  auto done = complete_note(*name, note, tree);
  if (note >= 0) close(note);
  return done;
}

std::optional<int> temporary_of(std::string_view name) {
  const std::string suffix = suffix_of(name);
  if (!name.starts_with('.') || suffix.empty() || suffix.size() > 20) return std::nullopt;
  return std::atoi(suffix.c_str());
}

bool is_temporary_of(std::string_view name, const std::string& target) {
  return temporary_of(name) && temporary_name(target, suffix_of(name)) == name;
}

}  // namespace deck
