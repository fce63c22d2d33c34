// Walks directories and manifests and names the results.
#include "batch/record.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "deck/text/number.hpp"
#include "library.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cli {
namespace {
namespace fs = std::filesystem;

/// Lines without blanks at their ends, without empty lines and comments. "-": standard input.
Result<std::vector<std::string>> manifest_lines(const std::string& path) {
  std::ifstream file;
  if (path != "-") file.open(path, std::ios::binary);
  if (!file) return Error{Error::Code::config, "cannot read the manifest " + path};
  std::istream& in = path == "-" ? std::cin : file;
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    out.push_back(line.substr(first, line.find_last_not_of(" \t\r") + 1 - first));
  }
  if (in.bad()) return Error{Error::Code::config, "cannot read the manifest " + path};
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
  for (bool longer = true; longer;) {
    longer = false;
    std::map<std::string, std::set<fs::path>> folders;
    for (std::size_t i = 0; i < paths.size(); ++i)
      folders[names[i] = name_with_parents(paths[i], parents[i])].insert(paths[i].parent_path());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      // Files of one directory are not told apart by its name, nor any files above the root.
      if ((folders[names[i]].size() < 2 && !reserved(names[i])) ||
          name_with_parents(paths[i], parents[i] + 1) == names[i])
        continue;
      ++parents[i];
      longer = true;
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

}  // namespace

Result<BatchList> list_decks(std::vector<std::string> given, const std::string& manifest,
                             const std::string& output, IncludeScan& scan) {
  if (!manifest.empty()) {
    const auto lines = manifest_lines(manifest);
    if (!lines) return lines.error();
    given.insert(given.end(), lines->begin(), lines->end());
  }
  if (std::find(given.begin(), given.end(), "-") != given.end())
    return Error{Error::Code::config,
                 "standard input cannot be one of many decks; --manifest - reads the list from it"};
  auto found = expand_decks(given, output);
  if (!found) return found.error();
  BatchList list;
  list.notes = take_includes(*found, given, scan);
  std::vector<fs::path> paths;
  for (const std::string& path : *found) paths.push_back(absolute_path(path));
  const auto names = result_names(paths);
  for (std::size_t i = 0; i < names.size(); ++i)
    list.decks.push_back({(*found)[i], names[i] + ".json"});
  return list;
}

DeckFiles files_of_decks(const std::vector<std::string>& decks, IncludeScan& scan) {
  DeckFiles out;
  std::string text;
  const auto add = [&](const std::string& path, std::uint64_t contents) {
    out.paths.push_back(path);
    text += "\n" + path + " " + std::to_string(contents);
  };
  for (const std::string& deck : decks) {
    const auto tree = scan.files(deck);
    if (tree.empty()) add(deck, 0);
    for (const IncludeScan::File& f : tree) add(f.path, f.contents);
    for (const std::string& engine : engine_files_beside(deck)) add(engine, file_hash(engine));
  }
  out.contents = content_hash(text);
  return out;
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
