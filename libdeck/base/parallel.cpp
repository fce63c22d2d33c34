// The one place that starts threads: shared loops that carry exceptions and a cancel flag.
#include "base/parallel.hpp"

#include <exception>
#include <new>
#include <system_error>
#include <thread>

namespace deck {

int processors() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

void run_workers(int workers, CancelFlag& cancel, const std::function<void(std::size_t)>& body) {
  if (workers <= 1) {
    body(0);
    return;
  }
  const auto count = static_cast<std::size_t>(workers);
  std::vector<std::exception_ptr> thrown(count);
  const auto guarded = [&](std::size_t worker) noexcept {
    try {
      body(worker);
    } catch (...) {
      thrown[worker] = std::current_exception();
      cancel.set();
    }
  };
  std::vector<std::thread> others;  // the loop in `guarded` throws nothing: all are joined
  others.reserve(count - 1);
  try {
    for (std::size_t w = 1; w < count && !cancel.is_set(); ++w) others.emplace_back(guarded, w);
  } catch (const std::system_error&) {
    // The system has no more threads: those that run do the work.
  } catch (const std::bad_alloc&) {
  }
  guarded(0);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& e : thrown)
    if (e) std::rethrow_exception(e);
}

}  // namespace deck
