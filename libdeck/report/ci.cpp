// Findings for build servers: SARIF 2.1.0 with rules, fixes and suppressions; workflow commands of
// GitHub Actions; Code Quality report of GitLab; JUnit XML. JUnit: one suite per deck, one case per
// finding or unreadable deck; only errors are failures. Names of cases have no line numbers, so
// that servers recognise them after edits elsewhere.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "base/shared/shown_text.hpp"
#include "report/shared/findings.hpp"
#include "report/shared/json.hpp"

namespace deck {

namespace {

const char* level_of(Severity severity) {
  return severity == Severity::info ? "note" : to_string(severity);
}

constexpr std::string_view root_id = "%SRCROOT%";

/// Percent-encodes characters that a URI reference cannot have.
std::string uri_of(std::string_view path) {
  std::string out = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const auto u = static_cast<unsigned char>(c);
    const bool plain = (u >= 'a' && u <= 'z') || (u >= 'A' && u <= 'Z') || (u >= '0' && u <= '9') ||
                       std::string_view("-._~/!$&'()*+,;=@").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", u);
  }
  return out;
}

class Sarif {
 public:
  Sarif(JsonWriter& json, const SchemaSet& schemas, const std::string& source_root)
      : json_(json), schemas_(schemas), root_(source_root) {}

  void write(const std::vector<LintedDeck>& decks) {
    json_.begin_object();
    json_.field("$schema", "https://json.schemastore.org/sarif-2.1.0.json");
    json_.field("version", "2.1.0").key("runs").begin_array().begin_object();
    tool();
    json_.field("columnKind", "unicodeCodePoints");
    if (!root_.path().empty()) source_root();
    invocation(decks);
    json_.key("results").begin_array();
    for (const LintedDeck& deck : decks)
      if (deck.result != nullptr)
        for (std::size_t i = 0; i < deck.result->findings.size(); ++i)
          result(deck, deck.result->findings[i], deck.result->fingerprints[i]);
    json_.end_array().end_object().end_array().end_object();
  }

 private:
  /// Writes an object with one member on one line.
  template <class T>
  void object(std::string_view name, std::string_view member, const T& value) {
    json_.key(name).begin_object(true).field(member, value).end_object();
  }
  void text(std::string_view name, std::string_view content) { object(name, "text", content); }

  void source_root() {
    json_.key("originalUriBaseIds").begin_object();
    object(root_id, "uri", uri_of(root_.path() + (root_.path().ends_with('/') ? "" : "/")));
    json_.end_object();
  }

  void tool() {
    json_.key("tool").begin_object().key("driver").begin_object();
    json_.field("name", "deck").field("version", library_version());
    json_.key("rules").begin_array();
    for (const Rule& r : all_rules()) {
      json_.begin_object();
      json_.field("id", id_text(r.id));
      text("shortDescription", r.title);
      text("fullDescription", r.problem);
      text("help", explain_rule(r, schemas_));
      object("defaultConfiguration", "level", level_of(r.severity()));
      json_.key("properties").begin_object(true).key("tags").begin_array(true);
      json_.value(family_of(r.id)).end_array().end_object();
      json_.end_object();
    }
    json_.end_array().end_object().end_object();
  }

  void invocation(const std::vector<LintedDeck>& decks) {
    const bool good = std::all_of(decks.begin(), decks.end(),
                                  [](const LintedDeck& d) { return d.result != nullptr; });
    json_.key("invocations").begin_array().begin_object();
    json_.field("executionSuccessful", good);
    json_.key("toolExecutionNotifications").begin_array();
    for (const LintedDeck& deck : decks) {
      if (deck.result == nullptr)
        notification("error", deck.error);
      else
        left_out(deck);
    }
    json_.end_array().end_object().end_array();
  }

  void left_out(const LintedDeck& deck) {
    if (const auto coverage = detail::coverage_of(deck))
      if (const std::string lead = coverage_lead(*coverage); !lead.empty())
        notification("warning", deck.path + ": " + lead);
    for (const NotChecked& n : deck.result->not_checked)
      notification("note", deck.path + ": not checked: " + n.what + ": " + n.why);
  }

  void notification(std::string_view level, const std::string& message) {
    json_.begin_object().field("level", level);
    text("message", message);
    json_.end_object();
  }

  /// File relative to the root, so that the log is valid on other machines.
  void artifact(std::string_view file) {
    const std::string place = root_.place(file);
    json_.key("artifactLocation").begin_object(true).field("uri", uri_of(place));
    if (!root_.path().empty() && !place.starts_with('/') && place != "-")
      json_.field("uriBaseId", root_id);
    json_.end_object();
  }

