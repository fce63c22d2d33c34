#include "deck/edit/write.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>

namespace deck {
namespace {
namespace fs = std::filesystem;

Error io_error(const std::string& what, const std::string& path, int code) {
  return {Error::Code::io, what + " " + path + ": " + std::strerror(code)};
}

/// Where a path leads if its last part is a symbolic link (or several); the target need not exist.
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

/// The part of a file's name that its temporaries carry: names end at 255 bytes.
std::string_view stem_of(std::string_view name) { return name.substr(0, 200); }

std::string temporary_name(const std::string& path, int number) {
  const fs::path p(path);
  return (p.parent_path() / ("." + std::string(stem_of(p.filename().string())) + "." +
                             std::to_string(getpid()) + "-" + std::to_string(number) + ".tmp"))
      .string();
}

/// Makes a name beside `path` by `make`, which returns 0, or -1 with EEXIST where the name is
/// taken: by another thread, or left by a killed process that had the same number.
template <class Make>
std::optional<std::string> take_temporary(const std::string& path, Make make) {
  for (int number = 0; number < 10000; ++number) {
    std::string name = temporary_name(path, number);
    if (make(name.c_str()) >= 0) return name;
    if (errno != EEXIST) return std::nullopt;
  }
  return std::nullopt;
}

Result<void> write_all(int fd, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t n = write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return io_error("cannot write", path, n == 0 ? EIO : errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

/// Flushes what `fd` stands for. File systems without such a thing are no failure.
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

Result<void> write_through(const std::string& path, std::string_view bytes) {
  const int fd = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) return io_error("cannot open", path, errno);
  Result<void> done = write_all(fd, bytes, path);
  if (close(fd) != 0 && done) done = io_error("cannot close", path, errno);
  return done;
}

// ---- sets that are half in place -------------------------------------------------------------
// Several files cannot be renamed in one step. While it is done, a plan lies beside each of them
// (one file with several names) that says what goes where. It is locked as long as its writer
// lives; one that is not locked was left by a kill, and whoever comes next does what it says.

/// One file of a plan.
struct Step {
  std::string temporary, target;
  std::uint64_t fresh = 0;                              ///< inode of the new file
  std::uint64_t old = 0;                                ///< inode of the file to replace, 0: none
  std::int64_t seconds = 0, nanoseconds = 0, size = 0;  ///< its time and size
};

std::string plan_name(const std::string& target) {
  const fs::path p(target);
  return (p.parent_path() / ("." + std::string(stem_of(p.filename().string())) + ".unfinished"))
      .string();
}

constexpr std::string_view plan_head = "deck unfinished 1", plan_end = "end";

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

/// nullopt: not a whole plan.
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

enum class StepState { pending, placed, overtaken };

/// Overtaken: somebody changed the file since, and what the plan says is no longer wanted.
StepState state_of(const Step& s) {
  struct stat target {
  }, temporary{};
  const bool exists = stat(s.target.c_str(), &target) == 0;
  if (exists && target.st_ino == s.fresh) return StepState::placed;
  const bool as_it_was =
      s.old == 0 ? !exists
                 : exists && target.st_ino == s.old && target.st_mtim.tv_sec == s.seconds &&
                       target.st_mtim.tv_nsec == s.nanoseconds && target.st_size == s.size;
  const bool ready = stat(s.temporary.c_str(), &temporary) == 0 && temporary.st_ino == s.fresh;
  return as_it_was && ready ? StepState::pending : StepState::overtaken;
}

/// A lock on the whole file; false if somebody else has it or there are no locks.
bool lock_file(int fd) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(fd, F_SETLK, &whole) == 0;
}

/// A set of files on its way to the disk. Whatever is not committed is taken back by the
/// destructor.
class Transaction {
 public:
  explicit Transaction(const WriteOptions& options) : options_(options) {}
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() {
    if (!committed_) roll_back();
    for (const std::string& t : temporaries_) unlink(t.c_str());
    for (const std::string& p : plans_) unlink(p.c_str());
    if (plan_ >= 0) close(plan_);
    if (committed_) return;
    // Of the directories made, deepest first; one that somebody uses by now stays.
    for (auto d = made_.rbegin(); d != made_.rend(); ++d) rmdir(d->c_str());
  }

