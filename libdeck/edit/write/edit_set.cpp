// Merges the edits of all decks file by file and refuses what contradicts.
#include "edit/shared/edit_set.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/shared/paths.hpp"
#include "edit/write/tree.hpp"
#include "edit/write/write_plan.hpp"
#include "text/shared/edits.hpp"
#include "text/shared/gzip.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

Error refuse(std::string why) { return {Error::Code::config, std::move(why)}; }

/// First line in which two texts differ, 1-based, and that line of both.
struct Difference {
  std::size_t line = 1;
  std::string a, b;
};
Difference first_difference(std::string_view a, std::string_view b) {
  const std::size_t common = static_cast<std::size_t>(
      std::mismatch(a.begin(),
                    a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())),
                    b.begin())
          .first -
      a.begin());
  const auto line_of = [&](std::string_view text) {
    const auto before = common == 0 ? text.npos : text.rfind('\n', common - 1);
    const std::size_t begin = before == text.npos ? 0 : before + 1;
    constexpr std::size_t longest = 100;
    std::string line(text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin));
    return line.size() > longest ? line.substr(0, longest) + "..." : line;
  };
  Difference d;
  d.line += static_cast<std::size_t>(
      std::count(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(common), '\n'));
  d.a = line_of(a);
  d.b = line_of(b);
  return d;
}

/// The directory above `path` that a git work tree begins with; empty: none.
fs::path work_tree_of(const fs::path& path) {
  std::error_code ec;
  for (fs::path dir = path.parent_path(); !dir.empty(); dir = dir.parent_path()) {
    if (fs::exists(dir / ".git", ec)) return dir;
    if (dir == dir.parent_path()) break;
  }
  return {};
}

bool is_below(const fs::path& path, const fs::path& directory) {
  const fs::path relative = path.lexically_relative(directory);
  return !relative.empty() && *relative.begin() != "..";
}

