// Expands the short examples of rule pages to decks.
#include "lint/shared/example.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <sstream>

#include "base/shared/embedded.hpp"
#include "base/shared/shown_text.hpp"
#include "deck/lint.hpp"
#include "text/shared/columns.hpp"
#include "text/shared/gzip.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

std::string render_at_line(std::string_view line, int version, const SchemaSet& schemas) {
  const auto parts = detail::words_of(line.substr(1));
  const std::string_view header = parts.empty() ? std::string_view() : parts[0];
  Values values;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto equal = parts[i].find('=');
    if (equal == std::string_view::npos) continue;
    values.emplace_back(parts[i].substr(0, equal), parts[i].substr(equal + 1));
  }
  const Schema* schema = schemas.match(header);
  if (schema == nullptr) return "# no schema for " + std::string(header) + "\n";
  const auto fallback = [&](const char* name, const char* value) {
    const auto given =
        std::any_of(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
    if (schema->find_field(name) != nullptr && !given) values.emplace_back(name, value);
  };
  if (schema->kind == "inter") {
    fallback("grnd_IDs", "2");
    fallback("surf_IDs", "2");
    fallback("surf_IDm", "1");
    fallback("line_IDs", "2");
    fallback("line_IDm", "1");
    fallback("Stfac", "1.0");
  }
  return render_card(*schema, header, version, values);
}

constexpr int usual_version = 2022;  // default version of examples

struct Parsed {
  int version = usual_version;
  bool bare = false, whole = false;
  std::vector<std::pair<std::string, std::string>> texts;  // file name ("": main), content
  std::vector<std::pair<std::string, int>> limits;
  std::vector<std::string> packed;  // files to store packed
};

Parsed parse(std::string_view example, const SchemaSet& schemas) {
  Parsed out;
  out.texts.emplace_back();
  while (!example.empty()) {
    const auto nl = std::min(example.find('\n'), example.size());
    const std::string_view line = example.substr(0, nl);
    const bool ended = nl < example.size();
    example.remove_prefix(std::min(nl + 1, example.size()));
    const auto parts = detail::words_of(line);
    const std::string_view first = parts.empty() ? std::string_view() : parts[0];
    const auto number = [&](std::size_t i) {
      int v = 0;
      if (i < parts.size()) std::from_chars(parts[i].data(), parts[i].data() + parts[i].size(), v);
      return v;
    };
    if (first == "@version")
      out.version = number(1);
    else if (first == "@bare")
      out.bare = true;
    else if (first == "@deck")
      out.whole = true;
    else if (first == "@file" && parts.size() > 1)
      out.texts.emplace_back(parts[1], "");
    else if (first == "@gzip" && parts.size() > 1)
      out.texts.emplace_back(out.packed.emplace_back(parts[1]), "");
    else if (first == "@limit" && parts.size() > 2)
      out.limits.emplace_back(parts[1], number(2));
    else if (first.starts_with("@/"))
      out.texts.back().second += render_at_line(line, out.version, schemas);
    else
      out.texts.back().second += std::string(line) + (ended ? "\n" : "");
  }
  return out;
}

}  // namespace

ExampleDeck example_deck(std::string_view example, const SchemaSet& schemas) {
  const Parsed p = parse(example, schemas);
  ExampleDeck out;
  out.limits = p.limits;
  for (std::size_t i = 1; i < p.texts.size(); ++i) {
    const auto& [name, text] = p.texts[i];
    const bool packed = std::find(p.packed.begin(), p.packed.end(), name) != p.packed.end();
    out.files.emplace_back(name, packed ? gzip(text) : text);
  }
  if (p.whole) {
    out.main = p.texts[0].second;
    return out;
  }
  std::string version = std::to_string(p.version);
  version.insert(0, 10 - std::min<std::size_t>(version.size(), 10), ' ');
  const std::string units = "                  kg                  mm                  ms\n";
  out.main = "#RADIOSS STARTER\n/BEGIN\nexample\n" + version + "         0\n" + units + units;
  if (!p.bare) out.main += detail::embedded_examples().front().text;  // two plates, a gap apart
  out.main += p.texts[0].second;
  if (!out.main.ends_with('\n')) out.main += '\n';
  out.main += "/END\n";
  return out;
}

std::string example_text(std::string_view example, const SchemaSet& schemas) {
  const Parsed p = parse(example, schemas);
  std::string out;
  // Differences between examples that the text does not show.
  if (p.version != usual_version) out += "--- input version " + std::to_string(p.version) + "\n";
  for (const auto& [name, limit] : p.limits)
    out += "--- " + name + " at most " + std::to_string(limit) + "\n";
  for (const auto& [name, text] : p.texts) {
    if (!name.empty()) out += "--- " + name + "\n";
    out += text;
    if (!out.empty() && out.back() != '\n') out += '\n';
  }
  return out;
}

