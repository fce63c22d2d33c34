// What lies beside files while a set of them is put in place: the note ".NAME.unfinished" beside
// the main file, which says what goes where, and temporaries. Private to the edit stage.
#pragma once
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/result.hpp"

namespace deck::detail {

/// One file of a set. Its temporaries are named by their suffix alone ("PID-NUMBER"): they lie
/// beside it and have its name, or are none of ours.
struct Step {
  std::string target;
  std::string fresh;  ///< suffix of the new file
  std::string old;    ///< suffix of the other name of the old file; empty: there is none
  std::uint64_t old_hash = 0, new_hash = 0;  ///< of the contents; old 0: there was no file
};

/// One line a file between a head and an end, so that a note that was cut off is known as such.
std::string note_text(const std::vector<Step>& steps);
/// Name of the note beside a file.
std::string note_name(const std::string& target);
/// Mode of a note: a file of that name that came with an archive or a checkout has another one.
inline constexpr unsigned note_mode = 0600;

/// Name of a temporary beside `path`.
std::string temporary_name(const std::string& path, const std::string& suffix);
/// "PID-NUMBER" of such a name; "" of any other.
std::string suffix_of(std::string_view temporary);
/// "PID-NUMBER" of this process.
std::string own_suffix(int number);

/// Makes a name beside `path` by `make`, which returns 0 or more, or -1 with EEXIST where the name
/// is taken: by another thread, or left by a killed process that had the same number.
template <class Make>
std::optional<std::string> take_temporary(const std::string& path, Make make) {
  for (int number = 0; number < 10000; ++number) {
    std::string name = temporary_name(path, own_suffix(number));
    if (make(name.c_str()) >= 0) return name;
    if (errno != EEXIST) return std::nullopt;
  }
  return std::nullopt;
}

/// A lock on the whole file; false if another program has it or there are no locks.
bool lock_file(int fd);

/// Where a path leads if its last part is a symbolic link (or several); the target need not exist.
Result<std::string> follow_links(const std::string& path);
std::string directory_of(const std::string& path);
/// Absolute, without links except perhaps the last part, which need not exist. Empty: no such
/// directory.
std::string canonical_place(const std::string& path);
/// Flushes what `fd` stands for. File systems without such a thing are no failure.
bool flush(int fd);
Result<void> flush_directory(const std::string& path);
/// "what path: the system's reason"
Error io_error(const std::string& what, const std::string& path, int code);

// attributes.cpp
/// Gives the open file the extended attributes of the file that it will replace, its access list
/// among them, and no other access list. Error: one that cannot be kept.
Result<void> keep_attributes(const std::string& from, int to);
/// Notes on the open file that it was made from `origin`, and of which bytes it consists; nothing
/// where the file system keeps no such notes. See deck::is_unchanged_output.
void note_origin(int fd, std::string_view origin, std::string_view bytes);

}  // namespace deck::detail
