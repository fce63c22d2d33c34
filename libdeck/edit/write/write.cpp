// Temporaries, flushing, exchanging, taking back: one set of files, all or none.
#include "edit/shared/write.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <tuple>

#include "base/shared/paths.hpp"
#include "deck/text/source.hpp"
#include "edit/write/rename.hpp"
#include "edit/write/write_plan.hpp"

namespace deck {
namespace {
namespace fs = std::filesystem;
using namespace detail;

Result<void> write_all(int fd, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t n = write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return io_error("cannot write", path, n == 0 ? EIO : errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

/// All of a file, from its bytes or its pieces.
Result<void> write_contents(int fd, std::string_view bytes, const WritePieces& pieces,
                            const std::string& path) {
  if (!pieces) return write_all(fd, bytes, path);
  return pieces([&](std::string_view piece) { return write_all(fd, piece, path); });
}

Result<void> write_through(const std::string& path, std::string_view bytes,
                           const WritePieces& pieces) {
  const int fd = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) return io_error("cannot open", path, errno);
  Result<void> done = write_contents(fd, bytes, pieces, path);
  if (close(fd) != 0 && done) done = io_error("cannot close", path, errno);
  return done;
}

// ---- files that were read ---------------------------------------------------------------------

/// True if the open file has exactly these bytes.
bool has_bytes(int fd, std::string_view bytes) {
  std::vector<char> buffer(std::size_t{1} << 18);
  for (;;) {
    const ssize_t n = read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return n == 0 && bytes.empty();
    const std::string_view part(buffer.data(), static_cast<std::size_t>(n));
    if (!bytes.starts_with(part)) return false;
    bytes.remove_prefix(part.size());
  }
}

Error changed_since(const std::string& path) {
  return {Error::Code::config, path +
                                   " was changed by another program after it was read; nothing was "
                                   "written. Run the command again"};
}

/// Error: `path` is not the file that was read any more, or has other bytes, or cannot be looked
/// at. `shown` is its name for people.
Result<void> check_as_read(const std::string& path, const FileRead& was, const std::string& shown) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (fd < 0 && errno != ENOENT && errno != ELOOP)
    return io_error("cannot compare with what was read:", shown, errno);
  if (fd < 0) return changed_since(shown);
  struct stat status {};
  const bool same =
      fstat(fd, &status) == 0 && status.st_dev == was.device && status.st_ino == was.inode &&
      static_cast<std::uint64_t>(status.st_size) == was.bytes.size() && has_bytes(fd, was.bytes);
  close(fd);
  if (!same) return changed_since(shown);
  return {};
}

/// True if two paths are one file, or regular files of the same bytes.
bool same_contents(const std::string& a, const std::string& b) {
  struct stat of_a {
  }, of_b{};
  if (lstat(a.c_str(), &of_a) != 0 || lstat(b.c_str(), &of_b) != 0) return false;
  if (of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino) return true;
  if (!S_ISREG(of_a.st_mode) || !S_ISREG(of_b.st_mode) || of_a.st_size != of_b.st_size)
    return false;
  const auto source = Source::open(a, Limits{});
  if (!source) return false;
  return check_as_read(b, {of_b.st_dev, of_b.st_ino, (*source)->bytes()}, b).ok();
}

/// Locks on the directories whose files are rewritten, held while that is done: two programs of
/// this kind never compare and replace at the same time. Where a file system has no locks, or a
/// directory may not be read, there is none.
class DirectoryLocks {
 public:
  DirectoryLocks() = default;
  DirectoryLocks(const DirectoryLocks&) = delete;
  DirectoryLocks& operator=(const DirectoryLocks&) = delete;
  ~DirectoryLocks() {
    for (const int fd : held_) close(fd);
  }

