// A batch in one process: what it does, its worker processes, and the groups of decks that these
// do.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "batch/record.hpp"
#include "common.hpp"
#include "library.hpp"

namespace deck::cli {

// ---- worker processes: one a job, so many at a time, each with a time limit. One that crashes,
// hangs or runs out of memory costs its own job only.

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

// ---- a run

struct BatchOptions {
  CommonOptions common;
  std::string directory, manifest, verb = "gaps", shard = "1/1";
  int jobs = 0;
  double timeout = 3600;
  bool merge = false, force = false;
  std::string in_directory(const std::string& name) const { return directory + "/" + name; }
};

/// The verb to run, as given in --verb.
struct BatchTask {
  Verb verb;
  std::vector<std::string> words;    ///< options of the verb
  std::vector<std::string> options;  ///< with those of the batch that it passes on
  // Verbs that write decks.
  bool writes = false;
  bool in_place = false;  ///< else below the output directory
  bool to_json = false;
  bool pages = false;      ///< --html: a page beside each document
  std::string root;        ///< where to look for decks that include the same files
  std::string frame_root;  ///< decks are written where they lie below it
  std::map<FileIdentity, std::string> outsiders;  ///< see BatchHooks
  /// Decks are all that it writes; other verbs have a document.
  bool converts() const { return verb.name == "convert"; }
};

/// Decks that are done together: one, or where decks are written those that share files.
struct BatchJob {
  std::vector<std::size_t> positions = {};  ///< in the list of all decks
  std::vector<std::string> decks = {};      ///< as given
  std::string result = {};                  ///< name of the first one's
  std::vector<std::string> files = {};      ///< of the decks; where decks are written
  Record record = {};                       ///< contents 0: nobody has looked yet
  bool done = false;                        ///< the record is of an earlier run
  bool converted = false;                   ///< in place, by an earlier run
  bool overtaken = false;                   ///< and was changed since
};

/// One process's part of a batch. Nothing is lost when it is killed: results are put in place
/// whole, each group has a record that is written after them, and a run begins with what the
/// records say and what still holds. Where decks are converted in place, the record says before
/// what will be.
struct BatchRun {
  const BatchOptions& o;
  BatchTask task;
  BatchList list;
  Shard shard;
  std::vector<BatchJob> jobs;  ///< of the shard
  std::map<std::string, Record> known = {};
  std::set<WrittenFiles::value_type> written = {};  ///< by earlier runs, by absolute path
};
/// Exit code.
int run_batch(BatchRun run);

/// What a worker does: one call of the verb, its result and its record, which it returns as a text.
std::string work_on(const BatchRun& run, const BatchJob& job, const Captured& output);

/// The first line of what a program says on standard error.
std::string first_line(std::string_view text);

/// Puts a file of the results in place. A link or pipe of its name, which somebody who may write to
/// the directory can lay there, is replaced, never followed. `sync`: see WriteOptions.
Result<void> write_result(const BatchOptions& o, const std::string& name, std::string_view bytes,
                          bool sync);

/// Removes the document and page of a job that has none: one of earlier would be taken for it.
void remove_result(const BatchRun& run, const BatchJob& job);
/// Removes temporary files that a killed process left: of the files of these names in a directory,
/// or (without names) of all files below it.
void remove_strays(const std::filesystem::path& directory, const std::set<std::string>& names = {});

/// Writes the summary, of the whole also the overview, of decks that were converted their loss
/// report. Then prints the totals and writes the document for --json; the exit code. `kept`: decks
/// that were done before.
int write_overview(const BatchOptions& o, const Shard& shard, const Json& summary,
                   std::size_t kept);

}  // namespace deck::cli
