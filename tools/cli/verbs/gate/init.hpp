// deck gate --init: the files that hold the decks of a repository against what they are today.
#pragma once
#include <string>

#include "common.hpp"

namespace deck::cli {

struct GateInit {
  std::string forge;  ///< github or gitlab; empty: what the repository looks like
  bool overwrite = false;
  std::size_t commits = 10;
};

/// Writes the settings, the documents of today's findings and penetrations, and the workflow, all
/// or none; then says what the gate would have said of the last commits. Returns the exit code.
int init_gate(const CommonOptions& common, const GateInit& init);

}  // namespace deck::cli
