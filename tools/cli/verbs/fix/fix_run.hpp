// deck fix: what is asked for, and a run over the decks of a call.
#pragma once
#include "common.hpp"
#include "deck/edit/fix.hpp"
#include "edit/shared/depenetrate.hpp"
#include "writing/changes.hpp"

namespace deck::cli::verb_fix {

struct Options {
  CommonOptions common;
  std::vector<std::string> strategies;  ///< in this order
  std::string html;
  WriteChoice write;
  bool ties = false;
  std::vector<std::int64_t> interfaces;
  std::size_t rows = 10;
  MoveNodesOptions move;
  std::string max_moved = "10%", max_displacement, min_gap = "50%", fpenmax, inacti, reach;
  int digits = 6;
};

/// "10%" or "0.1" as 0.1; nullopt if it is neither, or outside 0..1.
std::optional<double> share(std::string text);

/// Fixes the decks together, or says what each strategy would do.
int run(const Options& options);

}  // namespace deck::cli::verb_fix
