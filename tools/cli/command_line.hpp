// The command line parser as the verbs see it: options with where their value goes, how it is
// checked and how the help shows it. The parser itself (CLI11) is in one file, which takes longer
// to compile than all verbs together.
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

// ---- options

/// One option or flag; every call returns the option itself.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// What the help calls the value, such as FILE.
  Option& value(const std::string& name);
  Option& describe(const std::string& text);
  /// Shows the present value as the default.
  Option& show_default();
  Option& required(bool yes = true);

  /// Values that are not one of these, or not within these bounds, are refused.
  Option& one_of(std::initializer_list<const char*> values);
  Option& one_of(std::initializer_list<int> values);
  Option& range(int least, int most);
  Option& range(double least, double most);
  Option& range(std::size_t least, std::size_t most);
  /// A finite number from `least` to `most`: "nan" is none.
  Option& number(double least, double most);

  /// Takes one argument each time it is given, so that a deck behind it stays a deck.
  Option& one_each();
  /// An argument may be a list with commas.
  Option& by_commas();
  /// The same, and all the times that the option is given make one list.
  Option& comma_list();
  /// So many arguments, named `text` in the help.
  Option& takes(int count, const std::string& text);
  Option& takes(int least, int most, const std::string& text);
  /// As many arguments as there are, also none.
  Option& any_number();

  /// How often it was given.
  std::size_t count() const;

 private:
  CLI::Option* option_;
};

/// A command line: a program, or one verb of it.
class CommandLine {
 public:
  /// An empty one; `name` is what its help and its errors call it.
  CommandLine(const std::string& summary, const std::string& name, Session& session);
  /// Another name for a part of one.
  CommandLine(CLI::App* app, Session& session);
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;
  CommandLine& operator=(CommandLine&&) = delete;

  /// `names` as "-o,--output DIR": names, and what the help calls the value; without dashes it is
  /// an argument without a name. T: std::string, int, std::int64_t, std::size_t, double, or a
  /// vector of std::string or std::int64_t (command_line.cpp lists them). `target` has to outlive
  /// the parsing.
  template <class T>
  Option option(const std::string& names, T& target, const std::string& help);
  /// A number of bytes, also as 500MB or 2GB (1000 and 1000^3 bytes).
  Option bytes(const std::string& names, std::function<void(std::uint64_t)> take,
               const std::string& help);
  Option flag(const std::string& names, bool& target, const std::string& help);
  /// A flag that also takes --name=VALUE; "--backup{.orig}" says what it stands for without.
  Option flag(const std::string& names, std::string& target, const std::string& help);
  /// Options under a heading of their own.
  CommandLine group(const std::string& title);
  /// An option that is there already.
  Option existing(const std::string& name);
  void remove(const std::string& name);
  /// True if there is such an option and it was given.
  bool given(const std::string& name) const;

  /// Parses words (without the name of the program). Error: what the parser says.
  Result<void> parse(std::vector<std::string> words);
  CLI::App& parser() const { return *app_; }
  /// Of the call that the options are for.
  Session& session() const { return session_; }

 private:
  Option added(CLI::Option* option) const;

  std::unique_ptr<CLI::App> owned_;
  CLI::App* app_;
  Session& session_;
  std::string heading_;  ///< of the options that are added; empty: none of their own
};

/// Splits a line at blanks as a shell would, quotes included; the quotes are gone.
std::vector<std::string> split_words(const std::string& line);

/// A word of a command as a shell takes it: in quotes where it needs them.
std::string shell_word(const std::string& word);

/// Says what is wrong on the command line of a verb ("": of the program), and where its help is.
/// Returns exit_usage.
int wrong_usage(const std::string& verb, std::string_view message);

/// The program: finds the verb in argv, lets every verb add its options, parses and runs it.
/// `version` is what --version prints. Returns the exit code.
int run_program(int argc, char** argv, const std::string& version, Session& session);

}  // namespace deck::cli
