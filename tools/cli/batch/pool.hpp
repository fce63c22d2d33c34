// Worker processes of a batch: one a job, so many at a time, each with a time limit. One that
// crashes, hangs or runs out of memory costs its own job only.
#pragma once
#include <cstddef>
#include <functional>
#include <string>

#include "deck/text/result.hpp"

namespace deck::cli {

/// What a worker prints, kept in files in memory.
struct Captured {
  int out_file = -1, err_file = -1;
  std::string out() const;
  std::string err() const;
};

/// How a job ended.
struct JobReport {
  std::size_t job = 0;
  std::string answer;  ///< what the work returned; empty: the worker ended before
  int exit_code = -1;  ///< of a worker that ended by itself without an answer; -1: see `why`
  std::string why;     ///< "killed by signal 11 (Segmentation fault)", "no answer in 5 s"
  std::string err;     ///< standard error of a worker that ended without an answer
};

struct WorkerPool {
  int workers = 1;
  double timeout = 0;  ///< seconds for one job; 0: no limit
  /// Runs in a worker; what it returns reaches JobReport::answer.
  std::function<std::string(std::size_t job, const Captured& output)> work;

  /// Does the jobs 0 ... `jobs` - 1. `done` is called in this process, in the order of completion;
  /// `tick` about ten times a second. Returns the number of the signal (interrupt, termination,
  /// hang-up) that ended it early, or 0. Error: no process can be started.
  Result<int> run(std::size_t jobs, const std::function<void(const JobReport&)>& done,
                  const std::function<void()>& tick) const;
};

}  // namespace deck::cli
