// Writes a set of files, all or none. Steps: (1) write each new file as a temporary next to its
// target, with the mode and attributes of the old one, and flush it; (2) lock the directories and
// compare the old files with the bytes that were read; (3) make backups; (4) write the note
// ".NAME.unfinished" with the list of renames; (5) give each old file a second name; (6) per file
// compare again and rename, main files last; (7) flush the directories, remove note and second
// names. An error before the end of step 6 undoes all steps (~Transaction). After a kill the note
// allows complete_interrupted_write (write_plan.cpp) to do the remaining renames.
#include "edit/shared/write.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <thread>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "deck/text.hpp"
#include "edit/write/write_plan.hpp"

#if __has_include(<sys/xattr.h>) && defined(__linux__)
#include <sys/xattr.h>
#define DECK_FILE_ATTRIBUTES 1
#endif

namespace deck {
namespace fs = std::filesystem;
using namespace detail;

// ---- extended attributes: kept from the replaced file; origin of a result -----------------------

#ifdef DECK_FILE_ATTRIBUTES
namespace {

constexpr const char* origin_note = "user.libdeck.origin";
constexpr const char* access_list = "system.posix_acl_access";

/// Value of `get(buffer, size)`, which returns its size; nullopt if none.
template <class Get>
std::optional<std::string> attribute_of(const Get& get) {
  std::string value(65536, '\0');  // Linux's maximum
  const ssize_t size = get(value.data(), value.size());
  if (size < 0) return std::nullopt;
  value.resize(static_cast<std::size_t>(size));
  return value;
}

std::string note_of(std::string_view origin, std::string_view bytes) {
  return fmt::format("{:016x} {}", content_hash(bytes), origin);
}

/// Copies the extended attributes of the file to be replaced, access list included, and removes any
/// other access list. Error: one cannot be kept.
Result<void> keep_attributes(const std::string& from, int to) {
  const auto names =
      attribute_of([&](char* b, std::size_t n) { return llistxattr(from.c_str(), b, n); });
  if (!names) return {};  // the file system has none
  bool listed = false;
  for (std::size_t at = 0; at < names->size(); at += std::strlen(names->c_str() + at) + 1) {
    const char* const name = names->c_str() + at;
    listed = listed || std::string_view(name) == access_list;
    const auto old =
        attribute_of([&](char* b, std::size_t n) { return lgetxattr(from.c_str(), name, b, n); });
    const auto fresh =
        attribute_of([&](char* b, std::size_t n) { return fgetxattr(to, name, b, n); });
    if (old && old != fresh && fsetxattr(to, name, old->data(), old->size(), 0) != 0)
      return io_error("cannot keep " + std::string(name) + " of", from, errno);
  }
  // The directory may have given the new file an access list.
  if (!listed && fremovexattr(to, access_list) != 0 && errno != ENODATA && errno != ENOTSUP)
    return io_error("cannot keep the permissions of", from, errno);
  return {};
}

/// Stores `origin` and a hash of the bytes on the open file, if the file system can. See
/// deck::is_unchanged_output.
void note_origin(int fd, std::string_view origin, std::string_view bytes) {
  const std::string note = note_of(origin, bytes);
  // Failure is harmless: the file then counts as changed.
  if (!origin.empty() && fsetxattr(fd, origin_note, note.data(), note.size(), 0) != 0) return;
}

}  // namespace

bool is_unchanged_output(const std::string& path, std::string_view origin) {
  const auto note = attribute_of(
      [&](char* b, std::size_t n) { return lgetxattr(path.c_str(), origin_note, b, n); });
  if (origin.empty() || !note || !note->ends_with(origin)) return false;
  const auto source = Source::open(path, Limits{});
  return source && *note == note_of(origin, (*source)->bytes());
}
#else
namespace {
Result<void> keep_attributes(const std::string&, int) { return {}; }
void note_origin(int, std::string_view, std::string_view) {}
}  // namespace
bool is_unchanged_output(const std::string&, std::string_view) { return false; }
#endif

// ---- one set of files --------------------------------------------------------------------------

namespace {

Result<void> write_all(int fd, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t n = write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return io_error("cannot write", path, n == 0 ? EIO : errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

/// Writes bytes or pieces.
Result<void> write_contents(int fd, const OutputFile& file) {
  if (!file.pieces) return write_all(fd, file.bytes, file.path);
  return file.pieces([&](std::string_view piece) { return write_all(fd, piece, file.path); });
}

Result<void> write_through(const OutputFile& file) {
  const int fd = open(file.path.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) return io_error("cannot open", file.path, errno);
  Result<void> done = write_contents(fd, file);
  if (close(fd) != 0 && done) done = io_error("cannot close", file.path, errno);
  return done;
}

/// Error: `path` is no longer the file that was read, has other bytes, or cannot be read. `shown`
/// is its name in messages.
Result<void> check_as_read(const std::string& path, const FileRead& was, const std::string& shown) {
  const auto now = Source::open(path, Limits{});
  struct stat status {};
  if (!now && lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
    return Error{Error::Code::io, "cannot compare with what was read: " + now.error().message};
  if (!now || (*now)->device() != was.device || (*now)->inode() != was.inode ||
      (*now)->bytes() != was.bytes)
    return Error{Error::Code::config, shown +
                                          " was changed by another program after it was read; "
                                          "nothing was written. Run the command again"};
  return {};
}

bool same_contents(const std::string& a, const std::string& b) {
  const auto of_a = Source::open(a, Limits{}), of_b = Source::open(b, Limits{});
  return of_a && of_b && (*of_a)->bytes() == (*of_b)->bytes();
}

/// Waits for a lock; false after the time limit.
bool wait_for_lock(int fd) {
  for (int waited = 0; waited < 1000; ++waited) {
    if (flock(fd, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK && errno != EINTR) return true;  // no locks on this file system
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

/// Creates a file next to `path` and sets its name; -1: see errno.
int make_temporary(const std::string& path, mode_t mode, std::string& name) {
  int fd = -1;
  // Names may be taken by other threads or by remains of a killed process of this number.
  for (int number = 0; number < 10000; ++number) {
    name = temporary_name(path, std::to_string(getpid()) + "-" + std::to_string(number));
    fd = open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (fd >= 0 || errno != EEXIST) break;
  }
  return fd;
}

/// A set of files being written. The destructor undoes everything not committed.
class Transaction {
 public:
  explicit Transaction(const WriteOptions& options) : options_(options) {}
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();

  /// Every step before the files themselves change.
  Result<void> prepare(const OutputFile& file);
  /// Renames the prepared files.
  Result<void> commit();

 private:
  struct PreparedFile {
    const OutputFile* file = nullptr;
    std::string target;          ///< links resolved, unless they are replaced
    std::string temporary = {};  ///< the new file, until renamed
    std::string former = {};     ///< second name of the old file
    struct stat old {};
    bool exists = false, special = false, placed = false;
  };

  Result<void> make_directories(const std::string& directory);
  Result<void> lock_directories();
  Result<void> check_as_prepared(const PreparedFile& entry) const;
  Result<void> write_new(PreparedFile& entry);
  Result<void> back_up(const PreparedFile& entry);
  Result<void> write_note();
  Result<void> place(PreparedFile& entry);
  Result<void> flush_directories() const;

  const WriteOptions& options_;
  std::vector<PreparedFile> entries_;
  std::vector<std::string> made_, backups_;
  std::vector<int> locks_;
  std::string note_;
  int note_file_ = -1;
  bool committed_ = false;
};

Transaction::~Transaction() {
  for (auto e = entries_.rbegin(); e != entries_.rend(); ++e) {
    if (!committed_ && e->placed && !e->exists) unlink(e->target.c_str());
    if (!committed_ && e->placed && !e->former.empty()) {
      // If this fails the old file keeps its second name, its only one.
      (void)std::rename(e->former.c_str(), e->target.c_str());
      e->former.clear();
    }
    for (const std::string& name : {e->temporary, e->former})
      if (!name.empty()) unlink(name.c_str());
  }
  for (const std::string& b : backups_)
    if (!committed_) unlink(b.c_str());
  if (!note_.empty()) unlink(note_.c_str());
  if (note_file_ >= 0) close(note_file_);
  for (const int lock : locks_) close(lock);
  // Created directories, deepest first; one that is in use stays.
  for (auto d = made_.rbegin(); d != made_.rend() && !committed_; ++d) rmdir(d->c_str());
}

Result<void> Transaction::make_directories(const std::string& directory) {
  std::error_code ec;
  std::vector<std::string> missing;
  for (fs::path p = directory; !p.empty() && !fs::exists(p, ec); p = p.parent_path())
    if (p.has_filename()) missing.push_back(p.string());
  made_.insert(made_.end(), missing.rbegin(), missing.rend());
  fs::create_directories(directory, ec);
  if (ec) return io_error("cannot make the directory", directory, ec.value());
  return {};
}

/// Locks the directories of files that are rewritten or written below one directory: two such
/// programs never compare and replace at once. No lock if the file system has none or a directory
/// is not readable. All programs lock in the same order: no deadlock.
Result<void> Transaction::lock_directories() {
  std::set<std::string> directories;
  for (const PreparedFile& e : entries_)
    if (!e.special && (e.file->read || !options_.below.empty()))
      directories.insert(directory_of(e.target));
  for (const std::string& d : directories) {
    const int fd = open(d.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) continue;
    locks_.push_back(fd);
    if (!wait_for_lock(fd))
      return Error{Error::Code::config, "another program is writing to " + d +
                                            " and does not finish; nothing was written"};
  }
  return {};
}

/// Error: another program has replaced a file without `read` since it was prepared.
Result<void> Transaction::check_as_prepared(const PreparedFile& entry) const {
  struct stat now {};
  if (lstat(entry.target.c_str(), &now) != 0) return {};
  const struct stat& was = entry.old;  // zero: did not exist
  if (now.st_dev == was.st_dev && now.st_ino == was.st_ino &&
      now.st_mtim.tv_sec == was.st_mtim.tv_sec && now.st_mtim.tv_nsec == was.st_mtim.tv_nsec)
    return {};
  if (same_contents(entry.target, entry.temporary)) return {};
  return Error{Error::Code::config, "another program wrote " + entry.file->path +
                                        " at the same time; nothing was written. Run the command "
                                        "again, or name another directory"};
}

/// Error: a link between `directory` and the file would lead elsewhere.
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
  if (!options_.below.empty())
    if (auto clear = check_way(options_.below, file.path); !clear) return clear;
  PreparedFile entry{&file, file.path};
  // Before links are resolved: those of /proc (/dev/stdout) have no target path.
  entry.special = options_.follow_links && stat(file.path.c_str(), &entry.old) == 0 &&
                  !S_ISREG(entry.old.st_mode) && !S_ISDIR(entry.old.st_mode);
  if (!entry.special && options_.follow_links) {
    auto target = follow_links(file.path);
    if (!target) return target.error();
    entry.target = std::move(*target);
  }
  const std::string directory = directory_of(entry.target);
  if (options_.make_directories)
    if (auto made = make_directories(directory); !made) return made;
  std::error_code ec;
  entry.target = (fs::canonical(directory, ec) / fs::path(entry.target).filename()).string();
  if (ec) return io_error("cannot write", file.path, ec.value());
  // A link not to be followed, or a pipe in its place, counts as absent.
  if (lstat(entry.target.c_str(), &entry.old) == 0 &&
      (entry.special || !S_ISLNK(entry.old.st_mode))) {
    if (S_ISDIR(entry.old.st_mode)) return io_error("cannot write", file.path, EISDIR);
    entry.exists = entry.special || S_ISREG(entry.old.st_mode);
    // A rename would replace a write-protected file: refuse.
    if (faccessat(AT_FDCWD, entry.target.c_str(), W_OK, AT_EACCESS) != 0)
      return io_error("cannot write", file.path, errno);
  }
  entries_.push_back(std::move(entry));
  return entries_.back().special ? Result<void>() : write_new(entries_.back());
}

Result<void> Transaction::write_new(PreparedFile& entry) {
  const OutputFile& file = *entry.file;
  // The mode of a replaced file is set before the contents are written: others must not read them.
  std::string name;
  const int fd = make_temporary(entry.target, entry.exists ? 0600 : 0666, name);
  if (fd < 0) return io_error("cannot create a file beside", file.path, errno);
  entry.temporary = name;
  const auto fill = [&]() -> Result<void> {
    if (entry.exists) {
      // Only root may change owners; for others a new owner is accepted.
      if (entry.old.st_uid != geteuid() || entry.old.st_gid != getegid())
        if (fchown(fd, entry.old.st_uid, entry.old.st_gid) != 0 && errno != EPERM &&
            errno != EINVAL)
          return io_error("cannot set the owner of", file.path, errno);
      if (fchmod(fd, entry.old.st_mode & 07777) != 0)
        return io_error("cannot set the mode of", file.path, errno);
      if (auto kept = keep_attributes(entry.target, fd); !kept) return kept;
    }
    if (auto written = write_contents(fd, file); !written) return written;
    if (!file.pieces) note_origin(fd, file.origin, file.bytes);
    if (options_.sync && !flush(fd)) return io_error("cannot flush", file.path, errno);
    return {};
  };
  Result<void> done = fill();
  if (close(fd) != 0 && done) done = io_error("cannot close", file.path, errno);
  return done;
}

/// Gives the old file a second name, or copies it if there are no hard links. An existing backup is
/// never replaced: unless its bytes are equal, takes the next free number.
Result<void> Transaction::back_up(const PreparedFile& entry) {
  for (int number = 1; number < 10000; ++number) {
    const std::string backup =
        entry.target + options_.backup_suffix + (number == 1 ? "" : "." + std::to_string(number));
    Result<void> made;
    if (link(entry.target.c_str(), backup.c_str()) != 0) {
      struct stat status {};
      if (errno == EEXIST || lstat(backup.c_str(), &status) == 0) {
        if (same_contents(entry.target, backup)) return {};
        continue;
      }
      const auto old = Source::open(entry.target, Limits{});
      made = old ? write_file_atomic(backup, (*old)->bytes()) : Result<void>(old.error());
    }
    if (made) backups_.push_back(backup);
    return made;
  }
  return io_error("cannot make the backup", entry.target + options_.backup_suffix, EEXIST);
}

/// Writes the note of the renames of decks rewritten in place. Its writer keeps it locked: an
/// unlocked note is the remains of a kill.
Result<void> Transaction::write_note() {
  std::vector<RenameStep> steps;
  for (const PreparedFile& e : entries_) {
    if (!e.file->read || e.target.find_first_of("\t\n") != std::string::npos) return {};
    steps.push_back({e.target, suffix_of(e.temporary), content_hash(e.file->read->bytes),
                     content_hash(e.file->bytes)});
  }
  const auto main = follow_links(options_.note_beside.empty() ? entries_.back().file->path
                                                              : options_.note_beside);
  if (!main) return main.error();
  const std::string note = note_name(*main);
  std::string name;
  note_file_ = make_temporary(*main, note_mode, name);
  if (note_file_ < 0) return io_error("cannot create a file beside", *main, errno);
  Result<void> done = write_all(note_file_, note_text(steps), *main);
  if (done && options_.sync && !flush(note_file_)) done = io_error("cannot flush", name, errno);
  // Without locks an abandoned note looks like that of a running writer.
  if (done && lock_note(note_file_)) {
    if (std::rename(name.c_str(), note.c_str()) == 0) {
      note_ = note;
      return {};
    }
    done = io_error("cannot make", note, errno);
  }
  unlink(name.c_str());
  return done;
}

Result<void> Transaction::place(PreparedFile& entry) {
  if (const auto& read = entry.file->read)
    if (auto same = check_as_read(entry.target, *read, entry.file->path); !same) return same;
  if (std::rename(entry.temporary.c_str(), entry.target.c_str()) != 0)
    return io_error("cannot put in place", entry.file->path, errno);
  entry.temporary.clear();  // the name is free again
  entry.placed = true;
  return {};
}

Result<void> Transaction::flush_directories() const {
  if (!options_.sync) return {};
  std::set<std::string> directories;
  for (const PreparedFile& e : entries_)
    if (!e.special) directories.insert(directory_of(e.target));
  for (const std::string& d : made_) directories.insert(directory_of(d));
  for (const std::string& d : directories)
    if (auto done = flush_directory(d); !done) return done;
  return {};
}

Result<void> Transaction::commit() {
  // Until the main file is renamed, a reader gets the old deck or an error.
  std::stable_partition(entries_.begin(), entries_.end(),
                        [](const PreparedFile& e) { return !e.file->is_main; });
  for (const PreparedFile& e : entries_)
    if (e.special)
      if (auto done = write_through(*e.file); !done) return done;
  const bool rewrites = std::any_of(entries_.begin(), entries_.end(),
                                    [](const PreparedFile& e) { return e.file->read.has_value(); });
  if (auto locked = lock_directories(); !locked) return locked;
  for (const PreparedFile& e : entries_) {
    if (e.special) continue;
    Result<void> same;
    if (e.file->read)
      same = check_as_read(e.target, *e.file->read, e.file->path);
    else if (!options_.below.empty())
      same = check_as_prepared(e);
    if (!same) return same;
  }
  for (const PreparedFile& e : entries_)
    if (!options_.backup_suffix.empty() && e.exists && !e.special)
      if (auto done = back_up(e); !done) return done;
  if (entries_.size() > 1) {
    if (rewrites)
      if (auto done = write_note(); !done) return done;
    // For undo; impossible without hard links.
    for (PreparedFile& e : entries_)
      if (const std::string name = former_name(e.target, suffix_of(e.temporary));
          e.exists && !e.special && link(e.target.c_str(), name.c_str()) == 0)
        e.former = name;
    if (rewrites)
      if (auto done = flush_directories(); !done) return done;
  }
  for (PreparedFile& e : entries_)
    if (!e.special)
      if (auto done = place(e); !done) return done;
  committed_ = true;
  return flush_directories();
}

}  // namespace

Result<void> write_file_atomic(const std::string& path, std::string_view bytes,
                               const WriteOptions& options) {
  return write_files_atomic({{path, bytes}}, options);
}

Result<void> write_file_atomic(const std::string& path, const WritePieces& pieces,
                               const WriteOptions& options) {
  return write_files_atomic({{path, {}, std::nullopt, pieces}}, options);
}

Result<void> write_files_atomic(const std::vector<OutputFile>& files, const WriteOptions& options) {
  Transaction transaction(options);
  for (const OutputFile& f : files)
    if (auto prepared = transaction.prepare(f); !prepared) return prepared;
  return transaction.commit();
}

}  // namespace deck
