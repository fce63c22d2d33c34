// Session of one call: files read and written. Made in main() and passed in CommonOptions::session;
// the program has no other global state.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/edit.hpp"
#include "deck/report.hpp"
#include "deck/text.hpp"
#include "edit/shared/write.hpp"
#include "keyword/shared/include_scan.hpp"

namespace deck::cli {

/// Data passed from `deck batch` to a verb that writes decks, and back.
struct BatchHooks {
  // ---- from the batch
  std::string root;  ///< absolute: decks keep their relative path below this directory
  /// Files included by decks outside of the batch, with one of these decks.
  std::map<FileIdentity, std::string> outsiders;
  /// True if this batch wrote the file before and may replace it.
  std::function<bool(const std::string& path)> ours;
  /// Called with all files before they are written.
  std::function<Result<void>(const std::vector<OutputFile>&)> before_writing;
  // ---- to the batch
  struct Deck {
    int code = 0;
    std::string error;   ///< the first error
    std::string target;  ///< its main file or document, as written; empty: in place
    std::size_t changed = 0;
    std::size_t losses[4] = {};  ///< per Loss
  };
  std::map<std::string, Deck> decks;  ///< by name as given
  std::string error;                  ///< the first error about all decks
  std::vector<LossEntry> losses;
  bool written = false;
  /// Later errors are about this deck; empty: about all.
  void begin(const std::string& deck) { current_ = deck; }
  void end(int code) {
    if (!current_.empty()) decks[current_].code = std::max(decks[current_].code, code);
    current_.clear();
  }
  void note_error(std::string_view message) {
    std::string& first = current_.empty() ? error : decks[current_].error;
    if (first.empty()) first = message;
  }

 private:
  std::string current_;
};

/// Error of usage or configuration: exit code 2.
inline Error config_error(std::string message) { return {Error::Code::config, std::move(message)}; }

/// Rules for replacing files. Files that the call has read are never replaced.
struct OutputRules {
  bool overwrite = false;  ///< replace any file
  /// Decks are written: no different file is replaced without --overwrite. Otherwise: no file that
  /// looks like a deck or include.
  bool deck_tree = false;
  bool follow_links = true;
  std::function<bool(const std::string&)> ours = {};  ///< exceptions: files that may be replaced
};

/// Makes a document; returns the part that was not drained.
using MakeText = std::function<std::string(const TextDrain&)>;

/// Guards outputs: never overwrites a file that the call has read, or one that looks like a deck
/// (`--json deck.rad` when --json was taken for a flag).
class Session {
 public:
  /// Set by `deck batch`, which runs the verb; else nullptr.
  BatchHooks* frame = nullptr;
  /// Runs `work` for one deck; errors during it belong to the deck. Returns the exit code.
  int about(const std::string& deck, const std::function<int()>& work) const {
    if (frame != nullptr) frame->begin(deck);
    const int code = work();
    if (frame != nullptr) frame->end(code);
    return code;
  }
  /// Protects these files from being overwritten.
  void remember_read(const SourceSet& sources);
  void remember_read(const Source& source);
  void remember_read(const std::string& path);
  /// Error: the path is a protected file. Without `bytes` the new contents are unknown. Accepted: a
  /// file with these contents or, in a tree of decks, an unchanged one made from `origin`.
  Result<void> check_output(const std::string& path, const OutputRules& rules = {},
                            std::optional<std::string_view> bytes = std::nullopt,
                            std::string_view origin = {}) const;
  /// Registers output files before the work begins. Error: a protected file, or two names for one
  /// file; "" and "-" are ignored. Each write checks all of them again, also against files read
  /// since; if one is refused, none is written.
  Result<void> claim_outputs(const std::vector<std::string>& paths);
  Result<void> check_claimed() const;
  /// Checks files with their contents; none may be a claimed one.
  Result<void> check_outputs(const std::vector<OutputFile>& files, const OutputRules& rules) const;
  /// Writes bytes to standard output ("-") or atomically to a file.
  Result<void> write_output(const std::string& path, std::string_view bytes);
  /// Writes a document while it is made.
  Result<void> write_output(const std::string& path, const MakeText& make);
  /// Writes all files or none.
  Result<void> write_outputs(const std::vector<OutputFile>& files, const OutputRules& rules = {},
                             const WriteOptions& options = {"", true, true, true});
  /// Decks were written: later errors of standard output mention it.
  void remember_written() { wrote_decks_ = true; }
  /// Must be called last. False, with one message, if standard output could not be written
  /// completely.
  bool flush_standard_output();

 private:
  using Identity = std::pair<std::uint64_t, std::uint64_t>;
  std::string no_standard_output() const;
  Result<void> write_standard_output(std::string_view bytes);
  std::map<Identity, std::string> files_read_;  ///< by device and inode, with a name
  std::map<std::string, std::string> claimed_;  ///< name as given, by place
  bool told_of_standard_output_ = false;        ///< the error was reported
  bool wrote_decks_ = false;
};

}  // namespace deck::cli
