// Finds the deck of a document and keeps its blocks up to date.
#include "lsp/workspace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/shared/paths.hpp"
#include "text/shared/gzip.hpp"

namespace deck::lsp {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_candidates = 200;

/// True for a main file: /BEGIN at the start of a line, near the top.
bool is_main_file(std::string_view text) {
  text = text.substr(0, 1 << 16);
  return text.starts_with("/BEGIN") || text.find("\n/BEGIN") != text.npos ||
         text.starts_with("#RADIOSS STARTER");
}

bool has_starter_name(const fs::path& path) {
  const std::string name = without_gz(path.filename().string());
  return name.ends_with("_0000.rad") || name.ends_with(".D00");
}

}  // namespace

// ---- documents ------------------------------------------------------------------------------

Document& Workspace::open(const std::string& path, std::string uri, std::int64_t version,
                          std::string text) {
  shown_or_hidden(path);
  Document& d = documents_[path];
  d.uri = std::move(uri);
  d.version = version;
  d.lines = std::make_shared<const LineTable>(text);
  texts_[path] = std::move(text);
  roots_.erase(path);
  // This can be the deck of a file that had none.
  std::erase_if(roots_, [&](const auto& r) { return decks_.at(r.second).fragment; });
  return d;
}

/// Any deck can include the file if one of its includes is missing, or if the file is in no folder
/// yet.
void Workspace::shown_or_hidden(const std::string& path) {
  const auto complete = [](const auto& entry) {
    if (entry.second.syntax == nullptr) return false;
    const auto& found = entry.second.syntax->deck.findings.all();
    return std::none_of(found.begin(), found.end(),
                        [](const Finding& d) { return d.rule == RuleId::DK004; });
  };
  std::error_code ec;
  if (fs::exists(path, ec) && std::all_of(decks_.begin(), decks_.end(), complete))
    changed(path);
  else
    changed();
}

void Workspace::close(const std::string& path) {
  shown_or_hidden(path);
  documents_.erase(path);
  texts_.erase(path);
  roots_.erase(path);
}

Document* Workspace::find(const std::string& path) {
  const auto it = documents_.find(path);
  return it == documents_.end() ? nullptr : &it->second;
}

std::string Workspace::uri(const std::string& path) const {
  const auto it = documents_.find(path);
  return it == documents_.end() ? uri_of_path(path) : it->second.uri;
}

// ---- decks ----------------------------------------------------------------------------------

bool Workspace::reaches(const std::string& root, const std::string& path) {
  // An open main file can have unsaved includes.
  if (const auto it = decks_.find(root); it != decks_.end())
    if (const auto& syntax = refresh(it->second); syntax != nullptr)
      return syntax->file_of(path) != Span::no_file;
  if (std::error_code ec; starter_of_engine_file(path) == root && fs::exists(root, ec)) return true;
  IncludeScan scan(settings_.include_paths);
  const auto files = scan.files(root);
  return std::any_of(files.begin(), files.end(),
                     [&](const IncludeScan::File& f) { return normal_path(f.path) == path; });
}

/// Starter decks beside and above the file and in the client's folders.
std::vector<std::string> Workspace::candidates(const std::string& path) const {
  std::vector<std::string> out;
  const auto consider = [&](const fs::path& p) {
    const std::string text = normal_path(p.native());
    if (out.size() < most_candidates && has_starter_name(p) &&
        std::find(out.begin(), out.end(), text) == out.end())
      out.push_back(text);
  };
  const auto list = [&](const fs::path& folder) {
    std::error_code ec;
    std::vector<fs::path> names;
    for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec))
      names.push_back(it->path());
    std::sort(names.begin(), names.end());
    for (const fs::path& p : names) consider(p);
  };
  fs::path folder = fs::path(path).parent_path();
  for (int up = 0; up < 3; ++up) {
    list(folder);
    if (folder == folder.parent_path()) break;
    folder = folder.parent_path();
  }
  for (const std::string& f : folders_) list(f);
  return out;
}

