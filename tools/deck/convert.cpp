// deck convert: writes a deck again. `--to rad` copies the include tree byte for byte under another
// directory, so that every #include finds its file there.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

#include "common.hpp"

namespace {

using namespace deck;
using namespace deck::cli;
namespace fs = std::filesystem;

struct Options {
  CommonOptions common;
  std::string to = "rad";
  std::string directory;
};

/// Where the files of a deck go, relative to the output directory.
struct Layout {
  std::map<fs::path, std::uint32_t> files;  ///< target -> file of the deck
  std::vector<std::string> outside;         ///< absolute includes: left where they are
};

/// Leading ".." of a normalized relative path.
int climbs(const fs::path& path) {
  int count = 0;
  for (const fs::path& part : path) {
    if (part != "..") break;
    ++count;
  }
  return count;
}

/// Places every file so that the directive that names it leads to it. Relative to the main file's
/// directory at first, which may need "..".
std::vector<fs::path> relative_places(const Deck& deck, Layout& layout) {
  std::vector<fs::path> place(deck.sources.size());
  const fs::path main(deck.sources[0].path());
  place[0] = main.filename();
  std::vector<bool> known(deck.sources.size(), false);
  known[0] = true;
  for (const IncludeEdge& e : deck.includes) {
    const fs::path written(e.written);
    const std::string& opened = deck.sources[e.file].path();
    if (written.is_absolute() || !known[e.parent]) {
      // Its directive leads to the original, and so do those of the files it includes.
      layout.outside.push_back(opened);
      continue;
    }
    const fs::path beside = fs::path(deck.sources[e.parent].path()).parent_path() / written;
    const fs::path by_main = main.parent_path() / written;
    const bool from_main = beside.lexically_normal().string() != opened &&
                           by_main.lexically_normal().string() == opened;
    const fs::path base = from_main ? fs::path() : place[e.parent].parent_path();
    place[e.file] = (base / written).lexically_normal();
    known[e.file] = true;
  }
  return place;
}

Result<Layout> lay_out(const Deck& deck) {
  Layout layout;
  const std::vector<fs::path> places = relative_places(deck, layout);
  int up = 0;
  for (const fs::path& p : places) up = std::max(up, climbs(p));
  // Files above the main file's directory: the main file moves down into directories of the same
  // names, so that ".." leads where it should.
  fs::path prefix;
  fs::path dir = fs::absolute(deck.sources[0].path()).lexically_normal().parent_path();
  for (int i = 0; i < up; ++i) {
    if (!dir.has_relative_path())
      return Error{Error::Code::config,
                   deck.sources[0].path() + ": an include leads above the root directory"};
    prefix = prefix.empty() ? dir.filename() : dir.filename() / prefix;
    dir = dir.parent_path();
  }
  for (std::uint32_t f = 0; f < places.size(); ++f) {
    if (places[f].empty()) continue;
    const fs::path target = (prefix / places[f]).lexically_normal();
    const auto [it, is_new] = layout.files.emplace(target, f);
    if (!is_new && deck.sources[it->second].bytes() != deck.sources[f].bytes())
      return Error{Error::Code::config,
                   "two different files would be written to " + target.string() + ": " +
                       deck.sources[it->second].path() + " and " + deck.sources[f].path()};
  }
  return layout;
}

int write_tree(const Loaded& loaded, const Options& options,
               std::map<fs::path, std::string>& written) {
  const Deck& deck = loaded.deck;
  if (loaded.path == "-") {
    print_error(options.common, "a deck from standard input has no name to write it to");
    return exit_usage;
  }
  if (loaded.incomplete()) {
    print_findings(loaded, options.common);
    print_error(options.common, loaded.path + ": not written, the include tree is not complete");
    return exit_input;
  }
  const auto layout = lay_out(deck);
  if (!layout) {
    print_error(options.common, layout.error().message);
    return exit_usage;
  }
  std::vector<OutputFile> files;
  for (const auto& [target, file] : layout->files) {
    const fs::path path = fs::path(options.directory) / target;
    const Source& source = deck.sources[file];
    std::error_code ec;
    if (fs::equivalent(path, source.path(), ec)) {
      print_error(options.common, path.string() + " is the deck itself; name another directory");
      return exit_usage;
    }
    const auto [it, is_new] = written.emplace(path.lexically_normal(), source.path());
    if (!is_new && it->second != source.path()) {
      print_error(options.common, "both " + it->second + " and " + source.path() +
                                      " would be written to " + path.string());
      return exit_usage;
    }
    files.push_back({path.string(), source.bytes()});
  }
  if (auto done = write_files_atomic(files); !done) {
    print_error(options.common, done.error().message);
    return exit_usage;
  }
  for (const std::string& path : layout->outside)
    fmt::print(stderr, "deck: note: {} is included by its absolute path and was not copied\n",
               path);
  if (!options.common.quiet)
    for (const auto& [target, file] : layout->files)
      print_text((fs::path(options.directory) / target).string() + "\n");
  return exit_clean;
}

int run(const Options& options) {
  std::map<fs::path, std::string> written;
  return for_each_deck(options.common, Stage::blocks,
                       [&](Loaded& loaded) { return write_tree(loaded, options, written); });
}

Action setup(CLI::App& app) {
  auto options = std::make_shared<Options>();
  add_common(app, options->common, false);
  app.add_option("--to", options->to, "Format to write: rad (Starter deck)")
      ->check(CLI::IsMember({"rad"}))
      ->type_name("FORMAT");
  app.add_option(
         "-o,--output", options->directory,
         "Directory to write to; made if missing. The include tree keeps its relative names")
      ->required()
      ->type_name("DIR");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"convert", 50, "Write a deck with all it includes under another directory",
     "  deck convert car_0000.rad -o copy          copy/car_0000.rad and its includes\n"
     "\n"
     "Files that are included from above the deck's directory (#include ../common/x.inc) keep\n"
     "their place too: the deck is then written one or more directories further down.\n",
     setup}};

}  // namespace
