// A hint to the system to use large pages for large arrays. It has no effect on results.
#pragma once
#include <cstddef>
#include <vector>

namespace deck {

// Requests large pages for begin ... end.
void prefer_large_pages(const void* begin, const void* end);
template <class T>
void prefer_large_pages(const std::vector<T>& vector) {
  prefer_large_pages(vector.data(), vector.data() + vector.capacity());
}

}  // namespace deck
