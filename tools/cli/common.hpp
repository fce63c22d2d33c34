// What all verbs share: options, loading of decks, exit codes, output to files and terminals.
// Messages for people go to standard error, results to standard output or the files asked for.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/text.hpp"
#include "edit/shared/write.hpp"

namespace deck {
struct RulePage;
}

namespace deck::cli {

enum ExitCode : int {
  exit_clean = 0,  ///< nothing at or above the threshold
  exit_findings = 1,
  exit_usage = 2,  ///< wrong usage or configuration, or an output that cannot be written
  exit_input = 3,  ///< input could not be read
  exit_internal = 4,
};

struct CommonOptions {
  std::vector<std::string> decks;  ///< "-" is standard input
  std::string json;                ///< file, "-" for standard output, empty: none
  int threads = 0;                 ///< 0: all processors
  bool quiet = false;
  bool verbose = false;
  bool require_examined = false;  ///< exit 1 where no interface was examined
  std::string color = "auto";
  std::vector<std::string> include_paths, schema_dirs;
  std::string rules;  ///< directory of the rules of a team
  /// The verb will change files of the decks in place. Set by the verb, not by an option.
  bool rewrites = false;
  bool engine_files = false;  ///< the verb looks at the Engine files beside the decks, too
  bool unread_too = false;    ///< the verb reports decks of versions that are not read
  Limits limits;
  Session* session = nullptr;  ///< never nullptr once the options were added to a command line

  int thread_count() const;
  /// True if text to this descriptor (1, 2) is to be coloured.
  bool color_on(int fd) const;
  /// True if results for people are to be printed: not --quiet, and standard output not taken.
  bool wants_text() const { return !quiet && json != "-"; }
};

/// Adds the shared options. With `with_json` false the verb has no --json.
void add_common(CommandLine& line, CommonOptions& options, bool with_json = true);
/// Those of the shared options that decide about a result, as words: what a verb is called with
/// that another one runs.
std::vector<std::string> handed_on(const CommonOptions& options);
/// The decks may be directories, too: open_directories() has to be called.
void allow_directories(CommandLine& line);
/// Replaces directories by the decks below them. Says what is wrong and returns exit_input, or
/// exit_clean.
int open_directories(CommonOptions& options);
/// Only those that do not need a deck: --json, --quiet, --color, --schemas.
void add_common_without_decks(CommandLine& line, CommonOptions& options);

/// The built-in schemas themselves, or a set of their own with those of --schemas.
class LoadedSchemas {
 public:
  LoadedSchemas() = default;
  explicit LoadedSchemas(SchemaSet own) : own_(std::make_shared<SchemaSet>(std::move(own))) {}
  operator const SchemaSet&() const { return own_ ? *own_ : SchemaSet::built_in(); }

