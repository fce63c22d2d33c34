// Walks directories and manifests and names the results.
#include "batch/list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "batch/record.hpp"
#include "deck/text/number.hpp"
#include "deck/text/source.hpp"
#include "edit/shared/include_scan.hpp"
#include "library.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cli {
namespace {
namespace fs = std::filesystem;

Result<std::string> read_manifest(const std::string& path) {
  std::ostringstream text;
  if (path == "-") {
    text << std::cin.rdbuf();
    return text.str();
  }
  std::ifstream in(path, std::ios::binary);
  if (in) text << in.rdbuf();
  if (!in) return Error{Error::Code::config, "cannot read the manifest " + path};
  return text.str();
}

/// Lines without blanks at their ends, without empty lines and comments.
std::vector<std::string> manifest_lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    out.push_back(line.substr(first, line.find_last_not_of(" \t\r") + 1 - first));
  }
  return out;
}

/// Names that mean something else in the output directory.
bool reserved(const std::string& stem) {
  return stem == "summary" || stem.starts_with("summary-") || stem == "losses";
}

/// The last `parents` directory names and the stem, "a--b--car_0000".
std::string name_with_parents(const fs::path& path, int parents) {
  std::string name = fs::path(without_gz(path.string())).stem().string();
  fs::path dir = path.parent_path();
  for (int i = 0; i < parents && dir.has_filename(); ++i, dir = dir.parent_path())
    name = dir.filename().string() + "--" + name;
  return name;
}

/// Result names of normalized absolute paths.
std::vector<std::string> result_names(const std::vector<fs::path>& paths) {
  std::vector<int> parents(paths.size(), 0);
  std::vector<std::string> names(paths.size());
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::string, std::vector<std::size_t>> by_name;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      names[i] = name_with_parents(paths[i], parents[i]);
      by_name[names[i]].push_back(i);
    }
    for (const auto& [name, same] : by_name) {
      // Files of one directory are not told apart by its name.
      const fs::path parent = paths[same.front()].parent_path();
      if (!reserved(name) && std::all_of(same.begin(), same.end(), [&](std::size_t i) {
            return paths[i].parent_path() == parent;
          }))
        continue;
      for (const std::size_t i : same) {
        if (name_with_parents(paths[i], parents[i] + 1) == name) continue;  // at the root
        ++parents[i];
        changed = true;
      }
    }
  }
  // What differs in the extension only.
  std::set<std::string> used;
  for (std::string& name : names) {
    std::string candidate = name;
    for (int n = 2; reserved(candidate) || !used.insert(candidate).second; ++n)
      candidate = name + "--" + std::to_string(n);
    name = candidate;
  }
  return names;
}

/// True for a text with keywords that no deck can be: without head and /BEGIN. An Engine file, a
/// page, binary data or nothing at all are decks that cannot be read.
bool is_part_of_a_deck(const std::string& path) {
  const auto source = Source::open_text(path, Limits{});
  if (!source) return false;
  const std::string_view text = (*source)->bytes();
  constexpr std::size_t head = 4096;  // as far as the banner is looked for
  if (text.substr(0, head).find("#RADIOSS STARTER") != text.npos) return false;
  bool keyword = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view line = text.substr(at);
    if (line.starts_with("/BEGIN") || line.starts_with("/RUN/")) return false;
    if (!keyword && !line.starts_with('#') && line[0] != '$' && line[0] != '\n' &&
        line[0] != '\r') {
      if (line[0] != '/' || line.size() < 2 || line[1] < 'A' || line[1] > 'Z') return false;
      keyword = true;
    }
    if (line.starts_with("#include ")) keyword = true;
    const auto end = text.find('\n', at);
    if (end == text.npos) break;
    at = end + 1;
  }
  return keyword;
}

