// Walks directories, expands patterns, and finds decks that share files.
#include "library.hpp"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/shared/paths.hpp"
#include "deck/keyword.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cli {
namespace {

namespace fs = std::filesystem;

fs::path absolute_of(const std::string& path) {
  fs::path out = absolute_path(path);
  return out.has_filename() ? out : out.parent_path();  // "models/" is "models"
}

fs::path shared_part(const fs::path& a, const fs::path& b) {
  fs::path out;
  for (auto i = a.begin(), k = b.begin(); i != a.end() && k != b.end() && *i == *k; ++i, ++k)
    out /= *i;
  return out;
}

bool is_pattern(const std::string& text) { return text.find_first_of("*?[") != text.npos; }

std::vector<std::string> matches_of(const std::string& pattern) {
  std::vector<std::string> out;
  glob_t found{};
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i) out.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  return out;
}

}  // namespace

std::string find_deck(const std::string& given) {
  std::error_code ec;
  if (given.empty() || given == "-" || fs::exists(given, ec)) return given;
  for (const char* ending : {"_0000.rad", ".rad", "_0000.rad.gz", ".rad.gz", ".gz"})
    if (const std::string path = given + ending; fs::is_regular_file(path, ec)) return path;
  return given;
}

std::vector<fs::path> entries_of(const fs::path& directory) {
  std::vector<fs::path> out;
  std::error_code ec;
  for (fs::directory_iterator it(directory, ec), end; !ec && it != end; it.increment(ec))
    out.push_back(it->path());
  std::sort(out.begin(), out.end());
  return out;
}

Result<std::vector<std::string>> files_below(const std::string& directory,
                                             const std::string& output,
                                             fs::directory_options closed) {
  std::vector<std::string> found;
  const fs::path results = output.empty() ? fs::path() : absolute_of(output);
  std::error_code ec;
  for (auto it = fs::recursive_directory_iterator(directory, closed, ec);
       !ec && it != fs::recursive_directory_iterator(); it.increment(ec)) {
    const std::string name = it->path().filename().string();
    std::error_code status;
    if (it->is_directory(status) &&
        (name.starts_with('.') || (!output.empty() && absolute_of(it->path().string()) == results)))
      it.disable_recursion_pending();
    // A dangling link is an unreadable deck, not a missing one.
    const bool lost = it->is_symlink(status) && !it->exists(status);
    if (!without_gz(name).ends_with(deck_ending) || !(lost || it->is_regular_file(status)))
      continue;
    // If both exist, the packed one is the copy.
    if (has_gz_name(name) && fs::exists(without_gz(it->path().string()), status)) continue;
    found.push_back(it->path().string());
  }
  if (ec) return Error{Error::Code::io, "cannot read " + directory + ": " + ec.message()};
  std::sort(found.begin(), found.end());
  return found;
}

bool names_directory(const std::vector<std::string>& given) {
  std::error_code ec;
  return std::any_of(given.begin(), given.end(),
                     [&](const std::string& path) { return fs::is_directory(path, ec); });
}

Result<std::vector<std::string>> expand_decks(const std::vector<std::string>& given,
                                              const std::string& output) {
  std::vector<std::string> out;
  std::set<fs::path> seen;
  std::error_code ec;
  const auto add = [&](const std::string& path) {
    if (path == "-" || seen.insert(absolute_of(path)).second) out.push_back(path);
  };
  for (const std::string& path : given) {
    if (fs::is_directory(path, ec)) {
      const auto below = files_below(path, output);
      if (!below) return below.error();
      for (const std::string& deck : *below) add(deck);
    } else if (is_pattern(path) && !fs::exists(path, ec)) {
      const auto matches = matches_of(path);
      if (matches.empty())
        return Error{Error::Code::config, path + ": no file has a name of this form"};
      for (const std::string& deck : matches)
        if (!fs::is_directory(deck, ec)) add(deck);
    } else {
      add(find_deck(path));
    }
  }
  return out;
}

std::vector<std::string> extract_includes(std::vector<std::string>& found,
                                          const std::vector<std::string>& given,
                                          IncludeScan& scan) {
  std::set<std::string> named;
  for (const std::string& path : given) named.insert(find_deck(path));
  if (std::all_of(found.begin(), found.end(),
                  [&](const std::string& path) { return named.contains(path); }))
    return {};
  std::vector<std::vector<IncludeScan::File>> trees;
  std::set<FileIdentity> below;  // files included by some deck
  for (const std::string& path : found) {
    trees.push_back(scan.files(path));
    for (const IncludeScan::File& f : trees.back())
      if (f.identity != trees.back().front().identity) below.insert(f.identity);
  }
  // Decks that include each other stay decks; reading them reports the cycle.
  std::map<FileIdentity, std::string> includer;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const IncludeScan::File& f : trees[i])
      if (!below.contains(trees[i].front().identity)) includer.emplace(f.identity, found[i]);
  std::vector<std::string> notes, decks;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto by = trees[i].empty() || !below.contains(trees[i].front().identity)
                        ? includer.end()
                        : includer.find(trees[i].front().identity);
    if (by == includer.end() || named.contains(found[i]))
      decks.push_back(found[i]);
    else
      notes.push_back(found[i] + " is included by " + by->second + " and is not run by itself");
  }
  found = std::move(decks);
  return notes;
}

