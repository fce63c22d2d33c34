// Shared by all verbs: options, loading, exit codes, output. Messages go to standard error, results
// to standard output or files.
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
  exit_usage = 2,  ///< wrong usage or configuration, or unwritable output
  exit_input = 3,  ///< input could not be read
  exit_internal = 4,
};

struct CommonOptions {
  std::vector<std::string> decks;  ///< "-" is standard input
  std::string json;                ///< file, "-" for standard output; empty: none
  int threads = 0;                 ///< 0: all processors
  bool quiet = false;
  bool verbose = false;
  bool require_examined = false;  ///< exit 1 if no interface was examined
  std::string color = "auto";
  std::vector<std::string> include_paths, schema_dirs;
  std::string rules;  ///< directory of team rules
  /// The verb changes files of the decks in place. Set by the verb.
  bool rewrites = false;
  bool engine_files = false;  ///< the verb also reads the Engine files
  bool unread_too = false;    ///< the verb reports decks of unreadable versions
  Limits limits;
  Session* session = nullptr;  ///< never nullptr after the options were added to a command line

  int thread_count() const;
  /// True if text to descriptor 1 or 2 is coloured.
  bool color_on(int fd) const;
  /// True if text results are printed: not --quiet, and standard output is free.
  bool wants_text() const { return !quiet && json != "-"; }
};

/// Adds the shared options; --json only if `with_json`.
void add_common(CommandLine& line, CommonOptions& options, bool with_json = true);
/// Shared options that affect a result, as words, for a verb run by another one.
std::vector<std::string> handed_on(const CommonOptions& options);
/// Decks may be directories; the verb must call open_directories().
void allow_directories(CommandLine& line);
/// Replaces directories by their decks. Returns exit_clean, or exit_input after an error message.
int open_directories(CommonOptions& options);
/// Adds the options that need no deck: --json, --quiet, --color, --schemas.
void add_common_without_decks(CommandLine& line, CommonOptions& options);

/// The built-in schemas, or a set with those of --schemas added.
class LoadedSchemas {
 public:
  LoadedSchemas() = default;
  explicit LoadedSchemas(SchemaSet own) : own_(std::make_shared<SchemaSet>(std::move(own))) {}
  operator const SchemaSet&() const { return own_ ? *own_ : SchemaSet::built_in(); }

 private:
  std::shared_ptr<const SchemaSet> own_;
};

/// Error (usage): a directory cannot be used.
Result<LoadedSchemas> load_schemas(const CommonOptions& options);

/// Adds --rules, for verbs that use lint rules.
void add_rules(CommandLine& line, CommonOptions& options);
/// Pages of --rules; without it none or, with `of_directory`, those of the current directory's
/// configuration. Error (usage): an invalid page.
Result<std::vector<RulePage>> team_rules(const CommonOptions& options, bool of_directory = false);

/// Adds --require-examined, for verbs with a verdict about contacts.
void add_require_examined(CommandLine& line, CommonOptions& options);

/// Adds -v, for verbs that abbreviate their text.
void add_verbose(CommandLine& line, CommonOptions& options, const std::string& what);

/// Adds --accuracy; `value` receives the word.
void add_accuracy(CommandLine& line, std::string& value);
Accuracy accuracy_of(const std::string& value);

/// Processor name, for reports with times.
std::string processor_name();

