// Finishing a set of files that a kill left half in place. The note that says what is missing is
// believed only as far as it could have been written here: a regular file of the user, with the
// mode that notes get, that moves temporaries of the right name to the files beside them, and only
// to files of the decks at hand. Everything else of that name is left alone.
#include "edit/write/write_plan.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>

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

namespace {
/// The part of a file's name that its temporaries carry: names end at 255 bytes.
std::string_view stem_of(std::string_view name) { return name.substr(0, 200); }
}  // namespace

std::string temporary_name(const std::string& path, int number) {
  const fs::path p(path);
  return (p.parent_path() / ("." + std::string(stem_of(p.filename().string())) + "." +
                             std::to_string(getpid()) + "-" + std::to_string(number) + ".tmp"))
      .string();
}

std::string plan_name(const std::string& target) {
  const fs::path p(target);
  return (p.parent_path() / ("." + std::string(stem_of(p.filename().string())) + ".unfinished"))
      .string();
}

namespace {
constexpr std::string_view plan_head = "deck unfinished 1", plan_end = "end";
constexpr off_t longest_plan = off_t{16} << 20;
}  // namespace

std::string plan_text(const std::vector<Step>& steps) {
  std::string text = std::string(plan_head) + "\n";
  for (const Step& s : steps) {
    text += s.temporary + "\t" + s.target;
    for (const std::uint64_t n : {s.fresh, s.old}) text += "\t" + std::to_string(n);
    for (const std::int64_t n : {s.seconds, s.nanoseconds, s.size})
      text += "\t" + std::to_string(n);
    text += "\n";
  }
  return text + std::string(plan_end) + "\n";
}

std::optional<std::vector<Step>> parse_plan(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line != plan_head) return std::nullopt;
  std::vector<Step> steps;
  while (std::getline(lines, line)) {
    if (line == plan_end) return steps;
    std::istringstream cells(line);
    Step s;
    if (!std::getline(cells, s.temporary, '\t') || !std::getline(cells, s.target, '\t') ||
        !(cells >> s.fresh >> s.old >> s.seconds >> s.nanoseconds >> s.size))
      return std::nullopt;
    steps.push_back(std::move(s));
  }
  return std::nullopt;
}

bool lock_file(int fd) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(fd, F_SETLK, &whole) == 0;
}

namespace {

bool is_file_of_user(const struct stat& status) {
  return S_ISREG(status.st_mode) && status.st_uid == geteuid();
}

/// What `path` is itself, not what it leads to; nullopt: nothing is there.
std::optional<struct stat> look(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

enum class StepState { pending, placed, overtaken };

/// Outdated: another program changed the file since, so the plan must not be carried out.
StepState state_of(const Step& s) {
  const auto target = look(s.target), temporary = look(s.temporary);
  if (target && target->st_ino == s.fresh) return StepState::placed;
  const bool as_it_was =
      s.old == 0 ? !target
                 : target && S_ISREG(target->st_mode) && target->st_ino == s.old &&
                       target->st_mtim.tv_sec == s.seconds &&
                       target->st_mtim.tv_nsec == s.nanoseconds && target->st_size == s.size;
  const bool ready = temporary && is_file_of_user(*temporary) && temporary->st_ino == s.fresh;
  return as_it_was && ready ? StepState::pending : StepState::overtaken;
}

/// Why a step cannot be one of ours; empty: it can. `tree` holds canonical places.
std::string distrust(const Step& s, const std::set<std::string>& tree) {
  const fs::path temporary(s.temporary), target(s.target);
  const std::string place = canonical_place(s.target);
  if (!target.is_absolute() || place.empty() || !tree.contains(place))
    return "it would write " + s.target + ", which is not a file of the given decks";
  if (canonical_place(s.temporary) !=
      (fs::path(place).parent_path() / temporary.filename()).string())
    return "it would move " + s.temporary + " to another directory";
  if (!is_temporary_of(temporary.filename().string(), target.filename().string()))
    return s.temporary + " is not a valid name for such a file";
  const auto there = look(s.temporary);
  if (there && !is_file_of_user(*there)) return s.temporary + " is not a file of yours";
  return {};
}

/// Removes what a plan that is done with has left, as far as it is what the plan says.
void clean_up(const Step& s, const struct stat& plan) {
  const auto temporary = look(s.temporary);
  // The new file that was not wanted any more; or, behind a file that is in place, the old one.
  const bool fresh = temporary && temporary->st_ino == s.fresh;
  const bool former = temporary && temporary->st_ino == s.old && state_of(s) == StepState::placed;
  if (fresh || former) unlink(s.temporary.c_str());
  const std::string name = plan_name(s.target);
  const auto note = look(name);
  if (note && note->st_ino == plan.st_ino && note->st_dev == plan.st_dev) unlink(name.c_str());
}

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) close(fd);
  }
};

