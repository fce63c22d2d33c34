// deck explain: the page of a rule, of a keyword, or of one field of a keyword.

#include <algorithm>

#include "common.hpp"
#include "deck/base/escape.hpp"
#include "deck/lint/rule.hpp"

namespace {

using namespace deck;
using namespace deck::cli;

struct Options {
  CommonOptions common;
  std::vector<std::string> topics;
};

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return text;
}

/// A schema by its keyword, with or without the leading slash, in any case.
const Schema* keyword_named(const SchemaSet& schemas, const std::string& name) {
  const std::string wanted = upper(name.starts_with('/') ? name : "/" + name);
  if (const Schema* s = schemas.find(wanted)) return s;
  // "TYPE7" for "/INTER/TYPE7": of the keywords that end so the shortest, "/DEFAULT/INTER/TYPE7" is
  // about it.
  const Schema* best = nullptr;
  for (const Schema* s : schemas.all())
    if (upper(s->keyword).ends_with(wanted) &&
        (best == nullptr || s->keyword.size() < best->keyword.size()))
      best = s;
  return best;
}

std::string page_of(const SchemaSet& schemas, const std::string& topic) {
  if (const Rule* rule = find_rule(upper(topic))) return explain_rule(*rule, schemas);
  const auto dot = topic.rfind('.');
  if (const Schema* s = keyword_named(schemas, topic)) return explain_keyword(*s);
  if (dot == std::string::npos) return {};
  const Schema* s = keyword_named(schemas, topic.substr(0, dot));
  if (s == nullptr) return {};
  const std::string field = topic.substr(dot + 1);
  std::string page = explain_keyword(*s, field);
  if (!page.empty()) return page;
  for (const CardSchema& card : s->cards)
    for (const Field& f : card.fields)
      if (upper(f.name) == upper(field)) return explain_keyword(*s, f.name);
  return {};
}

int run(const Options& options) {
  const auto schemas = load_schemas(options.common);
  if (!schemas) {
    print_error(options.common, schemas.error().message);
    return exit_usage;
  }
  bool first = true;
  for (const std::string& topic : options.topics) {
    const std::string page = page_of(*schemas, topic);
    if (page.empty()) {
      print_error(options.common, "nothing is known about '" + topic +
                                      "'; expected a rule (DK203), a keyword (/INTER/TYPE7) or a "
                                      "field (/INTER/TYPE7.Igap)");
      return exit_usage;
    }
    print_text((first ? "" : "\n") + terminal_lines(page));
    first = false;
  }
  return exit_clean;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  line.option("topics", options->topics, "Rule id, keyword, or KEYWORD.FIELD")
      .required()
      .value("TOPIC");
  line.option("--schemas", options->common.schema_dirs, "Add the keyword schemas (*.json) of DIR")
      .value("DIR")
      .one_each();
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"explain", 81, "The page of a rule, a keyword or a field",
     "  deck explain DK254\n  deck explain /INTER/TYPE7\n  deck explain /INTER/TYPE7.Igap\n",
     setup}};

}  // namespace
