// Options and verbs of the program. The only file with the parser of the command line (CLI11).
#include "command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <sstream>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "common.hpp"
#include "deck/text.hpp"

namespace deck::cli {

// ---- one option

Option& Option::value(const std::string& name) {
  option_->type_name(name);
  return *this;
}
Option& Option::describe(const std::string& text) {
  option_->description(text);
  return *this;
}
Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}
Option& Option::required(bool yes) {
  option_->required(yes);
  return *this;
}

namespace {

using Check = std::function<std::string(std::string&)>;

/// CLI11 validators describe values in the help; `check` decides and words the error.
CLI::Validator described_by(CLI::Validator validator, Check check) {
  return validator.operation(std::move(check));
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string close = closest_word(word, known);
  return close.empty() ? close : "; did you mean '" + close + "'?";
}

Check check_whole(std::int64_t least, std::int64_t most) {
  return [least, most](std::string& text) -> std::string {
    const IntegerCell cell = read_integer(text);
    if (cell.status == NumberStatus::ok && cell.value >= least && cell.value <= most) return {};
    return fmt::format("'{}' is not a whole number from {} to {}", text, least, most);
  };
}

Check check_number(double least, double most) {
  return [least, most](std::string& text) -> std::string {
    const RealCell cell = read_real(text);
    const bool number =
        cell.status == NumberStatus::ok || cell.status == NumberStatus::implicit_exponent;
    if (number && cell.value >= least && cell.value <= most) return {};
    return fmt::format("'{}' is not a number from {} to {}", text, least, most);
  };
}

}  // namespace

Option& Option::one_of(std::initializer_list<const char*> values) {
  const std::vector<std::string> all(values.begin(), values.end());
  option_->check(described_by(CLI::IsMember(all), [all](std::string& text) -> std::string {
    if (std::find(all.begin(), all.end(), text) != all.end()) return {};
    return fmt::format("'{}' is not one of {}{}", text, fmt::join(all, ", "),
                       did_you_mean(text, all));
  }));
  return *this;
}
Option& Option::one_of(std::initializer_list<int> values) {
  const std::vector<int> all(values);
  option_->check(described_by(CLI::IsMember(all), [all](std::string& text) -> std::string {
    const IntegerCell cell = read_integer(text);
    if (cell.status == NumberStatus::ok &&
        std::find(all.begin(), all.end(), cell.value) != all.end())
      return {};
    return fmt::format("'{}' is not one of {}", text, fmt::join(all, ", "));
  }));
  return *this;
}
Option& Option::range(int least, int most) {
  option_->check(described_by(CLI::Range(least, most), check_whole(least, most)));
  return *this;
}
Option& Option::range(double least, double most) {
  option_->check(described_by(CLI::Range(least, most), check_number(least, most)));
  return *this;
}
Option& Option::range(std::size_t least, std::size_t most) {
  option_->check(
      described_by(CLI::Range(least, most),
                   check_whole(static_cast<std::int64_t>(least), static_cast<std::int64_t>(most))));
  return *this;
}
Option& Option::number(double least, double most) {
  option_->check(CLI::Validator(check_number(least, most), ""));
  return *this;
}
Option& Option::one_each() {
  option_->allow_extra_args(false);
  return *this;
}
Option& Option::by_commas() {
  option_->delimiter(',')->allow_extra_args(false);
  return *this;
}
Option& Option::comma_list() {
  option_->delimiter(',')->expected(1)->take_all()->allow_extra_args(false);
  return *this;
}
Option& Option::expects(int count, const std::string& text) {
  option_->expected(count)->option_text(text);
  return *this;
}
Option& Option::expects(int least, int most, const std::string& text) {
  option_->expected(least, most)->option_text(text);
  return *this;
}
Option& Option::any_number() {
  option_->expected(0, -1);
  return *this;
}
std::size_t Option::count() const { return option_->count(); }

// ---- a command line

CommandLine::CommandLine(const std::string& summary, const std::string& name, Session& session)
    : owned_(std::make_unique<CLI::App>(summary, name)), app_(owned_.get()), session_(session) {}
CommandLine::CommandLine(CLI::App* app, Session& session) : app_(app), session_(session) {}
CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;

namespace {

std::string before_blank(const std::string& names) { return names.substr(0, names.find(' ')); }

/// Sets the name of the value in the help: the word after the names.
void name_value(CLI::Option& option, const std::string& names) {
  if (const auto blank = names.find(' '); blank != names.npos)
    option.type_name(names.substr(blank + 1));
}

}  // namespace

