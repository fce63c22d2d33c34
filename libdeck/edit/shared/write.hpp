// Writing files so that a crash, a kill or a full disk never leaves a half-written one: the new
// contents are written and flushed beside their place and then renamed into it.
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

/// A file as it was when it was read.
struct FileRead {
  std::uint64_t device = 0, inode = 0;
  std::string_view bytes;
};

/// Writes one piece of a file behind those before it. Error: the system's reason.
using WritePiece = std::function<Result<void>(std::string_view)>;
/// Makes the contents of a file that is never held as a whole; passes on the error of a piece.
using WritePieces = std::function<Result<void>(const WritePiece&)>;

/// A file to be written, alone or as part of a set.
struct OutputFile {
  std::string path;
  std::string_view bytes;
  /// Given: the file is replaced only if it still is the one that was read, byte for byte.
  std::optional<FileRead> read = std::nullopt;
  WritePieces pieces = nullptr;  ///< given: called once for the contents, instead of `bytes`
  bool is_main = false;          ///< of a deck: put in place after the others of the set
  /// Not empty: what the contents were made from; kept with the file, see is_unchanged_output.
  std::string origin = {};
};

struct WriteOptions {
  /// Not empty: a file that is replaced stays as its own name plus this (".orig"). A file of that
  /// name is never replaced: unless it has the same bytes, a number is added (".orig.2").
  std::string backup_suffix;
  bool make_directories = false;  ///< of the path, where missing
  /// False: a symbolic link, pipe or device of the name is itself replaced by a regular file.
  bool follow_links = true;
  bool sync = true;  ///< flush files and directories to the disk; false: survives a kill of the
                     ///< process, but not surely a loss of power
  /// Not empty: all files go below this directory. Where a link stands in place of a file or of a
  /// directory below it, or something else that is no regular file, nothing is written.
  std::string below = {};
  /// Where several files are rewritten in place: the note of what is unfinished lies beside this
  /// one, the main file of a deck; empty: beside the last of the set.
  std::string note_beside = {};
};

/// Puts one file in place in one step. At any moment, also after a kill, the path holds the old
/// bytes or the new ones, whole. A replaced file keeps its permissions, its
/// access list and other extended attributes (what cannot be kept is an error) and, where allowed,
/// its owner; a symbolic link stays one and the file it leads to is replaced; devices and pipes are
/// written through; a file that may not be written is not replaced either. Error: the system's
/// reason. The old file is then as it was and nothing is left beside it, unless all that failed is
/// flushing the directory at the end. A kill can leave a hidden file, see is_temporary_of.
Result<void> write_file_atomic(const std::string& path, std::string_view bytes,
                               const WriteOptions& options = {});

/// The same for contents that come piece by piece. Whatever goes wrong, nothing is put in place.
Result<void> write_file_atomic(const std::string& path, const WritePieces& pieces,
                               const WriteOptions& options = {});

/// The same for several files: all of them are written and flushed beside their places before the
/// first is renamed; main files are the last. If a rename fails, those made before are taken back.
/// A kill between two renames leaves some files old and some new, each of them whole, and, if files
/// have `read`, a note of what is missing; see finish_interrupted_write.
///
/// Files with `read` are compared with what was read, under a lock that others who write this way
/// wait for, before any file is replaced and again just before each is. What remains: an edit saved
/// by another program in the instant between comparing and renaming; and an editor that has the old
/// file open and writes into it later writes into a file that has no name any more.
Result<void> write_files_atomic(const std::vector<OutputFile>& files,
                                const WriteOptions& options = {"", true, true, true});

/// True if the file consists of the very bytes that were written to it with this `origin`: nobody
/// has changed it since, and writing it again from the same origin loses nothing. Known from an
/// extended attribute of the file (user.libdeck.origin); where the file system has none, or a copy
/// lost it, false. Links are not followed.
bool is_unchanged_output(const std::string& path, std::string_view origin);

/// Finishes a set of files whose writing was killed between two renames: puts the remaining new
/// files in place, whose number it returns, and removes the note (".NAME.unfinished" beside the
/// main file) that said so. No file is put in place where nothing was left to do, where the writer
/// is still at work, and where somebody changed a file of the set since: then only the note is
/// removed, and the new files beside the old ones.
///
/// It is a note only if it is a regular file (not a link) of the user with the mode that notes get.
/// Error: it is not whole, or would change other files than `tree`, those of the decks that are to
/// be rewritten: then it is left alone; or a file cannot be put in place.
Result<std::size_t> finish_interrupted_write(const std::string& main,
                                             const std::vector<std::string>& tree);

/// The note beside `main` that finish_interrupted_write would read; changes and opens nothing.
std::optional<std::string> unfinished_note(const std::string& main);

/// The number of the process if `name` (without directory) is that of a temporary, which a killed
/// write leaves behind: ".TARGET.PID-NUMBER.tmp".
std::optional<int> temporary_of(std::string_view name);
/// True if it is one of the file `target`.
bool is_temporary_of(std::string_view name, const std::string& target);

}  // namespace deck
