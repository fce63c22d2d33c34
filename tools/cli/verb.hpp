// Verbs: how a subcommand announces itself to `deck`. A verb is one file holding one
// VerbRegistration; no other file is edited.
//
//   namespace {
//   struct Options { deck::cli::CommonOptions common; bool all = false; };
//   deck::cli::Action setup(CommandLine& line) {
//     auto options = std::make_shared<Options>();
//     deck::cli::add_common(line, options->common);
//     line.flag("--all", options->all, "Show everything");
//     return [options] { return run(*options); };   // the exit code
//   }
//   const deck::cli::VerbRegistration registration{
//       {"gaps", 30, "Gaps, stiffness and initial penetrations",
//        "  deck gaps car_0000.rad\n  deck gaps car_0000.rad --json gaps.json\n", setup}};
//   }  // namespace
#pragma once
#include <functional>
#include <string_view>
#include <vector>

namespace deck::cli {

class CommandLine;  // command_line.hpp

/// Does the work once the command line is understood; returns the exit code.
using Action = std::function<int()>;

struct Verb {
  std::string_view name;
  int rank = 100;             ///< place in the list of verbs; ties by name
  std::string_view summary;   ///< one line
  std::string_view examples;  ///< command lines, two blanks before each, for the end of --help
  Action (*setup)(CommandLine&) = nullptr;  ///< adds the options
};

/// Makes a verb known; meant for one static object per verb.
struct VerbRegistration {
  explicit VerbRegistration(const Verb& verb);
};

/// All verbs, ordered.
std::vector<Verb> verbs();

}  // namespace deck::cli
