// Large arrays get their memory before they are filled, by all threads: otherwise the one that
// fills them asks the system page by page. Hints only: nothing depends on them.
#pragma once
#include <cstddef>
#include <vector>

namespace deck {

// Asks for large pages behind begin ... end.
void prefer_large_pages(const void* begin, const void* end);
template <class T>
void prefer_large_pages(const std::vector<T>& vector) {
  prefer_large_pages(vector.data(), vector.data() + vector.capacity());
}

// Has the system provide the pages begin ... end, all of which will be written, on up to
// `threads` threads.
void populate_pages(void* begin, void* end, int threads);

// Reserves room for `count` items in all, which will all be used.
template <class T>
void make_room(std::vector<T>& vector, std::size_t count, int threads) {
  if (count <= vector.capacity()) return;
  vector.reserve(count);
  prefer_large_pages(vector);
  populate_pages(vector.data() + vector.size(), vector.data() + count, threads);
}

}  // namespace deck
