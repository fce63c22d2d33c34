// The settings of lint and of the gate as people ask for them: a file to begin with, and what holds
// for a deck and where it comes from.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "verbs/gate/options.hpp"

namespace deck::cli {

/// What the command line says.
struct GivenSettings {
  std::vector<std::string> select, ignore;
  std::string baseline;
  GateOptions gate;
  std::optional<bool> geometry;  ///< --geometry, --no-geometry
};

/// Every setting, its value and its origin: an option, a line of the configuration, or the default.
std::string settings_text(const LintConfig& config, const GivenSettings& given);

/// Writes .decklint.toml into a directory that has none. Error: there is one, or it cannot be
/// written. Returns its path.
Result<std::string> write_settings_file(const std::string& directory);

}  // namespace deck::cli
