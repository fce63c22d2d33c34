// deck completion: scripts with which bash and zsh complete verbs, options and their values,
// made from the options that the parser knows.
#include <fmt/format.h>

#include <algorithm>

#include "common.hpp"
#include "lint/shared/topics.hpp"
#include "verbs/completion_table.hpp"

namespace deck::cli::verb_completion {
namespace {

struct Options {
  std::string shell;
};

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : between) + w;
  return text;
}

/// In single quotes of a shell.
std::string shell_quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<std::string> option_names(const VerbInfo& v) {
  std::vector<std::string> names;
  for (const OptionInfo& o : v.options) names.insert(names.end(), o.names.begin(), o.names.end());
  return names;
}

bool has_decks(const VerbInfo& v) {
  return std::any_of(v.positionals.begin(), v.positionals.end(),
                     [](const OptionInfo& p) { return p.takes_deck(); });
}

// ---- bash -----------------------------------------------------------------------------------

/// Lines of `case "$verb $previous"`: what completes the value of each option.
std::string bash_values(const std::vector<VerbInfo>& all) {
  std::string text;
  for (const VerbInfo& v : all)
    for (const OptionInfo& o : v.options) {
      if (o.value.empty()) continue;
      std::vector<std::string> patterns;
      for (const std::string& n : o.names) patterns.push_back(shell_quoted(v.name + " " + n));
      const std::string words = !o.choices.empty()    ? "words=" + shell_quoted(joined(o.choices))
                                : o.takes_file()      ? "kind=file"
                                : o.takes_directory() ? "kind=directory"
                                                      : "kind=none";
      text += "    " + joined(patterns, "|") + ") " + words + " ;;\n";
    }
  return text;
}

std::string bash_script(const std::vector<VerbInfo>& all) {
  std::vector<std::string> verbs;
  std::string options, positionals;
  for (const VerbInfo& v : all) {
    verbs.push_back(v.name);
    options +=
        fmt::format("      {}) words={} ;;\n", v.name, shell_quoted(joined(option_names(v))));
    if (has_decks(v)) {
      positionals += fmt::format("      {}) kind=deck ;;\n", v.name);
    } else {
      for (const OptionInfo& p : v.positionals)
        if (!p.choices.empty())
          positionals +=
              fmt::format("      {}) words={}{} ;;\n", v.name, shell_quoted(joined(p.choices)),
                          p.value == "TOPIC" ? " kind=topic" : "");
    }
  }
  std::vector<std::string> program;
  for (const OptionInfo& o : program_options())
    program.insert(program.end(), o.names.begin(), o.names.end());
  return "# bash completion of deck; made by: deck completion bash\n"
         "_deck() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous= verb= words= kind=\n"
         "  [ \"$COMP_CWORD\" -gt 0 ] && previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  [ \"$COMP_CWORD\" -gt 1 ] && verb=${COMP_WORDS[1]}\n"
         "  # --option=value comes as three words.\n"
         "  if [ \"$current\" = = ]; then\n"
         "    current=\n"
         "  elif [ \"$previous\" = = ]; then\n"
         "    previous=${COMP_WORDS[COMP_CWORD-2]}\n"
         "  fi\n"
         "  COMPREPLY=()\n"
         "  if [ -z \"$verb\" ]; then\n"
         "    COMPREPLY=($(compgen -W " +
         shell_quoted(joined(verbs) + " " + joined(program)) +
         " -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  case \"$verb $previous\" in\n" +
         bash_values(all) +
         "  esac\n"
         "  if [ -z \"$words$kind\" ]; then\n"
         "    case \"$current\" in\n"
         "    -*) case \"$verb\" in\n" +
         options +
         "      esac ;;\n"
         "    *) case \"$verb\" in\n" +
         positionals +
         "      esac ;;\n"
         "    esac\n"
         "  fi\n"
         "  local IFS=$'\\n'\n"
         "  case \"$kind\" in\n"
         "  file) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -f -- \"$current\")) ;;\n"
         "  directory) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -d -- \"$current\")) "
         ";;\n"
         "  deck) compopt -o filenames 2>/dev/null\n"
         "    COMPREPLY=($(compgen -f -X '!*.rad' -- \"$current\") $(compgen -d -- \"$current\")) "
         ";;\n"
         "  none) ;;\n"
         "  topic) IFS=$' \\t\\n' COMPREPLY=($(IFS=' '; compgen -W \"$words\" -- \"$current\"; "
         "compgen -f -X '!*.out' -- \"$current\")) ;;\n"
         "  *) IFS=$' \\t\\n' COMPREPLY=($(IFS=' '; compgen -W \"$words\" -- \"$current\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -F _deck deck\n";
}

