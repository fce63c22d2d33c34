// Findings as SARIF 2.1.0, with rules, fixes and suppressions.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report/shared/diagnostics.hpp"
#include "report/shared/json.hpp"

namespace deck {
namespace {

const char* level_of(Severity severity) {
  return severity == Severity::info ? "note" : to_string(severity);
}

constexpr std::string_view root_id = "%SRCROOT%";

/// Percent-encodes what may not stand in a URI reference.
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
        for (std::size_t i = 0; i < deck.result->diagnostics.size(); ++i)
          result(deck, deck.result->diagnostics[i], deck.result->fingerprints[i]);
    json_.end_array().end_object().end_array().end_object();
  }

 private:
  /// An object of one member on a line.
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

  /// A file below the root by its place there, so that the log means the same on another machine.
  void artifact(std::string_view file) {
    const std::string place = root_.place(file);
    json_.key("artifactLocation").begin_object(true).field("uri", uri_of(place));
    if (!root_.path().empty() && !place.starts_with('/') && place != "-")
      json_.field("uriBaseId", root_id);
    json_.end_object();
  }

  /// `deleted`: what a fix takes out, which may end on another line.
  void region(const LintedDeck& deck, const Span& span, bool deleted = false) {
    const Source& source = deck.deck->sources[span.file];
    const detail::Place at = detail::place_of(deck, span);
    // SARIF columns count characters, spans count bytes.
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

  /// Of a finding, or of a note with its message.
  void location(const LintedDeck& deck, const Diagnostic* d, const Span& span,
                const std::string* message) {
    const detail::Place at = detail::place_of(deck, span);
    json_.begin_object();
    if (message != nullptr) text("message", *message);
    json_.key("physicalLocation").begin_object();
    artifact(at.file);
    if (at.known)
      region(deck, span);
    else  // code scanning shows nothing without a line
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

  void result(const LintedDeck& deck, const Diagnostic& d, const std::string& print) {
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

}  // namespace deck