/// What a note says; an error says why it is not believed.
Result<std::vector<Step>> read_plan(int fd, const struct stat& status,
                                    const std::set<std::string>& tree) {
  const auto refuse = [](std::string why) { return Error{Error::Code::config, std::move(why)}; };
  if (!is_file_of_user(status)) return refuse("it is not a file of yours");
  if ((status.st_mode & 07777) != plan_mode) return refuse("its mode is not that of such a note");
  if (status.st_size > longest_plan) return refuse("it is too long");
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t have = 0;
  for (ssize_t n; have < text.size() && (n = read(fd, text.data() + have, text.size() - have)) > 0;)
    have += static_cast<std::size_t>(n);
  text.resize(have);
  auto steps = parse_plan(text);
  if (!steps) return refuse("it is not a whole note");
  for (const Step& s : *steps)
    if (std::string why = distrust(s, tree); !why.empty()) return refuse(std::move(why));
  return std::move(*steps);
}

}  // namespace
}  // namespace detail

using namespace detail;

std::optional<std::string> unfinished_note(const std::string& path) {
  const auto target = follow_links(path);
  if (!target) return std::nullopt;
  std::string name = plan_name(*target);
  const auto status = look(name);
  if (!status || !is_file_of_user(*status) || (status->st_mode & 07777) != plan_mode)
    return std::nullopt;
  return name;
}

Result<FinishedWrite> finish_interrupted_write(const std::string& path,
                                               const std::vector<std::string>& tree) {
  const auto target = follow_links(path);
  if (!target) return FinishedWrite{};
  const std::string plan = plan_name(*target);
  const auto before = look(plan);
  if (!before) return FinishedWrite{};
  if (!S_ISREG(before->st_mode)) return FinishedWrite{0, plan + ": it is not a regular file"};
  const Descriptor note{open(plan.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)};
  struct stat status {};
  if (note.fd < 0 || fstat(note.fd, &status) != 0)
    return FinishedWrite{0, plan + ": " + std::strerror(errno)};
  std::set<std::string> places;
  for (const std::string& file : tree)
    if (const auto place = follow_links(file)) places.insert(canonical_place(*place));
  const auto steps = read_plan(note.fd, status, places);
  if (!steps) return FinishedWrite{0, plan + ": " + steps.error().message};
  if (!lock_file(note.fd)) return FinishedWrite{};  // its writer is at work
  FinishedWrite done;
  bool overtaken = false;
  for (const Step& s : *steps) overtaken = overtaken || state_of(s) == StepState::overtaken;
  std::set<std::string> directories;
  for (const Step& s : *steps) {
    if (overtaken || state_of(s) != StepState::pending) continue;
    if (std::rename(s.temporary.c_str(), s.target.c_str()) != 0)
      return io_error("cannot finish the interrupted rewriting of", s.target, errno);
    directories.insert(directory_of(s.target));
    ++done.files;
  }
  for (const std::string& d : directories)
    if (auto flushed = flush_directory(d); !flushed) return flushed.error();
  for (const Step& s : *steps) clean_up(s, status);
  // The plan may name its files by another way than `path` does.
  if (const auto left = look(plan); left && left->st_ino == status.st_ino) unlink(plan.c_str());
  return done;
}

bool is_temporary_of(std::string_view name, std::string_view target) {
  if (name.size() < 6 || name[0] != '.' || !name.ends_with(".tmp")) return false;
  name.remove_prefix(1);
  name.remove_suffix(4);
  target = stem_of(target);
  if (!name.starts_with(target) || name.substr(target.size(), 1) != ".") return false;
  name.remove_prefix(target.size() + 1);
  const auto dash = name.find('-');
  const auto digits = [](std::string_view s) {
    return !s.empty() && s.find_first_not_of("0123456789") == s.npos;
  };
  return dash != name.npos && digits(name.substr(0, dash)) && digits(name.substr(dash + 1));
}

}  // namespace deck
