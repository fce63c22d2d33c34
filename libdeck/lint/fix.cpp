#include "deck/lint/fix.hpp"

#include <algorithm>
#include <map>

namespace deck {
namespace {

/// Edits of one file by offset; they never overlap.
using FileEdits = std::map<std::uint64_t, const TextEdit*>;

bool overlaps(const FileEdits& taken, const TextEdit& e) {
  const std::uint64_t begin = e.span.offset, end = begin + e.span.length;
  auto it = taken.lower_bound(begin);
  if (it != taken.end() && (it->first < end || it->first == begin)) return true;
  if (it == taken.begin()) return false;
  const TextEdit* before = std::prev(it)->second;
  return before->span.offset + before->span.length > begin;
}

}  // namespace

FixResult apply_fixes(const SourceSet& sources, const std::vector<Diagnostic>& diagnostics,
                      bool unsafe) {
  FixResult result;
  std::map<std::uint32_t, FileEdits> edits;
  std::map<std::uint32_t, std::size_t> fixes;
  for (const Diagnostic& d : diagnostics) {
    if (!d.fix || (!d.fix->safe && !unsafe) || d.fix->edits.empty()) continue;
    const auto& wanted = d.fix->edits;
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
    const std::string_view bytes = sources[file].bytes();
    FixedFile fixed;
    fixed.file = file;
    fixed.fixes = fixes[file];
    fixed.text.reserve(bytes.size() + 64);
    std::uint64_t at = 0;
    for (const auto& [offset, e] : list) {
      fixed.text.append(bytes.substr(at, offset - at));
      fixed.text.append(e->text);
      at = offset + e->span.length;
    }
    fixed.text.append(bytes.substr(at));
    if (fixed.text != bytes) result.files.push_back(std::move(fixed));
  }
  return result;
}

}  // namespace deck
