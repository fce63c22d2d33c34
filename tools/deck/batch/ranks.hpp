// One batch divided among the processes that `mpirun -n N deck batch ...` starts. The launcher
// tells each its rank in the environment; what they have to tell one another (that their part is
// finished) goes through the output directory, which they share anyway. So `deck` needs no MPI
// library: not at build, and not at the start of every other verb.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

#include "batch/summary.hpp"

namespace deck::cli {

class Ranks {
 public:
  /// Of this process, from the variables that Open MPI sets; one rank where there are none.
  static Ranks from_environment();
  static Ranks alone() { return {}; }

  bool single() const { return size_ == 1; }
  bool first() const { return rank_ == 0; }
  std::size_t rank() const { return rank_; }
  std::size_t size() const { return size_; }
  /// Ranks on this machine.
  std::size_t local_size() const { return local_size_; }
  /// The part of the decks that is ours.
  Shard shard() const { return {rank_ + 1, size_}; }

  /// Makes the meeting place in `directory`; call first.
  Result<void> open(const std::string& directory);
  /// Sign of life; call often.
  void beat();
  /// Leaves our part for the first rank.
  Result<void> deliver(const Summary& part);
  /// For the first rank: waits for the parts of the others and merges all. Error: a rank has not
  /// shown a sign of life for `patience`.
  Result<Summary> collect(Summary own, std::chrono::seconds patience = std::chrono::seconds(120));

 private:
  std::string part_file(std::size_t rank) const;
  std::string life_file(std::size_t rank) const;

  std::size_t rank_ = 0, size_ = 1, local_size_ = 1;
  std::string job_;    ///< one run of the launcher, not to be mistaken for an earlier one
  std::string place_;  ///< directory
  std::size_t beats_ = 0;
  std::chrono::steady_clock::time_point last_beat_;
};

}  // namespace deck::cli