template <class T>
Option CommandLine::option(const std::string& names, T& target, const std::string& help) {
  CLI::Option* const option = app_->add_option(before_blank(names), target, help);
  name_value(*option, names);
  if constexpr (std::is_unsigned_v<T>)  // CLI11 reads "-1" as the largest number
    option->check(CLI::Validator(
        [](const std::string& text) {
          return text.starts_with('-') ? "'" + text + "' is below 0" : std::string();
        },
        ""));
  return added(option);
}
template Option CommandLine::option(const std::string&, std::string&, const std::string&);
template Option CommandLine::option(const std::string&, int&, const std::string&);
template Option CommandLine::option(const std::string&, std::int64_t&, const std::string&);
// std::size_t equals one of these types.
template Option CommandLine::option(const std::string&, unsigned long&, const std::string&);
template Option CommandLine::option(const std::string&, unsigned long long&, const std::string&);
template Option CommandLine::option(const std::string&, double&, const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::string>&,
                                    const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::int64_t>&,
                                    const std::string&);

Option CommandLine::bytes(const std::string& names, std::function<void(std::uint64_t)> take,
                          const std::string& help) {
  CLI::Option* option = app_->add_option_function<std::uint64_t>(
      before_blank(names), [take](std::uint64_t n) { take(n); }, help);
  name_value(*option, names);
  const CLI::AsSizeValue size(false);
  option->transform(described_by(size, [size](std::string& text) -> std::string {
    const std::string given = text;
    try {
      if (!text.starts_with('-') && size(text).empty()) return {};
    } catch (const CLI::ValidationError&) {  // an unknown unit
    }
    return "'" + given + "' is not a number of bytes, such as 500MB or 2GB";
  }));
  return added(option);
}
Option CommandLine::flag(const std::string& names, bool& target, const std::string& help) {
  return added(app_->add_flag(names, target, help));
}
Option CommandLine::flag(const std::string& names, std::string& target, const std::string& help) {
  return added(app_->add_flag(names, target, help));
}
CommandLine CommandLine::group(const std::string& title) {
  CommandLine line(app_, session_);
  line.heading_ = title;
  return line;
}
Option CommandLine::added(CLI::Option* option) const {
  if (!heading_.empty()) option->group(heading_);
  return Option(option);
}
Option CommandLine::existing(const std::string& name) { return Option(app_->get_option(name)); }
void CommandLine::remove(const std::string& name) { app_->remove_option(app_->get_option(name)); }
bool CommandLine::has_option(const std::string& name) const {
  const CLI::Option* option = app_->get_option_no_throw(name);
  return option != nullptr && option->count() > 0;
}

// ---- wrong usage

namespace {

/// Removed verbs and options with their replacement: exit code 2 and one sentence.
struct Removed {
  std::string_view verb, option;  ///< option empty: the verb
  std::string_view instead;
};

constexpr std::string_view naming_all =
    "the names of all decks that include the file, or of their directory";

constexpr std::array removed_words = {
    Removed{"fix", "--smooth", "--max-moved 100%, or --strategy move-part"},
    Removed{"fix", "--step", "deck fix without it"},
    Removed{"fix", "--iterations", "deck fix without it"},
    Removed{"accuracy", "--again", "deck accuracy, which measures the hard cases every time"},
    Removed{"accuracy", "--verbose", "--json, or bench_distance of tools/bench for number types"},
    Removed{"accuracy", "-v", "--json, or bench_distance of tools/bench for number types"},
    Removed{"convert", "--from", "libdeck in Python, or deck::Edit in C++"},
    Removed{"convert", "--round", "libdeck in Python, or deck::Edit in C++"},
    Removed{"convert", "--verify", "deck convert without it, which does so"},
    Removed{"convert", "--with-dependents", naming_all},
    Removed{"fix", "--with-dependents", naming_all},
    Removed{"lint", "--with-dependents", naming_all},
    Removed{"completion", "", "the file deck.bash that is installed with the program"},
    Removed{"replay", "", "the program replay of tools/bench, which is built with the tests"},
    Removed{"man", "", "the installed man pages, or deck help VERB"},
};

/// "'deck man' was removed: use …"; empty: not a removed name.
std::string removed(std::string_view verb, std::string_view option) {
  for (const Removed& r : removed_words)
    if (r.verb == verb && r.option == option)
      return "'deck " + std::string(verb) + (option.empty() ? "" : " ") + std::string(option) +
             "' was removed: use " + std::string(r.instead);
  return {};
}

/// Names of the options of a verb, including its groups (verbs without name).
void collect_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const CLI::App* group : app.get_subcommands([](const CLI::App*) { return true; }))
    if (group->get_name().empty()) collect_names(*group, names);
}

