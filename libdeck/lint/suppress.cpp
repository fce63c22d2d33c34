// Finds comments that suppress findings, and notes which were used.
#include "lint/suppress.hpp"

#include <algorithm>

#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Parses "ignore[DK1,DK201:Istf] reason=text" after the marker; false: invalid.
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
  for (const std::string_view rule : parts_of(text.substr(1, close - 1), ',')) {
    if (trim(rule).empty()) return false;
    out.rules.push_back(to_selector(trim(rule)));
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
    const std::string_view bytes = deck.sources[file].bytes();
    std::uint64_t at = 0;  // end of the previous line
    for (const std::uint64_t offset : deck.lint_markers[file].offsets) {
      if (offset < at) continue;
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
      if (!parse(bytes.substr(offset + lint_marker.size(), stop - offset - lint_marker.size()),
                 s)) {
        reporter.report(malformed, s.span, "this suppression comment cannot be read");
        continue;
      }
      for (const std::string& rule : s.rules) {
        const Rule* const known = find_rule(rule);
        if (!known_selector(rule))
          reporter.report(unknown, s.span, "no rule is called '" + rule + "'");
        else if (known != nullptr && is_gate_rule(known->id))
          reporter.report(unknown, s.span,
                          "no comment switches off '" + rule + "', a rule of the gate");
        else if (std::string now = renamed_selector(rule); !now.empty())
          reporter.report(unknown, s.span, std::move(now)).severity = Severity::info;
      }
      if (s.reason.empty()) {
        reporter.report(no_reason, s.span, "the suppression gives no reason and has no effect");
        continue;
      }
      if (s.whole_file) {
        if (!index.before_first_header(file, begin)) {
          reporter.report(malformed, s.span,
                          "ignore-file must be above the first keyword of its file");
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
                      const Finding& d) {
  if (suppressions.empty() || !d.span.valid() || id_number(d.rule) / 10 == 9) return nullptr;
  const std::int64_t block = index.find(d.span.file, d.span.offset);
  for (Suppression& s : suppressions) {
    const bool place = s.whole_file ? s.file == d.span.file : s.block >= 0 && s.block == block;
    if (!place) continue;
    for (const std::string& rule : s.rules)
      if (selects(rule, d.rule, d.field)) return &s;
  }
  return nullptr;
}

}  // namespace deck::detail
