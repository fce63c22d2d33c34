// Writing files so that a crash, a kill or a full disk never leaves a half-written one: the new
// contents are written and flushed beside their place and then renamed into it.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/result.hpp"

namespace deck {

/// A file to be written, alone or as part of a set.
struct OutputFile {
  std::string path;
  std::string_view bytes;
};

struct WriteOptions {
  /// Not empty: a file that is replaced stays as its own name plus this (".orig"). An older file of
  /// that name is replaced.
  std::string backup_suffix;
  bool make_directories = false;  ///< of the path, where missing
  bool sync = true;  ///< flush files and directories to the disk; false: survives a kill of the
                     ///< process, but not surely a loss of power
};

/// Puts one file in place in one step. At any moment, also after a kill, the path holds the old
/// bytes or the new ones, whole. A replaced file keeps its permissions and, where allowed, its
/// owner; a symbolic link stays one and the file it leads to is replaced; devices and pipes are
/// written through; a file that may not be written is not replaced either. Error: the system's
/// reason. The old file is then as it was and nothing is left beside it, unless all that failed is
/// flushing the directory at the end. A kill can leave a hidden file, see is_temporary_of.
Result<void> write_file_atomic(const std::string& path, std::string_view bytes,
                               const WriteOptions& options = {});

/// The same for several files: all of them are written and flushed beside their places before the
/// first is renamed. If a rename fails, those made before are taken back. A kill between two
/// renames leaves some files old and some new, each of them whole, and a note of what is missing;
/// see finish_interrupted_write. Two entries that lead to the same file must have the same bytes.
Result<void> write_files_atomic(const std::vector<OutputFile>& files,
                                const WriteOptions& options = {"", true, true});

/// Finishes a set of files, `path` being one of them, whose writing was killed between two renames:
/// puts the remaining new files in place and removes the note (".NAME.unfinished") that said so.
/// Returns how many files that were; 0 also where nothing was left to do, where the writer is still
/// at work, and where somebody changed a file of the set since: then nothing but the note is
/// removed. Error: a file cannot be put in place.
Result<std::size_t> finish_interrupted_write(const std::string& path);

/// True if `name` is what a killed write of the file `target` (both without directory) left behind:
/// ".TARGET.PID-NUMBER.tmp".
bool is_temporary_of(std::string_view name, std::string_view target);

}  // namespace deck
