// deck man: the man pages, made from the options that the parser knows. The build calls it; it is
// not listed among the verbs.

#include "common.hpp"
#include "deck/model/coverage.hpp"
#include "report/shared/json.hpp"
#include "verbs/completion_table.hpp"

namespace deck::cli::verb_man {
namespace {

struct Options {
  std::string verb, directory;
  Session* session = nullptr;
};

/// Text for roff: backslashes and hyphens as they are.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '`')
      out += "\\(ga";
    else if (c == '^')
      out += "\\(ha";
    else if (c == '~')
      out += "\\(ti";
    else
      out += c;
  }
  return out;
}

/// A line of text: one that begins with a dot is no request.
std::string line(std::string_view text) {
  std::string out = plain(text);
  if (out.starts_with('.')) out.insert(0, "\\&");
  return out + "\n";
}

std::string bold(std::string_view text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + plain(text) + "\\fR"; }

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string title(const std::string& name) {
  return ".TH " + plain(upper(name)) + " 1 \"\" \"deck " + plain(library_version()) +
         "\" \"Radioss contact decks\"\n";
}

std::string option_text(const OptionInfo& o) {
  std::string head;
  for (const std::string& name : o.names) {
    if (!head.empty()) head += ", ";
    head += name.starts_with('-') ? bold(name) : italic(o.value.empty() ? name : o.value);
  }
  if (!o.value.empty() && o.names.front().starts_with('-')) head += " " + italic(o.value);
  if (o.optional_value) head += "[=" + italic("VALUE") + "]";
  std::string text = ".TP\n" + head + "\n" + line(o.description + ".");
  std::string more;
  const auto add = [&](const std::string& sentence) {
    more += (more.empty() ? "" : " ") + sentence;
  };
  if (!o.choices.empty()) {
    std::string list;
    for (const std::string& c : o.choices) list += (list.empty() ? "" : ", ") + bold(c);
    add("One of " + list + ".");
  }
  if (!o.range.empty()) add(plain("Range: " + o.range + "."));
  if (!o.preset.empty()) add("Default: " + plain(o.preset) + ".");
  if (o.repeatable && o.description.find("repeatable") == std::string::npos)
    add("May be given several times.");
  if (o.required) add("Required.");
  if (!more.empty()) text += more + "\n";
  return text;
}

std::string options_text(const std::vector<OptionInfo>& options) {
  std::string text, group;
  for (const OptionInfo& o : options) {
    if (o.group != group) text += ".SS " + plain(group = o.group) + "\n";
    text += option_text(o);
  }
  return text;
}

std::string exit_status() {
  std::string text = ".SH EXIT STATUS\n";
  const std::pair<const char*, const char*> codes[] = {
      {"0", "Clean."},
      {"1", "Findings."},
      {"2", "Wrong usage, or an output that cannot be written."},
      {"3", "Input could not be read."},
      {"4", "Internal error."}};
  for (const auto& [code, meaning] : codes)
    text += std::string(".TP\n.B ") + code + "\n" + meaning + "\n";
  return text;
}

std::string see_also(const std::vector<VerbInfo>& all, const std::string& self) {
  std::vector<std::string> pages;
  if (self != "deck") pages.push_back("deck");
  for (const VerbInfo& v : all)
    if ("deck-" + v.name != self) pages.push_back("deck-" + v.name);
  std::string text = ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < pages.size(); ++i)
    text += ".BR " + plain(pages[i]) + " (1)" + (i + 1 < pages.size() ? "," : "") + "\n";
  return text;
}

/// Text that stands as it is written: examples with remarks between them.
std::string verbatim(const std::string& heading, const std::string& text) {
  if (text.empty()) return "";
  std::string out = ".SH " + heading + "\n.nf\n";
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    out += line(text.substr(at, end - at));
    at = end + 1;
  }
  return out + ".fi\n";
}

std::string verb_page(const VerbInfo& v, const std::vector<VerbInfo>& all) {
  const std::string name = "deck-" + v.name;
  std::string text = title(name);
  text += ".SH NAME\n" + plain(name) + " \\- " + plain(v.summary) + "\n";
  text += ".SH SYNOPSIS\n.B deck " + plain(v.name) + "\n[" + italic("OPTIONS") + "]";
  for (const OptionInfo& p : v.positionals) {
    const std::string what = italic(p.value.empty() ? p.names.front() : p.value);
    text += p.required ? " " + what : " [" + what + "]";
    if (p.repeatable) text += "...";
  }
  text += "\n.SH DESCRIPTION\n" + line(v.summary + ".");
  if (!v.positionals.empty()) text += options_text(v.positionals);
  text += ".SH OPTIONS\n" + options_text(v.options);
  text += exit_status() + verbatim("EXAMPLES", v.examples) + see_also(all, name);
  return text;
}

std::string program_page(const std::vector<VerbInfo>& all) {
  std::string text = title("deck");
  text += ".SH NAME\ndeck \\- check, measure and rewrite the contacts of Radioss decks\n";
  text += ".SH SYNOPSIS\n.B deck\n" + italic("VERB") + " [" + italic("OPTIONS") + "] " +
          italic("DECK") + "...\n";
  text += ".SH DESCRIPTION\n" +
          line(
              "Reads Radioss Starter decks (*_0000.rad) with their includes and shows what their "
              "contact interfaces (" +
              examined_types(Examined::contacts_and_ties) + ") will do.");
  text += ".SH VERBS\n";
  for (const VerbInfo& v : all)
    text += ".TP\n.BR deck\\-" + plain(v.name) + " (1)\n" + line(v.summary + ".");
  text += ".SH OPTIONS\n" + options_text(program_options());
  text += exit_status();
  text += ".SH ENVIRONMENT\n.TP\n.B NO_COLOR\nNo colours, unless asked for by " + bold("--color") +
          ".\n";
  return text + see_also(all, "deck");
}

int run(const Options& o) {
  CommonOptions common;
  common.session = o.session;
  const std::vector<VerbInfo> all = describe_verbs();
  if (!o.directory.empty()) {
    std::vector<std::string> texts = {program_page(all)};
    for (const VerbInfo& v : all) texts.push_back(verb_page(v, all));
    std::vector<OutputFile> files = {{o.directory + "/deck.1", texts[0]}};
    for (std::size_t i = 0; i < all.size(); ++i)
      files.push_back({o.directory + "/deck-" + all[i].name + ".1", texts[i + 1]});
    if (auto written = o.session->write_outputs(files); !written) {
      print_error(common, written.error().message);
      return exit_usage;
    }
    return exit_clean;
  }
  if (o.verb.empty()) {
    print_text(program_page(all));
    return exit_clean;
  }
  for (const VerbInfo& v : all)
    if (v.name == o.verb) {
      print_text(verb_page(v, all));
      return exit_clean;
    }
  print_error(common, "there is no verb '" + o.verb + "'");
  return exit_usage;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  options->session = &line.session();
  line.hide();  // for the build, not for the list of verbs
  line.option("verb", options->verb, "Page of this verb; none: of deck").value("VERB");
  line.option("--directory", options->directory, "Write all pages into DIR").value("DIR");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"man", 900, "Man pages", "  deck man lint | man -l -\n  deck man --directory man1\n", setup}};

}  // namespace
}  // namespace deck::cli::verb_man
