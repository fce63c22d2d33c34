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

namespace {

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto nl = text.find('\n');
    const auto n = nl == std::string_view::npos ? text.size() : nl + 1;
    lines.push_back(text.substr(0, n));
    text.remove_prefix(n);
  }
  return lines;
}

/// Stretches of lines that differ: [a0, a1) of the old text became [b0, b1) of the new one.
struct Change {
  std::size_t a0, a1, b0, b1;
};

/// Fixes touch few lines, so a greedy resynchronisation is enough: after a difference look for the
/// nearest pair of equal lines.
std::vector<Change> changes(const std::vector<std::string_view>& a,
                            const std::vector<std::string_view>& b) {
  std::vector<Change> out;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      ++i;
      ++j;
      continue;
    }
    std::size_t di = a.size() - i, dj = b.size() - j;
    for (std::size_t reach = 1; reach < di + dj; ++reach) {
      bool met = false;
      for (std::size_t x = 0; x <= reach; ++x) {
        const std::size_t y = reach - x;
        if (i + x < a.size() && j + y < b.size() && a[i + x] == b[j + y]) {
          di = x;
          dj = y;
          met = true;
          break;
        }
      }
      if (met || reach > 2000) break;
    }
    out.push_back({i, i + di, j, j + dj});
    i += di;
    j += dj;
  }
  return out;
}

void put_line(std::string& out, char mark, std::string_view line) {
  out += mark;
  out += line;
  if (!line.ends_with('\n')) out += "\n\\ No newline at end of file\n";
}

std::string range(std::size_t begin, std::size_t count) {
  const std::size_t first = count == 0 ? begin : begin + 1;
  return std::to_string(first) + (count == 1 ? "" : "," + std::to_string(count));
}

}  // namespace

std::string unified_diff(std::string_view path, std::string_view before, std::string_view after) {
  constexpr std::size_t context = 3;
  const auto a = split_lines(before), b = split_lines(after);
  const auto diff = changes(a, b);
  if (diff.empty()) return {};
  while (path.starts_with("./")) path.remove_prefix(2);
  const std::string_view rooted = path.starts_with('/') ? path.substr(1) : path;
  std::string out = "--- a/" + std::string(rooted) + "\n+++ b/" + std::string(rooted) + "\n";
  for (std::size_t k = 0; k < diff.size();) {
    std::size_t last = k;
    while (last + 1 < diff.size() && diff[last + 1].a0 - diff[last].a1 <= 2 * context) ++last;
    const std::size_t a0 = diff[k].a0 - std::min(context, diff[k].a0);
    const std::size_t b0 = diff[k].b0 - std::min(context, diff[k].b0);
    const std::size_t a1 = std::min(diff[last].a1 + context, a.size());
    const std::size_t b1 = std::min(diff[last].b1 + context, b.size());
    out += "@@ -" + range(a0, a1 - a0) + " +" + range(b0, b1 - b0) + " @@\n";
    std::size_t at = a0;
    for (; k <= last; ++k) {
      for (; at < diff[k].a0; ++at) put_line(out, ' ', a[at]);
      for (; at < diff[k].a1; ++at) put_line(out, '-', a[at]);
      for (std::size_t n = diff[k].b0; n < diff[k].b1; ++n) put_line(out, '+', b[n]);
    }
    for (; at < a1; ++at) put_line(out, ' ', a[at]);
  }
  return out;
}

TextEdit cell_edit(const SourceSet& sources, Span on_line, int first, int last,
                   std::string_view text) {
  const Source& source = sources[on_line.file];
  const std::string_view line = source.line_at(on_line.offset);
  const auto start = static_cast<std::uint64_t>(line.data() - source.bytes().data());
  const auto width = static_cast<std::size_t>(last - first + 1);
  const auto begin = static_cast<std::size_t>(first - 1);
  std::string padded(text.size() < width ? width - text.size() : 0, ' ');
  padded += text;
  // A line that ends before the cell grows to hold it.
  if (line.size() <= begin)
    return {Span{on_line.file, 0, start + line.size()},
            std::string(begin - line.size(), ' ') + padded};
  const auto length = static_cast<std::uint32_t>(std::min(width, line.size() - begin));
  return {Span{on_line.file, length, start + begin}, std::move(padded)};
}

TextEdit blank_edit(Span span) { return {span, std::string(span.length, ' ')}; }

}  // namespace deck
