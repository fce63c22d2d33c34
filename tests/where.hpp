// Where the tests find the project, its build and the decks of the corpus. One file alone is
// compiled with these paths, so that the tests of two clones are the same to a compiler cache.
#pragma once

#include <filesystem>

namespace deck::test {

/// The project's own folder.
std::filesystem::path source_dir();
/// The folder of this build.
std::filesystem::path binary_dir();
/// DECK_CORPUS, else `shared` beside the project. It need not exist.
std::filesystem::path shared_dir();

}  // namespace deck::test
