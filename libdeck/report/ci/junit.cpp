// Findings as JUnit XML: a suite for each deck, a case for what was found or could not be read.
// Only errors are failures. The names of cases hold no lines, so that a server knows them again
// after an edit elsewhere.
#include <map>

#include "base/shared/escape.hpp"
#include "report/diagnostics_common.hpp"

namespace deck {
namespace {

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + xml_text(value) + "\"";
}

/// "DK171 /INTER/TYPE7/31", and "... (2)" for the second of a name in a file.
std::string case_name(const Diagnostic& d, const std::string& file,
                      std::map<std::string, int>& seen) {
  std::string name = finding_name(d);
  if (!d.keyword.empty()) {
    name += " " + d.keyword;
    if (d.id != 0) name += "/" + std::to_string(d.id);
  }
  const int number = ++seen[file + '\n' + name];
  return number == 1 ? name : name + " (" + std::to_string(number) + ")";
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
    std::string left_out;
    if (const auto coverage = detail::coverage_of(deck))
      left_out = coverage_lead(*coverage) + coverage_tail(*coverage);
    const std::size_t skipped = left_out.empty() ? 0 : 1;
    const std::size_t count = (r.diagnostics.empty() ? 1 : r.diagnostics.size()) + skipped;
    std::size_t failures = 0;
    for (const Diagnostic& d : r.diagnostics) failures += d.severity == Severity::error;
    out += "  <testsuite" + attribute("name", deck.path) + " tests=\"" + std::to_string(count) +
           "\" failures=\"" + std::to_string(failures) + "\" errors=\"0\" skipped=\"" +
           std::to_string(skipped) + "\">\n";
    if (r.diagnostics.empty())
      out += "    <testcase name=\"lint\"" + attribute("classname", deck.path) + "/>\n";
    if (skipped > 0)
      out += "    <testcase name=\"not examined\"" + attribute("classname", deck.path) +
             "><skipped" + attribute("message", left_out.substr(left_out.find_first_not_of(' '))) +
             "/></testcase>\n";
    std::map<std::string, int> seen;
    for (const Diagnostic& d : r.diagnostics) {
      const detail::Place at = detail::place_of(deck, d.span);
      const std::string where =
          at.file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
      out += "    <testcase" + attribute("name", case_name(d, at.file, seen)) +
             attribute("classname", at.file) + attribute("file", at.file) + " line=\"" +
             std::to_string(at.line) + "\">";
      const std::string body = where + "\n" + detail::details(d);
      if (d.severity != Severity::error)
        out += "<system-out>" +
               xml_text(std::string(to_string(d.severity)) + ": " + d.message + "\n" + body) +
               "</system-out>";
      else
        out += "<failure" + attribute("type", to_string(d.severity)) +
               attribute("message", d.message) + ">" + xml_text(body) + "</failure>";
      out += "</testcase>\n";
    }
    out += "  </testsuite>\n";
  }
  return out + "</testsuites>\n";
}

}  // namespace deck
