// Running numbered pieces of work on a few threads and taking their results in order, so that what
// comes out does not depend on the number of threads.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace deck::detail {

/// Calls work(k, out) for k = 0 … n-1 on up to `threads` threads, and take(k, out) in the order of
/// k, one at a time. `Out` objects are reused. `work` and `take` must not throw.
template <class Out, class Work, class Take>
void run_in_order(std::size_t n, int threads, Work work, Take take) {
  if (threads <= 1 || n <= 1) {
    Out out;
    for (std::size_t k = 0; k < n; ++k) {
      work(k, out);
      take(k, out);
    }
    return;
  }
  constexpr std::size_t ahead = 16;  // bound on results that wait for an earlier one
  std::mutex mutex;
  std::condition_variable moved;
  std::vector<std::unique_ptr<Out>> waiting(n), spare;
  std::size_t next = 0, taken = 0;
  bool taking = false;
  const auto worker = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      moved.wait(lock, [&] { return next >= n || next < taken + ahead; });
      if (next >= n) return;
      const std::size_t k = next++;
      std::unique_ptr<Out> out;
      if (spare.empty()) {
        out = std::make_unique<Out>();
      } else {
        out = std::move(spare.back());
        spare.pop_back();
      }
      lock.unlock();
      work(k, *out);
      lock.lock();
      waiting[k] = std::move(out);
      // One thread takes, without the lock; the others go on with their work.
      if (taking) continue;
      taking = true;
      while (taken < n && waiting[taken] != nullptr) {
        const std::size_t t = taken;
        std::unique_ptr<Out> ready = std::move(waiting[t]);
        lock.unlock();
        take(t, *ready);
        lock.lock();
        spare.push_back(std::move(ready));
        taken = t + 1;
        moved.notify_all();
      }
      taking = false;
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) {
    try {
      others.emplace_back(worker);
    } catch (const std::system_error&) {
      break;  // the system has no more threads: fewer will do
    }
  }
  worker();
  for (std::thread& thread : others) thread.join();
}

}  // namespace deck::detail