Error no_deck_in(const std::string& directory) {
  return {Error::Code::io, directory + ": no *" + std::string(deck_ending) + " in this directory"};
}

Result<std::vector<std::string>> decks_in_directories(const std::vector<std::string>& given) {
  if (!names_directory(given)) return given;
  auto decks = expand_decks(given);
  if (decks && decks->empty()) return no_deck_in(given.front());
  return decks;
}

std::string common_root(const std::vector<std::string>& given,
                        const std::vector<std::string>& files) {
  std::optional<fs::path> root;
  const auto extend_root = [&](const fs::path& path) {
    root = root ? shared_part(*root, path) : path;
  };
  std::error_code ec;
  for (const std::string& d : given)
    if (fs::is_directory(d, ec)) extend_root(absolute_of(d));
  for (const std::string& f : files) extend_root(absolute_of(f).parent_path());
  return root ? root->string() : std::string();
}

namespace {

/// Empty: not in a work tree.
fs::path git_work_tree(const fs::path& file) {
  std::error_code ec;
  for (fs::path dir = file.parent_path(); !dir.empty(); dir = dir.parent_path()) {
    if (fs::exists(dir / ".git", ec)) return dir;
    if (dir == dir.parent_path()) break;
  }
  return {};
}

/// Adds folders that can have decks with a file of this tree. If only the root directory is common,
/// adds the folder of each file instead of searching the disk.
void add_roots(const std::vector<IncludeScan::File>& tree, SharedFiles& out) {
  std::vector<std::string> folders;
  for (const IncludeScan::File& f : tree) {
    std::error_code ec;
    // Links and paths can lead to other folders, whose decks are searched, too.
    for (const fs::path& path : {absolute_of(f.path), fs::canonical(f.path, ec)}) {
      if (path.empty()) continue;
      if (const fs::path work_tree = git_work_tree(path); !work_tree.empty())
        out.roots.insert(work_tree.string());
      else
        folders.push_back(path.parent_path().string());
    }
  }
  const std::string shared = common_root(folders, {});
  if (fs::path(shared).has_relative_path()) folders = {shared};
  for (const std::string& folder : folders) {
    out.roots.insert(folder);
    out.guessed = out.guessed || tree.size() > 1;
  }
}

}  // namespace

std::string library_root(const std::string& deck) {
  const fs::path file = absolute_of(deck), work_tree = git_work_tree(file);
  return (work_tree.empty() ? file.parent_path() : work_tree).string();
}

std::string SharedFiles::where() const {
  if (!guessed) return {};
  std::string list;
  for (const std::string& root : roots) list += (list.empty() ? "" : ", ") + root;
  return "searched for other decks that include these files below " + list +
         "; --root DIR sets another folder";
}

Result<SharedFiles> find_shared_files(const std::vector<std::string>& decks,
                                      const std::string& root,
                                      const std::vector<std::string>& include_paths) {
  SharedFiles out;
  IncludeScan scan(include_paths);
  std::set<FileIdentity> files, mains;
  if (!root.empty()) out.roots.insert(root);
  for (const std::string& deck : decks) {
    const auto tree = scan.files(deck);
    if (tree.empty()) continue;
    mains.insert(tree.front().identity);
    for (const IncludeScan::File& f : tree) files.insert(f.identity);
    if (root.empty()) add_roots(tree, out);
  }
  for (const std::string& directory : out.roots) {
    const auto below = files_below(
        directory, {},
        root.empty() ? fs::directory_options::skip_permission_denied : fs::directory_options::none);
    if (!below) return below.error();
    for (const std::string& deck : *below) {
      const auto tree = scan.files(deck);
      if (tree.empty() || !mains.insert(tree.front().identity).second) continue;
      for (const IncludeScan::File& f : tree)
        if (files.contains(f.identity)) out.others.emplace(f.identity, deck);
    }
  }
  return out;
}

Result<std::vector<std::string>> decks_of_files(const std::vector<std::string>& changed,
                                                const std::string& root,
                                                const std::vector<std::string>& include_paths) {
  const fs::path here = absolute_of(".");
  // As given, or as git names it from the current directory.
  const auto shown = [&](const std::string& path) {
    const fs::path relative = absolute_of(path).lexically_relative(here);
    return relative.empty() || *relative.begin() == ".." ? path : relative.string();
  };
  std::set<std::string> decks, roots;
  std::set<FileIdentity> included;
  IncludeScan scan(include_paths);
  for (const std::string& name : changed) {
    // An Engine file belongs to the deck beside it.
    const std::string starter = starter_of_engine_file(name);
    const std::string& path = starter.empty() ? name : starter;
    const auto files = scan.files(path);
    if (files.empty()) continue;  // removed by the change, or not a file
    if (without_gz(path).ends_with(deck_ending)) decks.insert(shown(path));
    included.insert(files.front().identity);
    roots.insert(root.empty() ? library_root(path) : root);
  }
  for (const std::string& directory : roots) {
    const auto below = files_below(directory);
    if (!below) return below.error();
    for (const std::string& deck : *below)
      for (const IncludeScan::File& file : scan.files(deck))
        if (included.contains(file.identity)) decks.insert(shown(deck));
  }
  return std::vector<std::string>(decks.begin(), decks.end());
}

}  // namespace deck::cli
