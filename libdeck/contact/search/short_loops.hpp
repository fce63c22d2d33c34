// When a loop is so short that another thread would cost more than it saves.
#pragma once

#include <cstddef>

namespace deck {

// Threads for a loop that does little for each of `count` things. A thread takes as long to start
// as some thousand of them, and to wait for it where other programs have the processors much
// longer.
inline int threads_for(std::size_t count, int threads) { return count < 32768 ? 1 : threads; }

}  // namespace deck