namespace {

/// A line of an example, and the columns of the finding.
struct MarkedLine {
  std::string text;
  std::size_t first = 0, last = 0;
};

struct ExampleRun {
  LoadedDeck loaded;
  std::vector<Finding> found;
};

/// Findings of this rule in an example.
Result<ExampleRun> run_example(const Rule& rule, std::string_view text, const SchemaSet& schemas) {
  const ExampleDeck example = example_deck(text, schemas);
  if (!example.files.empty() || !example.limits.empty())
    return Error{Error::Code::config, "expected an example of one file, without limits"};
  auto deck = read_deck_text("example_0000.rad", example.main, schemas);
  if (!deck) return deck.error();
  LoadOptions how;
  how.schemas = &schemas;
  how.geometry = false;
  LoadedDeck loaded = LoadedDeck::from(std::move(*deck), how);
  LintOptions only;
  only.select = {std::string(id_text(rule.id))};
  std::vector<Finding> found = run_lint(loaded, only).findings;
  std::erase_if(found, [&](const Finding& d) { return d.rule != rule.id; });
  return ExampleRun{std::move(loaded), std::move(found)};
}

std::optional<MarkedLine> finding_in(const Rule& rule, const SchemaSet& schemas) {
  const auto run = run_example(rule, rule.bad, schemas);
  if (!run) return std::nullopt;
  for (const Finding& d : run->found) {
    if (!d.span.valid()) continue;
    const Source& source = run->loaded.deck().sources[d.span.file];
    const std::string_view line = source.line_at(d.span.offset);
    auto first = static_cast<std::size_t>(source.position(d.span.offset).column - 1);
    std::size_t last = std::min<std::size_t>(first + d.span.length, line.size());
    while (first + 1 < last && line[first] == ' ') ++first;
    while (last > first + 1 && line[last - 1] == ' ') --last;
    return MarkedLine{std::string(line), first, last};
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> broken_examples(const std::vector<RulePage>& pages) {
  std::vector<std::string> out;
  for (const RulePage& page : pages) {
    if (page.rule.bad.empty()) out.push_back(page.problem("id", "expected two examples"));
    for (const auto& [heading, text] : {std::pair(detail::heading::bad, &page.rule.bad),
                                        std::pair(detail::heading::good, &page.rule.good)}) {
      if (text->empty()) continue;
      const auto run = run_example(page.rule, *text, SchemaSet::built_in());
      const bool fires = run && !run->found.empty();
      if (run && fires == (text == &page.rule.bad)) continue;
      out.push_back(page.problem(std::string(heading),
                                 !run    ? run.error().message
                                 : fires ? "the rule reports this: " + run->found.front().message
                                         : "the rule does not report this"));
    }
  }
  return out;
}

std::string marked_example(const Rule& rule, const SchemaSet& schemas, std::size_t width) {
  const auto mark = finding_in(rule, schemas);
  if (!mark || mark->first >= mark->last) return {};
  std::vector<std::string> lines;
  for (std::istringstream in(example_text(rule.bad, schemas)); in;)
    std::getline(in, lines.emplace_back());
  const auto at = std::find(lines.begin(), lines.end(), mark->text);
  if (at == lines.end()) return {};
  // For a wide card: the columns up to the cell, without leading cells of ten columns.
  const std::size_t room = (width == 0 ? 1000 : std::max<std::size_t>(width, 24)) - 4;
  const std::size_t start = mark->last <= room ? 0 : (mark->last - room + 9) / 10 * 10;
  std::string out;
  const auto show = [&](const std::string& line) {
    std::string piece = line.size() > start ? line.substr(start, room) : std::string();
    piece.resize(piece.find_last_not_of(' ') + 1);
    if (line.size() > start + room && piece.size() > 2) piece.replace(piece.size() - 2, 2, " …");
    out += piece.empty() ? "  |\n" : (start > 0 ? "  … " : "  | ") + piece + "\n";
  };
  const auto is_header = [](const std::string& line) { return line.starts_with('/'); };
  auto header = std::find_if(std::reverse_iterator(at + 1), lines.rend(), is_header);
  if (header != lines.rend() && !is_header(*at)) out += "  | " + *header + "\n";
  std::string ruler;
  for (std::size_t column = 1; column <= std::max(at->size(), mark->last); ++column)
    ruler += ruler_mark(column);
  if (!is_header(*at)) show(ruler);
  if (at != lines.begin() && (at - 1)->starts_with('#')) show(*(at - 1));
  show(*at);
  show(std::string(mark->first, ' ') + std::string(mark->last - mark->first, '^'));
  return out;
}

}  // namespace deck
