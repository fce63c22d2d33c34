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
    const bool taken = std::any_of(files_.begin(), files_.end(), [&](const File& f) {
      return std::any_of(f.uses.begin(), f.uses.end(),
                         [&](const Use& u) { return u.path == candidate.string(); });
    });
    if (!taken && !fs::exists(candidate, ec)) return candidate.string();
  }
}

/// From now on the deck includes `copy`, which is in its files already, instead of `path`.
Result<void> EditSet::give_copy(std::size_t deck, const std::string& path,
                                const std::string& copy) {
  Member& member = decks_[deck];
  const std::string name = fs::path(copy).filename().string();
  for (Edge& edge : member.edges) {
    if (edge.child != path) continue;
    File& parent = files_[member.file_of.at(edge.parent)];
    const auto use = std::find_if(parent.uses.begin(), parent.uses.end(), [&](const Use& u) {
      return u.deck == deck && u.path == edge.parent;
    });
    if (use == parent.uses.end()) continue;
    std::string text = parent.texts[use->text];
    // The same file through two directives of one text: the first of them has changed both.
    if (!redirect(text, edge.written, name) && text.find(name) == text.npos)
      return Error{Error::Code::config, edge.parent + ": the #include of " + edge.written +
                                            " cannot be changed; nothing was written. Write it on "
                                            "one line"};
    auto same = std::find(parent.texts.begin(), parent.texts.end(), text);
    if (same == parent.texts.end()) same = parent.texts.insert(parent.texts.end(), text);
    use->text = static_cast<std::size_t>(same - parent.texts.begin());
    edge.written = (fs::path(edge.written).parent_path() / name).string();
    edge.child = copy;
  }
  for (auto& [target, source] : member.layout)
    if (source == path) {
      target = (fs::path(target).parent_path() / name).string();
      source = copy;
    }
  return {};
}

Result<void> EditSet::split_includes() {
  // A copy changes the files that include it, which may be shared themselves: until all agree.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t f = 0; f < files_.size() && !changed; ++f) {
      File& file = files_[f];
      if (file.uses.empty()) continue;
      const bool kept = !file.outsider.empty();
      if (!(kept && file.uses.front().text != 0) && odd_use(file) == nullptr) continue;
      // The file keeps the text that a deck outside of the set, or one without changes, needs.
      std::size_t stays = kept ? 0 : file.uses.front().text;
      for (const Use& use : file.uses)
        if (use.text == 0) stays = 0;
      const auto odd = std::find_if(file.uses.begin(), file.uses.end(),
                                    [&](const Use& u) { return u.text != stays; });
      const Use first = *odd;
      if (first.place.empty()) return {};  // a main file: the conflict is reported
      const std::string copy = free_name(first.path, decks_[first.deck].name);
      File made;
      made.is_new = true;
      made.texts = {std::string(), file.texts[first.text]};
      made.places.emplace_back(detail::canonical_place(copy), copy);
      std::vector<Use> moved;
      for (const Use& use : file.uses)
        if (use.text == first.text) moved.push_back(use);
      std::erase_if(file.uses, [&](const Use& u) { return u.text == first.text; });
      for (Use use : moved) {
        // Beside the file as this deck opens it: the same place by another name, perhaps.
        const std::string old = use.path;
        use.path = (fs::path(old).parent_path() / fs::path(copy).filename()).string();
        use.text = 1;
        made.uses.push_back(use);
      }
      files_.push_back(std::move(made));
      for (std::size_t i = 0; i < moved.size(); ++i) {
        Member& member = decks_[moved[i].deck];
        const std::string now = files_.back().uses[i].path;
        member.file_of.erase(moved[i].path);
        member.file_of[now] = files_.size() - 1;
        std::replace(member.order.begin(), member.order.end(), moved[i].path, now);
        for (Edge& edge : member.edges)
          if (edge.parent == moved[i].path) edge.parent = now;
        if (auto given = give_copy(moved[i].deck, moved[i].path, now); !given) return given;
      }
      changed = true;
    }
  }
  return {};
}

}  // namespace deck
