// Findings for forges: workflow commands of GitHub Actions, a Code Quality report of GitLab, JUnit
// XML. Of JUnit: a suite for each deck, a case for what was found or could not be read; only errors
// are failures. The names of cases hold no lines, so that a server knows them again after an edit
// elsewhere.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "base/shared/escape.hpp"
#include "report/shared/diagnostics.hpp"
#include "report/shared/json.hpp"

namespace deck {

std::string lint_github(const std::vector<LintedDeck>& decks, const std::string& source_root) {
  std::vector<std::pair<const LintedDeck*, const Diagnostic*>> found;
  const detail::SourceRoot root(source_root);
  // `more`: further properties of the command
  const auto command = [&](const char* level, std::string_view file, const std::string& more,
                           std::string_view text) {
    return fmt::format("::{} file={},{}::{}\n", level, workflow_property(root.place(file)), more,
                       workflow_text(text));
  };
  std::string out, leads, notices, tails;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) {
      out += command("error", deck.path, "title=deck", deck.error);
      continue;
    }
    for (const Diagnostic& d : deck.result->diagnostics) found.emplace_back(&deck, &d);
    const auto coverage = detail::coverage_of(deck);
    if (!coverage) continue;
    const std::string lead = coverage_lead(*coverage), tail = coverage_tail(*coverage);
    if (!lead.empty()) leads += command("warning", deck.path, "title=not examined", lead + tail);
    if (lead.empty() && !tail.empty())
      tails += command("notice", deck.path, "title=not examined", tail.substr(1));
  }
  // Only the first annotations of a step are shown.
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.second->severity < b.second->severity;
  });
  for (const auto& [deck, d] : found) {
    const bool remark = d->severity == Severity::info;
    const detail::Place at = detail::place_of(*deck, d->span);
    (remark ? notices : out) += command(remark ? "notice" : to_string(d->severity), at.file,
                                        fmt::format("line={},col={},endColumn={},title={}", at.line,
                                                    at.column, at.end_column, finding_name(*d)),
                                        d->message + ". " + detail::details(*d));
  }
  return out + leads + notices + tails;
}

std::string lint_gitlab(const std::vector<LintedDeck>& decks, const std::string& source_root) {
  std::string out;
  JsonWriter json(out);
  json.begin_array();
  std::map<std::string, int> seen;
  const detail::SourceRoot root(source_root);
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    for (std::size_t i = 0; i < deck.result->diagnostics.size(); ++i) {
      const Diagnostic& d = deck.result->diagnostics[i];
      const detail::Place at = detail::place_of(deck, d.span);
      // Fingerprints must be unique in a report; equal findings get a number.
      std::string print = deck.result->fingerprints[i];
      if (const int n = seen[print]++; n > 0) print += "-" + std::to_string(n);
      static constexpr const char* severities[] = {"major", "minor", "info"};
      json.begin_object().field("description", d.message + ". " + detail::details(d));
      json.field("check_name", finding_name(d)).field("fingerprint", print);
      json.field("severity", severities[static_cast<std::size_t>(d.severity)]);
      json.key("location").begin_object().field("path", root.place(at.file));
      json.key("lines").begin_object(true).field("begin", at.line).end_object();
      json.end_object().end_object();
    }
  }
  json.end_array();
  if (out.back() != '\n') out += '\n';
  return out;
}

namespace {

/// "DK171 /INTER/TYPE7/31", and "... (2)" for the second of a name in a file.
std::string case_name(const Diagnostic& d, const std::string& file,
                      std::map<std::string, int>& seen) {
  std::string name = finding_name(d);
  if (!d.keyword.empty()) name += " " + d.keyword;
  if (!d.keyword.empty() && d.id != 0) name += fmt::format("/{}", d.id);
  const int number = ++seen[file + '\n' + name];
  return number == 1 ? name : fmt::format("{} ({})", name, number);
}

}  // namespace

std::string lint_junit(const std::vector<LintedDeck>& decks) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"deck lint\">\n";
  for (const LintedDeck& deck : decks) {
    const std::string path = xml_text(deck.path);
    if (deck.result == nullptr) {
      out += fmt::format(
          "  <testsuite name=\"{0}\" tests=\"1\" failures=\"0\" errors=\"1\">\n"
          "    <testcase name=\"read\" classname=\"{0}\"><error message=\"{1}\"/></testcase>\n"
          "  </testsuite>\n",
          path, xml_text(deck.error));
      continue;
    }
    const std::vector<Diagnostic>& found = deck.result->diagnostics;
    std::string left_out;
    if (const auto coverage = detail::coverage_of(deck))
      left_out = coverage_lead(*coverage) + coverage_tail(*coverage);
    const int skipped = left_out.empty() ? 0 : 1;
    const auto failures = std::count_if(found.begin(), found.end(), [](const Diagnostic& d) {
      return d.severity == Severity::error;
    });
    out += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n",
        path, std::max<std::size_t>(1, found.size()) + static_cast<std::size_t>(skipped), failures,
        skipped);
    if (found.empty()) out += fmt::format("    <testcase name=\"lint\" classname=\"{}\"/>\n", path);
    if (skipped > 0)
      out += fmt::format(
          "    <testcase name=\"not examined\" classname=\"{}\"><skipped message=\"{}\"/>"
          "</testcase>\n",
          path, xml_text(left_out.substr(left_out.find_first_not_of(' '))));
    std::map<std::string, int> seen;
    for (const Diagnostic& d : found) {
      const detail::Place at = detail::place_of(deck, d.span);
      out += fmt::format("    <testcase name=\"{0}\" classname=\"{1}\" file=\"{1}\" line=\"{2}\">",
                         xml_text(case_name(d, at.file, seen)), xml_text(at.file), at.line);
      const std::string body =
          fmt::format("{}:{}:{}\n{}", at.file, at.line, at.column, detail::details(d));
      if (d.severity != Severity::error)
        out += fmt::format(
            "<system-out>{}</system-out>",
            xml_text(fmt::format("{}: {}\n{}", to_string(d.severity), d.message, body)));
      else
        out += fmt::format("<failure type=\"error\" message=\"{}\">{}</failure>",
                           xml_text(d.message), xml_text(body));
      out += "</testcase>\n";
    }
    out += "  </testsuite>\n";
  }
  return out + "</testsuites>\n";
}

}  // namespace deck
