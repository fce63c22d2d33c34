// What lies beside the files of a set while they are put in place one after the other: the note of
// what goes where (".NAME.unfinished"), and the names of temporaries. Private to the edit stage.
#pragma once
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/result.hpp"

namespace deck::detail {

/// One file of a plan.
struct Step {
  std::string temporary, target;
  std::uint64_t fresh = 0;                              ///< inode of the new file
  std::uint64_t old = 0;                                ///< inode of the file to replace, 0: none
  std::int64_t seconds = 0, nanoseconds = 0, size = 0;  ///< its time and size
};

std::string plan_text(const std::vector<Step>& steps);
/// nullopt: not a whole plan.
std::optional<std::vector<Step>> parse_plan(const std::string& text);
/// Name of the note beside a file.
std::string plan_name(const std::string& target);

/// Mode of a note: a file of that name that came with an archive or a checkout has another one.
inline constexpr unsigned plan_mode = 0600;

/// Name of a temporary beside `path`, of this process.
std::string temporary_name(const std::string& path, int number);

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
