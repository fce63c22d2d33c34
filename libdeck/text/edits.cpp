// Applies edits to bytes and prints unified diffs. The diff is greedy: after a difference it goes
// on at the nearest pair of equal lines (smallest sum of skipped lines, at most 2000). It is
// correct for all texts and short for fixes, which change few lines; cost O(lines + skipped^2).
#include "text/shared/edits.hpp"

#include <algorithm>
#include <cstdint>

#include "base/shared/shown_text.hpp"
#include "text/shared/columns.hpp"

namespace deck {

Result<std::string> apply_edits(const Source& source, const std::vector<TextEdit>& edits) {
  std::vector<const TextEdit*> all;
  all.reserve(edits.size());
  for (const TextEdit& e : edits) all.push_back(&e);
  return apply_edit_pointers(source, std::move(all));
}

Result<std::string> apply_edit_pointers(const Source& source, std::vector<const TextEdit*> edits) {
  const auto less = [](const TextEdit* a, const TextEdit* b) {
    return a->span.offset != b->span.offset ? a->span.offset < b->span.offset
                                            : a->span.length < b->span.length;
  };
  if (!std::is_sorted(edits.begin(), edits.end(), less))
    std::stable_sort(edits.begin(), edits.end(), less);
  const std::string_view bytes = source.bytes();
  std::string out;
  out.reserve(bytes.size() + 64);
  std::uint64_t at = 0;
  const TextEdit* before = nullptr;
  for (const TextEdit* edit : edits) {
    const TextEdit& e = *edit;
    if (before != nullptr && before->span.offset == e.span.offset &&
        before->span.length == e.span.length && before->text == e.text && e.span.length > 0)
      continue;
    if (e.span.offset < at || e.span.offset + e.span.length > bytes.size()) {
      const Position p = source.position(std::min<std::uint64_t>(e.span.offset, bytes.size()));
      return Error{Error::Code::config, source.path() + ":" + std::to_string(p.line) + ":" +
                                            std::to_string(p.column) +
                                            ": two changes to the same columns"};
    }
    out.append(bytes.substr(at, e.span.offset - at));
    out.append(e.text);
    at = e.span.offset + e.span.length;
    before = &e;
  }
  out.append(bytes.substr(at));
  return out;
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

/// Lines [a0, a1) of the old text are replaced by [b0, b1) of the new one.
struct Change {
  std::size_t a0, a1, b0, b1;
};

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

/// File name in a diff, quoted as git does.
std::string diff_name(std::string_view prefix, std::string_view path) {
  std::string out(prefix);
  bool quoted = false;
  for (std::size_t i = 0; i < path.size();) {
    const TextUnit unit = text_unit_at(path, i);
    const bool plain = unit.visible() && unit.code != '"' && unit.code != '\\';
    for (const char c : path.substr(i, unit.length)) {
      const auto byte = static_cast<unsigned>(static_cast<unsigned char>(c));
      if (plain) {
        out += c;
      } else {
        out += '\\';
        for (const unsigned shift : {6U, 3U, 0U})
          out += static_cast<char>('0' + (byte >> shift & 7U));
      }
    }
    quoted = quoted || !plain;
    i += unit.length;
  }
  return quoted ? '"' + out + '"' : out;
}

}  // namespace

std::string unified_diff(std::string_view path, std::string_view before, std::string_view after) {
  constexpr std::size_t context = 3;
  const auto a = split_lines(before), b = split_lines(after);
  const auto diff = changes(a, b);
  if (diff.empty()) return {};
  while (path.starts_with("./")) path.remove_prefix(2);
  const std::string_view rooted = path.starts_with('/') ? path.substr(1) : path;
  std::string out = "--- " + diff_name("a/", rooted) + "\n+++ " + diff_name("b/", rooted) + "\n";
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

void CellWriter::put(std::string& line, int first, int last, std::string_view text) {
  const auto begin = static_cast<std::size_t>(first - 1);
  const auto width = static_cast<std::size_t>(last - first + 1);
  // A cell after the end of the line is blank already.
  if (text.empty() && line.size() <= begin) return;
  if (line.size() < begin) line.resize(begin, ' ');
  std::string cell(text.size() < width ? width - text.size() : 0, ' ');
  cell += text;
  if (text.empty()) cell.resize(std::min(width, line.size() - begin));
  if (line.size() < begin + cell.size()) line.resize(begin + cell.size(), ' ');
  line.replace(begin, cell.size(), cell);
}

TextEdit CellWriter::edit(const SourceSet& sources, Span on_line, int first, int last,
                          std::string_view text) {
  CellWriter cells(sources);
  cells.set(on_line, first, last, text);
  return cells.release_edits().front();
}

TextEdit CellWriter::edit_in_place(const SourceSet& sources, Span on_line, int first, int last,
                                   std::string_view text) {
  const std::string_view bytes = sources[on_line.file].bytes();
  const std::size_t begin = on_line.offset + static_cast<std::size_t>(first - 1);
  const auto width = static_cast<std::size_t>(last - first + 1);
  std::size_t end = begin;                 // end of the cell on this line, with trailing blanks
  const auto ends = [&](std::size_t at) {  // a carriage return within a line counts as a blank
    if (at >= bytes.size() || bytes[at] == '\n') return true;
    return bytes[at] == '\r' && (at + 1 == bytes.size() || bytes[at + 1] == '\n');
  };
  while (end < begin + width && !ends(end)) ++end;
  const std::string_view old = bytes.substr(begin, end - begin);
  const std::string_view token = detail::trim(old);
  std::size_t right =
      token.empty() ? width : static_cast<std::size_t>(token.data() - old.data()) + token.size();
  right = std::max(right, text.size());
  std::string cell(right - text.size(), ' ');
  cell += text;
  if (cell.size() < old.size()) cell.append(old.size() - cell.size(), ' ');
  return {Span{on_line.file, static_cast<std::uint32_t>(old.size()), begin}, std::move(cell)};
}

void CellWriter::set(Span on_line, int first, int last, std::string_view text) {
  const Source& source = (*sources_)[on_line.file];
  const auto start =
      static_cast<std::uint64_t>(source.line_at(on_line.offset).data() - source.bytes().data());
  const auto width = static_cast<std::size_t>(last - first + 1);
  std::string padded(text.size() < width ? width - text.size() : 0, ' ');
  padded += text;
  lines_[{on_line.file, start}][first] = {last, std::move(padded)};
}

void CellWriter::replace(Span cell, std::string_view text) {
  free_[{cell.file, cell.offset, cell.length}] = std::string(text);
}

std::vector<TextEdit> CellWriter::release_edits() {
  std::vector<TextEdit> edits;
  for (const auto& [place, cells] : lines_) {
    const auto [file, start] = place;
    const std::size_t size = (*sources_)[file].line_at(start).size();
    std::size_t grown = size;  // including the rest of a cell cut by the end of the line
    std::string tail;          // text to add after that
    for (const auto& [first, target] : cells) {
      const auto begin = static_cast<std::size_t>(first - 1);
      const auto width = static_cast<std::size_t>(target.last - first + 1);
      if (size <= begin) {
        tail.append(begin - grown - tail.size(), ' ');
        tail += target.text;
        continue;
      }
      const auto length = static_cast<std::uint32_t>(std::min(width, size - begin));
      edits.push_back({Span{file, length, start + begin}, target.text});
      if (length < width) grown = begin + width;
    }
    if (!tail.empty()) edits.push_back({Span{file, 0, start + size}, tail});
  }
  lines_.clear();
  for (auto& [place, text] : free_) {
    const auto& [file, offset, length] = place;
    edits.push_back({Span{file, length, offset}, std::move(text)});
  }
  free_.clear();
  return edits;
}

TextEdit blank_edit(Span span) { return {span, std::string(span.length, ' ')}; }

}  // namespace deck
