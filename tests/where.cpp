// Where the tests find the project, its build and the decks of the corpus.
#include "where.hpp"

#include <cstdlib>

namespace deck::test {

std::filesystem::path source_dir() { return DECK_SOURCE_DIR; }
std::filesystem::path binary_dir() { return DECK_BINARY_DIR; }
std::filesystem::path shared_dir() {
  const char* given = std::getenv("DECK_CORPUS");
  return given != nullptr ? std::filesystem::path(given) : source_dir().parent_path() / "shared";
}

}  // namespace deck::test
