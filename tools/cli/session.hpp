// The session of one call: what it has read and written, and who listens. Made in main() and passed
// with the options (CommonOptions::session); the program has no other state of the process.
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

/// What `deck batch` tells a verb that writes decks, and what it learns of it.
struct BatchHooks {
  // ---- told
  std::string root;  ///< absolute: every deck is written where it lies below this directory
  /// Files that decks outside the batch include, with one of these decks.
  std::map<FileIdentity, std::string> outsiders;
  /// True if the file was written by this batch before, and may be replaced.
  std::function<bool(const std::string& path)> ours;
  /// Called with all that will be written, before anything is.
  std::function<Result<void>(const std::vector<OutputFile>&)> before_writing;

  // ---- learnt
  struct Deck {
    int code = 0;
    std::string error;   ///< the first
    std::string target;  ///< its main file or document, as written; empty: in place
    std::size_t changed = 0;
    std::size_t losses[4] = {};  ///< by Loss
  };
  std::map<std::string, Deck> decks;  ///< by name as given
  std::string error;                  ///< the first that is about all decks together
  std::vector<LossEntry> losses;
  bool written = false;

  /// Errors are about this deck from now on; empty: about all.
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

/// Wrong usage or configuration: exit code 2.
inline Error config_error(std::string message) { return {Error::Code::config, std::move(message)}; }

/// What an output may replace. Never a file that the call has read.
struct OutputRules {
  bool overwrite = false;  ///< whatever is there
  /// Decks are written: no file that differs is replaced, and --overwrite is the way out. Else
  /// none that looks like a deck or an include.
  bool deck_tree = false;
  bool follow_links = true;
  std::function<bool(const std::string&)> ours = {};  ///< files that may be replaced all the same
};

/// Makes a document and returns what of it has not left through the drain.
using MakeText = std::function<std::string(const TextDrain&)>;

/// A result is never written over a file that the call has read, nor over a file that looks like a
/// deck: "--json a b" with a flag in mind costs nobody a deck.
class Session {
 public:
  /// Of `deck batch`, which runs the verb; nullptr: the verb was called by itself.
  BatchHooks* frame = nullptr;

  /// Does what is about one deck; errors meanwhile are its own. Returns the exit code.
  int about(const std::string& deck, const std::function<int()>& work) const {
    if (frame != nullptr) frame->begin(deck);
    const int code = work();
    if (frame != nullptr) frame->end(code);
    return code;
  }

  /// From now on no output is written over these files.
  void remember_read(const SourceSet& sources);
  void remember_read(const Source& source);
  void remember_read(const std::string& path);

  /// Error: the path is an existing file that the rules protect. Without `bytes` what will be
  /// written is not known yet; a file that holds it already is no obstacle, nor, in a tree of
  /// decks, one that was made from the same `origin` and is unchanged since.
  Result<void> check_output(const std::string& path, const OutputRules& rules = {},
                            std::optional<std::string_view> bytes = std::nullopt,
                            std::string_view origin = {}) const;
  /// Registers the files that a call will write, before its work begins. Error: a file is
  /// protected, or two names lead to the same file. "" and "-" are no files. Every write checks all
  /// of them again, also against the files read since; if one is refused, none is written.
  Result<void> claim_outputs(const std::vector<std::string>& paths);
  Result<void> check_claimed() const;
  /// The same for files with their contents, none of which may be a claimed one.
  Result<void> check_outputs(const std::vector<OutputFile>& files, const OutputRules& rules) const;
  /// Writes bytes to standard output ("-") or atomically to a file.
  Result<void> write_output(const std::string& path, std::string_view bytes);
  /// The same for a document that is written while it is made.
  Result<void> write_output(const std::string& path, const MakeText& make);
  /// Writes a set of files, all or none.
  Result<void> write_outputs(const std::vector<OutputFile>& files, const OutputRules& rules = {},
                             const WriteOptions& options = {"", true, true, true});

  /// Decks were written: what goes wrong with standard output from now on says so.
  void remember_written() { wrote_decks_ = true; }
  /// To be called last. False, said once, if not everything could be written to standard output.
  bool finish_standard_output();

 private:
  using Identity = std::pair<std::uint64_t, std::uint64_t>;

  std::string no_standard_output() const;
  Result<void> write_standard_output(std::string_view bytes);

  std::map<Identity, std::string> files_read_;  ///< by device and inode, with a name of each
  std::map<std::string, std::string> claimed_;  ///< as named, by place
  bool told_of_standard_output_ = false;        ///< it was said that it cannot be written
  bool wrote_decks_ = false;
};

}  // namespace deck::cli