std::string Workspace::root_of(const std::string& path, bool& fragment) {
  fragment = false;
  if (is_main_file(texts_.at(path))) return path;
  for (auto& [root, deck] : decks_)
    if (!deck.fragment && root != path && reaches(root, path)) return root;
  if (has_starter_name(path)) return path;
  if (const std::string starter = starter_of_engine_file(path);
      !starter.empty() && reaches(starter, path))
    return starter;
  for (const std::string& root : candidates(path))
    if (root != path && reaches(root, path)) return root;
  fragment = true;
  return frame_of(path);
}

std::string Workspace::frame_of(const std::string& path) {
  const fs::path file(path);
  const std::string frame =
      (file.parent_path() / (".deck-lsp-" + file.filename().string())).string();
  const std::string units = "                  kg                  mm                  ms\n";
  texts_[frame] = "#RADIOSS STARTER\n/BEGIN\nframe\n" +
                  fmt::format("{:>10}{:>10}\n", newest_version, 0) + units + units + "#include " +
                  file.filename().string() + "\n/END\n";
  return frame;
}

OpenDeck* Workspace::deck_of(const std::string& path) {
  if (!documents_.contains(path)) return nullptr;
  const auto known = roots_.find(path);
  if (known != roots_.end()) {
    OpenDeck& deck = decks_.at(known->second);
    // The deck may no longer include the file.
    if (const auto& syntax = refresh(deck);
        syntax != nullptr && syntax->file_of(path) != Span::no_file)
      return &deck;
    if (deck.path == path) return nullptr;
  }
  bool fragment = false;
  const std::string root = root_of(path, fragment);
  roots_[path] = root;
  OpenDeck& deck = decks_[root];
  deck.path = root;
  deck.fragment = fragment;
  const auto& syntax = refresh(deck);
  return syntax != nullptr && syntax->file_of(path) != Span::no_file ? &deck : nullptr;
}

bool Workspace::current(const OpenDeck& deck) const {
  return deck.syntax != nullptr && everything_ <= deck.syntax->generation &&
         std::none_of(touched_.begin(), touched_.end(), [&](const auto& file) {
           return file.second > deck.syntax->generation &&
                  deck.syntax->file_of(file.first) != Span::no_file;
         });
}

const std::shared_ptr<const Syntax>& Workspace::refresh(OpenDeck& deck) {
  if (current(deck)) return deck.syntax;
  ReadOptions read;
  read.include_paths = settings_.include_paths;
  read.limits = settings_.limits;
  read.overlay = &texts_;
  auto fresh = read_deck(deck.path, *schemas_, read);
  if (!fresh) {
    deck.syntax = nullptr;
    return deck.syntax;
  }
  read_engine_files(*fresh, settings_.limits);  // adds files to the deck
  const auto syntax = std::make_shared<const Syntax>(std::move(*fresh), generation_);
  for (std::uint32_t f = 0; f < syntax->deck.sources.size(); ++f) {
    const Source& source = syntax->deck.sources[f];
    // Engine files are used as on disk, even if open.
    if (const Document* d = find(source.path());
        d != nullptr && source.bytes() == text(source.path()))
      syntax->set_lines(f, d->lines);
  }
  deck.syntax = syntax;
  return deck.syntax;
}

std::vector<OpenDeck> Workspace::forget_closed() {
  std::vector<OpenDeck> out;
  for (auto it = decks_.begin(); it != decks_.end();) {
    const bool used = std::any_of(roots_.begin(), roots_.end(),
                                  [&](const auto& r) { return r.second == it->first; });
    if (used) {
      ++it;
      continue;
    }
    if (it->second.fragment) texts_.erase(it->first);
    out.push_back(std::move(it->second));
    it = decks_.erase(it);
  }
  return out;
}

}  // namespace deck::lsp
