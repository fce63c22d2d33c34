#include "report/diagnostics_common.hpp"

namespace deck {
namespace {

/// Text for XML 1.0: markup escaped, control characters and bytes that are no UTF-8 replaced.
std::string xml(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\n')
      out += "&#10;";
    else if (c < 0x20 || c == 0x7f)
      out += ' ';
    else if (c < 0x80)
      out += text[i];
    else {
      // Latin-1 decks are common; their bytes become the characters they mean.
      const std::size_t n = c >= 0xf0 ? 4 : c >= 0xe0 ? 3 : c >= 0xc2 ? 2 : 0;
      bool good = n > 1 && c < 0xf5 && i + n <= text.size();
      for (std::size_t k = 1; good && k < n; ++k)
        good = (static_cast<unsigned char>(text[i + k]) & 0xc0) == 0x80;
      if (good) {
        out += text.substr(i, n);
        i += n - 1;
      } else {
        out += static_cast<char>(0xc0 | (c >> 6));
        out += static_cast<char>(0x80 | (c & 0x3f));
      }
    }
  }
  return out;
}

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + xml(value) + "\"";
}

}  // namespace

std::string lint_junit(const std::vector<LintedDeck>& decks) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"deck lint\">\n";
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) {
      out += "  <testsuite" + attribute("name", deck.path) +
             " tests=\"1\" failures=\"0\" errors=\"1\">\n    <testcase name=\"read\"" +
             attribute("classname", deck.path) + "><error" + attribute("message", deck.error) +
             "/></testcase>\n  </testsuite>\n";
      continue;
    }
    const LintResult& r = *deck.result;
    const std::size_t count = r.diagnostics.empty() ? 1 : r.diagnostics.size();
    std::size_t failures = 0;
    for (const Diagnostic& d : r.diagnostics) failures += d.severity != Severity::info;
    out += "  <testsuite" + attribute("name", deck.path) + " tests=\"" + std::to_string(count) +
           "\" failures=\"" + std::to_string(failures) + "\" errors=\"0\">\n";
    if (r.diagnostics.empty())
      out += "    <testcase name=\"lint\"" + attribute("classname", deck.path) + "/>\n";
    for (const Diagnostic& d : r.diagnostics) {
      const detail::Place at = detail::place_of(deck, d.span);
      const std::string where =
          at.file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
      out += "    <testcase" + attribute("name", std::string(d.rule) + " " + where) +
             attribute("classname", at.file) + attribute("file", at.file) + " line=\"" +
             std::to_string(at.line) + "\">";
      const std::string body = where + "\n" + detail::details(d);
      if (d.severity == Severity::info)
        out += "<system-out>" + xml(d.message + "\n" + body) + "</system-out>";
      else
        out += "<failure" + attribute("type", detail::severity_name(d.severity)) +
               attribute("message", d.message) + ">" + xml(body) + "</failure>";
      out += "</testcase>\n";
    }
    out += "  </testsuite>\n";
  }
  return out + "</testsuites>\n";
}

}  // namespace deck