 private:
  std::shared_ptr<const SchemaSet> own_;
};

/// Built-in schemas plus those of --schemas. A directory that cannot be used is a usage error.
Result<LoadedSchemas> load_schemas(const CommonOptions& options);

/// Adds --rules, for verbs that go by the rules of lint.
void add_rules(CommandLine& line, CommonOptions& options);
/// The pages of --rules; without it none or, with `of_directory`, those of the configuration of the
/// current directory. A page that breaks the form is a usage error.
Result<std::vector<RulePage>> team_rules(const CommonOptions& options, bool of_directory = false);

/// Adds --require-examined, for verbs whose result is a verdict about contacts.
void add_require_examined(CommandLine& line, CommonOptions& options);

/// Adds -v, for verbs whose text folds things.
void add_verbose(CommandLine& line, CommonOptions& options, const std::string& what);

/// Adds --accuracy, for verbs that decide about contact; `value` keeps the word.
void add_accuracy(CommandLine& line, std::string& value);
Accuracy accuracy_of(const std::string& value);

/// The processor that a time was measured on, for the reports that say one.
std::string processor_name();

/// One line on the terminal that says what is being done and how far it is. Prints nothing where
/// standard error is no terminal, and nothing for work shorter than a moment.
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

/// LoadedDeck::mesh_values() with progress on the terminal.
const Scene& resolve_geometry(const LoadedDeck& loaded, const CommonOptions& options);

/// Contents that files are taken to have, by path; see ReadOptions::overlay.
using Overlay = std::map<std::string, std::string>;

/// How the options have a deck read, and what is made of it.
LoadOptions load_options(const CommonOptions& options, const SchemaSet& schemas,
                         const Overlay* overlay = nullptr);

/// Reads one deck and makes of it what comes up to `stage`. Error: the main file cannot be read, or
/// is no Starter deck; the message says what it is. `schemas` must outlive it. Values that follow
/// from the mesh are open until resolve_geometry().
/// A verb that only reads says that a rewriting of the deck was interrupted (finish_interrupted).
/// A name without its ending is found (see find_deck), with a note.
Result<LoadedDeck> load(const std::string& given, const SchemaSet& schemas,
                        const CommonOptions& options, Stage stage = Stage::interfaces,
                        const Overlay* overlay = nullptr);

/// Says that another file is read than the one that was named, if that is so.
void note_found(const std::string& given, const std::string& path, const CommonOptions& options);

/// Loads the decks one after the other and calls `body`; returns the worst exit code. What cannot
/// be read is reported and counts as exit_input; a missing include too, after `body` has run.
int for_each_deck(const CommonOptions& options, const std::function<int(LoadedDeck&)>& body);

/// exit_findings if --require-examined is given and nothing was examined, else exit_clean.
int examined_code(const LoadedDeck& loaded, const CommonOptions& options);

/// Refuses ids that are no examined interface of the deck. The error lists those that there are.
/// `option` is what the ids were given to.
Result<void> check_interfaces(const LoadedDeck& loaded, const std::vector<std::int64_t>& ids,
                              std::string_view option, Examined which = Examined::contacts);
/// The same for parts.
Result<void> check_parts(const LoadedDeck& loaded, const std::vector<std::int64_t>& ids,
                         std::string_view option);

/// Prints what the stages that were made have found on standard error, one line each: errors only,
/// or all. At most `limit`, then how many more there are. Returns the number of errors.
std::uint64_t print_findings(const LoadedDeck& loaded, const CommonOptions& options,
                             bool errors_only = true, std::size_t limit = 20);

/// "deck: error: ..." on standard error. The message is one line, whatever it quotes.
void print_error(const CommonOptions& options, std::string_view message);
/// The same; returns `code`, the exit code.
int failed(const CommonOptions& options, std::string_view message, int code = exit_usage);
int failed(const CommonOptions& options, const Error& error, int code = exit_usage);
/// The exit code of an error on the way to a deck: exit_usage if the call is wrong, else
/// exit_input.
int reading_code(const Error& error);

/// Prints results on standard output. A failure (full disk) is noticed at the end of the program.
void print_text(std::string_view text);
/// The same for lines that people read: those longer than text_width() are continued on further
/// ones.
void print_lines(std::string_view text);
/// Lines on standard error, continued in the same way where that is a terminal.
void print_messages(std::string_view text);

/// The same for contents of files (a deck, a patch): as they are, but on a terminal with what it
/// would obey spelled out.
void print_contents(std::string_view text);

/// Columns of the terminal behind a descriptor (1, 2); 0: it is none.
std::size_t terminal_width(int fd);
/// Columns of the terminal that standard output is, else of $COLUMNS; 0: lines of any length.
std::size_t text_width();

/// "deck: note: ..." on standard error.
void print_note(std::string_view note);

/// Session::claim_outputs(): says what is wrong and returns exit_usage, or exit_clean.
int check_outputs(const CommonOptions& options, const std::vector<std::string>& paths);

/// Collects the JSON documents of a run: one deck gives the document itself; several are the list
/// "decks" of a document with the same schema id.
class JsonOutput {
 public:
  JsonOutput(const CommonOptions& options, std::string_view schema_id, int schema_version)
      : options_(options), schema_id_(schema_id), schema_version_(schema_version) {}
  bool wanted() const { return !options_.json.empty(); }
  void add(std::string document) { documents_.push_back(std::move(document)); }
  /// The same for a large document: with one deck it is written at once, while it is made.
  void add(const MakeText& make);
  /// What was added, as one document.
  std::string text() const;
  /// Writes it; returns `code`, or exit_usage if the file cannot be written.
  int finish(int code) const;

 private:
  const CommonOptions& options_;
  std::string schema_id_;
  int schema_version_;
  std::vector<std::string> documents_;
  bool failed_ = false;  ///< a document could not be written
};

}  // namespace deck::cli