// ---- zsh ------------------------------------------------------------------------------------

/// Text inside [...] of an _arguments specification.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_action(const OptionInfo& o) {
  if (o.value == "TOPIC")  // words, and listings
    return "{ compadd -- " + joined(o.choices) + "; _files -g \"*.out(-.)\" }";
  if (!o.choices.empty()) return "(" + joined(o.choices) + ")";
  if (o.takes_file()) return "_files";
  if (o.takes_directory()) return "_files -/";
  if (o.takes_deck()) return "_files -g \"*.rad(-.)\"";
  return " ";
}

std::string zsh_option(const OptionInfo& o) {
  std::string text;
  for (const std::string& name : o.names) {
    std::string spec = o.repeatable ? "*" : "";
    if (!o.repeatable && o.names.size() > 1) spec += "(" + joined(o.names) + ")";
    spec += name;
    if (!o.value.empty() && name.starts_with("--")) spec += "=";
    spec += "[" + zsh_text(o.description) + "]";
    if (!o.value.empty()) spec += ":" + zsh_text(o.value) + ":" + zsh_action(o);
    text += " \\\n        " + shell_quoted(spec);
  }
  return text;
}

std::string zsh_script(const std::vector<VerbInfo>& all) {
  std::string verbs, cases;
  for (const VerbInfo& v : all) {
    verbs += "    " + shell_quoted(v.name + ":" + zsh_text(v.summary)) + "\n";
    cases += "    " + v.name + ")\n      _arguments -s -S";
    for (const OptionInfo& o : v.options) cases += zsh_option(o);
    for (const OptionInfo& p : v.positionals)
      cases += " \\\n        " +
               shell_quoted((p.repeatable ? "*:" : ":") +
                            zsh_text(p.value.empty() ? p.names[0] : p.value) + ":" + zsh_action(p));
    cases += " ;;\n";
  }
  std::string program;
  for (const OptionInfo& o : program_options()) program += zsh_option(o);
  return "#compdef deck\n"
         "# zsh completion of deck; made by: deck completion zsh\n"
         "_deck() {\n"
         "  local state line\n"
         "  local -a verbs\n"
         "  verbs=(\n" +
         verbs +
         "  )\n"
         "  _arguments -C" +
         program +
         " \\\n        '1: :->verb' '*:: :->rest'\n"
         "  case $state in\n"
         "  verb) _describe -t verbs verb verbs ;;\n"
         "  rest)\n"
         "    case $line[1] in\n" +
         cases +
         "    esac ;;\n"
         "  esac\n"
         "}\n"
         "if [ \"$funcstack[1]\" = _deck ]; then _deck \"$@\"; else compdef _deck deck; fi\n";
}

/// Words for what the parser takes as free text: rules, and topics of explain.
void offer_words(std::vector<VerbInfo>& all) {
  const std::vector<std::string> topics = common_topics(SchemaSet::built_in());
  std::vector<std::string> rules;
  for (const std::string& t : topics)
    if (t.starts_with("DK")) rules.push_back(t);
  for (VerbInfo& v : all) {
    for (OptionInfo& o : v.options)
      if (o.value == "RULES") o.choices = rules;
    for (OptionInfo& p : v.positionals)
      if (p.value == "TOPIC") p.choices = topics;
  }
}

int run(const Options& o) {
  auto all = describe_verbs();
  offer_words(all);
  print_text(o.shell == "bash" ? bash_script(all) : zsh_script(all));
  return exit_clean;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  line.hide();  // for the build and for setting up, not for the list of verbs
  line.option("shell", options->shell, "bash or zsh")
      .required()
      .one_of({"bash", "zsh"})
      .value("SHELL");
  return [options] { return run(*options); };
}

const VerbRegistration registration{{"completion", 910, "Completion script for a shell",
                                     "  eval \"$(deck completion bash)\"\n"
                                     "  deck completion zsh > ~/.zfunc/_deck\n",
                                     setup}};

}  // namespace
}  // namespace deck::cli::verb_completion
