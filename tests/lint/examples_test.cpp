// Where lint finds the bad examples of the rules (DECK_RECORD=1 renews example_places.txt), and
// what it finds in cases of its own: rule, severity, message of the solver, place, text, notes and
// fix, as case_findings.tsv has them. What a run found instead is written into the folder of the
// build, to be read and, where it is right, put in place of the record.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "lint/support.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

namespace fs = std::filesystem;

const std::string head =
    "# example\tfound\tseverity\tsolver\tline:column\tat\tmessage\tnotes\tfix\n";

/// One line of a table: what would break it is written as an escape.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) >= 0x7f)
      out += "\\x" + std::string(1, "0123456789abcdef"[static_cast<unsigned char>(c) >> 4]) +
             std::string(1, "0123456789abcdef"[c & 15]);
    else
      out += c;
  }
  return out;
}

std::string fix_text(const Linted& run, const Diagnostic& d) {
  if (!d.fix) return "-";
  std::string out = d.fix->safe ? "safe: " : "unsafe: ";
  out += d.fix->title;
  for (const TextEdit& e : d.fix->edits)
    out += " ['" + std::string(run.deck->sources.text(e.span)) + "' -> '" + e.text + "']";
  return out;
}

/// What is found in nearly every example: it is about the model around them.
constexpr RuleId of_the_model[] = {RuleId::DK188, RuleId::DK601, RuleId::DK916, RuleId::DK918};

std::string place_text(const Linted& run, const Span& span) {
  if (!span.valid()) return "-";
  const auto at = run.deck->sources[span.file].position(span.offset);
  return std::to_string(at.line) + ":" + std::to_string(at.column);
}

/// The findings of a deck, a line each. Names of temporary folders are left out.
std::string lines_of(const std::string& name, const Linted& run) {
  const std::string folder = fs::path(run.deck->sources[0].path()).parent_path().string();
  std::string out;
  for (const Diagnostic& d : run.result.diagnostics) {
    const bool known = std::find(std::begin(of_the_model), std::end(of_the_model), d.rule) !=
                       std::end(of_the_model);
    if (known) continue;
    std::string message = d.message, notes, solver = "-";
    if (const auto found = folder.empty() ? message.npos : message.find(folder);
        found != message.npos)
      message.replace(found, folder.size(), "DIR");
    for (const auto& [span, note] : d.notes)
      notes += (notes.empty() ? "" : "; ") + place_text(run, span) + " " + note;
    if (d.reference)
      solver =
          std::string(to_string(d.reference->severity)) + " " + std::to_string(d.reference->number);
    std::ostringstream line;
    line << name << '\t' << finding_name(d) << '\t' << to_string(d.severity) << '\t' << solver
         << '\t' << place_text(run, d.span) << '\t'
         << cell(d.span.valid() ? run.deck->sources.text(d.span).substr(0, 60) : "-") << '\t'
         << cell(message) << '\t' << cell(notes.empty() ? "-" : notes) << '\t'
         << cell(fix_text(run, d)) << '\n';
    out += line.str();
  }
  return out;
}

/// A file of findings by the name of their deck.
class Record {
 public:
  explicit Record(std::string file) : file_(std::move(file)) {
    std::ifstream in(source_dir() / "tests/lint" / file_);
    for (std::string line; std::getline(in, line);)
      if (!line.starts_with('#')) wanted_[line.substr(0, line.find('\t'))] += line + "\n";
  }
  void expect(const std::string& name, const std::string& found) {
    const std::string& wanted = wanted_[name];
    EXPECT_EQ(found, wanted);
    same_ = same_ && found == wanted;
    all_ += found;
  }
  ~Record() {
    if (!same_) std::ofstream(binary_dir() / file_) << head << all_;
  }

 private:
  std::string file_, all_;
  std::map<std::string, std::string> wanted_;
  bool same_ = true;
};

/// Where the bad example of each rule is found: "rule line:column" in the order of the rules.
TEST(ExamplePlaces, AreThoseOfTheRecord) {
  std::string found;
  std::size_t width = 0;
  for (const Rule& rule : all_rules()) {
    if (rule.bad.empty() || rule.stage == RuleStage::gate) continue;
    const bool geometry = rule.stage == RuleStage::extra;
    const Linted run = geometry ? lint_geometry(rule.bad) : lint_example(rule.bad);
    std::string item(id_text(rule.id));
    for (const Diagnostic& d : run.result.diagnostics)
      if (d.rule == rule.id) item += " " + place_text(run, d.span);
    const bool breaks = width > 0 && width + item.size() > 96;
    if (width > 0) found += breaks ? ";\n" : "; ";
    width = (breaks ? 0 : width + 2) + item.size();
    found += item;
  }
  const auto path = source_dir() / "tests/lint/example_places.txt";
  std::ifstream in(path);
  const std::string wanted{std::istreambuf_iterator<char>(in), {}};
  if (found + "\n" != wanted && std::getenv("DECK_RECORD") != nullptr)
    std::ofstream(path) << found << '\n';
  else
    EXPECT_EQ(found + "\n", wanted);
}

/// "@move Z" puts the upper plate at that distance from the lower one.
std::string with_moves(std::string text) {
  for (auto at = text.find("@move "); at != text.npos; at = text.find("@move ")) {
    const auto end = std::min(text.find('\n', at), text.size());
    const double z = std::stod(text.substr(at + 6, end - at - 6));
    std::ostringstream card;
    card << "@/TRANSFORM/TRA/1 GR_NODE=2 TZ=" << z - 3;
    text.replace(at, end - at, card.str());
  }
  return text;
}

/// The cases of cases.txt: "== name" and the lines of an example.
std::vector<std::pair<std::string, std::string>> cases() {
  std::vector<std::pair<std::string, std::string>> out;
  std::ifstream in(source_dir() / "tests/lint/cases.txt");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("== "))
      out.emplace_back(line.substr(3), "");
    else if (!out.empty() && !line.starts_with("=="))
      out.back().second += line + "\n";
  }
  return out;
}

TEST(CaseFindings, AreThoseOfTheRecord) {
  Record record("case_findings.tsv");
  const auto all = cases();
  EXPECT_GT(all.size(), 50u);
  for (const auto& [name, text] : all)
    record.expect(name, lines_of(name, lint_geometry(with_moves(text))));
}

}  // namespace
}  // namespace deck::test