/// Words that the parser could not use.
std::string unexpected(const CLI::App& app) {
  const std::vector<std::string> all = app.remaining();
  const auto option = std::find_if(all.begin(), all.end(),
                                   [](const std::string& word) { return word.starts_with('-'); });
  if (option == all.end())
    return "unexpected argument '" + (all.empty() ? std::string() : all.front()) + "'";
  std::vector<std::string> names;
  collect_names(app, names);
  const std::string word = option->substr(0, option->find('='));
  if (std::string text = removed(app.get_name(), word); !text.empty()) return text;
  return "unknown option '" + word + "'" + did_you_mean(word, names);
}

/// Name of an option's value in the help.
std::string value_name(const CLI::Option* option) {
  const std::string text = option->get_type_name();
  return text.substr(0, text.find(':'));
}

/// The parser's message; `app` is the verb. Unknown words get a suggestion.
std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& error) {
  return dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ? unexpected(app) : error.what();
}

/// Error for an option without its value: CLI11 takes any next word, so "--json --threads 1" would
/// write a file of that name, and --compare "" (an unset variable) would compare with nothing.
/// Empty: no error.
std::string no_value(const CLI::App& app, const CLI::App& verb) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->nonpositional()) continue;
    for (const std::string& word : option->results())
      if (word.empty())
        return fmt::format("{} needs a value: {}; it is empty", option->get_name(),
                           value_name(option));
      else if (word.size() > 1 && word.starts_with('-') &&
               verb.get_option_no_throw(word.substr(0, word.find('='))) != nullptr)
        return fmt::format("{} needs a value: {}; '{}' is an option (./{} if it is a file's name)",
                           option->get_name(), value_name(option), word, word);
  }
  for (const CLI::App* group : app.get_subcommands([](const CLI::App*) { return true; }))
    if (group->get_name().empty())
      if (std::string text = no_value(*group, verb); !text.empty()) return text;
  return {};
}

}  // namespace

int wrong_usage(const std::string& verb, std::string_view message) {
  const std::string help = verb.empty() ? "Run 'deck --help' for the verbs."
                                        : "Run 'deck " + verb + " --help' for its options.";
  fmt::print(stderr, "deck: error: {}\n{}\n", terminal_text(message), help);
  return exit_usage;
}

