// deck cycle: what is asked for, and a run over the decks of a call.
#pragma once
#include "common.hpp"
#include "report/shared/cycle.hpp"
#include "verbs/gate/options.hpp"

namespace deck::cli::verb_cycle {

struct Options {
  CommonOptions common;
  bool all = false, effects = false, costs = false, fail = false;
  bool measures() const { return costs || !html.empty(); }
  std::string model = "robust", accuracy = "robust";
  double dt = 0, time = 0;
  std::vector<std::int64_t> only;
  std::vector<std::string> velocities, gone;
  std::string vtk, html, without;
  int steps = 1;
  GateOptions gate;
};

/// "KIND:ID" or "KIND:ID@TIME": an element that is gone from a time on.
Result<cycle::DeadElement> parse_gone(const Model& model, const std::string& text);
/// "PART=vx,vy,vz".
Result<cycle::PartVelocity> parse_velocity(const std::string& text);

/// Evaluates the contacts of every deck, and says what was asked for.
int run_cycle_verb(const Options& options);

}  // namespace deck::cli::verb_cycle
