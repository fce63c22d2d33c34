// What `deck batch` tells a verb that writes decks, and what it learns of it. A verb that is called
// by itself has no frame.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "edit/shared/write.hpp"
#include "keyword/shared/include_scan.hpp"

namespace deck::cli {

struct BatchFrame {
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

}  // namespace deck::cli
