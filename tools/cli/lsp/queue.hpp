// What the server works through, in order, and the threads beside it that must not hold it up.
#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

namespace deck::lsp {

/// Tasks from any thread, done by one.
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
  /// The next task; nullopt: none came until then.
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

/// One thread that does what it is given; ends when this does, after the task at hand. Where
/// threads cannot be started the owner calls do_one().
class Worker {
 public:
  Worker() {
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {  // a machine without threads
    }
  }
  ~Worker() {
    if (!thread_.joinable()) return;
    queue_.push({});
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void push(Queue::Task task) { queue_.push(std::move(task)); }
  /// Does the next task here; false: there is none, or a thread does them.
  bool do_one() {
    if (thread_.joinable()) return false;
    const auto task = queue_.pop(Queue::Clock::now());
    if (task) (*task)();
    return task.has_value();
  }

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