/// What the paths of a patch are relative to.
fs::path patch_root(const std::vector<fs::path>& files) {
  const auto holds = [&](const fs::path& directory) {
    return !directory.empty() && std::all_of(files.begin(), files.end(), [&](const fs::path& f) {
      return is_below(f, directory);
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
  const auto changed = [&](const File& file) {
    return refuse(source.path() + " was changed while the decks were read (it is also " +
                  file.places.front().second + "); nothing was written. Run the command again");
  };
  std::string place;
  if (source.inode() != 0) {
    // By the same name and still the same file: its place is known.
    if (const auto known = by_path_.find(source.path()); known != by_path_.end()) {
      const File& file = files_[known->second];
      if (file.device != source.device() || file.inode != source.inode() ||
          file.texts.front() != source.bytes())
        return changed(file);
      return known->second;
    }
    const auto target = detail::follow_links(source.path());
    place = target ? detail::canonical_place(*target) : source.path();
    const auto by_place = by_place_.find(place);
    const auto found = by_identity_.find({source.device(), source.inode()});
    if (by_place != by_place_.end() &&
        (found == by_identity_.end() || found->second != by_place->second))
      return changed(files_[by_place->second]);
    if (found != by_identity_.end()) {
      File& file = files_[found->second];
      if (file.texts.front() != source.bytes()) return changed(file);
      if (by_place == by_place_.end()) {
        by_place_.emplace(place, found->second);
        file.places.emplace_back(place, source.path());
      }
      by_path_.emplace(source.path(), found->second);
      return found->second;
    }
    by_identity_.emplace(std::pair{source.device(), source.inode()}, files_.size());
    by_place_.emplace(place, files_.size());
    by_path_.emplace(source.path(), files_.size());
  }
  File& file = files_.emplace_back();
  file.device = source.device();
  file.inode = source.inode();
  file.places.emplace_back(place, source.path());
  file.texts.emplace_back(source.bytes());
  if (source.packed()) file.on_disk = source.on_disk();
  return files_.size() - 1;
}

Result<std::size_t> EditSet::add(const Deck& deck, std::string name) {
  Member member;
  member.name = name.empty() ? deck.sources[0].path() : std::move(name);
  member.main = deck.sources[0].path();
  std::vector<std::string> directives(deck.sources.size());
  for (const IncludeEdge& e : deck.includes)
    directives[e.file] = deck.sources[e.parent].path() + ":" +
                         std::to_string(deck.sources.position(e.directive).line);
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f) {
    const Source& source = deck.sources[f];
    // From memory one path is one file, within its deck.
    if (source.inode() == 0 && member.file_of.contains(source.path())) continue;
    const auto file = enter(source);
    if (!file) return file.error();
    if (!member.file_of.emplace(source.path(), *file).second) continue;
    files_[*file].uses.push_back({decks_.size(), source.path(), directives[f], 0});
  }
  const UnitSystem& units = deck.begin.input;
  if (deck.begin.has_input)
    member.units = units.mass_code + ", " + units.length_code + ", " + units.time_code;
  decks_.push_back(std::move(member));
  return decks_.size() - 1;
}

void EditSet::propose(std::size_t deck, const Deck& now, const ChangedFiles& changed) {
  Member& member = decks_[deck];
  for (const auto& [path, text] : changed) {
    const auto found = member.file_of.find(path);
    if (found == member.file_of.end()) continue;
    File& file = files_[found->second];
    auto same = std::find(file.texts.begin(), file.texts.end(), text);
    if (same == file.texts.end()) same = file.texts.insert(file.texts.end(), text);
    for (Use& use : file.uses)
      if (use.deck == deck && use.path == path)
        use.text = static_cast<std::size_t>(same - file.texts.begin());
  }
  member.order.clear();
  // Files beside the deck are not read back with it.
  std::set<std::uint32_t> included = {0};
  for (const IncludeEdge& e : now.includes) included.insert(e.file);
  for (const std::uint32_t f : included) member.order.push_back(now.sources[f].path());
  for (const IncludeEdge& e : now.includes)
    member.edges.push_back({now.sources[e.parent].path(), e.written, now.sources[e.file].path()});
  std::optional<fs::path> folder;
  if (!root_.empty()) {
    // A deck from memory stands where its document does.
    const std::string& place =
        now.sources[0].inode() != 0 || changed.empty() ? now.sources[0].path() : member.name;
    folder = fs::path(parent_path(absolute_path(place))).lexically_relative(root_);
  }
  const auto layout = detail::lay_out(now, folder);
  if (!layout) {
    member.no_layout = layout.error().message;
    return;
  }
  member.layout.clear();
  for (const auto& [target, file] : layout->files)
    member.layout.emplace_back(target.string(), now.sources[file].path());
  const auto main =
      std::find_if(member.layout.begin(), member.layout.end(),
                   [&](const auto& entry) { return entry.second == now.sources[0].path(); });
  if (main != member.layout.end()) std::iter_swap(main, member.layout.begin());
  member.outside = layout->outside;
}

const EditSet::Use* EditSet::use_of(std::size_t deck, const std::string& path) const {
  const auto found = decks_[deck].file_of.find(path);
  if (found == decks_[deck].file_of.end()) return nullptr;
  for (const Use& use : files_[found->second].uses)
    if (use.deck == deck && use.path == path) return &use;
  return nullptr;
}

Error EditSet::conflict(const File& file, const Use& a, const Use& b,
                        const std::string& where) const {
  const auto who = [&](const Use& use) {
    std::string text = decks_[use.deck].name;
    if (!use.place.empty()) text += " (which includes it in " + use.place + ")";
    return text;
  };
  const Difference d = first_difference(file.texts[a.text], file.texts[b.text]);
  const auto wants = [&](const Use& use, const std::string& line) {
    return who(use) + (use.text == 0 ? " leaves it as it is: '" : " makes it '") + line + "'";
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

/// A use that wants another text than the first; nullptr: all agree.
const EditSet::Use* EditSet::odd_use(const File& file) const {
  for (const Use& use : file.uses)
    if (use.text != file.uses.front().text) return &use;
  return nullptr;
}

Result<std::vector<std::pair<const EditSet::File*, std::size_t>>> EditSet::changes() const {
  std::vector<std::pair<const File*, std::size_t>> out;
  for (const File& file : files_) {
    if (file.uses.empty()) continue;
    const Use& first = file.uses.front();
    if (const Use* odd = odd_use(file)) return conflict(file, first, *odd, first.path);
    if (first.text == 0) continue;
    if (!file.outsider.empty())
      return refuse(first.path + " would change for " + decks_[first.deck].name + ", and " +
                    file.outsider +
                    " includes it too; nothing was written. --with-dependents changes all decks "
                    "that include it, --split-includes gives the deck its own copy");
    out.emplace_back(&file, first.text);
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return a.first->places.front().second < b.first->places.front().second;
  });
  return out;
}

std::string_view EditSet::as_written(Plan& plan, const std::string& text, bool packed) {
  return packed ? std::string_view(plan.packed.emplace_back(gzip(text))) : std::string_view(text);
}

Result<EditSet::Plan> EditSet::in_place() const {
  auto changed = changes();
  if (!changed) return changed.error();
  Plan plan;
  if (!decks_.empty()) plan.main = decks_.front().main;
  for (const auto& [file, text] : *changed) {
    if (file->is_new) {
      plan.files.push_back({file->uses.front().path, file->texts[text]});
      continue;
    }
    if (file->inode == 0)
      return refuse(file->uses.front().path + " was not read from a file and cannot be rewritten");
    const bool packed = !file->on_disk.empty();
    const std::string_view bytes = as_written(plan, file->texts[text], packed);
    const FileRead read{file->device, file->inode,
                        packed ? std::string_view(file->on_disk) : file->texts.front()};
    const bool is_main = std::any_of(file->uses.begin(), file->uses.end(),
                                     [](const Use& use) { return use.place.empty(); });
    for (const auto& [place, path] : file->places)
      plan.files.push_back({path, bytes, read, nullptr, {}, is_main});
  }
  return plan;
}

/// Where the tree of each deck goes below the directory of all: nowhere further down, unless files
/// of two decks would be in one place there.
std::vector<std::string> EditSet::folders() const {
  std::map<std::string, std::size_t> files;  // by place
  std::vector<fs::path> above;               // what each tree is relative to
  fs::path shared;
  bool one_place = false;
  for (const Member& member : decks_) {
    fs::path target;
    for (const auto& [relative, path] : member.layout) {
      if (path == member.main) target = relative;
      const auto file = member.file_of.find(path);
      if (file == member.file_of.end()) continue;
      one_place = one_place || files.emplace(relative, file->second).first->second != file->second;
    }
    above.push_back(parent_path(absolute_path(member.main)));
    for (fs::path p = target.parent_path(); !p.empty(); p = p.parent_path())
      above.back() = above.back().parent_path();
    if (above.size() == 1) shared = above.back();
    while (above.back() != shared && !is_below(above.back(), shared)) shared = shared.parent_path();
  }
  std::vector<std::string> out;
  for (const fs::path& p : above)
    out.push_back(one_place ? p.lexically_relative(shared).string() : std::string());
  return out;
}

Result<EditSet::Plan> EditSet::tree(const std::string& directory) const {
  Plan plan;
  std::map<std::string, std::pair<const File*, const Use*>> targets;
  std::set<std::string> outside;
  const std::vector<std::string> folder = folders();
  for (std::size_t d = 0; d < decks_.size(); ++d) {
    const Member& member = decks_[d];
    if (!member.no_layout.empty()) return refuse(member.no_layout);
    for (const std::string& path : member.outside) {
      outside.insert(path);
      if (const Use* use = use_of(d, path); use != nullptr && use->text != 0)
        return refuse(path +
                      " is included by its absolute path and would have to change; change it "
                      "with --in-place, or make one file with deck convert --flatten");
    }
    for (const auto& [relative, path] : member.layout) {
      const Use* use = use_of(d, path);
      if (use == nullptr) return Error{Error::Code::internal, path + " was not read before"};
      const File& file = files_[member.file_of.at(path)];
      const std::string target = normal_path((fs::path(directory) / folder[d] / relative).string());
      const auto [it, is_new] = targets.try_emplace(target, &file, use);
      if (is_new) continue;
      const auto& [other, other_use] = it->second;
      if (other == &file && other_use->text != use->text)
        return conflict(file, *other_use, *use, target);
      const bool same_text = other->texts[other_use->text] == file.texts[use->text];
      const bool from_memory = other->inode == 0 && file.inode == 0;
      if (other != &file && (!same_text || (other_use->deck != d && !from_memory)))
        return refuse("both " + other_use->path + " (" + decks_[other_use->deck].name + ") and " +
                      path + " (" + member.name + ") would be written to " + target +
                      "; nothing was written. Write the decks to different directories");
    }
  }
  for (const auto& [target, source] : targets) {
    const std::string& text = source.first->texts[source.second->text];
    const std::string& from = source.second->path;
    plan.files.push_back({target, as_written(plan, text, has_gz_name(target))});
    if (from != "-") plan.files.back().origin = absolute_path(from);
    plan.files.back().is_main = source.second->place.empty();
  }
  plan.outside.assign(outside.begin(), outside.end());
  return plan;
}

Result<std::string> EditSet::diff() const {
  auto changed = changes();
  if (!changed) return changed.error();
  std::vector<fs::path> places;
  for (const auto& [file, text] : *changed)
    for (const auto& [place, path] : file->places)
      if (!place.empty()) places.emplace_back(place);
  const fs::path root = patch_root(places);
  // Paths of a patch with this line count from the top of the work tree, wherever git is called.
  std::error_code ec;
  const bool elsewhere = !root.empty() && root != fs::canonical(".", ec);
  std::string out;
  for (const auto& [file, text] : *changed)
    for (const auto& [place, path] : file->places) {
      std::string shown = place.empty() ? path : fs::path(place).lexically_relative(root).string();
      if (!file->on_disk.empty()) shown = without_gz(shown);
      const std::string hunks = unified_diff(shown, file->texts.front(), file->texts[text]);
      if (!hunks.empty() && (elsewhere || file->is_new))
        out += "diff --git a/" + shown + " b/" + shown + "\n";
      if (file->is_new)
        out += "new file mode 100644\n--- /dev/null\n" + hunks.substr(hunks.find('\n') + 1);
      else
        out += hunks;
    }
  return out;
}

std::string EditSet::read_back_difference(std::size_t deck, const Deck& written) const {
  const Member& member = decks_[deck];
  if (written.sources.size() != member.order.size())
    return "it has " + std::to_string(written.sources.size()) + " files, expected " +
           std::to_string(member.order.size());
  for (std::uint32_t f = 0; f < written.sources.size(); ++f) {
    const Use* use = use_of(deck, member.order[f]);
    const auto file = member.file_of.find(member.order[f]);
    if (use == nullptr || file == member.file_of.end()) return member.order[f] + " was not read";
    if (files_[file->second].texts[use->text] != written.sources[f].bytes())
      return written.sources[f].path() + " is not the text for " + member.order[f];
  }
  return {};
}

void EditSet::add_outsider(const FileIdentity& file, const std::string& deck) {
  const auto found = by_identity_.find(file);
  if (found == by_identity_.end()) return;
  std::string& known = files_[found->second].outsider;
  if (known.empty()) known = deck;
}

std::set<FileIdentity> EditSet::changed_files() const {
  std::set<FileIdentity> out;
  for (const File& file : files_)
    for (const Use& use : file.uses)
      if (use.text != 0 && file.inode != 0) out.emplace(file.device, file.inode);
  return out;
}

}  // namespace deck
