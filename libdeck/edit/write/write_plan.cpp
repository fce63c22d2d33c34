// Finishing a set of files that a kill left half in place. The note that says what is missing is
// believed only as far as it could have been written here: a regular file of the user, with the
// mode that notes get, that moves temporaries of the user to the files beside them, and only to
// files of the decks at hand. Everything else of that name is left alone.
#include "edit/write/write_plan.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/shared/hash.hpp"
#include "deck/text/source.hpp"
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
    struct stat status {};
    if (lstat(at.c_str(), &status) != 0 || !S_ISLNK(status.st_mode)) return at;
    std::error_code ec;
    const fs::path link = fs::read_symlink(at, ec);
    if (ec) return io_error("cannot read the link", at, ec.value());
    at = (fs::path(at).parent_path() / link).string();  // an absolute link replaces all of it
  }
  return io_error("cannot write", path, ELOOP);
}

std::string directory_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

std::string canonical_place(const std::string& path) {
  std::error_code ec;
  const fs::path p(path);
  const fs::path directory = fs::canonical(p.has_parent_path() ? p.parent_path() : ".", ec);
  return ec ? std::string() : (directory / p.filename()).string();
}

bool flush(int fd) { return fsync(fd) == 0 || errno == EINVAL || errno == EROFS; }

Result<void> flush_directory(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) {
    // A directory that may be written but not read cannot be flushed, and need not be.
    if (errno == EACCES) return {};
    return io_error("cannot open the directory", path, errno);
  }
  const bool flushed = flush(fd);
  const int code = errno;
  close(fd);
  if (!flushed) return io_error("cannot flush the directory", path, code);
  return {};
}

bool lock_file(int fd) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(fd, F_SETLK, &whole) == 0;
}

namespace {

/// A hidden name beside `path`. Names end at 255 bytes.
std::string beside(const std::string& path, const std::string& ending) {
  const fs::path p(path);
  return (p.parent_path() / ("." + p.filename().string().substr(0, 200) + ending)).string();
}

/// Two numbers with a dash between: nothing that could lead elsewhere.
bool is_suffix(std::string_view text) {
  const auto dash = text.find('-');
  const auto digits = [](std::string_view s) {
    return !s.empty() && s.find_first_not_of("0123456789") == s.npos;
  };
  return dash != text.npos && digits(text.substr(0, dash)) && digits(text.substr(dash + 1));
}

}  // namespace

std::string temporary_name(const std::string& path, const std::string& suffix) {
  return beside(path, "." + suffix + ".tmp");
}
std::string note_name(const std::string& target) { return beside(target, ".unfinished"); }
std::string own_suffix(int number) {
  return std::to_string(getpid()) + "-" + std::to_string(number);
}

std::string suffix_of(std::string_view name) {
  if (!name.ends_with(".tmp")) return {};
  name.remove_suffix(4);
  name.remove_prefix(name.rfind('.') + 1);
  return is_suffix(name) ? std::string(name) : std::string();
}

