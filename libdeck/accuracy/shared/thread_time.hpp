// The clock of measurements.
#pragma once
#include <time.h>

namespace deck::accuracy {

// Processor time of this thread in nanoseconds: others on the machine do not count.
inline double thread_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

}  // namespace deck::accuracy
