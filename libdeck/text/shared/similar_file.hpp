// What a path that leads nowhere was probably meant to be. Looks into folders on disk.
#pragma once
#include <string>

namespace deck {

/// The path of a file that differs from `path` in the case of its letters only; empty: none.
std::string file_in_other_case(const std::string& path);

/// A file in the folder of `path` whose name is close to that of `path`; empty: none.
std::string similar_file(const std::string& path);

}  // namespace deck
