// Task queue of the server, and worker threads for long tasks.
#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace deck::lsp {

/// Tasks from any thread, run by one.
class Queue {
 public:
  using Task = std::function<void()>;
  using Clock = std::chrono::steady_clock;
  void push(Task task) {
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    ready_.notify_one();
  }
  /// The next task; nullopt: timeout.
  std::optional<Task> pop(std::optional<Clock::time_point> until) {
    std::unique_lock lock(mutex_);
    const auto any = [this] { return !tasks_.empty(); };
    if (until)
      ready_.wait_until(lock, *until, any);
    else
      ready_.wait(lock, any);
    if (tasks_.empty()) return std::nullopt;
    Task task = std::move(tasks_.front());
    tasks_.pop_front();
    return task;
  }

 private:
  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Task> tasks_;
};

/// A thread that runs tasks; ends with this object, after the current task.
class Worker {
 public:
  Worker() : thread_([this] { run(); }) {}
  ~Worker() {
    queue_.push({});
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  void push(Queue::Task task) { queue_.push(std::move(task)); }

 private:
  void run() {
    while (const auto task = queue_.pop(std::nullopt)) {
      if (!*task) return;
      (*task)();
    }
  }
  Queue queue_;
  std::thread thread_;
};

}  // namespace deck::lsp
