// Runs work on several threads. An exception in one thread stops the others and is rethrown by the
// call. If the system has no more threads, fewer do the work.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace deck {

// Processors of this machine, at least 1.
int processors();

// Number of threads to use: `requested`, or one per processor for 0 and below.
inline int effective_threads(int requested) { return requested > 0 ? requested : processors(); }

// Set when the rest of the work is no longer needed.
class CancelFlag {
 public:
  void set() { set_.store(true, std::memory_order_relaxed); }
  bool is_set() const { return set_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> set_{false};
};

// Calls body(0) in this thread and body(1) ... body(workers-1) in as many others as the system
// starts before body(0) ends; the results of body must not depend on their number. Waits for all.
// Rethrows the exception of the lowest worker; `cancel` is set at the first one and body must check
// it.
void run_workers(int workers, CancelFlag& cancel, const std::function<void(std::size_t)>& body);

// Calls body(item) once for each item 0 ... count-1 on up to `threads` threads. Starts no further
// item after an exception.
template <class Body>
void parallel_items(int threads, std::size_t count, const Body& body) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  CancelFlag cancel;
  std::atomic<std::size_t> next{0};
  run_workers(static_cast<int>(std::min(count, static_cast<std::size_t>(threads))), cancel,
              [&](std::size_t) {
                for (;;) {
                  const std::size_t item = next.fetch_add(1);
                  if (item >= count || cancel.is_set()) return;
                  body(item);
                }
              });
}

constexpr std::size_t worth_a_thread = 4096;  // items of a loop that justify a thread

// First index of part `part` of `parts` nearly equal parts of [0, count).
inline std::size_t part_bound(std::size_t count, std::size_t parts, std::size_t part) {
  return count / parts * part + std::min(part, count % parts);
}

// Calls body(part, begin, end) for `threads` contiguous parts of [0, count). For loops with a setup
// per part. Results must not depend on the bounds.
template <class Body>
void parallel_parts(int threads, std::size_t count, const Body& body) {
  const auto parts = static_cast<std::size_t>(std::max(1, threads));
  parallel_items(count < worth_a_thread ? 1 : threads, parts, [&](std::size_t part) {
    body(part, part_bound(count, parts, part), part_bound(count, parts, part + 1));
  });
}

// Number of pieces that parallel_pieces makes of `count` items.
inline std::size_t pieces_of(int threads, std::size_t count) {
  constexpr std::size_t smallest = 1024, most_per_thread = 16;
  if (threads <= 1 || count < worth_a_thread) return 1;
  return std::min(count / smallest, most_per_thread * static_cast<std::size_t>(threads));
}

// Like parallel_parts, with many small pieces that free threads fetch, so that a slow thread does
// fewer. Combine results by the number of the piece.
template <class Body>
void parallel_pieces(int threads, std::size_t count, const Body& body) {
  const std::size_t pieces = pieces_of(threads, count);
  parallel_items(threads, pieces, [&](std::size_t piece) {
    body(piece, part_bound(count, pieces, piece), part_bound(count, pieces, piece + 1));
  });
}

// Calls work(k, out) for k = 0 ... n-1 on up to `threads` threads, and consume(k, out) in the order
// of k, one at a time. `Out` objects are reused.
template <class Out, class Work, class Take>
void run_in_order(std::size_t n, int threads, const Work& work, const Take& consume) {
  if (threads <= 1 || n <= 1) {
    Out out;
    for (std::size_t k = 0; k < n; ++k) {
      work(k, out);
      consume(k, out);
    }
    return;
  }
  constexpr std::size_t ahead = 16;  // limit of results that wait for an earlier one
  std::mutex mutex;
  std::condition_variable moved;
  std::vector<std::unique_ptr<Out>> waiting(n), spare;
  spare.reserve(ahead + static_cast<std::size_t>(threads));
  std::size_t next = 0, taken = 0;
  bool taking = false;
  CancelFlag cancel;
  const auto loop = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      moved.wait(lock, [&] { return cancel.is_set() || next >= n || next < taken + ahead; });
      if (cancel.is_set() || next >= n) return;
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
      // One thread consumes without the lock; the others continue with their work.
      if (taking) continue;
      taking = true;
      while (taken < n && waiting[taken] != nullptr) {
        const std::size_t t = taken;
        std::unique_ptr<Out> ready = std::move(waiting[t]);
        lock.unlock();
        consume(t, *ready);
        lock.lock();
        if (spare.size() < spare.capacity()) spare.push_back(std::move(ready));
        taken = t + 1;
        moved.notify_all();
      }
      taking = false;
    }
  };
  run_workers(threads, cancel, [&](std::size_t) {
    try {
      loop();
    } catch (...) {
      {
        const std::lock_guard lock(mutex);
        cancel.set();
      }
      moved.notify_all();
      throw;
    }
  });
}

}  // namespace deck
