// Losses of conversions as text: line by line, and grouped by cause over many decks.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common.hpp"
#include "deck/edit.hpp"

namespace deck::cli::verb_convert {

/// Converts a refusal ("file:line:column: /KEYWORD/id field: reason") to an entry.
LossEntry refused_entry(const std::string& refusal);

/// Prints counts, and a line per lost or undecided value. Values without effect are one line per
/// field.
void print_losses(const std::vector<LossEntry>& losses, const CommonOptions& common);
/// Prints the counts only.
void print_loss_counts(const std::vector<LossEntry>& losses);

/// Results of a conversion per deck, and losses by cause with the number of decks. For --check.
class ConversionCheck {
 public:
  enum class Outcome : std::uint8_t {
    written,     ///< without loss, or with accepted losses
    undecided,   ///< written, with decisions left
    refused,     ///< not written
    unreadable,  ///< unreadable, or with a missing include
  };
  /// Adds a deck; `refusals` of Rewrite; `other`: another reason.
  void add(const std::string& deck, Outcome outcome, const std::vector<LossEntry>& losses,
           const std::vector<std::string>& refusals = {}, const std::string& other = {});
  enum class Tense : std::uint8_t { can, was };
  /// Losses by cause, open decisions by place, and the verdict; table lines up to `width` columns
  /// (0: any).
  std::string text(bool color, std::size_t width, Tense tense = Tense::can) const;

 private:
  struct Cause {
    std::set<std::string> decks;
    std::size_t times = 0;
    std::string text, place;  ///< of the first one
  };
  std::string open_text(bool color, std::size_t width) const;
  void add_cause(const std::string& deck, const char* kind, const LossEntry& entry);
  std::map<std::string, Outcome> decks_;
  /// By kind, field and reason with numbers ignored.
  std::map<std::tuple<std::string, std::string, std::string>, Cause> causes_;
  std::set<std::pair<std::string, std::string>> open_;  ///< place, and decision to make
  bool open_repeats_ = false;                           ///< true: a cause has several places
};

}  // namespace deck::cli::verb_convert
