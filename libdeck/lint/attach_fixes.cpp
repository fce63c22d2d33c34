// Adds fixes to findings of the reader.
#include "lint/shared/fix.hpp"

#include <algorithm>

namespace deck::detail {
namespace {

Fix missing_end(const Deck& deck) {
  const std::string_view bytes = deck.sources[0].bytes();
  const bool crlf = bytes.size() > 1 && bytes.find("\r\n") != std::string_view::npos;
  const std::string eol = crlf ? "\r\n" : "\n";
  const bool open_line = !bytes.empty() && bytes.back() != '\n';
  Fix fix;
  fix.title = "append /END";
  // Not safe: it would make a deck that was cut off within a line look complete.
  fix.safe = !open_line;
  fix.edits.push_back({Span{0, 0, bytes.size()}, (open_line ? eol : "") + "/END" + eol});
  return fix;
}

/// Changes the first line for official solver builds: banner in the main file, no text before it.
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

/// Replaces each tab of the line by one blank, which keeps the columns that the solver sees.
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

/// True if the blanks at `span` start the line; removing them does not change its reading. Later
/// blanks can end the keyword or hide the id.
bool before_the_line(const Deck& deck, const Span& span) {
  const Source& source = deck.sources[span.file];
  return source.line_at(span.offset).data() == source.bytes().data() + span.offset;
}

constexpr std::string_view blanks = " \t\r";

/// Text of a line before and after a span.
std::pair<std::string_view, std::string_view> around(const Deck& deck, const Span& span) {
  const Source& source = deck.sources[span.file];
  const std::string_view line = source.line_at(span.offset);
  const auto at = static_cast<std::size_t>(source.bytes().data() + span.offset - line.data());
  return {line.substr(0, at), line.substr(std::min(line.size(), at + span.length))};
}

/// True if this cell of a comma-separated line must not be blank, because later cells would move:
/// blanks are separators, too.
bool keeps_cells_apart(const Deck& deck, const Span& span) {
  const auto [before, behind] = around(deck, span);
  if (before.find(',') == before.npos && behind.find(',') == behind.npos) return false;
  const auto left = before.find_last_not_of(blanks), right = behind.find_first_not_of(blanks);
  if (right == behind.npos) return false;
  return behind[right] != ',' || (left != before.npos && before[left] != ',');
}

/// True if a fix blanks everything before a '/' or '#': the line would become a keyword or comment.
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
    if (keeps_cells_apart(deck, d.span)) return;
    // The solver ignores this text, so blanking it changes nothing. Text with other characters than
    // zeros may be a value in the wrong columns; that fix is not safe.
    const bool zeros = context.text(d.span).find_first_not_of("0.+- ") == std::string_view::npos;
    d.fix = Fix{"blank the text that is not read", zeros, {blank_edit(d.span)}};
  } else if (d.rule == RuleId::DK030) {
    d.fix = remove_line(deck, d.span, false, "delete the extra line");
  } else if (d.rule == RuleId::DK091) {
    // Another deck may need the line.
    d.fix = remove_line(deck, d.span, d.span.file == 0, "delete the unused suppression");
  }
}

}  // namespace

void attach_fix(const LintContext& context, Finding& d) {
  make_fix(context, d);
  if (d.fix && uncovers_a_mark(context.deck, *d.fix)) d.fix.reset();
}

}  // namespace deck::detail
