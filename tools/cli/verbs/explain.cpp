// deck explain: pages of rules, keywords, fields and solver messages; a Starter listing message by
// message.

#include <fmt/format.h>

#include <filesystem>

#include "base/shared/shown_text.hpp"
#include "common.hpp"
#include "lint/shared/topics.hpp"
#include "report/shared/inspection.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cli::verb_explain {
namespace {

struct Options {
  CommonOptions common;  ///< `decks` has the topics
  std::string deck;
  std::size_t worst = 3;
};

/// True for names of listings and existing paths.
bool names_listing(const std::string& topic) {
  const std::string name = without_gz(topic);
  std::error_code ec;
  return name.ends_with(".out") ||
         (topic.find_first_of("/.") != topic.npos && !topic.starts_with('/') &&
          std::filesystem::is_regular_file(topic, ec));
}

/// The deck beside a listing, with the same name; empty: none.
std::string deck_beside(const std::string& listing) {
  std::string stem = without_gz(listing);
  if (stem.ends_with(".out")) stem.resize(stem.size() - 4);
  for (const char* ending : {".rad", ".rad.gz"})
    if (std::error_code ec; std::filesystem::is_regular_file(stem + ending, ec))
      return stem + ending;
  return {};
}

int explain_one_listing(const Options& o, const std::string& path, const SchemaSet& schemas,
                        JsonOutput& json, bool first) {
  const auto listing = read_listing(path, o.common.limits);
  if (!listing) return failed(o.common, listing.error(), exit_input);
  o.common.session->remember_read(path);
  const std::string deck = o.deck.empty() ? deck_beside(path) : o.deck;
  std::optional<LoadedDeck> loaded;
  if (deck.empty()) {
    if (!o.common.quiet)
      print_note("no deck beside " + path + ": its messages are explained alone (--deck DECK)");
  } else {
    auto read = load(deck, schemas, o.common);
    if (!read) return failed(o.common, read.error(), exit_input);
    loaded.emplace(std::move(*read));
    if (const std::size_t nodes = loaded->model().nodes.size();
        listing->nodes && *listing->nodes != nodes && !loaded->incomplete())
      return failed(o.common,
                    fmt::format("{} is of another model: it has {} nodes, {} has {}; name "
                                "its deck with --deck",
                                path, *listing->nodes, deck, nodes));
  }
  ListingReport report;
  {
    Progress progress(!o.common.quiet);
    progress.step("comparing with " + path);
    report = loaded ? compare_listing(*listing, *loaded) : explain_listing(*listing);
  }
  const LoadedDeck* const beside = loaded ? &*loaded : nullptr;
  if (json.wanted()) json.add(listing_json(*listing, report, beside));
  if (o.common.wants_text()) {
    ListingTextOptions text;
    text.color = o.common.color_on(1);
    text.width = text_width();
    text.worst = o.worst;
    text.verbose = o.common.verbose;
    print_lines((first ? "" : "\n") + listing_text(*listing, report, beside, text));
  }
  const bool errors =
      std::any_of(report.messages.begin(), report.messages.end(),
                  [](const MessageGroup& group) { return group.severity == Severity::error; });
  if (loaded && loaded->incomplete()) {
    print_findings(*loaded, o.common);
    return exit_input;
  }
  return errors || !report.agrees() ? exit_findings : exit_clean;
}

int explain_listings(const Options& o, const SchemaSet& schemas) {
  if (!o.deck.empty() && o.common.decks.size() > 1)
    return failed(o.common, "--deck takes one listing at a time");
  if (const int bad = check_outputs(o.common, {o.common.json}); bad != exit_clean) return bad;
  JsonOutput json(o.common, "deck/explain", 1);
  int worst = exit_clean;
  bool first = true;
  for (const std::string& path : o.common.decks) {
    worst = std::max(worst, explain_one_listing(o, path, schemas, json, first));
    first = false;
  }
  return json.write(worst);
}

int explain_topics(const Options& options, const SchemaSet& schemas) {
  if (!options.common.json.empty() || !options.deck.empty())
    return failed(options.common, "--json and --deck go with a listing (car_0000.out)");
  bool first = true;
  for (const std::string& topic : options.common.decks) {
    const std::string page = explain_topic(topic, schemas, text_width());
    if (page.empty()) {
      std::string near;
      if (!message_number(topic))
        for (const std::string& name : similar_topics(topic, schemas))
          near += (near.empty() ? "; did you mean " : ", ") + name;
      return failed(options.common,
                    "nothing is known about '" + topic + "'" + near +
                        "; expected a rule (DK104) or a family of them (DK2), a keyword "
                        "(TYPE7), a field (Igap, TYPE7.Igap), the number or words of a solver "
                        "message (611, 'initial penetrations') or a listing (car_0000.out)");
    }
    print_lines((first ? "" : "\n") + terminal_lines(page));
    first = false;
  }
  return exit_clean;
}

int run(const Options& options) {
  const auto schemas = load_schemas(options.common);
  if (!schemas) return failed(options.common, schemas.error());
  const auto pages = team_rules(options.common, true);
  if (!pages) return failed(options.common, pages.error());
  const auto rules = use_rules(*pages);
  const auto listings = static_cast<std::size_t>(
      std::count_if(options.common.decks.begin(), options.common.decks.end(), names_listing));
  if (listings == options.common.decks.size()) return explain_listings(options, *schemas);
  if (listings == 0) return explain_topics(options, *schemas);
  return failed(options.common, "listings and topics cannot be explained in one call");
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  line.remove("DECK");
  line.option("TOPIC", options->common.decks,
              "Rule, keyword, field, KEYWORD.FIELD, number or words of a solver message; or "
              "listings of the Starter (*_0000.out, also .gz), each beside its deck")
      .value("")
      .required();
  add_rules(line, options->common);
  line.option("--deck DECK", options->deck,
              "The deck of the listing (default: *_0000.rad of the same name beside it)");
  line.option("--worst N", options->worst,
              "Of a listing: rows of the deepest pairs of each contact")
      .show_default();
  add_verbose(line, options->common, "Of a listing: every place and finding");
  return [options] {
    options->common.engine_files = true;
    return run(*options);
  };
}

const VerbRegistration registration{
    {"explain", 81,
     "The page of a rule, keyword, field or solver message; a listing beside its deck",
     R"(  deck explain DK254
  deck explain DK1                  the rules of a family
  deck explain TYPE7
  deck explain Gapmin               also TYPE7.Gapmin, /INTER/TYPE19.Gapmin
  deck explain 611                  message of the solver, also 'ERROR 611'
  deck explain 'initial penetrations'
  deck explain car_0000.out         the messages of a run, beside car_0000.rad

Exit code of a listing: 1 if it has errors, or penetrations or time steps that differ from
those of deck gaps and deck parts.)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_explain
