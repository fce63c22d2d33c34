// Interface of the command line parser for verbs: options with target, check and help. CLI11 is
// included by one file only, because it takes longer to compile than all verbs.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text.hpp"
#include "session.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace deck::cli {

// ---- verbs: how a subcommand announces itself to `deck`. A verb is one file holding one
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
//        "  deck gaps car_0000.rad\n  deck gaps car_0000.rad --json gaps.json", setup}};
//   }  // namespace

class CommandLine;

/// Runs the verb after parsing; returns the exit code.
using Action = std::function<int()>;

struct Verb {
  std::string_view name;
  int rank = 100;             ///< position in the list of verbs; ties by name
  std::string_view summary;   ///< one line
  std::string_view examples;  ///< command lines for the end of --help, each after two blanks
  Action (*setup)(CommandLine&) = nullptr;  ///< adds the options
};

/// Registers a verb; one static object per verb.
struct VerbRegistration {
  explicit VerbRegistration(const Verb& verb);
};

/// All verbs in order.
std::vector<Verb> verbs();

// ---- options

/// An option or flag. Functions return it, for chaining.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// Name of the value in the help, such as FILE.
  Option& value(const std::string& name);
  Option& describe(const std::string& text);
  /// Shows the current value as the default.
  Option& show_default();
  Option& required(bool yes = true);

  /// Legal values or bounds.
  Option& one_of(std::initializer_list<const char*> values);
  Option& one_of(std::initializer_list<int> values);
  Option& range(int least, int most);
  Option& range(double least, double most);
  Option& range(std::size_t least, std::size_t most);
  /// A finite number from `least` to `most`.
  Option& number(double least, double most);

  /// One argument per occurrence, so that a following deck is not taken.
  Option& one_each();
  /// An argument can be a list with commas.
  Option& by_commas();
  /// A list with commas; all occurrences are combined.
  Option& comma_list();
  /// Expects exactly `count` arguments, shown as `text` in --help.
  Option& expects(int count, const std::string& text);
  Option& expects(int least, int most, const std::string& text);
  /// Any number of arguments, also none.
  Option& any_number();

  /// Number of occurrences.
  std::size_t count() const;

 private:
  CLI::Option* option_;
};

/// A command line of the program or a verb.
class CommandLine {
 public:
  /// An empty one; `name` is used in help and errors.
  CommandLine(const std::string& summary, const std::string& name, Session& session);
  /// Wraps an existing subcommand.
  CommandLine(CLI::App* app, Session& session);
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;
  CommandLine& operator=(CommandLine&&) = delete;

  /// `names`: "-o,--output DIR" (names, and the value's name in the help); without dashes: a
  /// positional argument. T: std::string, int, std::int64_t, std::size_t, double, or a vector of
  /// std::string or std::int64_t (list in command_line.cpp). `target` must outlive the parsing.
  template <class T>
  Option option(const std::string& names, T& target, const std::string& help);
  /// A number of bytes, optionally as 500MB or 2GB (1000 and 1000^3 bytes).
  Option bytes(const std::string& names, std::function<void(std::uint64_t)> take,
               const std::string& help);
  Option flag(const std::string& names, bool& target, const std::string& help);
  /// A flag with an optional --name=VALUE; "--backup{.orig}" gives the default value.
  Option flag(const std::string& names, std::string& target, const std::string& help);
  /// Options under their own heading.
  CommandLine group(const std::string& title);
  /// An option added before.
  Option existing(const std::string& name);
  void remove(const std::string& name);
  /// True if the option exists and was given.
  bool has_option(const std::string& name) const;

  /// Parses words without the program name. Error: the parser's message.
  Result<void> parse(std::vector<std::string> words);
  /// Session of this call.
  Session& session() const { return session_; }

 private:
  Option added(CLI::Option* option) const;

  std::unique_ptr<CLI::App> owned_;
  CLI::App* app_;
  Session& session_;
  std::string heading_;  ///< heading of new options; empty: none
};

/// Splits a line like a shell and removes quotes.
std::vector<std::string> split_words(const std::string& line);

/// Quotes a word for a shell if needed.
std::string shell_word(const std::string& word);

/// Prints a usage error of a verb ("": the program) and where its help is. Returns exit_usage.
int wrong_usage(const std::string& verb, std::string_view message);

/// The program: finds the verb in argv, parses its options and runs it. `version` is printed by
/// --version. Returns the exit code.
int run_program(int argc, char** argv, const std::string& version, Session& session);

}  // namespace deck::cli
