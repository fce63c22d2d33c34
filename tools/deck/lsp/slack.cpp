// Where slacks are, and how places with and without them belong together.
#include "lsp/slack.hpp"

#include <algorithm>

namespace deck::lsp {
namespace {

constexpr std::uint64_t least_slack = 80, most_slack = 400;
constexpr std::size_t most_blocks = 20'000;

}  // namespace

std::string slack_text(std::uint64_t size) {
  constexpr std::uint64_t line = 80;
  std::string out;
  out.reserve(size);
  while (size > 0) {
    std::uint64_t now = std::min(size, line);
    if (size - now == 1) --now;  // a line has two bytes at least
    out += '#';
    out.append(now - 2, '-');
    out += '\n';
    size -= now;
  }
  return out;
}

SlackTable SlackTable::of(const Deck& deck, const std::vector<std::uint32_t>& open_files) {
  SlackTable table;
  if (deck.blocks.size() > most_blocks) return table;
  for (const std::uint32_t file : open_files) {
    const std::string_view bytes = deck.sources[file].bytes();
    const std::uint64_t size = std::clamp<std::uint64_t>(
        bytes.size() / 4 / (deck.blocks.size() + 1), least_slack, most_slack);
    std::vector<Slack> slacks;
    const auto add = [&](std::uint64_t offset) {
      if (offset > 0 && offset < bytes.size() && bytes[offset - 1] == '\n')
        slacks.push_back({offset, size});
    };
    for (const Block& b : deck.blocks) {
      if (b.header_span.file != file) continue;
      const auto line = bytes.rfind('\n', b.header_span.offset);
      add(b.header_span.offset == 0 || line == bytes.npos ? 0 : line + 1);
      // Behind the last block stands /END.
      if (!b.body.empty() && b.body.back().file == file &&
          bytes.substr(b.body.back().end).starts_with("/END"))
        add(b.body.back().end);
    }
    std::sort(slacks.begin(), slacks.end(),
              [](const Slack& a, const Slack& b) { return a.offset < b.offset; });
    slacks.erase(std::unique(slacks.begin(), slacks.end(),
                             [](const Slack& a, const Slack& b) { return a.offset == b.offset; }),
                 slacks.end());
    if (!slacks.empty()) table.by_path_[deck.sources[file].path()] = std::move(slacks);
  }
  return table;
}

const std::vector<Slack>* SlackTable::find(const std::string& path) const {
  const auto it = by_path_.find(path);
  return it == by_path_.end() ? nullptr : &it->second;
}

std::vector<Slack>* SlackTable::find(const std::string& path) {
  const auto it = by_path_.find(path);
  return it == by_path_.end() ? nullptr : &it->second;
}

std::string SlackTable::padded(const std::string& path, std::string_view text) const {
  std::string out;
  std::uint64_t at = 0;
  if (const auto* slacks = find(path))
    for (const Slack& s : *slacks) {
      out.append(text, at, s.offset - at);
      out += slack_text(s.size);
      at = s.offset;
    }
  return out.append(text, at);
}

std::uint64_t SlackTable::padded_offset(const std::string& path, std::uint64_t offset,
                                        std::uint64_t end) const {
  std::uint64_t before = 0;
  if (const auto* slacks = find(path))
    for (const Slack& s : *slacks) {
      if (s.offset >= end || s.offset > offset) break;
      before += s.size;
    }
  return offset + before;
}

namespace {

std::uint64_t real_offset(const std::vector<Slack>& slacks, std::uint64_t padded) {
  std::uint64_t before = 0;
  for (const Slack& s : slacks) {
    const std::uint64_t begin = s.offset + before;
    if (padded <= begin) break;
    if (padded < begin + s.size) return s.offset;
    before += s.size;
  }
  return padded - before;
}

}  // namespace

Span SlackTable::real(const SourceSet& sources, Span span) const {
  if (!span.valid() || by_path_.empty()) return span;
  const auto* slacks = find(sources[span.file].path());
  if (slacks == nullptr) return span;
  const std::uint64_t begin = real_offset(*slacks, span.offset);
  const std::uint64_t end = real_offset(*slacks, span.offset + span.length);
  return {span.file, static_cast<std::uint32_t>(end - begin), begin};
}

void SlackTable::make_real(const SourceSet& sources, Diagnostic& d) const {
  d.span = real(sources, d.span);
  for (auto& [span, text] : d.notes) span = real(sources, span);
  if (d.fix)
    for (TextEdit& e : d.fix->edits) e.span = real(sources, e.span);
}

}  // namespace deck::lsp
