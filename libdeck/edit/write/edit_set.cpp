// Merges edits of all decks file by file and refuses contradictions; assigns places below another
// directory so that every #include finds its file.
#include "edit/shared/edit_set.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/shared/paths.hpp"
#include "edit/write/write_plan.hpp"
#include "text/shared/edits.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

Error refuse(std::string why) { return {Error::Code::config, std::move(why)}; }

/// First line (1-based) in which two texts differ, with both texts.
struct LineDifference {
  std::size_t line = 0;
  std::string_view a, b;
};
LineDifference first_difference(std::string_view a, std::string_view b) {
  const auto next_line = [](std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
  };
  LineDifference d;
  do {
    d = {d.line + 1, next_line(a), next_line(b)};
  } while (d.a == d.b && !(a.empty() && b.empty()));
  return d;
}
std::string quoted(std::string_view line) {
  constexpr std::size_t longest = 100;
  return "'" + std::string(line.substr(0, longest)) + (line.size() > longest ? "...'" : "'");
}

/// Nearest directory above `path` with a git work tree; empty if none.
fs::path work_tree_of(const fs::path& path) {
  std::error_code ec;
  for (fs::path dir = path.parent_path(); !dir.empty(); dir = dir.parent_path()) {
    if (fs::exists(dir / ".git", ec)) return dir;
    if (dir == dir.parent_path()) break;
  }
  return {};
}

/// Directory that paths of a patch are relative to.
fs::path patch_root(const std::vector<fs::path>& files) {
  const auto holds = [&](const fs::path& directory) {
    return !directory.empty() && std::all_of(files.begin(), files.end(), [&](const fs::path& f) {
      return detail::lies_below(f, directory);
    });
  };
  if (files.empty()) return {};
  if (fs::path top = work_tree_of(files.front()); holds(top)) return top;
  std::error_code ec;
  if (fs::path here = fs::canonical(".", ec); holds(here)) return here;
  fs::path shared = files.front().parent_path();
  while (!holds(shared) && shared != shared.parent_path()) shared = shared.parent_path();
  return shared;
}

}  // namespace

Result<std::size_t> EditSet::enter(const Source& source) {
  File file{{source.device(), source.inode()}, {}, source.path()};
  if (source.inode() != 0) {
    std::error_code ec;
    const fs::path real = fs::canonical(source.path(), ec);
    file.place = ec ? source.path() : real.string();
    if (const auto [it, is_new] = by_place_.try_emplace(file.place, files_.size()); !is_new) {
      const File& known = files_[it->second];
      if (known.identity == file.identity && known.texts.front() == source.bytes())
        return it->second;
      return refuse(source.path() + " was changed while the decks were read (it is also " +
                    known.path + "); nothing was written. Run the command again");
    }
  }
  file.texts.emplace_back(source.bytes());
  if (source.packed()) file.on_disk = source.on_disk();
  files_.push_back(std::move(file));
  return files_.size() - 1;
}

Result<std::size_t> EditSet::add(const Deck& deck, std::string name) {
  Member member{name.empty() ? deck.sources[0].path() : std::move(name)};
  std::vector<std::string> directives(deck.sources.size());
  for (const IncludeEdge& e : deck.includes)
    directives[e.file] = deck.sources[e.parent].path() + ":" +
                         std::to_string(deck.sources.position(e.directive).line);
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f) {
    const Source& source = deck.sources[f];
    // From memory, a path identifies a file within its deck.
    if (source.inode() == 0 && member.by_path.contains(source.path())) continue;
    const auto file = enter(source);
    if (!file) return file.error();
    if (member.by_path.emplace(source.path(), member.uses.size()).second)
      member.uses.push_back({source.path(), *file, directives[f]});
  }
  const UnitSystem& units = deck.begin.input;
  if (deck.begin.has_input)
    member.units = units.mass_code + ", " + units.length_code + ", " + units.time_code;
  decks_.push_back(std::move(member));
  return decks_.size() - 1;
}

