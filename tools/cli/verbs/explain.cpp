// deck explain: the page of a rule, a keyword, a field or a solver message.

#include "common.hpp"
#include "deck/base/escape.hpp"
#include "deck/lint/topics.hpp"

namespace deck::cli::verb_explain {
namespace {

struct Options {
  CommonOptions common;
  std::vector<std::string> topics;
};

int run(const Options& options) {
  const auto schemas = load_schemas(options.common);
  if (!schemas) {
    print_error(options.common, schemas.error().message);
    return exit_usage;
  }
  bool first = true;
  for (const std::string& topic : options.topics) {
    const std::string page = explain_topic(topic, *schemas, text_width());
    if (page.empty()) {
      std::string near;
      for (const std::string& name : similar_topics(topic, *schemas))
        near += (near.empty() ? "; did you mean " : ", ") + name;
      print_error(options.common,
                  "nothing is known about '" + topic + "'" + near +
                      "; expected a rule (DK203) or a family of them (DK2), a keyword "
                      "(TYPE7), a field (Igap, TYPE7.Igap) or the number of a solver "
                      "message (611)");
      return exit_usage;
    }
    print_lines((first ? "" : "\n") + terminal_lines(page));
    first = false;
  }
  return exit_clean;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  options->common.session = &line.session();
  line.option("topics", options->topics, "Rule, keyword, field, KEYWORD.FIELD or solver message")
      .required()
      .value("TOPIC");
  line.option("--schemas", options->common.schema_dirs, "Add the keyword schemas (*.json) of DIR")
      .value("DIR")
      .one_each();
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"explain", 81, "The page of a rule, a keyword, a field or a solver message",
     "  deck explain DK254\n"
     "  deck explain DK1                  the rules of a family\n"
     "  deck explain TYPE7\n"
     "  deck explain Gapmin               also TYPE7.Gapmin, /INTER/TYPE19.Gapmin\n"
     "  deck explain 611                  message of the solver\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_explain
