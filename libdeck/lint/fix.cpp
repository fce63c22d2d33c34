// Selects compatible fixes and applies them.
#include "lint/shared/fix.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace deck {
namespace {

/// Edits of one file by offset, without overlaps.
using FileEdits = std::map<std::uint64_t, const TextEdit*>;

bool overlaps(const FileEdits& taken, const TextEdit& e) {
  const std::uint64_t begin = e.span.offset, end = begin + e.span.length;
  auto it = taken.lower_bound(begin);
  if (it != taken.end() && (it->first < end || it->first == begin)) return true;
  if (it == taken.begin()) return false;
  const TextEdit* before = std::prev(it)->second;
  return before->span.offset + before->span.length > begin;
}

/// Identity of a file on disk; in memory: deck and path.
using Identity = std::tuple<std::uint64_t, std::uint64_t, std::size_t, std::string_view>;

Identity identity_of(const Source& source, std::size_t deck) {
  if (source.inode() != 0) return {source.device(), source.inode(), 0, {}};
  return {0, 0, deck, source.path()};
}

bool counts(const Finding& d, bool unsafe) {
  return d.fix && (d.fix->safe || unsafe) && !d.fix->edits.empty() &&
         std::all_of(d.fix->edits.begin(), d.fix->edits.end(),
                     [](const TextEdit& e) { return e.span.valid(); });
}

/// One include of a file in one deck.
struct Instance {
  std::size_t deck = 0;
  std::uint32_t file = 0;
  std::set<std::tuple<std::uint64_t, std::uint32_t, std::string_view>> wanted = {};
};

}  // namespace

AgreedFixes agree_on_fixes(const std::vector<FixedDeck>& decks, bool unsafe) {
  std::map<Identity, std::vector<Instance>> instances;
  for (std::size_t d = 0; d < decks.size(); ++d) {
    const SourceSet& sources = *decks[d].sources;
    std::map<std::uint32_t, Instance*> by_file;
    for (std::uint32_t f = 0; f < sources.size(); ++f)
      instances[identity_of(sources[f], d)].push_back({d, f});
    for (auto& [identity, list] : instances)
      for (Instance& i : list)
        if (i.deck == d) by_file[i.file] = &i;
    for (const Finding& finding : *decks[d].findings)
      if (counts(finding, unsafe))
        for (const TextEdit& e : finding.fix->edits)
          by_file.at(e.span.file)->wanted.emplace(e.span.offset, e.span.length, e.text);
  }
  AgreedFixes out;
  out.wanted.resize(decks.size());
  for (std::size_t d = 0; d < decks.size(); ++d) {
    for (const Finding& finding : *decks[d].findings) {
      if (!counts(finding, unsafe)) continue;
      const Instance* against = nullptr;
      for (const TextEdit& e : finding.fix->edits)
        for (const Instance& i : instances.at(identity_of((*decks[d].sources)[e.span.file], d)))
          if (!i.wanted.contains({e.span.offset, e.span.length, e.text})) against = &i;
      if (against == nullptr)
        out.wanted[d].push_back(&*finding.fix);
      else
        out.withheld.push_back({d, against->deck, &finding});
    }
  }
  return out;
}

FixResult apply_fixes(const SourceSet& sources, const std::vector<Finding>& findings, bool unsafe) {
  std::vector<const Fix*> wanted;
  for (const Finding& d : findings)
    if (d.fix && (d.fix->safe || unsafe)) wanted.push_back(&*d.fix);
  return apply_fixes(sources, wanted);
}

FixResult apply_fixes(const SourceSet& sources, const std::vector<const Fix*>& all) {
  FixResult result;
  std::map<std::uint32_t, FileEdits> edits;
  std::map<std::uint32_t, std::size_t> fixes;
  for (const Fix* fix : all) {
    if (fix->edits.empty()) continue;
    const auto& wanted = fix->edits;
    const bool free = std::none_of(wanted.begin(), wanted.end(), [&](const TextEdit& e) {
      return !e.span.valid() || overlaps(edits[e.span.file], e);
    });
    if (!free) {
      ++result.skipped;
      continue;
    }
    for (const TextEdit& e : wanted) edits[e.span.file].emplace(e.span.offset, &e);
    ++fixes[wanted.front().span.file];
    ++result.applied;
  }
  for (auto& [file, list] : edits) {
    if (list.empty()) continue;
    FixedFile fixed;
    fixed.file = file;
    fixed.fixes = fixes[file];
    std::vector<const TextEdit*> wanted;
    for (const auto& [offset, e] : list) wanted.push_back(e);
    fixed.text = *apply_edit_pointers(sources[file], std::move(wanted));
    if (fixed.text != sources[file].bytes()) result.files.push_back(std::move(fixed));
  }
  return result;
}

}  // namespace deck