/// Takes the files out of `found` that are includes; see list_decks. `files`: those of the others.
std::vector<IncludeFile> take_includes(
    std::vector<std::string>& found, const std::vector<std::string>& named,
    const std::vector<std::string>& include_paths,
    std::map<std::string, std::vector<IncludeScan::File>>& files) {
  std::set<std::string> by_name;
  for (const std::string& path : named) by_name.insert(find_deck(path));
  if (std::all_of(found.begin(), found.end(),
                  [&](const std::string& path) { return by_name.contains(path); }))
    return {};
  IncludeScan scan(include_paths);
  std::vector<std::vector<IncludeScan::File>> trees;
  std::set<FileIdentity> below;  // files that some deck includes
  for (const std::string& path : found) {
    trees.push_back(scan.files(path));
    for (const IncludeScan::File& f : trees.back())
      if (f.identity != trees.back().front().identity) below.insert(f.identity);
  }
  // Decks that include each other are decks: reading them says what is wrong.
  std::map<FileIdentity, std::string> includer;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const IncludeScan::File& f : trees[i])
      if (!below.contains(trees[i].front().identity)) includer.emplace(f.identity, found[i]);
  std::vector<IncludeFile> includes;
  std::vector<std::string> decks;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool needed = !trees[i].empty() && below.contains(trees[i].front().identity) &&
                        includer.contains(trees[i].front().identity);
    const bool include = !by_name.contains(found[i]) && (needed || is_part_of_a_deck(found[i]));
    if (!include) {
      decks.push_back(found[i]);
      files.emplace(found[i], std::move(trees[i]));
    } else if (needed) {
      includes.push_back({found[i], "included by " + includer.at(trees[i].front().identity)});
    } else {
      includes.push_back({found[i], "has neither '#RADIOSS STARTER' nor /BEGIN"});
    }
  }
  found = std::move(decks);
  return includes;
}

}  // namespace

Result<BatchList> list_decks(const std::vector<std::string>& given, const std::string& manifest,
                             std::string_view ending, const std::string& output,
                             const std::vector<std::string>& include_paths) {
  std::vector<std::string> named = given;
  if (!manifest.empty()) {
    const auto text = read_manifest(manifest);
    if (!text) return text.error();
    const auto lines = manifest_lines(*text);
    named.insert(named.end(), lines.begin(), lines.end());
  }
  if (std::find(named.begin(), named.end(), "-") != named.end())
    return Error{Error::Code::config,
                 "standard input cannot be one of many decks; --manifest - reads the list from it"};
  auto found = expand_decks(named, ending, output);
  if (!found) return found.error();
  BatchList list;
  if (ending == deck_ending)
    list.includes = take_includes(*found, named, include_paths, list.files);
  std::vector<BatchDeck>& decks = list.decks;
  std::vector<fs::path> paths;
  std::error_code ec;
  for (const std::string& path : *found) {
    decks.push_back({path, {}});
    paths.push_back(absolute_path(path));
  }
  const auto names = result_names(paths);
  for (std::size_t i = 0; i < decks.size(); ++i) decks[i].result = names[i] + ".json";
  return list;
}

DeckFiles files_of_decks(const std::vector<std::string>& decks,
                         const std::vector<std::vector<IncludeScan::File>>& trees) {
  DeckFiles out;
  std::string text;
  const auto add = [&](const std::string& path, std::uint64_t contents) {
    out.paths.push_back(path);
    text += "\n" + path + " " + std::to_string(contents);
  };
  for (std::size_t d = 0; d < decks.size(); ++d) {
    if (trees[d].empty()) add(decks[d], file_hash(decks[d]));
    for (const IncludeScan::File& f : trees[d]) add(f.path, f.contents);
    std::string name = without_gz(decks[d]);
    if (!name.ends_with(deck_ending)) continue;
    name.resize(name.size() - deck_ending.size());
    for (int number = 1;; ++number) {
      const std::string engine = fmt::format("{}_{:04}.rad", name, number);
      const std::uint64_t plain = file_hash(engine), packed = file_hash(engine + ".gz");
      if (plain == 0 && packed == 0) break;
      add(engine, plain == 0 ? packed : plain);
    }
  }
  out.contents = content_hash(text);
  return out;
}

DeckFiles files_of_decks(const std::vector<std::string>& decks, IncludeScan& scan) {
  std::vector<std::vector<IncludeScan::File>> trees;
  for (const std::string& deck : decks) trees.push_back(scan.files(deck));
  return files_of_decks(decks, trees);
}

Result<Shard> parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  if (slash != std::string::npos) {
    const IntegerCell index = read_integer(std::string_view(text).substr(0, slash));
    const IntegerCell count = read_integer(std::string_view(text).substr(slash + 1));
    if (index.status == NumberStatus::ok && count.status == NumberStatus::ok && count.value >= 1 &&
        index.value >= 1 && index.value <= count.value)
      return Shard{static_cast<std::size_t>(index.value), static_cast<std::size_t>(count.value)};
  }
  return Error{Error::Code::config,
               "--shard " + text + ": expected i/n, part i of n, for example 1/8 ... 8/8"};
}

}  // namespace deck::cli