  /// Always in the same order, so that two programs cannot wait for each other for ever.
  Result<void> take(const std::set<std::string>& directories) {
    std::map<std::pair<dev_t, ino_t>, int> by_identity;
    for (const std::string& d : directories) {
      const int fd = open(d.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      struct stat status {};
      if (fd < 0 || fstat(fd, &status) != 0) continue;
      held_.push_back(fd);
      by_identity.emplace(std::pair{status.st_dev, status.st_ino}, fd);
    }
    for (const auto& [identity, fd] : by_identity)
      if (!wait_for(fd))
        return Error{
            Error::Code::config,
            "another program is writing to " + *directories.begin() +
                " (or another directory of these decks) and does not finish; nothing was written"};
    return {};
  }

 private:
  static bool wait_for(int fd) {
    constexpr auto step = std::chrono::milliseconds(20);
    for (int waited = 0; waited < 1000; ++waited) {
      if (flock(fd, LOCK_EX | LOCK_NB) == 0) return true;
      if (errno != EWOULDBLOCK && errno != EINTR) return true;  // no locks here
      std::this_thread::sleep_for(step);
    }
    return false;
  }
  std::vector<int> held_;
};

// ---- sets that are half in place -------------------------------------------------------------
// Several files cannot be renamed in one step. While it is done, a plan lies beside each of them
// (one file with several names) that says what goes where. It is locked as long as its writer
// lives; one that is not locked was left by a kill, and who rewrites the deck next finishes it.

/// A set of files on its way to the disk. Whatever is not committed is taken back by the
/// destructor.
class Transaction {
 public:
  explicit Transaction(const WriteOptions& options) : options_(options) {}
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() {
    if (!committed_) {
      roll_back();
      for (const std::string& b : backups_) unlink(b.c_str());
    }
    for (const std::string& t : temporaries_) unlink(t.c_str());
    for (const std::string& p : plans_) unlink(p.c_str());
    if (plan_ >= 0) close(plan_);
    if (committed_) return;
    // Of the directories made, deepest first; one that is used in the meantime stays.
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
    WritePieces pieces;
    std::optional<FileRead> read;
    std::string origin;
    struct stat old {
    }, fresh{};
    bool exists = false, special = false, placed = false;
  };

  Result<void> make_directories(const std::string& directory);
  Result<void> write_new(Entry& entry);
  Result<void> back_up(const Entry& entry);
  Result<bool> copy_to(const Entry& entry, const std::string& backup);
  Result<void> lay_plan();
  Result<void> place(Entry& entry);
  Result<bool> exchange(Entry& entry);
  void roll_back();
  void forget(const std::string& temporary) {
    const auto it = std::find(temporaries_.begin(), temporaries_.end(), temporary);
    if (it != temporaries_.end()) temporaries_.erase(it);
  }