  /// `deleted`: text that a fix removes; it may end on another line.
  void region(const LintedDeck& deck, const Span& span, bool deleted = false) {
    const Source& source = deck.deck->sources[span.file];
    const detail::Place at = detail::place_of(deck, span);
    // SARIF columns count characters; spans count bytes.
    const auto characters = [&](std::uint64_t offset, std::uint64_t column) {
      const auto before = source.line_at(offset).substr(0, static_cast<std::size_t>(column) - 1);
      return column -
             static_cast<std::uint64_t>(std::count_if(before.begin(), before.end(), [](char c) {
               return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
             }));
    };
    json_.key(deleted ? "deletedRegion" : "region").begin_object(true);
    json_.field("startLine", at.line).field("startColumn", characters(span.offset, at.column));
    const std::uint64_t last = span.offset + (deleted ? span.length : 0);
    const Position end = source.position(last);
    if (deleted) json_.field("endLine", end.line);
    json_.field("endColumn", characters(last, deleted ? end.column : at.end_column)).end_object();
  }

  /// Location of a finding, or of a note with its message.
  void location(const LintedDeck& deck, const Finding* d, const Span& span,
                const std::string* message) {
    const detail::Place at = detail::place_of(deck, span);
    json_.begin_object();
    if (message != nullptr) text("message", *message);
    json_.key("physicalLocation").begin_object();
    artifact(at.file);
    if (at.known)
      region(deck, span);
    else  // GitHub code scanning hides results without a line
      object("region", "startLine", at.line);
    json_.end_object();
    if (d != nullptr && !d->keyword.empty()) {
      json_.key("logicalLocations").begin_array().begin_object(true);
      json_.field("fullyQualifiedName", d->keyword + "/" + std::to_string(d->id));
      json_.field("kind", "object").end_object().end_array();
    }
    json_.end_object();
  }

  void fixes(const LintedDeck& deck, const Fix& fix) {
    std::map<std::uint32_t, std::vector<const TextEdit*>> by_file;
    for (const TextEdit& e : fix.edits) by_file[e.span.file].push_back(&e);
    json_.key("fixes").begin_array().begin_object();
    text("description", fix.title);
    json_.key("artifactChanges").begin_array();
    for (const auto& [file, edits] : by_file) {
      json_.begin_object();
      artifact(deck.deck->sources[file].path());
      json_.key("replacements").begin_array();
      for (const TextEdit* e : edits) {
        json_.begin_object();
        region(deck, e->span, true);
        text("insertedContent", e->text);
        json_.end_object();
      }
      json_.end_array().end_object();
    }
    json_.end_array().end_object().end_array();
  }

  void result(const LintedDeck& deck, const Finding& d, const std::string& print) {
    json_.begin_object();
    json_.field("ruleId", id_text(d.rule));
    json_.field("ruleIndex", static_cast<std::int64_t>(&rule_of(d.rule) - all_rules().data()));
    json_.field("level", level_of(d.severity));
    const std::string more = detail::details(d);
    text("message", d.message + "." + (more.empty() ? "" : " " + more));
    json_.key("locations").begin_array();
    location(deck, &d, d.span, nullptr);
    json_.end_array();
    if (!d.notes.empty()) {
      json_.key("relatedLocations").begin_array();
      for (const auto& [span, message] : d.notes) location(deck, nullptr, span, &message);
      json_.end_array();
    }
    if (!d.field.empty()) object("properties", "field", d.field);
    object("partialFingerprints", "deckFinding/v1", print);
    if (d.fix && d.fix->safe) fixes(deck, *d.fix);
    json_.end_object();
  }

  JsonWriter& json_;
  const SchemaSet& schemas_;
  const detail::SourceRoot root_;
};

}  // namespace

std::string lint_sarif(const std::vector<LintedDeck>& decks, const SchemaSet& schemas,
                       const std::string& source_root) {
  std::string out;
  JsonWriter json(out);
  Sarif(json, schemas, source_root).write(decks);
  if (out.back() != '\n') out += '\n';
  return out;
}

std::string lint_github(const std::vector<LintedDeck>& decks, const std::string& source_root) {
  std::vector<std::pair<const LintedDeck*, const Finding*>> found;
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
    for (const Finding& d : deck.result->findings) found.emplace_back(&deck, &d);
    const auto coverage = detail::coverage_of(deck);
    if (!coverage) continue;
    const std::string lead = coverage_lead(*coverage), tail = coverage_tail(*coverage);
    if (!lead.empty()) leads += command("warning", deck.path, "title=not examined", lead + tail);
    if (lead.empty() && !tail.empty())
      tails += command("notice", deck.path, "title=not examined", tail.substr(1));
  }
  // GitHub shows only the first annotations of a step.
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
    for (std::size_t i = 0; i < deck.result->findings.size(); ++i) {
      const Finding& d = deck.result->findings[i];
      const detail::Place at = detail::place_of(deck, d.span);
      // Fingerprints must be unique per report: equal findings get a number.
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

/// "DK171 /INTER/TYPE7/31"; "... (2)" for the second case of that name in a file.
std::string case_name(const Finding& d, const std::string& file, std::map<std::string, int>& seen) {
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
    const std::vector<Finding>& found = deck.result->findings;
    std::string left_out;
    if (const auto coverage = detail::coverage_of(deck))
      left_out = coverage_lead(*coverage) + coverage_tail(*coverage);
    const int skipped = left_out.empty() ? 0 : 1;
    const auto failures = std::count_if(
        found.begin(), found.end(), [](const Finding& d) { return d.severity == Severity::error; });
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
    for (const Finding& d : found) {
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
