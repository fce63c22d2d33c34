// Adds the edits that mend findings of the reader.
#include "lint/shared/fix.hpp"

#include <algorithm>

#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace {

Fix missing_end(const Deck& deck) {
  const std::string_view bytes = deck.sources[0].bytes();
  const bool crlf = bytes.size() > 1 && bytes.find("\r\n") != std::string_view::npos;
  const std::string eol = crlf ? "\r\n" : "\n";
  const bool open_line = !bytes.empty() && bytes.back() != '\n';
  Fix fix;
  fix.title = "append /END";
  // A deck that was cut off amid a line would be made to look whole: that is for a person to
  // decide.
  fix.safe = !open_line;
  fix.edits.push_back({Span{0, 0, bytes.size()}, (open_line ? eol : "") + "/END" + eol});
  return fix;
}

/// The first line as official builds want it: nothing in front of the banner, and a banner in the
/// main file.
std::optional<Fix> first_line(const Deck& deck, std::uint32_t file) {
  constexpr std::string_view mark = "\xef\xbb\xbf", banner = "#RADIOSS STARTER";
  std::string_view bytes = deck.sources[file].bytes();
  const bool marked = bytes.starts_with(mark);
  if (marked) bytes.remove_prefix(mark.size());
  const bool bare = file == 0 && !trim(bytes.substr(0, 200)).starts_with(banner);
  if (!marked && !bare) return std::nullopt;
  const std::string_view first = bytes.substr(0, bytes.find('\n'));
  const std::string eol = first.ends_with('\r') ? "\r\n" : "\n";
  return Fix{marked ? "remove the byte order mark" : "insert the banner",
             true,
             {{Span{file, marked ? 3u : 0u, 0}, bare ? std::string(banner) + eol : std::string()}}};
}

/// Every tab of the line becomes one blank: the columns stay where the reference solver sees them.
Fix tabs_to_blanks(const Deck& deck, const Span& span) {
  const Source& source = deck.sources[span.file];
  const std::string_view line = source.line_at(span.offset);
  const auto begin = static_cast<std::uint64_t>(line.data() - source.bytes().data());
  Fix fix;
  fix.title = "replace each tab by one blank, as the reference solver reads it";
  fix.safe = true;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '\t') fix.edits.push_back({Span{span.file, 1, begin + i}, " "});
  return fix;
}

Fix remove_line(const Deck& deck, const Span& span, bool safe, std::string title) {
  const Source& source = deck.sources[span.file];
  const std::string_view bytes = source.bytes();
  const std::string_view line = source.line_at(span.offset);
  const auto begin = static_cast<std::uint64_t>(line.data() - bytes.data());
  const auto nl = bytes.find('\n', begin);
  const std::uint64_t end = nl == std::string_view::npos ? bytes.size() : nl + 1;
  Fix fix;
  fix.title = std::move(title);
  fix.safe = safe;
  fix.edits.push_back({Span{span.file, static_cast<std::uint32_t>(end - begin), begin}, ""});
  return fix;
}

/// True if the blanks at `span` stand in front of the line: without them it is read as it was. A
/// blank further on may end the keyword or hide the id.
bool before_the_line(const Deck& deck, const Span& span) {
  const Source& source = deck.sources[span.file];
  return source.line_at(span.offset).data() == source.bytes().data() + span.offset;
}

constexpr std::string_view blanks = " \t\r";

/// A line in two: what stands in front of a span, and behind it.
std::pair<std::string_view, std::string_view> around(const Deck& deck, const Span& span) {
  const Source& source = deck.sources[span.file];
  const std::string_view line = source.line_at(span.offset);
  const auto at = static_cast<std::size_t>(source.bytes().data() + span.offset - line.data());
  return {line.substr(0, at), line.substr(std::min(line.size(), at + span.length))};
}

/// True for a cell of a line with commas that would be gone without its text, so that those behind
/// it moved: blanks part cells there, too.
bool holds_a_place(const Deck& deck, const Span& span) {
  const auto [before, behind] = around(deck, span);
  if (before.find(',') == before.npos && behind.find(',') == behind.npos) return false;
  const auto left = before.find_last_not_of(blanks), right = behind.find_first_not_of(blanks);
  if (right == behind.npos) return false;
  return behind[right] != ',' || (left != before.npos && before[left] != ',');
}

/// True where a fix blanks all that stands in front of a '/' or '#': the line would be a keyword or
/// a comment.
bool uncovers_a_mark(const Deck& deck, const Fix& fix) {
  return std::any_of(fix.edits.begin(), fix.edits.end(), [&](const TextEdit& e) {
    if (!e.span.valid() || e.text.empty() || e.text.find_first_not_of(' ') != e.text.npos)
      return false;
    const auto [before, behind] = around(deck, e.span);
    const auto next = behind.find_first_not_of(blanks);
    return before.find_first_not_of(blanks) == before.npos && next != behind.npos &&
           (behind[next] == '/' || behind[next] == '#');
  });
}

void make_fix(const LintContext& context, Finding& d) {
  if (d.fix) return;
  const Deck& deck = context.deck;
  if (d.rule == RuleId::DK010) {
    d.fix = missing_end(deck);
  } else if (!d.span.valid()) {
    return;
  } else if (d.rule == RuleId::DK033 || d.rule == RuleId::DK001) {
    d.fix = first_line(deck, d.span.file);
  } else if (d.rule == RuleId::DK052) {
    d.fix = Fix{"remove the blank", before_the_line(deck, d.span), {{d.span, ""}}};
  } else if (d.rule == RuleId::DK013) {
    d.fix = tabs_to_blanks(deck, d.span);
  } else if (d.rule == RuleId::DK012 || d.rule == RuleId::DK027 || d.rule == RuleId::DK028) {
    if (holds_a_place(deck, d.span)) return;
    // The reference solver drops this text, so blanking it changes nothing for it. Text that is not
    // just zeros may be a value in the wrong columns: that is for a person to decide.
    const bool zeros = context.text(d.span).find_first_not_of("0.+- ") == std::string_view::npos;
    d.fix = Fix{"blank the text that is not read", zeros, {blank_edit(d.span)}};
  } else if (d.rule == RuleId::DK030) {
    d.fix = remove_line(deck, d.span, false, "delete the extra line");
  } else if (d.rule == RuleId::DK091) {
    // Another deck may include the file and need it.
    d.fix = remove_line(deck, d.span, d.span.file == 0, "delete the unused suppression");
  }
}

}  // namespace

void attach_fix(const LintContext& context, Finding& d) {
  make_fix(context, d);
  if (d.fix && uncovers_a_mark(context.deck, *d.fix)) d.fix.reset();
}

}  // namespace deck::detail