void EditSet::propose(std::size_t deck, const Deck& now, const ChangedFiles& changed) {
  Member& member = decks_[deck];
  for (const auto& [path, text] : changed)
    if (const auto found = member.by_path.find(path); found != member.by_path.end()) {
      Use& use = member.uses[found->second];
      auto& texts = files_[use.file].texts;
      auto same = std::find(texts.begin(), texts.end(), text);
      if (same == texts.end()) same = texts.insert(texts.end(), text);
      use.text = static_cast<std::size_t>(same - texts.begin());
    }
  // A deck from memory lies where its document does.
  const std::string& main = now.sources[0].path();
  lay_out(member, now,
          root_.empty() || now.sources[0].inode() != 0 || changed.empty()
              ? main
              : (fs::path(parent_path(member.name)) / fs::path(main).filename()).string());
}

Error EditSet::conflict(const Claim& a, const Claim& b, const std::string& where) const {
  const LineDifference d = first_difference(text_of(*a.use), text_of(*b.use));
  const auto wants = [&](const Claim& claim, std::string_view line) {
    std::string text = decks_[claim.deck].name;
    if (!claim.use->directive.empty())
      text += " (which includes it in " + claim.use->directive + ")";
    return text + (claim.use->text == 0 ? " leaves it as it is: " : " makes it ") + quoted(line);
  };
  const Member &of_a = decks_[a.deck], &of_b = decks_[b.deck];
  std::string units;
  if (of_a.units != of_b.units && !of_a.units.empty() && !of_b.units.empty())
    units =
        " (" + of_a.name + " is in " + of_a.units + ", " + of_b.name + " in " + of_b.units + ")";
  return refuse(where + ":" + std::to_string(d.line) +
                ": the decks need different texts for this file: " + wants(a, d.a) + ", " +
                wants(b, d.b) + units +
                "; nothing was written. Give each of the decks a file of its own, or convert them "
                "one at a time into different directories");
}

/// Changed files by path, each with one deck that changes it.
Result<std::vector<std::pair<const EditSet::File*, EditSet::Claim>>> EditSet::changes() const {
  std::map<std::size_t, Claim> claims;  // the first of each file
  for (std::size_t d = 0; d < decks_.size(); ++d)
    for (const Use& use : decks_[d].uses) {
      const Claim& first = claims.try_emplace(use.file, Claim{d, &use}).first->second;
      if (use.text != first.use->text) return conflict(first, {d, &use}, first.use->path);
    }
  std::vector<std::pair<const File*, Claim>> out;
  for (const auto& [number, first] : claims) {
    const File& file = files_[number];
    if (first.use->text == 0) continue;
    if (!file.outsider.empty())
      return refuse(first.use->path + " would change for " + decks_[first.deck].name + ", and " +
                    file.outsider +
                    " includes it too; nothing was written. Name all decks that include it in "
                    "one call, or give this deck a file of its own");
    out.emplace_back(&file, first);
  }
  std::sort(out.begin(), out.end(),
            [](const auto& a, const auto& b) { return a.first->path < b.first->path; });
  return out;
}

Result<EditSet::Plan> EditSet::in_place() const {
  const auto changed = changes();
  if (!changed) return changed.error();
  Plan plan;
  std::set<std::size_t> mains;
  for (const Member& member : decks_) {
    plan.mains.push_back(member.uses.front().path);
    mains.insert(member.uses.front().file);
  }
  for (const auto& [file, claim] : *changed) {
    const std::string& text = text_of(*claim.use);
    if (file->identity == FileIdentity())
      return refuse(claim.use->path + " was not read from a file and cannot be rewritten");
    const bool packed = !file->on_disk.empty();
    const std::string_view bytes = packed ? plan.packed.emplace_back(gzip(text)) : text;
    const FileRead read{file->identity.first, file->identity.second,
                        packed ? std::string_view(file->on_disk) : file->texts.front()};
    plan.files.push_back({file->path, bytes, read, nullptr, mains.contains(claim.use->file)});
  }
  return plan;
}

