// Where the files of decks go when they are written below another directory, so that every #include
// finds its file there.
#include <algorithm>
#include <filesystem>

#include "base/shared/paths.hpp"
#include "edit/shared/edit_set.hpp"
#include "edit/write/write_plan.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

using detail::lies_below;
Error no_tree(std::string why) { return {Error::Code::config, std::move(why)}; }

}  // namespace

/// Order and places of the files: where the directives lead from `main`, where the main
/// file is taken to lie. What no directive names lies beside it and belongs to it: Engine files.
void EditSet::lay_out(Member& member, const Deck& now, const std::string& main) const {
  member.order.clear();
  member.outside.clear();
  std::vector<std::size_t> use(now.sources.size(), 0);  // of its files
  for (std::uint32_t f = 0; f < now.sources.size(); ++f) {
    const auto known = member.by_path.find(now.sources[f].path());
    if (known == member.by_path.end())
      member.no_place = now.sources[f].path() + " was not read before";
    else
      use[f] = known->second;
  }
  const fs::path top = parent_path(absolute_path(main));
  std::vector<fs::path> place(now.sources.size());
  std::vector<bool> included(now.sources.size(), false);
  place[0] = top / fs::path(main).filename();
  for (const IncludeEdge& e : now.includes) {
    included[e.file] = true;
    const Source& opened = now.sources[e.file];
    if (fs::path(e.written).is_absolute() || place[e.parent].empty()) {
      // Its directive leads to the original, and so do those of the files it includes.
      member.outside.push_back(opened.path());
      continue;
    }
    const auto opened_below = [&](std::string_view directory) {
      const std::string found =
          normal_path(directory.empty() ? e.written : std::string(directory) + '/' + e.written);
      return found == opened.path() || (opened.packed() && found + ".gz" == opened.path());
    };
    const bool from_main = !opened_below(parent_path(now.sources[e.parent].path())) &&
                           opened_below(parent_path(now.sources[0].path()));
    const fs::path base = from_main ? top : place[e.parent].parent_path();
    if (normal_path((base.relative_path() / e.written).string()).starts_with(".."))
      member.no_place = main + ": an include leads above the root directory";
    place[e.file] = normal_path((base / e.written).string());
  }
  for (Use& of : member.uses) of.places.clear();
  for (std::uint32_t f = 0; f < now.sources.size(); ++f) {
    const std::string& path = now.sources[f].path();
    if (f == 0 || included[f])  // files beside the deck are not read back with it
      member.order.push_back(use[f]);
    else if (parent_path(path) == parent_path(now.sources[0].path()))
      place[f] = top / fs::path(path).filename();
    if (!place[f].empty()) member.uses[use[f]].places.insert(place[f].string());
  }
}

/// What the tree of each deck is relative to: the directory of its main file, or as many above it
/// as its includes lead; where files of two decks would be in one place, what all of these share.
Result<std::vector<std::string>> EditSet::tops() const {
  std::vector<std::string> out;
  std::map<std::string, std::size_t> files;  // by place
  fs::path shared;
  bool one_place = false;
  for (const Member& member : decks_) {
    if (!member.no_place.empty()) return no_tree(member.no_place);
    fs::path top = root_;
    if (root_.empty() && !member.uses.front().places.empty())
      top = fs::path(*member.uses.front().places.begin()).parent_path();
    for (const Use& use : member.uses)
      for (const fs::path place : use.places)
        while (!lies_below(place, top)) {
          if (!root_.empty())
            return no_tree(use.path + " lies above the directory whose tree is written; name a " +
                           "directory that also contains it");
          top = top.parent_path();
        }
    for (const Use& use : member.uses)
      for (const fs::path place : use.places) {
        const std::string target = place.lexically_relative(top).string();
        one_place = one_place || files.emplace(target, use.file).first->second != use.file;
      }
    if (out.empty()) shared = top;
    while (top != shared && !lies_below(top, shared)) shared = shared.parent_path();
    out.push_back(top.string());
  }
  if (one_place) std::fill(out.begin(), out.end(), shared.string());
  return out;
}

Result<EditSet::Plan> EditSet::tree(const std::string& directory) const {
  const auto relative_to = tops();
  if (!relative_to) return relative_to.error();
  Plan plan;
  std::map<std::string, Claim> targets;
  std::set<std::string> outside;
  for (std::size_t d = 0; d < decks_.size(); ++d) {
    const Member& member = decks_[d];
    plan.mains.emplace_back();
    for (const std::string& path : member.outside) {
      outside.insert(path);
      if (const auto use = member.by_path.find(path);
          use != member.by_path.end() && member.uses[use->second].text != 0)
        return no_tree(path +
                       " is included by its absolute path and would have to change; change it "
                       "with --in-place, or make one file with deck convert --flatten");
    }
    for (const Use& use : member.uses)
      for (const fs::path place : use.places) {
        const fs::path relative = place.lexically_relative((*relative_to)[d]);
        const std::string target = normal_path((fs::path(directory) / relative).string());
        if (&use == &member.uses.front()) plan.mains.back() = target;
        const auto [it, is_new] = targets.try_emplace(target, Claim{d, &use});
        const auto& [deck, other] = it->second;
        if (other->file == use.file && other->text != use.text)
          return conflict(it->second, {d, &use}, target);
        const bool from_memory = files_[other->file].identity == FileIdentity() &&
                                 files_[use.file].identity == FileIdentity();
        if (other->file != use.file &&
            (text_of(*other) != text_of(use) || (deck != d && !from_memory)))
          return no_tree("both " + other->path + " (" + decks_[deck].name + ") and " + use.path +
                         " (" + member.name + ") would be written to " + target +
                         "; nothing was written. Write the decks to different directories");
      }
  }
  for (const auto& [target, claim] : targets) {
    const std::string& text = text_of(*claim.use);
    const std::string_view bytes =
        has_gz_name(target) ? plan.packed.emplace_back(gzip(text)) : text;
    const std::string origin = claim.use->path == "-" ? "" : absolute_path(claim.use->path);
    plan.files.push_back(
        {target, bytes, std::nullopt, nullptr, claim.use->directive.empty(), origin});
  }
  plan.outside.assign(outside.begin(), outside.end());
  return plan;
}

}  // namespace deck
