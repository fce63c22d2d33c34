// deck convert in its parts: what is asked for (convert.cpp), the conversions (convert_steps.cpp)
// of each deck one after the other (convert_deck.cpp), what they cost (convert_losses.cpp), and
// where all of them go (convert_output.cpp).
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common.hpp"
#include "deck/edit/rewrite.hpp"
#include "writing/changes.hpp"

namespace deck::cli {

// ---- the conversions

struct ConvertSteps {
  std::vector<std::int64_t> extract;
  bool flatten = false, expand_type19 = false, resolve_defaults = false;
  int version = 0;
  bool allow_loss = false;
  std::string units;
  bool keep_working = false, partial = false;
  std::vector<std::string> renumber;
};

void add_step_options(CommandLine& line, ConvertSteps& steps);

struct ConvertStep {
  std::string option;  ///< as on the command line, for messages
  std::function<Rewrite(const LoadedDeck&)> run;
  std::string way_out;  ///< what to do about a refusal; may be empty
  /// What the Engine files beside the deck need; may be empty.
  std::function<void(const Deck&, const EngineFiles&, Rewrite&)> engine = {};
};

/// Those asked for, in the order they are done. Error: an option that makes no sense.
Result<std::vector<ConvertStep>> make_steps(const ConvertSteps& steps);

// ---- what a conversion costs

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

}  // namespace deck::cli

namespace deck::cli::verb_convert {

struct ConvertOptions {
  CommonOptions common;
  ConvertSteps steps;
  WriteChoice write;
  std::string to = "rad";
  std::string report;
  bool verify = false, no_verify = false;
  bool check = false;  ///< nothing is written: what would happen
  /// Every step is compared with the deck before it.
  bool verifies() const { return !no_verify; }
};

/// A deck in JSON; `below_root` is its place where the call mirrors a tree.
struct Document {
  std::string deck, text;
  std::filesystem::path below_root;
};

/// All decks of the call: converted one after the other, written together or not at all.
struct ConvertRun {
  const ConvertOptions& options;
  const std::vector<ConvertStep> steps;
  Changes changes;
  Progress progress;
  std::vector<Document> documents = {};
  std::vector<LossEntry> losses = {};
  bool refused = false;   ///< nothing may be written
  bool together = false;  ///< several decks: what they lose is said once, by its causes
  ConversionCheck check = {};
};

/// Prints the error of wrong usage; the exit code.
int fail(const ConvertRun& run, const Error& error);

/// Reads and converts one deck; what it has become is kept until all are ready. The exit code.
int convert_one(ConvertRun& run, const std::string& path, const SchemaSet& schemas);

/// The deck in JSON, kept until all decks of the call are ready.
int add_document(ConvertRun& run, const LoadedDeck& deck);
/// Writes what all decks have become, or prints it; nothing with --check. The exit code.
int write_all(ConvertRun& run);

}  // namespace deck::cli::verb_convert
