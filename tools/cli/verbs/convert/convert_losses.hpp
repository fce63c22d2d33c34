// What conversions cost, for people: losses line by line, and by their causes over many decks.
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

/// A refusal ("file:line:column: /KEYWORD/id field: why") as an entry of the report.
LossEntry refused_entry(const std::string& refusal);

/// Counts for people; what was lost or waits for a decision line by line. Values without effect of
/// one field are one line.
void print_losses(const std::vector<LossEntry>& losses, const CommonOptions& common);
/// The counts alone.
void print_loss_counts(const std::vector<LossEntry>& losses);

/// What a conversion would do to each deck, and what it would lose: one line a cause, with the
/// number of decks. For --check, before a library is converted.
class ConversionCheck {
 public:
  enum class Outcome : std::uint8_t {
    written,     ///< without a loss, or with losses that were accepted
    undecided,   ///< written, and somebody has to decide something
    refused,     ///< not written
    unreadable,  ///< could not be read, or lacks an include
  };

  /// One deck; `refusals` as Rewrite has them, `other` why else it is not written.
  void add(const std::string& deck, Outcome outcome, const std::vector<LossEntry>& losses,
           const std::vector<std::string>& refusals = {}, const std::string& other = {});
  enum class Tense : std::uint8_t { can, was };
  /// What would be lost by its causes, what is left to a person by its places, and the verdict;
  /// lines of tables have at most `width` columns (0: any).
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
  /// By kind, field and reason; numbers in the reason do not make another cause.
  std::map<std::tuple<std::string, std::string, std::string>, Cause> causes_;
  std::set<std::pair<std::string, std::string>> open_;  ///< place, and what a person has to decide
  bool open_repeats_ = false;                           ///< one cause in several places
};

}  // namespace deck::cli::verb_convert