Result<std::string> EditSet::diff() const {
  const auto changed = changes();
  if (!changed) return changed.error();
  std::vector<fs::path> places;
  for (const auto& [file, claim] : *changed)
    if (!file->place.empty()) places.emplace_back(file->place);
  const fs::path root = patch_root(places);
  // Patch paths with this line start at the top of the work tree, wherever git is called.
  std::error_code ec;
  const bool elsewhere = !root.empty() && root != fs::canonical(".", ec);
  std::string out;
  for (const auto& [file, claim] : *changed) {
    std::string shown =
        file->place.empty() ? file->path : fs::path(file->place).lexically_relative(root).string();
    if (!file->on_disk.empty()) shown = without_gz(shown);
    const std::string hunks = unified_diff(shown, file->texts.front(), text_of(*claim.use));
    if (!hunks.empty() && elsewhere) out += "diff --git a/" + shown + " b/" + shown + "\n";
    out += hunks;
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> EditSet::other_paths() const {
  std::vector<std::pair<std::string, std::string>> out;
  for (const Member& member : decks_)
    for (const Use& use : member.uses)
      if (use.path != files_[use.file].path) out.emplace_back(use.path, files_[use.file].path);
  return out;
}

std::string EditSet::read_back_difference(std::size_t deck, const Deck& written) const {
  const Member& member = decks_[deck];
  if (written.sources.size() != member.order.size())
    return "it has " + std::to_string(written.sources.size()) + " files, expected " +
           std::to_string(member.order.size());
  for (std::uint32_t f = 0; f < written.sources.size(); ++f)
    if (const Use& use = member.uses[member.order[f]]; text_of(use) != written.sources[f].bytes())
      return written.sources[f].path() + " is not the text for " + use.path;
  return {};
}

void EditSet::add_outsider(const FileIdentity& file, const std::string& deck) {
  for (File& known : files_)
    if (known.identity == file && known.outsider.empty()) known.outsider = deck;
}

// ---- below another directory -------------------------------------------------------------------

/// Order and places of the files by the directives, from `main` as the place of the main file.
/// Files without directive (Engine files) lie next to it.
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
      // Its directive and those of the files it includes lead to the original.
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
    if (f == 0 || included[f])  // files next to the deck are not read back
      member.order.push_back(use[f]);
    else if (parent_path(path) == parent_path(now.sources[0].path()))
      place[f] = top / fs::path(path).filename();
    if (!place[f].empty()) member.uses[use[f]].places.insert(place[f].string());
  }
}

/// Root of each deck's tree: the directory of its main file, or as many levels up as its includes
/// lead; on collisions the common root of the decks.
Result<std::vector<std::string>> EditSet::tops() const {
  std::vector<std::string> out;
  std::map<std::string, std::size_t> files;  // by place
  fs::path shared;
  bool one_place = false;
  for (const Member& member : decks_) {
    if (!member.no_place.empty()) return refuse(member.no_place);
    fs::path top = root_;
    if (root_.empty() && !member.uses.front().places.empty())
      top = fs::path(*member.uses.front().places.begin()).parent_path();
    for (const Use& use : member.uses)
      for (const fs::path place : use.places)
        while (!detail::lies_below(place, top)) {
          if (!root_.empty())
            return refuse(use.path + " lies above the directory whose tree is written; name a " +
                          "directory that also contains it");
          top = top.parent_path();
        }
    for (const Use& use : member.uses)
      for (const fs::path place : use.places) {
        const std::string target = place.lexically_relative(top).string();
        one_place = one_place || files.emplace(target, use.file).first->second != use.file;
      }
    if (out.empty()) shared = top;
    while (top != shared && !detail::lies_below(top, shared)) shared = shared.parent_path();
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
        return refuse(path +
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
          return refuse("both " + other->path + " (" + decks_[deck].name + ") and " + use.path +
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
