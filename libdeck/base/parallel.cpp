// Thread loops with exceptions and cancellation, and the request for large memory pages. Only this
// file starts threads.
#include "base/shared/parallel.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include "base/shared/pages.hpp"

namespace deck {

int processors() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

namespace {

/// Counts the threads of one call that are inside its body. It is shared with the caller, who may
/// return only when nobody is inside.
class Gate {
 public:
  bool enter() {
    const std::lock_guard lock(mutex_);
    inside_ += !closed_;
    return !closed_;
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    if (--inside_ == 0) empty_.notify_all();
  }
  /// Lets no further thread in and waits for those inside.
  void close() {
    std::unique_lock lock(mutex_);
    closed_ = true;
    empty_.wait(lock, [&] { return inside_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable empty_;
  int inside_ = 0;
  bool closed_ = false;
};

}  // namespace

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
  // Threads that get no processor before the work is done are not waited for: they find the gate
  // closed and end.
  const auto gate = std::make_shared<Gate>();
  try {
    for (std::size_t w = 1; w < count && !cancel.is_set(); ++w)
      std::thread([gate, w, &guarded] {
        if (!gate->enter()) return;
        guarded(w);
        gate->leave();
      }).detach();
  } catch (const std::system_error&) {
    // The system has no more threads: the running ones do the work.
  } catch (const std::bad_alloc&) {
  }
  guarded(0);
  gate->close();
  for (const std::exception_ptr& e : thrown)
    if (e) std::rethrow_exception(e);
}

void prefer_large_pages(const void* begin, const void* end) {
  constexpr std::uintptr_t page = 2 << 20;  // only whole pages
  const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const std::uintptr_t last = reinterpret_cast<std::uintptr_t>(end) / page * page;
  if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace deck