namespace {

constexpr std::string_view note_head = "deck unfinished 2", note_end = "end";
constexpr off_t longest_note = off_t{16} << 20;

bool is_file_of_user(const struct stat& status) {
  return S_ISREG(status.st_mode) && status.st_uid == geteuid();
}

/// What `path` is itself, not what it leads to; nullopt: nothing is there.
std::optional<struct stat> look(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

std::optional<std::vector<Step>> parse_note(std::string_view text) {
  std::istringstream lines{std::string(text)};
  std::string line;
  if (!std::getline(lines, line) || line != note_head) return std::nullopt;
  std::vector<Step> steps;
  while (std::getline(lines, line)) {
    if (line == note_end) return steps;
    std::istringstream cells(line);
    Step s;
    if (!(cells >> s.fresh >> s.old >> std::hex >> s.old_hash >> s.new_hash) ||
        cells.get() != '\t' || !std::getline(cells, s.target) || !is_suffix(s.fresh) ||
        (s.old != "-" && !is_suffix(s.old)))
      return std::nullopt;
    if (s.old == "-") s.old.clear();
    steps.push_back(std::move(s));
  }
  return std::nullopt;
}

/// Contents of a regular file; 0: there is nothing; 1: something else is there.
std::uint64_t hash_of(const std::string& path) {
  const auto there = look(path);
  if (!there) return 0;
  const auto source = S_ISREG(there->st_mode) ? Source::open(path, Limits{}) : Error{};
  return source ? content_hash((*source)->bytes()) : 1;
}

/// What a note says; an error says why it is not believed. `tree` holds canonical places.
Result<std::vector<Step>> read_note(int fd, const struct stat& status,
                                    const std::set<std::string>& tree) {
  const auto refuse = [](std::string why) { return Error{Error::Code::config, std::move(why)}; };
  if (!is_file_of_user(status)) return refuse("it is not a file of yours");
  if ((status.st_mode & 07777) != note_mode) return refuse("its mode is not that of such a note");
  if (status.st_size > longest_note) return refuse("it is too long");
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  const ssize_t got = pread(fd, text.data(), text.size(), 0);
  auto steps = got == status.st_size ? parse_note(text) : std::nullopt;
  if (!steps) return refuse("it is not a whole note");
  for (const Step& s : *steps) {
    if (!fs::path(s.target).is_absolute() || !tree.contains(canonical_place(s.target)))
      return refuse("it would write " + s.target + ", which is not a file of the given decks");
    for (const std::string& suffix : {s.fresh, s.old})
      if (const auto there = look(temporary_name(s.target, suffix));
          !suffix.empty() && there && !is_file_of_user(*there))
        return refuse(temporary_name(s.target, suffix) + " is not a file of yours");
  }
  return std::move(*steps);
}

/// Puts in place what is not yet. Nothing where another program changed one of the files since.
Result<std::size_t> carry_out(const std::vector<Step>& steps) {
  std::vector<const Step*> pending;
  for (const Step& s : steps) {
    const std::uint64_t now = hash_of(s.target);
    if (now == s.old_hash && hash_of(temporary_name(s.target, s.fresh)) == s.new_hash)
      pending.push_back(&s);
    else if (now != s.new_hash)
      return std::size_t{0};
  }
  std::set<std::string> directories;
  for (const Step* s : pending) {
    if (std::rename(temporary_name(s->target, s->fresh).c_str(), s->target.c_str()) != 0)
      return io_error("cannot finish the interrupted rewriting of", s->target, errno);
    directories.insert(directory_of(s->target));
  }
  for (const std::string& d : directories)
    if (auto flushed = flush_directory(d); !flushed) return flushed.error();
  return pending.size();
}

/// Finishes what the open note says.
Result<FinishedWrite> finish_note(const std::string& name, int fd,
                                  const std::vector<std::string>& tree) {
  struct stat status {};
  if (fd < 0 || fstat(fd, &status) != 0)
    return FinishedWrite{0, name + ": " + std::strerror(errno)};
  std::set<std::string> places;
  for (const std::string& file : tree)
    if (const auto place = follow_links(file)) places.insert(canonical_place(*place));
  const auto steps = read_note(fd, status, places);
  if (!steps) return FinishedWrite{0, name + ": " + steps.error().message};
  if (!lock_file(fd)) return FinishedWrite{};  // its writer is at work
  const auto done = carry_out(*steps);
  if (!done) return done.error();
  for (const Step& s : *steps)
    for (const std::string& suffix : {s.fresh, s.old})
      if (!suffix.empty()) unlink(temporary_name(s.target, suffix).c_str());
  if (const auto left = look(name); left && left->st_ino == status.st_ino) unlink(name.c_str());
  return FinishedWrite{*done, {}};
}

}  // namespace

std::string note_text(const std::vector<Step>& steps) {
  std::string text = std::string(note_head) + "\n";
  for (const Step& s : steps)
    text += fmt::format("{}\t{}\t{:016x}\t{:016x}\t{}\n", s.fresh, s.old.empty() ? "-" : s.old,
                        s.old_hash, s.new_hash, s.target);
  return text + std::string(note_end) + "\n";
}

}  // namespace detail

using namespace detail;

std::optional<std::string> unfinished_note(const std::string& main) {
  const auto target = follow_links(main);
  if (!target) return std::nullopt;
  std::string name = note_name(*target);
  const auto status = look(name);
  if (!status || !is_file_of_user(*status) || (status->st_mode & 07777) != note_mode)
    return std::nullopt;
  return name;
}

Result<FinishedWrite> finish_interrupted_write(const std::string& main,
                                               const std::vector<std::string>& tree) {
  const auto target = follow_links(main);
  const std::string name = target ? note_name(*target) : std::string();
  const auto there = look(name);
  if (!there) return FinishedWrite{};
  if (!S_ISREG(there->st_mode)) return FinishedWrite{0, name + ": it is not a regular file"};
  const int note = open(name.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  auto done = finish_note(name, note, tree);
  if (note >= 0) close(note);
  return done;
}

std::optional<int> temporary_of(std::string_view name) {
  const std::string suffix = suffix_of(name);
  if (!name.starts_with('.') || suffix.empty() || suffix.size() > 20) return std::nullopt;
  return std::atoi(suffix.c_str());
}

bool is_temporary_of(std::string_view name, std::string_view target) {
  return temporary_of(name) && temporary_name(std::string(target), suffix_of(name)) == name;
}

}  // namespace deck