  const WriteOptions& options_;
  std::vector<Entry> entries_;
  /// (device and inode of the directory, name) -> entry
  std::map<std::tuple<dev_t, ino_t, std::string>, std::size_t> by_target_;
  std::vector<std::string> temporaries_, made_, plans_, backups_;
  DirectoryLocks locks_;
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

/// A link on the way from `directory` to the file would lead it elsewhere.
Result<void> check_way(const std::string& directory, const std::string& path) {
  fs::path at = absolute_path(directory);
  for (const fs::path& part : fs::path(absolute_path(path)).lexically_relative(at)) {
    at /= part;
    std::error_code ec;
    const fs::file_status status = fs::symlink_status(at, ec);
    if (fs::exists(status) && !fs::is_directory(status) && !fs::is_regular_file(status))
      return Error{Error::Code::config,
                   at.string() +
                       (fs::is_symlink(status) ? " is a symbolic link" : " is no regular file") +
                       "; nothing was written. Remove it, or name another directory"};
  }
  return {};
}

Result<void> Transaction::prepare(const OutputFile& file) {
  Entry entry;
  if (!options_.below.empty())
    if (auto clear = check_way(options_.below, file.path); !clear) return clear;
  entry.given = file.path;
  entry.bytes = file.bytes;
  entry.pieces = file.pieces;
  entry.read = file.read;
  entry.origin = file.origin;
  // Before links are followed: those of /proc (/dev/stdout) lead to no path.
  entry.special = options_.follow_links && stat(file.path.c_str(), &entry.old) == 0 &&
                  !S_ISREG(entry.old.st_mode) && !S_ISDIR(entry.old.st_mode);
  auto target = entry.special || !options_.follow_links ? Result<std::string>(file.path)
                                                        : follow_links(file.path);
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
  // A link that is not to be followed, or a pipe in its place, is replaced like no file at all.
  if (lstat(entry.target.c_str(), &entry.old) == 0 &&
      (entry.special || !S_ISLNK(entry.old.st_mode))) {
    if (S_ISDIR(entry.old.st_mode)) return io_error("cannot write", entry.given, EISDIR);
    entry.exists = entry.special || S_ISREG(entry.old.st_mode);
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
    if (auto kept = keep_attributes(entry.target, fd); !kept) {
      close(fd);
      return kept;
    }
  }
  if (auto written = write_contents(fd, entry.bytes, entry.pieces, entry.given); !written) {
    close(fd);
    return written;
  }
  if (!entry.pieces) note_origin(fd, entry.origin, entry.bytes);
  if (options_.sync && !flush(fd)) return fail("cannot flush");
  if (fstat(fd, &entry.fresh) != 0) return fail("cannot look at");
  if (close(fd) != 0) return io_error("cannot close", entry.given, errno);
  return {};
}

/// Copies the old file to a name that is free; false: it is not, or not any more.
Result<bool> Transaction::copy_to(const Entry& entry, const std::string& backup) {
  std::error_code ec;
  const auto name = take_temporary(backup, [&](const char* path) {
    if (fs::copy_file(entry.target, path, ec)) return 0;
    errno = ec.value();
    return -1;
  });
  if (!name) return io_error("cannot make the backup", backup, errno);
  temporaries_.push_back(*name);
  if (const int fd = options_.sync ? open(name->c_str(), O_RDONLY | O_CLOEXEC) : -1; fd >= 0) {
    flush(fd);
    close(fd);
  }
  struct stat status {};
  if (lstat(backup.c_str(), &status) == 0) return false;
  if (rename_if_free(name->c_str(), backup.c_str()) != 0) {
    if (errno == EEXIST) return false;
    if (errno != EINVAL && errno != ENOSYS)
      return io_error("cannot make the backup", backup, errno);
    if (std::rename(name->c_str(), backup.c_str()) != 0)
      return io_error("cannot make the backup", backup, errno);
  }
  forget(*name);
  return true;
}

/// The old file gets a second name; where the file system has no hard links, a copy. A backup that
/// exists is never replaced: unless it has these very bytes, the next free number is taken.
Result<void> Transaction::back_up(const Entry& entry) {
  constexpr int most = 10000;
  for (int number = 1; number < most; ++number) {
    const std::string backup =
        entry.target + options_.backup_suffix + (number == 1 ? "" : "." + std::to_string(number));
    bool made = link(entry.target.c_str(), backup.c_str()) == 0;
    if (!made && errno != EEXIST) {
      const auto copied = copy_to(entry, backup);
      if (!copied) return copied.error();
      made = *copied;
    }
    if (made) {
      backups_.push_back(backup);
      return {};
    }
    if (same_contents(entry.target, backup)) return {};
  }
  return io_error("cannot make the backup", entry.target + options_.backup_suffix, EEXIST);
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
    return plan_ = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, plan_mode);
  });
  if (!name) return io_error("cannot create a file beside", first, errno);
  temporaries_.push_back(*name);
  if (auto written = write_all(plan_, text, first); !written) return written;
  if (options_.sync && !flush(plan_)) return io_error("cannot flush", *name, errno);
  // Without locks an abandoned plan could not be told from one that is being carried out.
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

/// Puts the new file in place of one that was read, and looks at what was taken out: if that is not
/// what was read, it is put back. False: this file system cannot exchange two names.
Result<bool> Transaction::exchange(Entry& entry) {
  const auto swap = [&] {
    return rename_exchanging(entry.temporary.c_str(), entry.target.c_str()) == 0;
  };
  if (!swap()) {
    if (errno == EINVAL || errno == ENOSYS || errno == ENOTSUP) return false;
    if (errno == ENOENT) return changed_since(entry.given);
    return io_error("cannot put in place", entry.given, errno);
  }
  const auto same = check_as_read(entry.temporary, *entry.read, entry.given);
  if (same) {
    entry.former = entry.temporary;  // still among the temporaries: it goes at the end
    entry.placed = true;
    return true;
  }
  if (!swap()) {
    forget(entry.temporary);
    return Error{Error::Code::config, entry.given + " was changed while it was replaced; what " +
                                          "stood there is " + entry.temporary + " now"};
  }
  return same.error();
}

Result<void> Transaction::place(Entry& entry) {
  if (entry.read) {
    if (auto same = check_as_read(entry.target, *entry.read, entry.given); !same) return same;
    const auto exchanged = exchange(entry);
    if (!exchanged) return exchanged.error();
    if (*exchanged) return {};
  }
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
    if (!e->exists) {
      unlink(e->target.c_str());
      continue;
    }
    if (e->former.empty()) continue;
    // Where that fails the old file stays under its other name: it is the only one left.
    (void)std::rename(e->former.c_str(), e->target.c_str());
    forget(e->former);
  }
}

Result<void> Transaction::commit() {
  std::set<std::string> directories;
  for (const Entry& e : entries_)
    if (e.special) {
      if (auto done = write_through(e.target, e.bytes, e.pieces); !done) return done;
    } else {
      directories.insert(directory_of(e.target));
    }
  for (const std::string& d : made_) directories.insert(directory_of(d));
  std::set<std::string> rewritten;
  for (const Entry& e : entries_)
    if (e.read) rewritten.insert(directory_of(e.target));
  if (auto locked = locks_.take(rewritten); !locked) return locked;
  for (const Entry& e : entries_)
    if (e.read)
      if (auto same = check_as_read(e.target, *e.read, e.given); !same) return same;
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

Result<void> write_file_atomic(const std::string& path, const WritePieces& pieces,
                               const WriteOptions& options) {
  return write_set({{path, {}, std::nullopt, pieces}}, options);
}

Result<void> write_files_atomic(const std::vector<OutputFile>& files, const WriteOptions& options) {
  return write_set(files, options);
}

}  // namespace deck
