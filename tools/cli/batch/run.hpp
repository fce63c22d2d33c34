// The run of a batch in one process: what is to do, workers that do it, results, summary.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "batch/json.hpp"
#include "batch/list.hpp"
#include "batch/pool.hpp"
#include "batch/record.hpp"
#include "batch/summary.hpp"
#include "common.hpp"
#include "library.hpp"
#include "writing/frame.hpp"

namespace deck::cli {

struct BatchOptions {
  CommonOptions common;
  std::string directory, manifest, verb = "gaps", shard = "1/1";
  int jobs = 0;
  double timeout = 3600;
  bool merge = false, force = false;
};

/// The verb to run, as given in --verb.
struct BatchTask {
  Verb verb;
  std::vector<std::string> words;         ///< options of the verb
  std::vector<std::string> options;       ///< with those of the batch that it passes on
  std::string_view ending = deck_ending;  ///< of the files below a directory

  // Verbs that write decks.
  bool writes = false;
  bool in_place = false;        ///< else below the output directory
  bool with_documents = false;  ///< they have a document as well
  bool from_json = false, to_json = false, with_dependents = false;
  std::string root;        ///< where to look for decks that depend on the same files
  std::string frame_root;  ///< decks are written where they lie below it
  std::map<FileIdentity, std::string> outsiders;  ///< see BatchFrame

  bool converts() const { return verb.name == "convert"; }
};

/// Decks that are done together: one, or where decks are written those that share files.
struct BatchGroup {
  std::vector<std::size_t> decks;       ///< in the list of all
  std::vector<std::string> files = {};  ///< see DeckFiles; where decks are written
  std::uint64_t contents = 0;           ///< the same; 0: nobody has looked yet
};

/// One process's part of a batch. Nothing is lost when it is killed: results are put in place
/// whole, each group has a record that is written after them, and a run begins with what the
/// records say and what still holds. Where decks are written, the record says before what will be.
class Batch {
 public:
  /// `list` has the decks of all shards; the process takes the groups of its shard.
  Batch(const BatchOptions& o, BatchTask task, BatchList list, std::vector<BatchGroup> groups,
        Shard shard);
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  ~Batch();

  /// Exit code.
  int run();

 private:
  struct Job {
    BatchGroup group;
    std::vector<std::string> decks;         ///< as given
    std::string result;                     ///< name of the first one's
    std::uint64_t settings = 0;             ///< see Record
    std::vector<const Record*> known = {};  ///< that have one of the decks
    std::optional<Record> record = {};      ///< done, now or before
    bool overtaken = false;                 ///< was changed after it was converted in place
  };
  /// What came of a call of the verb.
  struct Outcome {
    int code = exit_internal;
    std::string broken;  ///< why there is no result at all
    std::string document, err;
    std::optional<DocumentFacts> facts = {};
  };

  int fail(const std::string& message) const {
    print_error(o_.common, message);
    return exit_usage;
  }
  std::string in_directory(const std::string& name) const { return o_.directory + "/" + name; }
  /// A path as records have it: relative to the output directory where it lies below that.
  std::string below_directory(const std::string& path) const;

  Result<void> lock();
  Result<void> prepare();
  void remove_temporaries() const;
  void take_over(Job& job) const;
  Result<int> work(std::size_t& kept);
  void take(Job& job, const JobReport& report) const;
  int finish(std::size_t kept);

  // ---- work.cpp: in a worker
  std::string work_on(const Job& job, const Captured& output) const;
  Outcome call(const Job& job, const Captured& output, BatchFrame& frame, Record& record) const;
  Result<void> announce(const Job& job, const std::set<std::string>& read,
                        const std::vector<OutputFile>& files, BatchFrame& frame,
                        Record& record) const;
  void keep_document(const Job& job, Outcome& outcome) const;
  void enter_written(Record& record, const Job& job, BatchFrame& frame, const Outcome& outcome,
                     bool written) const;
  SummaryEntry entry_read(const Job& job, const Outcome& outcome) const;
  void set_outputs(Record& record, const Job& job, std::vector<WrittenFile> outputs) const;
  Result<void> write_record(const Job& job, const Record& record, bool sync) const;

  const BatchOptions& o_;
  BatchTask task_;
  Shard shard_;
  std::size_t all_ = 0;                ///< decks of all shards
  std::vector<IncludeFile> includes_;  ///< of all shards
  std::vector<Job> jobs_;              ///< ours
  std::map<std::string, Record> known_;
  /// What earlier runs wrote, by normal path and hash.
  std::set<std::pair<std::string, std::uint64_t>> written_;
  int lock_ = -1;
};

/// The first line of what a program says on standard error.
std::string first_line(std::string_view text);

/// Makes a directory that belongs to the results. Error: there is a link of that name.
Result<void> make_own_directory(const std::string& path);
/// Puts a file of the results in place. A link or pipe of its name, which somebody who may write to
/// the directory can lay there, is replaced, never followed.
Result<void> write_result(Session& session, const std::string& path, std::string_view bytes,
                          bool sync);

/// Removes temporary files that a killed process left, of these names in one directory or of all
/// names below it.
void remove_strays(const std::string& directory,
                   const std::optional<std::set<std::string>>& names = std::nullopt);

/// Writes the summary. Of the whole also the overview, and what earlier runs wrote and this summary
/// does not have is removed; of decks that were converted their loss report.
Result<void> write_overview(Session& session, const std::string& directory, const Summary& summary);

/// Prints the totals and writes the document for --json; the exit code.
int report_batch(const BatchOptions& options, const Summary& summary, std::size_t kept);

}  // namespace deck::cli
