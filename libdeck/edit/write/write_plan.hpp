// What lies beside files while a set of them is put in place: the note ".NAME.unfinished" beside
// the main file, which says what goes where, and temporaries. Private to the edit stage.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text.hpp"

namespace deck::detail {

/// One file of a set. What belongs to it beside it is named by the suffix alone ("PID-NUMBER").
struct Step {
  std::string target;
  std::string suffix;                        ///< of the temporary with the new contents
  std::uint64_t old_hash = 0, new_hash = 0;  ///< of the contents
};

/// One line a file between a head and an end, so that a note that was cut off is known as such.
std::string note_text(const std::vector<Step>& steps);
/// Name of the note beside a file.
std::string note_name(const std::string& target);
/// Mode of a note: a file of that name that came with an archive or a checkout has another one.
inline constexpr unsigned note_mode = 0600;
/// A lock on the whole note; false if another program has it or there are no locks.
bool lock_note(int fd);

/// Name of a temporary beside `path`.
std::string temporary_name(const std::string& path, const std::string& suffix);
/// "PID-NUMBER" of such a name; "" of any other.
std::string suffix_of(std::string_view temporary);
/// The other name that an old file keeps until the whole set is in place.
std::string former_name(const std::string& path, const std::string& suffix);

/// Where a path leads if its last part is a symbolic link (or several); the target need not exist.
Result<std::string> follow_links(const std::string& path);
std::string directory_of(const std::string& path);
bool lies_below(const std::filesystem::path& path, const std::filesystem::path& directory);
/// Flushes what `fd` stands for. File systems without such a thing are no failure.
bool flush(int fd);
Result<void> flush_directory(const std::string& path);
/// "what path: the system's reason"
Error io_error(const std::string& what, const std::string& path, int code);

}  // namespace deck::detail
