// deck schema: the JSON schema of the document that a verb writes with --json.
#include <fmt/format.h>

#include <cstdio>

#include "common.hpp"
#include "report/shared/json.hpp"

namespace deck::cli::verb_schema {
namespace {

std::string verbs() {
  std::string names;
  for (const DocumentOfVerb& d : documents_of_verbs()) names += fmt::format("{}, ", d.verb);
  return names + "common";
}

int run(const CommonOptions& common, const std::string& verb) {
  std::string text = verb == "common" ? common_schema() : std::string();
  for (const DocumentOfVerb& d : documents_of_verbs())
    if (verb == d.verb) text = d.schema().text;
  if (text.empty()) {
    print_error(common, fmt::format("'{}' has no schema; expected one of {}", verb, verbs()));
    return exit_usage;
  }
  std::fwrite(text.data(), 1, text.size(), stdout);
  return exit_clean;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<CommonOptions>();
  auto verb = std::make_shared<std::string>();
  line.option("VERB", *verb, "The verb, or 'common' for what all schemas share")
      .value("")
      .required();
  add_common_without_decks(line, *options);
  return [options, verb] { return run(*options, *verb); };
}

const VerbRegistration registration{
    {"schema", 85, "JSON schema of a verb's --json",
     "  deck schema gaps > gaps.schema.json\n  deck schema common > common.schema.json", setup}};

}  // namespace
}  // namespace deck::cli::verb_schema
