// Files next to targets while a set is written: the note ".NAME.unfinished" next to the main file,
// which lists the renames, and temporaries.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text.hpp"

namespace deck::detail {

/// A file of a set. `suffix` ("PID-NUMBER") identifies its temporary and second name.
struct RenameStep {
  std::string target;
  std::string suffix;                        ///< of the temporary with the new contents
  std::uint64_t old_hash = 0, new_hash = 0;  ///< of the contents
};

/// One line per file between a head and an end line: a note that is cut off is detected.
std::string note_text(const std::vector<RenameStep>& steps);
std::string note_name(const std::string& target);
/// Files of that name from an archive or a checkout have another mode.
inline constexpr unsigned note_mode = 0600;
/// Locks the whole note; false if another program has the lock or there are no locks.
bool lock_note(int fd);

/// Name of a temporary next to `path`.
std::string temporary_name(const std::string& path, const std::string& suffix);
/// "PID-NUMBER" of such a name; else "".
std::string suffix_of(std::string_view temporary);
/// Second name of an old file until the set is complete.
std::string former_name(const std::string& path, const std::string& suffix);

/// Target of a symbolic link (or chain); it need not exist.
Result<std::string> follow_links(const std::string& path);
std::string directory_of(const std::string& path);
bool lies_below(const std::filesystem::path& path, const std::filesystem::path& directory);
/// Flushes `fd`. True also if the file system cannot flush.
bool flush(int fd);
Result<void> flush_directory(const std::string& path);
/// "what path: the system's reason"
Error io_error(const std::string& what, const std::string& path, int code);

}  // namespace deck::detail