  /// Everything up to, but not including, a change of the files themselves.
  Result<void> prepare(const OutputFile& file);
  /// Puts the prepared files in place.
  Result<void> commit();

 private:
  struct Entry {
    std::string given, target, temporary, former;
    std::string_view bytes;
    struct stat old {
    }, fresh{};
    bool exists = false, special = false, placed = false;
  };

  Result<void> make_directories(const std::string& directory);
  Result<void> write_new(Entry& entry);
  Result<void> back_up(const Entry& entry);
  Result<void> lay_plan();
  Result<void> place(Entry& entry);
  void roll_back();
  void forget(const std::string& temporary) {
    const auto it = std::find(temporaries_.begin(), temporaries_.end(), temporary);
    if (it != temporaries_.end()) temporaries_.erase(it);
  }

  const WriteOptions& options_;
  std::vector<Entry> entries_;
  /// (device and inode of the directory, name) -> entry
  std::map<std::tuple<dev_t, ino_t, std::string>, std::size_t> by_target_;
  std::vector<std::string> temporaries_, made_, plans_;
  int plan_ = -1;
  bool committed_ = false;
};

Result<void> Transaction::make_directories(const std::string& directory) {
  std::error_code ec;
  std::vector<std::string> missing;
  for (fs::path p = directory; !p.empty() && !fs::exists(p, ec); p = p.parent_path())
    if (p.has_filename()) missing.push_back(p.string());
  for (auto p = missing.rbegin(); p != missing.rend(); ++p) {
    if (mkdir(p->c_str(), 0777) == 0)
      made_.push_back(*p);
    else if (errno != EEXIST)
      return io_error("cannot make the directory", *p, errno);
  }
  return {};
}

Result<void> Transaction::prepare(const OutputFile& file) {
  Entry entry;
  entry.given = file.path;
  entry.bytes = file.bytes;
  // Before links are followed: those of /proc (/dev/stdout) lead to no path.
  entry.special = stat(file.path.c_str(), &entry.old) == 0 && !S_ISREG(entry.old.st_mode) &&
                  !S_ISDIR(entry.old.st_mode);
  auto target = entry.special ? Result<std::string>(file.path) : follow_links(file.path);
  if (!target) return target.error();
  entry.target = std::move(*target);
  const std::string directory = directory_of(entry.target);
  if (options_.make_directories)
    if (auto made = make_directories(directory); !made) return made;
  struct stat status {};
  if (stat(directory.c_str(), &status) != 0) return io_error("cannot write", entry.given, errno);
  const auto [it, is_new] = by_target_.try_emplace(
      {status.st_dev, status.st_ino, fs::path(entry.target).filename().string()}, entries_.size());
  if (!is_new) {
    if (entries_[it->second].bytes == file.bytes) return {};
    return Error{Error::Code::config, "two different contents would be written to " + entry.target};
  }
  if (stat(entry.target.c_str(), &entry.old) == 0) {
    if (S_ISDIR(entry.old.st_mode)) return io_error("cannot write", entry.given, EISDIR);
    entry.exists = true;
    // A rename would replace a protected file as well; who protects a deck means it.
    if (faccessat(AT_FDCWD, entry.target.c_str(), W_OK, AT_EACCESS) != 0)
      return io_error("cannot write", entry.given, errno);
  }
  if (!entry.special)
    if (auto written = write_new(entry); !written) return written;
  entries_.push_back(std::move(entry));
  return {};
}

Result<void> Transaction::write_new(Entry& entry) {
  int fd = -1;
  // The mode of a file that is replaced is set before it has contents that others must not see.
  const mode_t mode = entry.exists ? 0600 : 0666;
  const auto name = take_temporary(entry.target, [&](const char* path) {
    return fd = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  });
  if (!name) return io_error("cannot create a file beside", entry.given, errno);
  temporaries_.push_back(*name);
  entry.temporary = *name;
  const auto fail = [&](const char* what) {
    const Error error = io_error(what, entry.given, errno);
    close(fd);
    return error;
  };
  if (entry.exists) {
    // Only root may give files away; for others a changed owner is what replacing means.
    if (entry.old.st_uid != geteuid() || entry.old.st_gid != getegid())
      if (fchown(fd, entry.old.st_uid, entry.old.st_gid) != 0 && errno != EPERM && errno != EINVAL)
        return fail("cannot set the owner of");
    if (fchmod(fd, entry.old.st_mode & 07777) != 0) return fail("cannot set the mode of");
  }
  if (auto written = write_all(fd, entry.bytes, entry.given); !written) {
    close(fd);
    return written;
  }
  if (options_.sync && !flush(fd)) return fail("cannot flush");
  if (fstat(fd, &entry.fresh) != 0) return fail("cannot look at");
  if (close(fd) != 0) return io_error("cannot close", entry.given, errno);
  return {};
}

/// The old file gets a second name; where the file system has no hard links, a copy.
Result<void> Transaction::back_up(const Entry& entry) {
  const std::string backup = entry.target + options_.backup_suffix;
  std::error_code ec;
  if (fs::is_directory(backup, ec)) return io_error("cannot write", backup, EISDIR);
  auto name =
      take_temporary(backup, [&](const char* path) { return link(entry.target.c_str(), path); });
  if (!name) {
    name = take_temporary(backup, [&](const char* path) {
      if (fs::copy_file(entry.target, path, ec)) return 0;
      errno = ec.value();
      return -1;
    });
    if (!name) return io_error("cannot make the backup", backup, errno);
    if (const int fd = options_.sync ? open(name->c_str(), O_RDONLY | O_CLOEXEC) : -1; fd >= 0) {
      flush(fd);
      close(fd);
    }
  }
  temporaries_.push_back(*name);
  if (std::rename(name->c_str(), backup.c_str()) != 0)
    return io_error("cannot make the backup", backup, errno);
  // Renaming one name of a file to another name of the same file does nothing: the first one would
  // stay. It happens when a killed write is repeated.
  unlink(name->c_str());
  forget(*name);
  return {};
}

Result<void> Transaction::lay_plan() {
  std::vector<Step> steps;
  bool replaces = false;
  for (const Entry& e : entries_) {
    if (e.special) continue;
    replaces = replaces || e.exists;
    std::error_code ec;
    Step s{fs::absolute(e.temporary, ec).string(),
           fs::absolute(e.target, ec).string(),
           e.fresh.st_ino,
           e.exists ? e.old.st_ino : 0,
           e.exists ? e.old.st_mtim.tv_sec : 0,
           e.exists ? e.old.st_mtim.tv_nsec : 0,
           e.exists ? e.old.st_size : 0};
    if ((s.temporary + s.target).find_first_of("\t\n") != std::string::npos) return {};
    steps.push_back(std::move(s));
  }
  if (steps.size() < 2 || !replaces) return {};
  const std::string text = plan_text(steps);
  const std::string& first = steps.front().target;
  const auto name = take_temporary(first, [&](const char* path) {
    return plan_ = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  });
  if (!name) return io_error("cannot create a file beside", first, errno);
  temporaries_.push_back(*name);
  if (auto written = write_all(plan_, text, first); !written) return written;
  if (options_.sync && !flush(plan_)) return io_error("cannot flush", *name, errno);
  // Without locks nobody could tell a plan that was left from one that is being carried out.
  if (!lock_file(plan_)) return {};
  for (const Step& s : steps) {
    const auto second =
        take_temporary(s.target, [&](const char* path) { return link(name->c_str(), path); });
    if (!second) continue;  // no hard links here: then one name less leads to the plan
    temporaries_.push_back(*second);
    plans_.push_back(plan_name(s.target));
    if (std::rename(second->c_str(), plans_.back().c_str()) != 0)
      return io_error("cannot make", plans_.back(), errno);
    forget(*second);
  }
  return {};
}

Result<void> Transaction::place(Entry& entry) {
  if (entry.exists && entries_.size() > 1) {
    // To be able to go back. Without hard links that is not possible, and not needed for one file.
    const auto former = take_temporary(
        entry.target, [&](const char* path) { return link(entry.target.c_str(), path); });
    if (former) {
      temporaries_.push_back(*former);
      entry.former = *former;
    }
  }
  if (std::rename(entry.temporary.c_str(), entry.target.c_str()) != 0)
    return io_error("cannot put in place", entry.given, errno);
  forget(entry.temporary);
  entry.placed = true;
  return {};
}

void Transaction::roll_back() {
  for (auto e = entries_.rbegin(); e != entries_.rend(); ++e) {
    if (!e->placed) continue;
    if (!e->exists)
      unlink(e->target.c_str());
    else if (!e->former.empty() && std::rename(e->former.c_str(), e->target.c_str()) == 0)
      forget(e->former);
  }
}

Result<void> Transaction::commit() {
  std::set<std::string> directories;
  for (const Entry& e : entries_)
    if (e.special) {
      if (auto done = write_through(e.target, e.bytes); !done) return done;
    } else {
      directories.insert(directory_of(e.target));
    }
  for (const std::string& d : made_) directories.insert(directory_of(d));
  if (!options_.backup_suffix.empty())
    for (const Entry& e : entries_)
      if (e.exists && !e.special)
        if (auto done = back_up(e); !done) return done;
  if (auto done = lay_plan(); !done) return done;
  if (options_.sync && !plans_.empty())
    for (const std::string& d : directories)
      if (auto done = flush_directory(d); !done) return done;
  for (Entry& e : entries_)
    if (!e.special)
      if (auto done = place(e); !done) return done;
  committed_ = true;
  if (options_.sync)
    for (const std::string& d : directories)
      if (auto done = flush_directory(d); !done) return done;
  return {};
}

Result<void> write_set(const std::vector<OutputFile>& files, const WriteOptions& options) {
  Transaction transaction(options);
  for (const OutputFile& f : files)
    if (auto prepared = transaction.prepare(f); !prepared) return prepared;
  return transaction.commit();
}

}  // namespace

Result<void> write_file_atomic(const std::string& path, std::string_view bytes,
                               const WriteOptions& options) {
  return write_set({{path, bytes}}, options);
}

Result<void> write_files_atomic(const std::vector<OutputFile>& files, const WriteOptions& options) {
  return write_set(files, options);
}

Result<std::size_t> finish_interrupted_write(const std::string& path) {
  const auto target = follow_links(path);
  if (!target) return std::size_t{0};
  const std::string plan = plan_name(*target);
  const int fd = open(plan.c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0) return std::size_t{0};
  struct Closer {
    int fd;
    ~Closer() { close(fd); }
  } closer{fd};
  if (!lock_file(fd)) return std::size_t{0};
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(fd, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  const auto steps = parse_plan(text);
  std::size_t pending = 0;
  bool overtaken = !steps;
  for (const Step& s : steps.value_or(std::vector<Step>{})) {
    const StepState state = state_of(s);
    pending += state == StepState::pending ? 1 : 0;
    overtaken = overtaken || state == StepState::overtaken;
  }
  std::set<std::string> directories;
  if (!overtaken) {
    for (const Step& s : *steps) {
      directories.insert(directory_of(s.target));
      if (state_of(s) == StepState::pending &&
          std::rename(s.temporary.c_str(), s.target.c_str()) != 0)
        return io_error("cannot finish the interrupted rewriting of", s.target, errno);
    }
    for (const std::string& d : directories)
      if (auto done = flush_directory(d); !done) return done.error();
  }
  for (const Step& s : steps.value_or(std::vector<Step>{})) {
    unlink(s.temporary.c_str());
    if (const std::string other = plan_name(s.target); other != plan) unlink(other.c_str());
  }
  unlink(plan.c_str());
  return overtaken ? 0 : pending;
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
