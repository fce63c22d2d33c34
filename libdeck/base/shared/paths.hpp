// Paths as text. Every deck has many files, and every file is looked up by its path more than once:
// std::filesystem::path takes its paths apart into a list of strings for that. And what a path that
// leads nowhere was probably meant to be, by the folders on disk.
#pragma once
#include <string>
#include <string_view>

namespace deck {

/// The path without what cancels out ("a/./b//../c" is "a/c"), as path::lexically_normal gives it;
/// no file is asked for. "." where nothing is left of a relative path, "" of "".
std::string normal_path(std::string_view path);

/// normal_path of the path from the root; of the path itself where the working directory cannot be
/// found out.
std::string absolute_path(const std::string& path);

/// What stands before the last separator, as path::parent_path of a normal path: "" of a name
/// alone, "/" of what lies in the root.
std::string_view parent_path(std::string_view path);

/// The path of a file that differs from `path` in the case of its letters only; empty: none.
std::string file_in_other_case(const std::string& path);

/// A file in the folder of `path` whose name is close to that of `path`; empty: none.
std::string similar_file(const std::string& path);

}  // namespace deck
