// What the program as WebAssembly cannot know of itself.
#include "batch/record.hpp"

namespace deck::cli {

/// A module has no file that it could name: what was measured once is measured again.
std::string program_identity() { return {}; }

}  // namespace deck::cli
