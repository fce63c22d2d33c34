// Large arrays ask the system for their memory in large pages. A hint only: nothing depends on it.
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

}  // namespace deck
