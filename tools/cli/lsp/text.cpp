// Lines, positions and offsets of a text; names of documents.
#include "lsp/text.hpp"

#include <algorithm>
#include <cstring>

#include "base/shared/paths.hpp"
#include "base/shared/shown_text.hpp"

namespace deck::lsp {
namespace {

/// Appends the starts of lines after line ends in [begin, end).
void find_lines(std::string_view text, std::uint64_t begin, std::uint64_t end,
                std::vector<std::uint64_t>& starts) {
  const bool returns = text.substr(begin, end - begin).find('\r') != text.npos;
  if (!returns) {
    for (std::uint64_t at = begin; at < end;) {
      const void* const hit = std::memchr(text.data() + at, '\n', end - at);
      if (hit == nullptr) return;
      at = static_cast<std::uint64_t>(static_cast<const char*>(hit) - text.data()) + 1;
      starts.push_back(at);
    }
    return;
  }
  for (std::uint64_t at = begin; at < end; ++at)
    if (text[at] == '\n' || (text[at] == '\r' && !(at + 1 < text.size() && text[at + 1] == '\n')))
      starts.push_back(at + 1);
}

/// Bytes and units of the character at `at`.
struct Unit {
  std::size_t bytes = 1;
  std::uint64_t units = 1;
};
Unit unit_at(std::string_view text, std::size_t at, Encoding encoding) {
  if (static_cast<unsigned char>(text[at]) < 0x80) return {};
  const TextUnit unit = text_unit_at(text, at);
  if (!unit.character) return {1, encoding == Encoding::utf8 ? 2u : 1u};  // sent as Latin-1
  return {unit.length, encoding == Encoding::utf8 ? unit.length : unit.code > 0xffff ? 2u : 1u};
}

}  // namespace

LineTable::LineTable(std::string_view text) {
  starts_.push_back(0);
  find_lines(text, 0, text.size(), starts_);
}

std::string_view LineTable::line(std::string_view text, std::uint64_t number) const {
  if (number >= starts_.size()) return {};
  const std::uint64_t begin = starts_[number];
  std::uint64_t end = number + 1 < starts_.size() ? starts_[number + 1] : text.size();
  if (number + 1 < starts_.size()) {
    if (end > begin && text[end - 1] == '\n') --end;
    if (end > begin && text[end - 1] == '\r') --end;
  }
  return text.substr(begin, end - begin);
}

std::uint64_t LineTable::line_of(std::uint64_t offset) const {
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
  return static_cast<std::uint64_t>(after - starts_.begin()) - 1;
}

std::uint64_t LineTable::offset(std::string_view text, TextPlace place, Encoding encoding) const {
  if (place.line >= starts_.size()) return text.size();
  const std::string_view content = line(text, place.line);
  std::uint64_t left = place.character;
  std::size_t at = 0;
  while (at < content.size() && left > 0) {
    const Unit unit = unit_at(content, at, encoding);
    if (unit.units > left) break;  // inside of a character: its start
    left -= unit.units;
    at += unit.bytes;
  }
  return starts_[place.line] + at;
}

TextPlace LineTable::place(std::string_view text, std::uint64_t offset, Encoding encoding) const {
  offset = std::min<std::uint64_t>(offset, text.size());
  const std::uint64_t number = line_of(offset);
  const std::string_view content = line(text, number);
  const std::uint64_t length = std::min<std::uint64_t>(offset - starts_[number], content.size());
  return {number, units(content.substr(0, length), encoding)};
}

std::shared_ptr<const LineTable> LineTable::spliced(std::string_view before, std::string_view after,
                                                    std::uint64_t begin, std::uint64_t end) const {
  // A two-byte line end may have been split or joined: one line more on both sides.
  std::uint64_t first = line_of(begin), last = line_of(end);
  if (first > 0) --first;
  last = std::min<std::uint64_t>(last + 1, starts_.size() - 1);
  const std::uint64_t from = starts_[first];
  const std::uint64_t old_to = last + 1 < starts_.size() ? starts_[last + 1] : before.size();
  const std::uint64_t to = old_to + after.size() - before.size();  // modulo 2^64: may wrap
  std::shared_ptr<LineTable> table(new LineTable);
  table->starts_.reserve(starts_.size() + 16);
  table->starts_.assign(starts_.begin(), starts_.begin() + static_cast<std::ptrdiff_t>(first + 1));
  find_lines(after, from, to, table->starts_);
  const std::uint64_t shift = after.size() - before.size();
  if (last + 1 < starts_.size()) {
    // The line after the changed ones begins at `to`; it was found above unless no line ends there.
    if (table->starts_.back() == to) table->starts_.pop_back();
    for (std::uint64_t i = last + 1; i < starts_.size(); ++i)
      table->starts_.push_back(starts_[i] + shift);
  }
  return table;
}

void replace(std::string& text, Document& document, std::uint64_t begin, std::uint64_t end,
             std::string_view by) {
  end = std::min<std::uint64_t>(end, text.size());
  begin = std::min(begin, end);
  std::string after;
  after.reserve(text.size() + by.size());
  after.append(text, 0, begin).append(by).append(text, end);
  document.lines = document.lines->spliced(text, after, begin, end);
  text = std::move(after);
}

std::uint64_t units(std::string_view text, Encoding encoding) {
  std::uint64_t n = 0;
  for (std::size_t at = 0; at < text.size();) {
    const Unit unit = unit_at(text, at, encoding);
    n += unit.units;
    at += unit.bytes;
  }
  return n;
}

std::string path_of_uri(std::string_view uri) {
  constexpr std::string_view scheme = "file://";
  if (!uri.starts_with(scheme)) return {};
  uri.remove_prefix(scheme.size());
  uri.remove_prefix(std::min(uri.find('/'), uri.size()));  // the host
  std::string path;
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      path += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  if (path.find('\0') != path.npos) return {};
  return normal_path(path);
}

std::string uri_of_path(std::string_view path) {
  std::string uri = "file://";
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::strchr("/-._~", c) != nullptr;
    if (plain) {
      uri += c;
      continue;
    }
    constexpr const char* digits = "0123456789ABCDEF";
    uri += '%';
    uri += digits[static_cast<unsigned char>(c) >> 4];
    uri += digits[static_cast<unsigned char>(c) & 15];
  }
  return uri;
}

std::string utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    if (static_cast<unsigned char>(text[at]) < 0x80) {
      out += text[at++];
      continue;
    }
    const TextUnit unit = text_unit_at(text, at);
    if (unit.character) {
      out.append(text, at, unit.length);
      at += unit.length;
      continue;
    }
    const auto byte = static_cast<unsigned char>(text[at++]);
    out += static_cast<char>(0xc0 | (byte >> 6));
    out += static_cast<char>(0x80 | (byte & 0x3f));
  }
  return out;
}

}  // namespace deck::lsp
