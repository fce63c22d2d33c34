// Maps the files of an include tree to their places below another directory.
#include "edit/write/tree.hpp"

#include <algorithm>

#include "base/shared/paths.hpp"

namespace deck::detail {
namespace {

namespace fs = std::filesystem;

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
    const auto opened_below = [&](std::string_view directory) {
      const std::string found =
          normal_path(directory.empty() ? e.written : std::string(directory) + '/' + e.written);
      return found == opened || (deck.sources[e.file].packed() && found + ".gz" == opened);
    };
    const bool from_main = !opened_below(parent_path(deck.sources[e.parent].path())) &&
                           opened_below(parent_path(deck.sources[0].path()));
    const fs::path base = from_main ? fs::path() : place[e.parent].parent_path();
    place[e.file] = normal_path((base / written).native());
    known[e.file] = true;
  }
  // What no directive names lies beside the main file and belongs to it: Engine files.
  std::vector<bool> included(deck.sources.size(), false);
  for (const IncludeEdge& e : deck.includes) included[e.file] = true;
  for (std::uint32_t f = 1; f < deck.sources.size(); ++f) {
    const std::string& path = deck.sources[f].path();
    if (!included[f] && parent_path(path) == parent_path(deck.sources[0].path()))
      place[f] = fs::path(path).filename();
  }
  return place;
}

}  // namespace

Result<Layout> lay_out(const Deck& deck, const std::optional<fs::path>& folder) {
  Layout layout;
  const std::vector<fs::path> places = relative_places(deck, layout);
  int up = 0;
  for (const fs::path& p : places) up = std::max(up, climbs(p));
  // Files above the main file's directory: the main file moves down into directories of the same
  // names, so that ".." leads where it should.
  fs::path prefix = folder.value_or(fs::path());
  fs::path dir = parent_path(absolute_path(deck.sources[0].path()));
  for (int i = 0; i < up && !folder; ++i) {
    if (!dir.has_relative_path())
      return Error{Error::Code::config,
                   deck.sources[0].path() + ": an include leads above the root directory"};
    prefix = prefix.empty() ? dir.filename() : dir.filename() / prefix;
    dir = dir.parent_path();
  }
  for (std::uint32_t f = 0; f < places.size(); ++f) {
    if (places[f].empty()) continue;
    const fs::path target = normal_path((prefix / places[f]).native());
    if (climbs(target) > 0)
      return Error{Error::Code::config, deck.sources[f].path() +
                                            " lies above the directory whose tree is written; " +
                                            "name a directory that also contains it"};
    const auto [it, is_new] = layout.files.emplace(target, f);
    if (!is_new && deck.sources[it->second].bytes() != deck.sources[f].bytes())
      return Error{Error::Code::config,
                   "two different files would be written to " + target.string() + ": " +
                       deck.sources[it->second].path() + " and " + deck.sources[f].path()};
  }
  return layout;
}

}  // namespace deck::detail
