// The run of a batch in one process: what is to do, workers that do it, journal, results, summary.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "batch/list.hpp"
#include "batch/pool.hpp"
#include "batch/record.hpp"
#include "batch/summary.hpp"
#include "common.hpp"
#include "writing/frame.hpp"
#include "writing/library.hpp"

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
  bool from_json = false, to_json = false;
  bool with_dependents = false, split_includes = false;
  std::string root;        ///< where to look for decks that depend on the same files
  std::string frame_root;  ///< decks are written where they lie below it
  std::map<FileIdentity, std::string> outsiders;  ///< see BatchFrame
  /// Files of each deck, by its path, that grouping the decks has seen; normal paths. Empty: decks
  /// are no text with includes.
  std::map<std::string, std::set<std::string>> seen;
};

/// One process's part of a batch. Nothing is lost when it is killed: results are put in place
/// whole, each is noted in the journal DIR/.batch/NAME.jsonl after that (decks that are written
/// before that, too), and a run begins with what the journals say and what still holds.
class Batch {
 public:
  /// `list` has the decks of all shards, `groups` those that are done together; the process takes
  /// the groups of its shard.
  Batch(const BatchOptions& o, BatchTask task, BatchList list,
        std::vector<std::vector<std::size_t>> groups, Shard shard);
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
  Result<void> claim_directory() const;
  void remove_strays(const std::set<std::string>& targets) const;
  void read_journals();
  Result<int> work();
  std::string work_on(std::size_t index, Captured& output) const;
  std::vector<Record> records_of(const JobReport& report) const;
  Result<void> keep(Record record, std::size_t index);
  /// Adds lines to the journal; of the process and its workers, each at once.
  Result<void> note(const std::string& lines, bool flush) const;
  Summary summary() const;
  std::vector<const Record*> lasting() const;
  Result<void> shorten_journal() const;
  int finish();

  // ---- writing.cpp: groups of decks that are written together
  std::string write_group(std::size_t group, Captured& output) const;
  /// Cleans up behind a writing that was killed: finishes it, and removes what is half written.
  void settle(const std::vector<Record>& announced) const;
  /// The same for all that the journals say was to be written.
  void settle_announced();
  /// What our journal says that these decks were to write.
  std::vector<Record> announced_by(const std::vector<std::size_t>& group) const;
  /// True if the file is one that this batch wrote, as it wrote it.
  bool is_ours(const std::string& path) const;
  /// Removes what the journals know and the list does not.
  void remove_leftovers() const;

  const BatchOptions& o_;
  BatchTask task_;
  std::vector<BatchDeck> all_;
  std::vector<IncludeFile> includes_;             ///< of all shards
  std::vector<BatchDeck> decks_;                  ///< ours
  std::vector<std::size_t> positions_;            ///< of ours among all
  std::vector<std::vector<std::size_t>> groups_;  ///< of ours
  Shard shard_;
  std::uint64_t key_ = 0;
  std::vector<Record> records_;  ///< by deck; code -1: to do
  std::vector<Record> known_;    ///< all that the journals hold
  /// What was to be written when a process was killed, by the label of its journal.
  std::map<std::string, std::vector<Record>> announced_;
  /// What was written below the output directory, normal path and hash.
  std::set<std::pair<std::string, std::uint64_t>> written_;
  std::set<std::size_t> overtaken_;  ///< decks that were changed after they were written in place
  std::size_t kept_ = 0;
  int journal_ = -1, lock_ = -1;
};

/// Runs a verb as `deck VERB ... DECK...` would; its output goes where standard output goes.
int run_verb(const BatchTask& task, const std::vector<std::string>& decks, Session& session);
/// The first line of what a program says on standard error.
std::string first_line(std::string_view text);

/// Makes a directory that belongs to the results. Error: there is a link of that name.
Result<void> make_own_directory(const std::string& path);
/// Puts a file of the results in place. A link or pipe of its name, which somebody who may write to
/// the directory can lay there, is replaced, never followed.
Result<void> write_result(Session& session, const std::string& path, std::string_view bytes,
                          bool sync);

/// Writes the summary, the overview and, of decks that were converted, their loss report, which the
/// journals hold. `own`: the records of the journal `own_name`, which is not read then.
Result<void> write_overview(Session& session, const std::string& directory, const Summary& summary,
                            const std::string& own_name = {},
                            const std::vector<const Record*>& own = {});

/// Prints the totals and writes the document for --json; the exit code.
int report_batch(const BatchOptions& options, const Summary& summary, std::size_t kept);

}  // namespace deck::cli
