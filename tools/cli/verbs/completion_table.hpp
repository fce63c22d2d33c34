// The options of all verbs as data, read from the command line parser itself: what man pages and
// shell completions are made of, so that they cannot differ from the program.
#pragma once
#include <string>
#include <vector>

namespace deck::cli {

struct OptionInfo {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional one its name alone
  std::string value;               ///< "FILE"; empty: a flag
  std::string range;               ///< of a number: "[0 - 1024]", "0 or more"
  std::vector<std::string> choices;
  std::string preset;  ///< default value, where the parser knows it
  std::string group;   ///< heading of its own; empty: "Options"
  std::string description;
  bool optional_value = false;  ///< a flag that also takes --name=VALUE
  bool repeatable = false, required = false;

  bool takes_file() const { return value == "FILE"; }
  bool takes_directory() const { return value == "DIR"; }
  bool takes_deck() const { return value == "DECK"; }
};

struct VerbInfo {
  std::string name, summary, description, examples;
  std::vector<OptionInfo> options;  ///< by group, in the order of --help
  std::vector<OptionInfo> positionals;
};

/// All verbs that --help lists.
std::vector<VerbInfo> describe_verbs();
/// Options of `deck` itself.
std::vector<OptionInfo> program_options();

}  // namespace deck::cli
