// deck convert in three parts: what is asked for (convert.cpp), the conversions of each deck one
// after the other (convert_deck.cpp), and where all of them go (convert_output.cpp).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common.hpp"
#include "deck/edit/rewrite.hpp"
#include "verbs/convert/convert_check.hpp"
#include "verbs/convert/convert_steps.hpp"
#include "writing/changes.hpp"

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
