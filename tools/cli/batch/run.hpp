// A batch in one process: what it does, and the groups of decks that its workers do.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "batch/pool.hpp"
#include "batch/record.hpp"
#include "common.hpp"
#include "library.hpp"

namespace deck::cli {

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
  std::string root;        ///< where to look for decks that include the same files
  std::string frame_root;  ///< decks are written where they lie below it
  std::map<FileIdentity, std::string> outsiders;  ///< see BatchFrame

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

/// Removes the document of a job that has none: one of earlier would be taken for it.
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
