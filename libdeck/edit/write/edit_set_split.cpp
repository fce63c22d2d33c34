// Gives decks that disagree about a file copies of their own, and makes their #include lead there.
#include <algorithm>
#include <filesystem>

#include "edit/shared/edit_set.hpp"
#include "edit/write/write_plan.hpp"
#include "keyword/shared/include_file.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

/// `text` with the directives that name `written` leading to `name` in the same directory. False:
/// there is none.
bool redirect(std::string& text, const std::string& written, const std::string& name) {
  const std::string old_name = fs::path(written).filename().string();
  bool found = false;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    if (!detail::is_include(std::string_view(text).substr(at, end - at))) {
      at = end + 1;
      continue;
    }
    std::uint64_t behind = at;
    std::string path = detail::include_path(text, behind);
    std::replace(path.begin(), path.end(), '\\', '/');
    std::size_t next = static_cast<std::size_t>(behind);
    if (path == written) {
      const auto place = text.rfind(old_name, next);
      if (place == text.npos || place < at) return false;  // written over several lines
      text.replace(place, old_name.size(), name);
      next += name.size() - old_name.size();
      found = true;
    }
    at = std::max(next, at + 1);
  }
  return found;
}

}  // namespace

/// A path beside `path` that is free and of no file of the decks.
std::string EditSet::free_name(const std::string& path, const std::string& deck) const {
  const fs::path p(without_gz(path));
  std::string stem = fs::path(without_gz(deck)).stem().string();
  if (stem.ends_with("_0000")) stem.resize(stem.size() - 5);
  std::error_code ec;
  for (int number = 1;; ++number) {
    const fs::path candidate =
        p.parent_path() /
        (p.stem().string() + "_" + stem + (number == 1 ? "" : "_" + std::to_string(number)) +
         p.extension().string());
    const bool taken = std::any_of(decks_.begin(), decks_.end(), [&](const Member& member) {
      return std::any_of(member.uses.begin(), member.uses.end(),
                         [&](const Use& u) { return u.path == candidate.string(); });
    });
    if (!taken && !fs::exists(candidate, ec)) return candidate.string();
  }
}

/// From now on the directives that lead to `child` name a file beside it.
Result<void> EditSet::redirect_to(Member& member, std::size_t child, const std::string& name) {
  for (Edge& edge : member.edges) {
    if (edge.child != child) continue;
    Use& parent = member.uses[edge.parent];
    std::string text = text_of(parent);
    // The same file through two directives of one text: the first of them has changed both.
    if (!redirect(text, edge.written, name) && text.find(name) == text.npos)
      return Error{Error::Code::config, parent.path + ": the #include of " + edge.written +
                                            " cannot be changed; nothing was written. Write it on "
                                            "one line"};
    parent.text = text_number(files_[parent.file], text);
    edge.written = (fs::path(edge.written).parent_path() / name).string();
  }
  return {};
}

Result<void> EditSet::split_includes() {
  // A copy changes the files that include it, which may be shared themselves: until all agree.
  for (std::size_t f = 0; f < files_.size(); ++f) {
    const std::vector<Claim> all = claims()[f];
    if (all.empty()) continue;
    // The file keeps the text that a deck outside of the set, or one without changes, needs.
    std::size_t stays = files_[f].outsider.empty() ? all.front().use->text : 0;
    for (const Claim& claim : all)
      if (claim.use->text == 0) stays = 0;
    const auto odd =
        std::find_if(all.begin(), all.end(), [&](const Claim& c) { return c.use->text != stays; });
    if (odd == all.end()) continue;
    if (odd->use->directive.empty()) return {};  // a main file: the conflict is reported
    const std::string copy = free_name(odd->use->path, decks_[odd->deck].name);
    const std::size_t text = odd->use->text;
    File& made = files_.emplace_back();
    made.is_new = true;
    made.texts = {std::string(), files_[f].texts[text]};
    made.places.emplace_back(detail::canonical_place(copy), copy);
    const std::string name = fs::path(copy).filename().string();
    const auto beside = [&](const std::string& path) {
      return (fs::path(path).parent_path() / name).string();
    };
    for (const Claim& claim : all) {
      if (claim.use->text != text) continue;
      Member& member = decks_[claim.deck];
      const auto number = static_cast<std::size_t>(claim.use - member.uses.data());
      Use& use = member.uses[number];
      // Beside the file as this deck opens it: the same place by another name, perhaps.
      member.by_path.erase(use.path);
      std::set<std::string> places;
      for (const std::string& place : use.places) places.insert(beside(place));
      use = {beside(use.path), files_.size() - 1, use.directive, 1, places};
      member.by_path.emplace(use.path, number);
      if (auto given = redirect_to(member, number, name); !given) return given;
    }
    f = static_cast<std::size_t>(-1);  // from the first file again
  }
  return {};
}

}  // namespace deck
