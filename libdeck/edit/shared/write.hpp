// Atomic writing: new contents are written and flushed next to the target, then renamed. A crash,
// kill or full disk leaves no half-written file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text.hpp"

namespace deck {

/// Identity and contents of a file when it was read.
struct FileRead {
  std::uint64_t device = 0, inode = 0;
  std::string_view bytes;
};

/// Appends a piece to a file. Error: the system's reason.
using WritePiece = std::function<Result<void>(std::string_view)>;
/// Produces a file that is never whole in memory; passes on errors of the pieces.
using WritePieces = std::function<Result<void>(const WritePiece&)>;

/// A file to be written, alone or as part of a set.
struct OutputFile {
  std::string path;
  std::string_view bytes;
  /// If set, replace the file only if it is still, byte for byte, as read.
  std::optional<FileRead> read = std::nullopt;
  WritePieces pieces = nullptr;  ///< if set: produces the contents instead of `bytes`
  bool is_main = false;          ///< main file of a deck: renamed after the others
  /// If set: source of the contents, stored with the file for is_unchanged_output.
  std::string origin = {};
};

struct WriteOptions {
  /// If set (".orig"): a replaced file is kept under its name plus this. An existing backup stays:
  /// unless its bytes are equal, the new one gets a number (".orig.2").
  std::string backup_suffix;
  bool make_directories = false;  ///< of the path, if missing
  /// False: replaces a symbolic link, pipe or device by a regular file.
  bool follow_links = true;
  bool sync = true;  ///< flush to the disk; false: safe against a kill, not against a loss of power
  /// If set: all files go below this directory; a link or special file there is an error.
  std::string below = {};
  /// Path of the main file next to which the note about unfinished work is written if several files
  /// are rewritten in place; empty: next to the last one.
  std::string note_beside = {};
};

/// Replaces one file in one step: at any moment, also after a kill, the path has the old bytes or
/// the new ones, complete. The new file keeps permissions, access list, extended attributes (an
/// error if impossible) and, if allowed, the owner. A symbolic link stays and its target is
/// replaced; devices and pipes are written directly; a write-protected file is not replaced. Error:
/// the system's reason; the old file is unchanged and nothing is left next to it, unless only the
/// final flush of the directory failed. A kill can leave a hidden file, see is_temporary_of.
Result<void> write_file_atomic(const std::string& path, std::string_view bytes,
                               const WriteOptions& options = {});

/// write_file_atomic for contents in pieces. After any error nothing is replaced.
Result<void> write_file_atomic(const std::string& path, const WritePieces& pieces,
                               const WriteOptions& options = {});

/// write_file_atomic for several files: all are written and flushed before the first rename; main
/// files are renamed last. A failed rename undoes the earlier ones. A kill between two renames
/// leaves some whole files old and some new, and, if files have `read`, a note of the missing ones;
/// see complete_interrupted_write.
///
/// Files with `read` are compared with it under a lock (among programs that write this way), before
/// the first rename and again before each. Not covered: a save by another program between
/// comparison and rename; an editor that keeps the old file open writes to a file without a name.
Result<void> write_files_atomic(const std::vector<OutputFile>& files,
                                const WriteOptions& options = {"", true, true, true});

/// True if the file has exactly the bytes written with this `origin`, so writing it again loses
/// nothing. Stored in an extended attribute (user.libdeck.origin); false if the file system or a
/// copy has lost it. Does not follow links.
bool is_unchanged_output(const std::string& path, std::string_view origin);

/// Completes a set of files whose writing was killed between two renames: renames the remaining
/// files, returns their number, and removes the note (".NAME.unfinished" next to the main file).
/// Renames nothing if nothing is left, if the writer still runs, or if a file of the set has
/// changed: then only the note and the new files are removed.
///
/// Accepts a note only if it is a regular file (no link) of the user with the mode of notes. Error:
/// the note is cut off or names files outside `tree` (files of the decks to be rewritten), and is
/// left alone; or a rename fails.
Result<std::size_t> complete_interrupted_write(const std::string& main,
                                               const std::vector<std::string>& tree);

/// Path of the note that complete_interrupted_write would read; changes and opens nothing.
std::optional<std::string> unfinished_note(const std::string& main);

/// Process number if `name` (without directory) is a temporary of a killed write:
/// ".TARGET.PID-NUMBER.tmp".
std::optional<int> temporary_of(std::string_view name);
bool is_temporary_of(std::string_view name, const std::string& target);

}  // namespace deck
