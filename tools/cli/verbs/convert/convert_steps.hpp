// The conversions of `deck convert`: their options, and the functions of the library behind them.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common.hpp"
#include "deck/edit/rewrite.hpp"

namespace deck::cli {

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

}  // namespace deck::cli
