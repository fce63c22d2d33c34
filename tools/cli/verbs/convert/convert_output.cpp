// Where the decks of a call go: files, documents, a patch or standard output, all of it or nothing.
#include <filesystem>
#include <map>
#include <set>

#include "base/shared/paths.hpp"
#include "report/shared/deck_json.hpp"
#include "text/shared/gzip.hpp"
#include "verbs/convert/convert_run.hpp"

namespace deck::cli::verb_convert {
namespace {

namespace fs = std::filesystem;

/// Where the documents of the decks go below a directory: by the names of the decks, and where two
/// have one name by their places below the directory that all of them share.
std::vector<fs::path> document_names(const ConvertRun& run) {
  std::vector<fs::path> names, places;
  fs::path shared;
  const auto below = [](const fs::path& place, const fs::path& directory) {
    const fs::path relative = place.lexically_relative(directory);
    return !relative.empty() && *relative.begin() != "..";
  };
  for (const auto& [deck, text, below_root] : run.documents) {
    places.push_back(absolute_path(deck == "-" ? "stdin" : without_gz(deck)));
    places.back().replace_extension(".json");
    names.push_back(places.back().filename());
    if (places.size() == 1) shared = places.back().parent_path();
    while (!below(places.back(), shared)) shared = shared.parent_path();
  }
  if (std::set<fs::path>(names.begin(), names.end()).size() == names.size()) return names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = places[i].lexically_relative(shared);
  return names;
}

int write_documents(ConvertRun& run) {
  const std::string& place = run.options.write.directory;
  std::string all;  // which the files may point to
  std::vector<OutputFile> files;
  const bool rooted = !run.documents.front().below_root.empty();
  if (place.empty() || place == "-" || (fs::path(place).extension() == ".json" && !rooted)) {
    std::vector<std::string> texts;
    for (const Document& d : run.documents) texts.push_back(d.text);
    all = decks_to_json(texts);
    if (place.empty() || place == "-") {
      print_text(all);
      return exit_clean;
    }
    files.push_back({place, all});
  } else {
    const std::vector<fs::path> names = document_names(run);
    std::map<std::string, std::string> from;  // target, its deck
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Document& d = run.documents[i];
      const std::string target = (fs::path(place) / (rooted ? d.below_root : names[i])).string();
      const auto [it, is_new] = from.emplace(target, d.deck);
      if (!is_new)
        return fail(run, {Error::Code::config, "both " + it->second + " and " + d.deck +
                                                   " would be written to " + target});
      files.push_back({target, d.text});
    }
  }
  const auto done = run.changes.write_documents(files, true);
  return done ? exit_clean : fail(run, done.error());
}

}  // namespace

int fail(const ConvertRun& run, const Error& error) {
  return failed(run.options.common, error.message);
}

int write_all(ConvertRun& run) {
  const ConvertOptions& options = run.options;
  Result<void> done;
  if (options.check) {
    done = run.changes.check();
    return done ? exit_clean : fail(run, done.error());
  }
  if (!run.documents.empty()) return write_documents(run);
  if (options.to == "json") {
    return exit_clean;
  } else if (options.write.in_place || !options.write.directory.empty()) {
    run.progress.step("writing");
    done = run.changes.write(true);
    run.progress.clear();
  } else if (options.write.diff) {
    const auto patch = run.changes.diff();
    if (!patch) return fail(run, patch.error());
    print_contents(*patch);
  }  // else standard input, which went to standard output
  return done ? exit_clean : fail(run, done.error());
}

int add_document(ConvertRun& run, const LoadedDeck& deck) {
  resolve_geometry(deck, run.options.common);
  auto document = deck_to_json({deck.path(), &deck.deck(), &deck.model(), &deck.interfaces()});
  if (!document) return fail(run, document.error());
  Document made{deck.path(), std::move(*document), {}};
  fs::path name =
      made.deck == "-" ? "stdin.json" : fs::path(without_gz(made.deck)).stem().string() + ".json";
  if (!run.changes.root().empty())
    made.below_root = name =
        (fs::path(parent_path(absolute_path(made.deck))).lexically_relative(run.changes.root()) /
         name)
            .lexically_normal();
  if (BatchFrame* frame = run.options.common.session->frame)
    frame->decks[made.deck].target = name.string();
  run.documents.push_back(std::move(made));
  return exit_clean;
}

}  // namespace deck::cli::verb_convert
