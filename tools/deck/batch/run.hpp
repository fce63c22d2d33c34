// The run of a batch in one process: what is to do, workers that do it, journal, results, summary.
#pragma once
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "batch/list.hpp"
#include "batch/pool.hpp"
#include "batch/ranks.hpp"
#include "batch/record.hpp"
#include "batch/summary.hpp"
#include "common.hpp"

namespace deck::cli {

struct BatchOptions {
  CommonOptions common;
  std::string directory, manifest, verb = "gaps", shard = "1/1";
  int jobs = 0;
  double timeout = 3600;
  bool merge = false, force = false, no_mpi = false;
};

/// The verb to run, as given in --verb.
struct BatchTask {
  Verb verb;
  std::vector<std::string> words;    ///< options of the verb
  std::vector<std::string> options;  ///< with those of the batch that it passes on
};

/// One process's part of a batch. Nothing is lost when it is killed: results are put in place
/// whole, each is noted in the journal DIR/.batch/NAME.jsonl after that, and a run begins with what
/// the journals say and what still holds.
class Batch {
 public:
  /// `all` are the decks of all shards and ranks; the process takes what is its own.
  Batch(const BatchOptions& o, BatchTask task, const std::vector<BatchDeck>& all, Shard shard,
        Ranks ranks);
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  ~Batch();

  /// Exit code.
  int run();

 private:
  int fail(const std::string& message) const {
    print_error(o_.common, message);
    return exit_usage;
  }
  std::string in_directory(const std::string& name) const { return o_.directory + "/" + name; }
  std::string label() const;

  Result<void> prepare();
  void remove_strays(const std::set<std::string>& targets) const;
  void read_journals();
  Result<int> work();
  std::string work_on(std::size_t index, Captured& output) const;
  Record record_of(const JobReport& report) const;
  Result<void> keep(Record record, std::size_t index);
  Summary summary() const;
  int finish();

  const BatchOptions& o_;
  BatchTask task_;
  std::vector<BatchDeck> decks_;    ///< ours
  std::size_t all_, in_shard_ = 0;  ///< decks of all shards; of our shard, all ranks together
  Shard shard_;
  Ranks ranks_;
  std::uint64_t key_ = 0;
  std::vector<Record> records_;  ///< by deck; code -1: to do
  std::size_t kept_ = 0;
  int journal_ = -1, lock_ = -1;
};

/// Makes a directory that belongs to the results. Error: there is a link of that name.
Result<void> make_own_directory(const std::string& path);
/// Puts a file of the results in place. A link or pipe of its name, which somebody who may write to
/// the directory can lay there, is replaced, never followed.
Result<void> write_result(const std::string& path, std::string_view bytes, bool sync);

/// Prints the totals and writes the document for --json; the exit code.
int report_batch(const BatchOptions& options, const Summary& summary, std::size_t kept);

}  // namespace deck::cli
