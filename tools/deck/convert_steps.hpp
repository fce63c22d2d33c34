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
  bool flatten = false;
  int version = 0;
  bool allow_loss = false;
  std::string units;
  bool keep_working = false, partial = false;
};

void add_step_options(CLI::App& app, ConvertSteps& steps);

struct ConvertStep {
  std::string option;  ///< as on the command line, for messages
  std::function<Rewrite(const EditContext&)> run;
  std::string way_out;  ///< what to do about a refusal; may be empty
};

/// Those asked for, in the order they are done. Error: an option that makes no sense.
Result<std::vector<ConvertStep>> make_steps(const ConvertSteps& steps);

}  // namespace deck::cli
