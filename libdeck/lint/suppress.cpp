// Finds the comments that suppress findings and notes which were used.
#include "lint/suppress.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "lint/context.hpp"

namespace deck::detail {
namespace {

constexpr std::string_view marker = "decklint:";
constexpr std::uint64_t searched_at_once = 8 << 20;

/// Next place of the marker at or behind `from`; npos: none. Decks hold few colons, which are
/// looked for first. Pages of a mapped file that were looked through are given back.
std::uint64_t next_marker(const Source& source, std::uint64_t from) {
  const std::string_view bytes = source.bytes();
  constexpr std::size_t before = marker.size() - 1;
  for (std::uint64_t at = from; at < bytes.size();) {
    const std::uint64_t stop =
        std::min<std::uint64_t>((at / searched_at_once + 1) * searched_at_once, bytes.size());
    while (at < stop) {
      const void* const hit = std::memchr(bytes.data() + at, ':', stop - at);
      if (hit == nullptr) break;
      const auto colon = static_cast<std::uint64_t>(static_cast<const char*>(hit) - bytes.data());
      if (colon >= from + before && bytes.substr(colon - before, marker.size()) == marker)
        return colon - before;
      at = colon + 1;
    }
    source.release(stop - 1 - (stop - 1) % searched_at_once, stop);
    at = stop;
  }
  return std::string_view::npos;
}

/// "ignore[DK1,DK203] reason=text" behind the marker; false: not understood.
bool parse(std::string_view text, Suppression& out) {
  text = trim(text);
  if (text.starts_with("ignore-file")) {
    out.whole_file = true;
    text.remove_prefix(11);
  } else if (text.starts_with("ignore")) {
    text.remove_prefix(6);
  } else {
    return false;
  }
  if (!text.starts_with('[')) return false;
  const auto close = text.find(']');
  if (close == std::string_view::npos) return false;
  std::string_view list = text.substr(1, close - 1);
  while (!list.empty()) {
    const auto comma = std::min(list.find(','), list.size());
    const std::string_view rule = trim(list.substr(0, comma));
    if (rule.empty()) return false;
    out.rules.emplace_back(rule);
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  if (out.rules.empty()) return false;
  text = trim(text.substr(close + 1));
  if (text.starts_with("reason=")) out.reason = std::string(trim(text.substr(7)));
  return true;
}

}  // namespace

std::vector<Suppression> find_suppressions(const Deck& deck, const BlockIndex& index,
                                           Reporter& reporter) {
  std::vector<Suppression> out;
  const Rule& no_reason = rule_of(RuleId::DK090);
  const Rule& unknown = rule_of(RuleId::DK092);
  const Rule& malformed = rule_of(RuleId::DK093);
  for (std::uint32_t file = 0; file < deck.sources.size(); ++file) {
    const Source& source = deck.sources[file];
    const std::string_view bytes = source.bytes();
    for (std::uint64_t at = 0; at < bytes.size();) {
      const std::uint64_t offset = next_marker(source, at);
      if (offset == std::string_view::npos) break;
      const auto before = offset == 0 ? std::string_view::npos : bytes.rfind('\n', offset - 1);
      const std::uint64_t begin = before == std::string_view::npos ? 0 : before + 1;
      const std::uint64_t stop = std::min<std::uint64_t>(bytes.find('\n', offset), bytes.size());
      at = stop + 1;
      const bool comment = bytes[begin] == '#' || bytes[begin] == '$';
      if (!comment || !trim(bytes.substr(begin + 1, offset - begin - 1)).empty()) continue;
      Suppression s;
      s.file = file;
      const std::string_view line = trim(bytes.substr(begin, stop - begin));
      s.span = {file, static_cast<std::uint32_t>(line.size()), begin};
      if (!parse(bytes.substr(offset + marker.size(), stop - offset - marker.size()), s)) {
        reporter.report(malformed, s.span, "this suppression comment cannot be read");
        continue;
      }
      for (const std::string& rule : s.rules)
        if (!known_selector(rule))
          reporter.report(unknown, s.span, "no rule is called '" + rule + "'");
      if (s.reason.empty()) {
        reporter.report(no_reason, s.span, "the suppression gives no reason and has no effect");
        continue;
      }
      if (s.whole_file) {
        if (!index.before_first_header(file, begin)) {
          reporter.report(malformed, s.span,
                          "ignore-file must stand above the first keyword of its file");
          continue;
        }
      } else {
        s.block = index.next_header_after_comments(file, begin);
        if (s.block < 0) s.block = index.find(file, begin);
      }
      out.push_back(std::move(s));
    }
  }
  return out;
}

Suppression* covering(std::vector<Suppression>& suppressions, const BlockIndex& index,
                      const Diagnostic& d) {
  if (suppressions.empty() || !d.span.valid() || id_number(d.rule) / 10 == 9) return nullptr;
  const std::int64_t block = index.find(d.span.file, d.span.offset);
  for (Suppression& s : suppressions) {
    const bool place = s.whole_file ? s.file == d.span.file : s.block >= 0 && s.block == block;
    if (!place) continue;
    for (const std::string& rule : s.rules)
      if (selects(rule, d.rule)) return &s;
  }
  return nullptr;
}

}  // namespace deck::detail
