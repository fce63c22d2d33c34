// What lint finds in the bad examples of the rules: rule, severity, place, text and fix, as
// example_findings.tsv has them. What a run found instead is written into the folder of the build,
// to be read and, where it is right, put in place of the record.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "lint/support.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

namespace fs = std::filesystem;

const std::string head = "# example\tfound\tseverity\tline:column\tat\tmessage\tfix\n";

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

/// The findings of one example, a line each. Names of temporary folders are left out.
std::string lines_of(const Rule& rule) {
  const Linted run =
      rule.stage == RuleStage::extra ? lint_geometry(rule.bad) : lint_example(rule.bad);
  const std::string folder = fs::path(run.deck->sources[0].path()).parent_path().string();
  std::string out;
  for (const Diagnostic& d : run.result.diagnostics) {
    const bool known = std::find(std::begin(of_the_model), std::end(of_the_model), d.rule) !=
                       std::end(of_the_model);
    if (known && d.rule != rule.id) continue;
    const bool placed = d.span.valid();
    const auto at =
        run.deck->sources[placed ? d.span.file : 0].position(placed ? d.span.offset : 0);
    std::string message = d.message;
    if (const auto found = folder.empty() ? message.npos : message.find(folder);
        found != message.npos)
      message.replace(found, folder.size(), "DIR");
    std::ostringstream line;
    line << id_text(rule.id) << '\t' << finding_name(d) << '\t' << to_string(d.severity) << '\t'
         << at.line << ':' << at.column << '\t'
         << cell(placed ? run.deck->sources.text(d.span).substr(0, 60) : "-") << '\t'
         << cell(message) << '\t' << cell(fix_text(run, d)) << '\n';
    out += line.str();
  }
  return out;
}

std::map<std::string, std::string> recorded() {
  std::map<std::string, std::string> out;
  std::ifstream in(source_dir() / "tests/lint/example_findings.tsv");
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with('#')) out[line.substr(0, line.find('\t'))] += line + "\n";
  return out;
}

TEST(ExampleFindings, AreThoseOfTheRecord) {
  auto record = recorded();
  std::string all = head;
  bool same = true;
  for (const Rule& rule : all_rules()) {
    if (rule.bad.empty() || rule.stage == RuleStage::gate) continue;
    const std::string found = lines_of(rule), wanted = record[std::string(id_text(rule.id))];
    EXPECT_EQ(found, wanted);
    same = same && found == wanted;
    all += found;
  }
  if (!same) std::ofstream(binary_dir() / "example_findings.tsv") << all;
}

}  // namespace
}  // namespace deck::test