/// Progress line on the terminal. Prints nothing if standard error is not a terminal or the work is
/// short.
class Progress {
 public:
  /// `enabled` applies to terminals only.
  explicit Progress(bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins a step of unknown length.
  void step(std::string_view what);
  /// Sets the progress; a non-empty `what` renames the step. Cheap. Not thread-safe.
  void update(std::uint64_t done, std::uint64_t total, std::string_view what = {});
  /// Removes the line; step() shows it again.
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

/// Crossed elements of the scene; beside them, all findings of the deck, with the solver's errors.
std::vector<Crossing> crossings_and_findings(LoadedDeck& loaded, int threads);

/// File contents by path; see ReadOptions::overlay.
using Overlay = std::map<std::string, std::string>;

/// Options for loading a deck.
LoadOptions load_options(const CommonOptions& options, const SchemaSet& schemas,
                         const Overlay* overlay = nullptr);

/// Reads a deck and builds all stages up to `stage`. Error: the main file is unreadable or not a
/// Starter deck. `schemas` must outlive it. Values from the mesh need resolve_geometry(). Read-only
/// verbs print a note about an interrupted write. Names without ending are completed (find_deck),
/// with a note.
Result<LoadedDeck> load(const std::string& given, const SchemaSet& schemas,
                        const CommonOptions& options, Stage stage = Stage::interfaces,
                        const Overlay* overlay = nullptr);

/// Prints a note if the file read is not the one named.
void note_found(const std::string& given, const std::string& path, const CommonOptions& options);

/// Loads the decks in turn and calls `body`; returns the worst exit code. An unreadable deck, or
/// one with a missing include after `body`, counts as exit_input.
int for_each_deck(const CommonOptions& options, const std::function<int(LoadedDeck&)>& body);

/// exit_findings if --require-examined is set and nothing was examined, else exit_clean.
int examined_code(const LoadedDeck& loaded, const CommonOptions& options);

/// Error for ids that are no examined interface, with the list of legal ones. `option`: name for
/// the message.
Result<void> check_interfaces(const LoadedDeck& loaded, const std::vector<std::int64_t>& ids,
                              std::string_view option, Examined which = Examined::contacts);
/// check_interfaces() for parts.
Result<void> check_parts(const LoadedDeck& loaded, const std::vector<std::int64_t>& ids,
                         std::string_view option);

/// Prints findings of the finished stages on standard error, one line each: errors, or all; at most
/// `limit`, then the number of others. Returns the number of errors.
std::uint64_t print_findings(const LoadedDeck& loaded, const CommonOptions& options,
                             bool errors_only = true, std::size_t limit = 20);

/// Prints "deck: error: ..." as one line on standard error.
void print_error(const CommonOptions& options, std::string_view message);
/// print_error(), and returns `code`.
int failed(const CommonOptions& options, std::string_view message, int code = exit_usage);
int failed(const CommonOptions& options, const Error& error, int code = exit_usage);
/// Exit code for a reading error: exit_usage for a wrong call, else exit_input.
int reading_code(const Error& error);

/// Prints results on standard output; errors (full disk) are detected at the end.
void print_text(std::string_view text);
/// print_text() with lines folded to text_width().
void print_lines(std::string_view text);
/// Prints lines on standard error, folded if that is a terminal.
void print_messages(std::string_view text);

/// Prints file contents (a deck, a patch) unchanged; on a terminal with control characters spelled
/// out.
void print_contents(std::string_view text);

/// Columns of the terminal at descriptor 1 or 2; 0: not a terminal.
std::size_t terminal_width(int fd);
/// Columns of standard output or of $COLUMNS; 0: unlimited.
std::size_t text_width();

/// Prints "deck: note: ..." on standard error.
void print_note(std::string_view note);

/// Session::claim_outputs() with error message: exit_usage or exit_clean.
int check_outputs(const CommonOptions& options, const std::vector<std::string>& paths);

/// Collects JSON documents: one deck gives its document; several a list "decks" in a document with
/// the same schema id.
class JsonOutput {
 public:
  JsonOutput(const CommonOptions& options, std::string_view schema_id, int schema_version)
      : options_(options), schema_id_(schema_id), schema_version_(schema_version) {}
  bool wanted() const { return !options_.json.empty(); }
  void add(std::string document) { documents_.push_back(std::move(document)); }
  /// For large documents: with one deck it is streamed.
  void add(const MakeText& make);
  /// All documents as one.
  std::string text() const;
  /// Writes it; returns `code`, or exit_usage on error.
  int write(int code) const;

 private:
  const CommonOptions& options_;
  std::string schema_id_;
  int schema_version_;
  std::vector<std::string> documents_;
  bool failed_ = false;  ///< a document could not be written
};

}  // namespace deck::cli
