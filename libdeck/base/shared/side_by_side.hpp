// Items of very different size that one thread finds and all work on: small ones in parallel, as
// soon as they are found; large ones after the last, one after another with all threads.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "base/shared/parallel.hpp"

namespace deck {

template <class Item>
class SideBySide {
 public:
  /// Called once per item with the worker and the threads that it may use; results must not depend
  /// on either.
  using Body = std::function<void(Item, std::size_t worker, int threads)>;
  SideBySide(int threads, Body body) : threads_(threads), body_(std::move(body)) {}

  /// Calls find(), which adds all items; returns after the work on all of them.
  void run(const std::function<void()>& find) {
    if (threads_ <= 1) return find();
    CancelFlag cancel;
    run_workers(threads_, cancel, [&](std::size_t worker) {
      if (worker == 0) {
        const std::shared_ptr<void> at_end(nullptr, [this](void*) { close(); });
        find();
      }
      work(worker, cancel);
    });
    for (const Item& item : large_) body_(item, 0, threads_);
  }
  /// `size`: about the number of loop iterations. With one thread the work is done at once.
  void add(Item item, std::size_t size) {
    constexpr std::size_t serves_all = 65536;
    if (threads_ <= 1) return body_(std::move(item), 0, 1);
    if (size >= serves_all) return large_.push_back(std::move(item));
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(item));
    changed_.notify_one();
  }

 private:
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  void work(std::size_t worker, const CancelFlag& cancel) {
    for (std::unique_lock lock(mutex_);; lock.lock()) {
      changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
      if (waiting_.empty() || cancel.is_set()) return;
      Item item = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      body_(std::move(item), worker, 1);
    }
  }

  int threads_;
  Body body_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> waiting_, large_;
  bool closed_ = false;
};

}  // namespace deck
