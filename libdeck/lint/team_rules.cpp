// Reads the rule pages of a team from a directory.
#include <algorithm>
#include <filesystem>
#include <set>

#include "base/shared/shown_text.hpp"
#include "lint/rule_pages.hpp"
#include "lint/shared/config.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_page_bytes = 64 << 10;

Error refused(std::string message) { return {Error::Code::config, std::move(message)}; }

/// Text of a page with normalized line ends.
Result<std::string> text_of_page(const std::string& path) {
  auto text = read_config_file(path, most_page_bytes);
  if (!text) return text;
  std::erase(*text, '\r');
  const std::string shown = terminal_lines(*text);
  const auto bad = std::mismatch(text->begin(), text->end(), shown.begin(), shown.end());
  if (bad.first == text->end()) return text;
  const Position p = Source::from_bytes(path, *text)
                         ->position(static_cast<std::uint64_t>(bad.first - text->begin()));
  return refused(path + ":" + std::to_string(p.line) + ":" + std::to_string(p.column) +
                 ": expected text in UTF-8 without control characters, not '" +
                 std::string(bad.second, std::min(bad.second + 4, shown.end())) + "'");
}

const RulePage* page_of(const std::vector<RulePage>& pages, std::string_view id) {
  const auto page = std::find_if(pages.begin(), pages.end(),
                                 [&](const RulePage& p) { return id_text(p.rule.id) == id; });
  return page == pages.end() ? nullptr : &*page;
}

std::vector<std::string> covered_by(const RulePage* page) {
  if (page == nullptr || !page->rule.exceptions.contains("covers")) return {};
  return page->rule.exceptions.find("covers")->second;
}

/// Conflict of a page with others; empty: none.
std::string problem_among(const std::vector<RulePage>& pages, const RulePage& page) {
  const std::string id(id_text(page.rule.id));
  if (!is_team_rule(page.rule.id))
    return page.problem("id", "expected X001 to X999, not " + id + ", an id of deck's own rules");
  if (const RulePage* first = page_of(pages, id); first != &page)
    return page.problem("id", "expected another id: " + first->path + " has it");
  const auto same_name = [&](const RulePage& p) {
    return &p != &page && p.rule.name == page.rule.name;
  };
  if (find_rule(page.rule.name) != nullptr || std::any_of(pages.begin(), pages.end(), same_name))
    return page.problem("name",
                        "expected another name: a rule is called " + page.rule.name + " already");
  // Two rules that cover each other would report nothing.
  std::vector<std::string> covered = covered_by(&page);
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const Rule* const rule = find_rule(covered[i]);
    const RulePage* const own = page_of(pages, covered[i]);
    if (own == &page || (own == nullptr && (rule == nullptr || id_text(rule->id) != covered[i] ||
                                            is_gate_rule(rule->id))))
      return page.problem(
          "covers",
          "expected ids of other rules, not of the gate and not in a circle, not " + covered[i]);
    for (const std::string& next : covered_by(own))
      if (std::find(covered.begin(), covered.end(), next) == covered.end()) covered.push_back(next);
  }
  return {};
}

}  // namespace

Result<std::vector<RulePage>> read_rules(const std::string& directory) {
  std::error_code error;
  std::set<std::string> files;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".md") files.insert(it->path().string());
  if (error || files.empty())
    return refused(directory + ": expected a directory with pages of rules (X101.md): " +
                   (error ? error.message() : "there is none"));
  std::vector<RulePage> pages;
  for (const std::string& file : files) {
    const auto text = text_of_page(file);
    if (!text) return text.error();
    auto page = detail::read_rule_page(file, *text, [](const std::string& keyword) {
      return SchemaSet::built_in().find(keyword);
    });
    if (!page) return page.error();
    pages.push_back(std::move(*page));
  }
  for (const RulePage& page : pages)
    if (std::string problem = problem_among(pages, page); !problem.empty())
      return refused(std::move(problem));
  return pages;
}

}  // namespace deck
