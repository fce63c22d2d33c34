// Worker processes for a batch: each does one job after the other, and one that crashes, hangs or
// runs out of memory costs its own job only.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "deck/text/result.hpp"

namespace deck::cli {

/// Standard output and standard error of a worker, kept in memory.
class Captured {
 public:
  Captured(int out, int err) : out_(out), err_(err) {}
  void reset();
  std::string out() const;
  std::string err() const;

 private:
  int out_, err_;
};

/// How a job ended.
struct JobReport {
  std::size_t job = 0;
  bool answered = false;
  std::string message;  ///< what the work returned
  int exit_code = -1;   ///< of a worker that ended without an answer by itself; -1: see `why`
  std::string why;      ///< "killed by signal 11 (Segmentation fault)", "no answer in 5 s"
  std::string err;      ///< standard error of a worker that ended without an answer
};

class WorkerPool {
 public:
  /// Runs in a worker; the message reaches JobReport::message.
  using Work = std::function<std::string(std::size_t job, Captured& output)>;

  /// `timeout` in seconds for one job; 0: none.
  WorkerPool(int workers, double timeout, Work work)
      : workers_(workers), timeout_(timeout), work_(std::move(work)) {}

  /// Does the jobs. `done` is called in this process, in the order of completion; it returns false
  /// to stop. `tick` is called about ten times a second. Returns the number of the signal
  /// (interrupt, termination, hang-up) that ended it early, or 0. Error: no process can be started.
  Result<int> run(const std::vector<std::size_t>& jobs, const std::function<bool(JobReport)>& done,
                  const std::function<void()>& tick);

 private:
  int workers_;
  double timeout_;
  Work work_;
};

}  // namespace deck::cli
