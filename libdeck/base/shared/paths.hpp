// Paths as text, without std::filesystem::path, which is slow for the many look-ups of files in a
// deck. Also finds a similar file for a path that does not exist.
#pragma once
#include <string>
#include <string_view>

namespace deck {

/// Removes redundant components: "a/./b//../c" becomes "a/c", as path::lexically_normal does,
/// without disk access. A relative path of nothing is ".", "" stays "".
std::string normal_path(std::string_view path);

/// normal_path of the absolute path; of the path itself if the working directory is unknown.
std::string absolute_path(const std::string& path);

/// Text before the last separator of a normal path: "" for a plain name, "/" for a file in the
/// root.
std::string_view parent_path(std::string_view path);

/// Path of a file whose name differs only in case; empty: none.
std::string file_in_other_case(const std::string& path);

/// Path of a file with a similar name in the folder; empty: none.
std::string similar_file(const std::string& path);

}  // namespace deck
