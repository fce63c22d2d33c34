// Progress: one line on the terminal that says what is being done and how far it is. Prints
// nothing where standard error is no terminal, and nothing for work shorter than a moment.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace deck::cli {

class Progress {
 public:
  /// `enabled` is further restricted to terminals.
  explicit Progress(bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins a step of unknown length.
  void step(std::string_view what);
  /// `done` of `total` of the step, which is called `what` from now on unless that is empty; cheap
  /// enough to call often. Not thread safe.
  void update(std::uint64_t done, std::uint64_t total, std::string_view what = {});
  /// Removes the line; later calls of step() bring it back.
  void clear();

 private:
  void draw(double share);
  bool enabled_;
  bool drawn_ = false;
  std::string what_;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace deck::cli
