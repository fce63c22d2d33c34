// deck gate --init: files for a gate with the current state as baseline.
#pragma once
#include <string>

#include "common.hpp"

namespace deck::cli {

struct GateInit {
  std::string forge;  ///< github or gitlab; empty: detected
  bool overwrite = false;
  std::size_t commits = 10;
};

/// Writes settings, baselines and workflow, all or none; prints gate results of the last commits.
/// Returns the exit code.
int init_gate(const CommonOptions& common, const GateInit& init);

}  // namespace deck::cli
