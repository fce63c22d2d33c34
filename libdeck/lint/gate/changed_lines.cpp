// Changed lines of a deck; moves findings to them.
#include "lint/shared/gate.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "base/shared/paths.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

/// "@@ -12,3 +14,2 @@" gives 14 and 2; a missing count is 1.
std::pair<std::uint64_t, std::uint64_t> new_side(std::string_view hunk) {
  const std::size_t plus = hunk.find(" +");
  if (plus == hunk.npos) return {0, 0};
  std::uint64_t first = 0, count = 1;
  const char* const end = hunk.data() + hunk.size();
  const auto [after, wrong] = std::from_chars(hunk.data() + plus + 2, end, first);
  if (wrong != std::errc()) return {0, 0};
  if (after != end && *after == ',') std::from_chars(after + 1, end, count);
  return {first, count};
}

}  // namespace

void ChangedLines::add(const std::string& path, std::uint64_t first, std::uint64_t count) {
  if (first == 0 || count == 0) return;
  auto& stretches = files_[absolute_path(path)];
  stretches.emplace_back(first, first + count - 1);
  std::sort(stretches.begin(), stretches.end());
}

void ChangedLines::add_hunks(const std::string& path, std::string_view patch) {
  // Text lines of a patch start with a sign, so "@@" at the start is a hunk.
  for (const std::string_view line : detail::parts_of(patch, '\n')) {
    if (!line.starts_with("@@ ")) continue;
    const auto [first, count] = new_side(line);
    add(path, first, count);
  }
}

Span ChangedPlaces::first_in(const Span& span) {
  if (!span.valid()) return {};
  const auto [known, is_new] = of_file_.try_emplace(span.file, nullptr);
  const Source& source = sources_[span.file];
  if (is_new)
    if (const auto it = lines_.files_.find(absolute_path(source.path())); it != lines_.files_.end())
      known->second = &it->second;
  if (known->second == nullptr) return {};
  std::uint64_t line = source.position(span.offset).line;
  const auto stretch = std::find_if(
      known->second->begin(), known->second->end(),
      [&](const std::pair<std::uint64_t, std::uint64_t>& s) { return s.second >= line; });
  if (stretch == known->second->end()) return {};
  const std::string_view bytes = source.bytes();
  const std::uint64_t end = std::min<std::uint64_t>(span.offset + span.length, bytes.size());
  std::uint64_t at = span.offset;
  for (; line < stretch->first; ++line) {
    const std::size_t next = bytes.find('\n', at);
    if (next == bytes.npos || next + 1 >= end) return {};
    at = next + 1;
  }
  const std::uint64_t stop = std::min<std::uint64_t>(bytes.find('\n', at), end);
  return {span.file, static_cast<std::uint32_t>(stop - at), at};
}

void stand_at_changes(std::vector<Finding>& findings, const SourceSet& sources,
                      const ChangedLines& lines) {
  if (lines.empty()) return;
  ChangedPlaces changed(lines, sources);
  for (Finding& d : findings) {
    if (!d.span.valid() || changed.first_in(d.span).valid()) continue;
    const auto note = std::find_if(d.notes.begin(), d.notes.end(), [&](const auto& n) {
      return changed.first_in(n.first).valid();
    });
    if (note == d.notes.end()) continue;
    const Span old = std::exchange(d.span, note->first);
    d.notes.erase(note);
    d.notes.insert(
        d.notes.begin(),
        {old, d.keyword.empty() ? "what it is about" : d.keyword + " " + std::to_string(d.id)});
  }
}

}  // namespace deck
