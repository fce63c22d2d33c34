// The only file that knows the parser of the command line (CLI11): options, the verbs of the
// program, and what man pages and completion read from it.
#include "command_line.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>

#include "common.hpp"
#include "deck/base/escape.hpp"
#include "deck/base/spelling.hpp"
#include "deck/text/number.hpp"
#include "help/completion_table.hpp"

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
Option& Option::heading(const std::string& title) {
  option_->group(title);
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
Option& Option::one_of(std::initializer_list<const char*> values) {
  option_->check(CLI::IsMember(std::vector<std::string>(values.begin(), values.end())));
  return *this;
}
Option& Option::one_of(std::initializer_list<int> values) {
  option_->check(CLI::IsMember(std::vector<int>(values)));
  return *this;
}
Option& Option::range(int least, int most) {
  option_->check(CLI::Range(least, most));
  return *this;
}
Option& Option::range(double least, double most) {
  option_->check(CLI::Range(least, most));
  return *this;
}
Option& Option::range(std::size_t least, std::size_t most) {
  option_->check(CLI::Range(least, most));
  return *this;
}
// CLI::Range lets "nan" pass.
Option& Option::number(double least, double most) {
  const auto check = [least, most](std::string& text) -> std::string {
    const RealCell cell = read_real(text);
    const bool number =
        cell.status == NumberStatus::ok || cell.status == NumberStatus::implicit_exponent;
    if (number && cell.value >= least && cell.value <= most) return {};
    return fmt::format("'{}' is not a number from {} to {}", text, least, most);
  };
  option_->check(CLI::Validator(check, ""));
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
  option_->delimiter(',')->expected(1)->take_all();
  return *this;
}
Option& Option::takes(int count, const std::string& text) {
  option_->expected(count)->option_text(text);
  return *this;
}
Option& Option::any_number() {
  option_->expected(0, -1);
  return *this;
}
std::size_t Option::count() const { return option_->count(); }

// ---- a command line

CommandLine::CommandLine(const std::string& summary, const std::string& name)
    : owned_(std::make_unique<CLI::App>(summary, name)), app_(owned_.get()) {}
CommandLine::CommandLine(CLI::App* app) : app_(app) {}
CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;

template <class T>
Option CommandLine::option(const std::string& names, T& target, const std::string& help) {
  return Option(app_->add_option(names, target, help));
}
template Option CommandLine::option(const std::string&, std::string&, const std::string&);
template Option CommandLine::option(const std::string&, int&, const std::string&);
template Option CommandLine::option(const std::string&, std::int64_t&, const std::string&);
template Option CommandLine::option(const std::string&, std::size_t&, const std::string&);
template Option CommandLine::option(const std::string&, double&, const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::string>&,
                                    const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::int64_t>&,
                                    const std::string&);

Option CommandLine::bytes(const std::string& names, std::function<void(std::uint64_t)> take,
                          const std::string& help) {
  CLI::Option* option = app_->add_option_function<std::uint64_t>(
      names, [take](std::uint64_t n) { take(n); }, help);
  option->transform(CLI::AsSizeValue(false));
  return Option(option);
}
Option CommandLine::flag(const std::string& names, bool& target, const std::string& help) {
  return Option(app_->add_flag(names, target, help));
}
Option CommandLine::flag(const std::string& names, std::string& target, const std::string& help) {
  return Option(app_->add_flag(names, target, help));
}
CommandLine CommandLine::group(const std::string& title) {
  return CommandLine(app_->add_option_group(title));
}
Option CommandLine::existing(const std::string& name) { return Option(app_->get_option(name)); }
void CommandLine::remove(const std::string& name) { app_->remove_option(app_->get_option(name)); }
bool CommandLine::given(const std::string& name) const {
  const CLI::Option* option = app_->get_option_no_throw(name);
  return option != nullptr && option->count() > 0;
}
void CommandLine::hide() { app_->group(""); }
bool CommandLine::hidden() const { return app_->get_group().empty(); }

Result<void> CommandLine::parse(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // the parser takes them from the back
  try {
    app_->parse(words);
  } catch (const CLI::ParseError& e) {
    return Error{Error::Code::config, e.what()};
  }
  return {};
}

std::vector<std::string> split_words(const std::string& line) {
  std::vector<std::string> words = CLI::detail::split_up(line);
  for (std::string& w : words) CLI::detail::remove_quotes(w);
  return words;
}

// ---- what there is, as data

namespace {

/// "FORMAT:{human,json}" and "N:INT in [0 - 1024]" as name, choices and range.
void split_type(const std::string& type, OptionInfo& info) {
  const auto colon = type.find(':');
  info.value = type.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string rest = type.substr(colon + 1);
  if (!rest.starts_with('{')) {
    // "INT in [0 - 9]", NONNEGATIVE
    if (const auto bracket = rest.find(" in ["); bracket != std::string::npos)
      info.range = rest.substr(bracket + 4);
    else if (rest == "NONNEGATIVE" || rest == "POSITIVE")
      info.range = rest == "POSITIVE" ? "above 0" : "0 or more";
    return;
  }
  const auto end = rest.find('}');
  info.choices = CLI::detail::split(rest.substr(1, end - 1), ',');
}

OptionInfo describe(const CLI::Option& option, const std::string& group) {
  OptionInfo info;
  for (const std::string& s : option.get_snames()) info.names.push_back("-" + s);
  for (const std::string& l : option.get_lnames()) info.names.push_back("--" + l);
  if (option.get_positional() && info.names.empty()) info.names.push_back(option.get_name(true));
  info.optional_value = option.get_expected_min() == 0 && !option.get_fnames().empty();
  if (option.get_items_expected_max() > 0 && option.get_expected_min() > 0)
    split_type(option.get_type_name(), info);
  info.preset = option.get_default_str();
  info.group = group.empty() && option.get_group() != "Options" ? option.get_group() : group;
  info.description = option.get_description();
  info.repeatable = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  info.required = option.get_required();
  return info;
}

void collect(const CLI::App& app, const std::string& group, VerbInfo& verb) {
  for (const CLI::Option* option : app.get_options()) {
    // Hidden ones, and the help that every option group has once more.
    if (option->get_group().empty() || (!group.empty() && option->check_lname("help"))) continue;
    OptionInfo info = describe(*option, group);
    (option->nonpositional() ? verb.options : verb.positionals).push_back(std::move(info));
  }
  // Option groups are subcommands without a name.
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    if (sub->get_name().empty() && !sub->get_group().empty()) collect(*sub, sub->get_group(), verb);
}

/// Refuses an unknown verb with the closest known one; 0: the verb is known or there is none.
int check_verb(int argc, char** argv, const std::vector<Verb>& all) {
  if (argc < 2 || argv[1][0] == '-') return 0;
  const std::string_view word = argv[1];
  const Verb* best = nullptr;
  std::size_t distance = 4;
  for (const Verb& v : all) {
    if (v.name == word) return 0;
    if (const auto d = edit_distance(word, v.name); d < distance) {
      distance = d;
      best = &v;
    }
  }
  std::string text = "deck: error: there is no verb '" + terminal_text(word) + "'";
  if (word.find('.') != std::string_view::npos)
    text += "; name what to do first, for example: deck params " + terminal_text(word);
  else if (best != nullptr)
    text += "; did you mean '" + std::string(best->name) + "'?";
  text += "\nRun 'deck --help' for the list.\n";
  std::fputs(text.c_str(), stderr);
  return exit_usage;
}

}  // namespace

std::vector<VerbInfo> describe_verbs() {
  std::vector<VerbInfo> all;
  for (const Verb& v : verbs()) {
    CommandLine line((std::string(v.summary)), std::string(v.name));
    line.parser().set_help_flag("-h,--help", "This help");
    const Action action = v.setup(line);  // holds what the options are stored in
    if (line.hidden()) continue;
    VerbInfo info;
    info.name = v.name;
    info.summary = v.summary;
    info.description = line.parser().get_description();
    info.examples = v.examples;
    collect(line.parser(), "", info);
    std::stable_sort(info.options.begin(), info.options.end(),
                     [](const OptionInfo& a, const OptionInfo& b) {
                       return a.group.empty() && !b.group.empty();
                     });
    all.push_back(std::move(info));
  }
  return all;
}

std::vector<OptionInfo> program_options() {
  OptionInfo help, version;
  help.names = {"-h", "--help"};
  help.description = "Help; deck VERB --help explains a verb";
  version.names = {"--version"};
  version.description = "Version and compiler";
  return {help, version};
}

// ---- the program

int run_program(int argc, char** argv, const std::string& version) {
  const std::vector<Verb> all = verbs();
  if (const int code = check_verb(argc, argv, all); code != 0) return code;
  CLI::App app("Radioss contact decks (TYPE7, 10, 11, 19): read, check, measure, rewrite.", "deck");
  app.set_version_flag("--version", version, "Version and compiler");
  app.set_help_flag("-h,--help", "This help; 'deck VERB --help' explains a verb");
  std::map<CLI::App*, Action> actions;
  for (const Verb& v : all) {
    CLI::App* sub = app.add_subcommand(std::string(v.name), std::string(v.summary));
    sub->set_help_flag("-h,--help", "This help");
    if (!v.examples.empty()) sub->footer("Examples:\n" + std::string(v.examples));
    CommandLine line(sub);
    actions[sub] = v.setup(line);
  }
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n"
      "  deck params car_0000.rad              what every interface really uses\n"
      "  deck params car_0000.rad --json -     the same for programs\n"
      "\n"
      "Exit codes: 0 clean, 1 findings, 2 wrong usage, 3 input could not be read, 4 internal "
      "error.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream out, err;
    const int code = app.exit(e, out, err);
    std::fputs(out.str().c_str(), stdout);
    std::fputs(terminal_lines(err.str()).c_str(), stderr);
    return code == 0 ? exit_clean : exit_usage;
  }
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return exit_usage;
  }
  return actions.at(chosen.front())();
}

}  // namespace deck::cli