Result<void> CommandLine::parse(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // the parser reads from the end
  try {
    app_->parse(words);
  } catch (const CLI::ParseError& e) {
    return config_error(what_is_wrong(*app_, e));
  }
  if (std::string text = no_value(*app_, *app_); !text.empty())
    return config_error(std::move(text));
  return {};
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,:=@%-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<std::string> split_words(const std::string& line) {
  std::vector<std::string> words = CLI::detail::split_up(line);
  for (std::string& w : words) CLI::detail::remove_quotes(w);
  return words;
}

// ---- the help

namespace {

/// Heading in the help for options of several verbs; nullptr: the verb's own options, at the top.
const char* heading_of(std::string_view name) {
  struct Heading {
    const char* title;
    std::string_view names;  ///< names between blanks
  };
  static constexpr Heading headings[] = {
      {"Output",
       " json quiet color verbose csv ties-csv svg vtk html all format output worst rows ruler "
       "per-rule no-group statistics report matrix markdown "},
      {"Exit code",
       " fail-on fail-on-penetration fail-on-force require-examined baseline write-baseline "},
      {"Changes", " fix unsafe-fixes diff in-place backup overwrite check no-verify "},
      {"Reading", " include-path schemas threads max-memory config no-config git "}};
  const std::string wanted = " " + std::string(name) + " ";
  for (const Heading& heading : headings)
    if (heading.names.find(wanted) != std::string_view::npos) return heading.title;
  return nullptr;
}

/// Groups the options of a verb under headings.
void group_options(CLI::App& verb) {
  for (CLI::Option* option : verb.get_options())
    if (option->nonpositional() && option->get_group() == "Options")
      for (const std::string& name : option->get_lnames())
        if (const char* const heading = heading_of(name)) {
          option->group(heading);
          break;
        }
}

/// Refuses an unknown verb with a suggestion; 0: known, or none given.
int check_verb(const std::vector<std::string>& words, const std::vector<Verb>& all) {
  if (words.empty() || words.front().starts_with('-')) return exit_clean;
  const std::string& word = words.front();
  std::vector<std::string> known = {"help"};
  for (const Verb& v : all) known.emplace_back(v.name);
  if (std::find(known.begin() + 1, known.end(), word) != known.end()) return exit_clean;
  if (const std::string text = removed(word, ""); !text.empty()) return wrong_usage("", text);
  std::string text = "there is no verb '" + word + "'";
  if (word.find('.') != std::string::npos)
    text += "; name what to do first, for example: deck params " + word;
  else
    text += did_you_mean(word, known);
  return wrong_usage("", text);
}

/// Continues help lines longer than `width` (0: no limit) below their description.
std::string folded_help(std::string_view text, std::size_t width) {
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto start = line.find_first_not_of(' ');
    if (start == line.npos && out.ends_with("\n\n")) continue;  // one empty line between groups
    if (width == 0 || start == line.npos || display_width(line) <= width) {
      out += std::string(line) + '\n';
      continue;
    }
    const auto gap = line.find("  ", start);
    auto column =
        gap == line.npos ? start : std::min(line.find_first_not_of(' ', gap), line.size());
    if (2 * column > width) column = start;
    std::string words = wrapped(line.substr(column), column, width);
    if (column > start) words.replace(0, column, line.substr(0, column));
    out += words;
  }
  return out;
}

/// Converts "deck help VERB" to "deck VERB --help".
void help_verb_to_option(std::vector<std::string>& words) {
  if (words.empty() || words.front() != "help") return;
  words.erase(words.begin());
  if (!words.empty() && !words.front().starts_with('-')) words.resize(1);
  words.emplace_back("--help");
}

}  // namespace

int run_program(int argc, char** argv, const std::string& version, Session& session) {
  const std::vector<Verb> all = verbs();
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  help_verb_to_option(words);
  if (const int code = check_verb(words, all); code != exit_clean) return code;
  CLI::App app("Contacts and ties of Radioss decks: read, check, measure, rewrite.", "deck");
  app.set_version_flag("--version", version, "Version and compiler");
  app.set_help_flag("-h,--help", "This help; 'deck help VERB' explains a verb");
  std::map<CLI::App*, Action> actions;
  for (const Verb& v : all) {
    CLI::App* sub = app.add_subcommand(std::string(v.name), std::string(v.summary));
    if (std::find(words.begin(), words.end(), v.name) == words.end()) continue;  // start-up time
    sub->set_help_flag("-h,--help", "This help");
    if (!v.examples.empty()) sub->footer("Examples:\n" + std::string(v.examples) + "\n");
    CommandLine line(sub, session);
    actions[sub] = v.setup(line);
    group_options(*sub);
  }
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n"
      "  deck lint car_0000.rad                what is wrong on the cards and in the mesh\n"
      "  deck gaps car_0000.rad --html a.html  penetrations, in a page for the browser\n"
      "  deck params car_0000.rad --json -     effective values, for programs\n"
      "\n"
      "Exit codes: 0 nothing at --fail-on or above, 1 findings, 2 wrong usage, 3 unreadable input, "
      "4 internal error.");
  try {
    std::reverse(words.begin(), words.end());  // the parser reads from the end
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    const auto verb = app.get_subcommands();
    if (e.get_exit_code() != 0) {
      if (verb.empty()) return wrong_usage("", what_is_wrong(app, e));
      return wrong_usage(verb.front()->get_name(), what_is_wrong(*verb.front(), e));
    }
    std::ostringstream out;
    app.exit(e, out, out);
    std::fputs(folded_help(out.str(), text_width()).c_str(), stdout);
    return exit_clean;
  }
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    std::fputs(folded_help(app.help(), terminal_width(2)).c_str(), stderr);
    return exit_usage;
  }
  if (const std::string text = no_value(*chosen.front(), *chosen.front()); !text.empty())
    return wrong_usage(chosen.front()->get_name(), text);
  return actions.at(chosen.front())();
}

}  // namespace deck::cli
