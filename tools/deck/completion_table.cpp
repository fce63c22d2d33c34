#include "completion_table.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

#include "verbs.hpp"

namespace deck::cli {
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

}  // namespace

std::vector<VerbInfo> describe_verbs() {
  std::vector<VerbInfo> all;
  for (const Verb& v : verbs()) {
    CLI::App app(std::string(v.summary), std::string(v.name));
    app.set_help_flag("-h,--help", "This help");
    const Action action = v.setup(app);     // holds what the options are stored in
    if (app.get_group().empty()) continue;  // hidden
    VerbInfo info;
    info.name = v.name;
    info.summary = v.summary;
    info.description = app.get_description();
    info.examples = v.examples;
    collect(app, "", info);
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

}  // namespace deck::cli
