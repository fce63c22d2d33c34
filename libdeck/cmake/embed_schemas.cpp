// Build tool: reads the files of keyword schemas, checks them as `--schemas DIR` does, and writes
// them as a C++ file that defines embedded_schemas(): one entry for each keyword. Checks the pages
// of rules, that no two of them have the same name, and that the rules that are predicates of cells
// name fields that their interfaces have.
//   embed_schemas OUT SCHEMAS.json... RULE.md...
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "keyword/schema/json.hpp"
#include "lint/cell_rule.hpp"
#include "text/shared/rule_page.hpp"

namespace {

/// As literals of one line: a compiler reads them faster than a number for each byte.
std::string literal(const std::string& text) { return nlohmann::json(text).dump(); }

std::string contents(const char* path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Fields of each keyword, by name; true: with numbers.
using Fields = std::map<std::string, std::map<std::string, bool>>;

/// What is wrong with the values of which the solver speaks on a page; empty: nothing.
std::string problem_of_limits(const std::string& name, const deck::Rule& rule,
                              const Fields& fields) {
  for (std::size_t i = 1; i < rule.cells.size(); ++i) {
    const auto limits = deck::detail::Limit::read(rule.id, rule.cells[i]);
    if (!limits) return name + ": " + limits.error().message;
    for (const auto& limit : *limits) {
      const auto known = fields.find(limit.keyword);
      if (known == fields.end()) return name + ": no keyword " + limit.keyword;
      std::vector<std::string> names = limit.fields();
      names.push_back(limit.field);
      for (const std::string& field : names)
        if (!field.empty() && field != deck::detail::this_field)
          if (const auto cell = known->second.find(field);
              cell == known->second.end() || !cell->second)
            return name + ": " + limit.keyword + " has no number " + field;
    }
  }
  return {};
}

/// What is wrong with the page of a rule; empty: nothing. `names`: those of the pages before.
std::string problem_of_page(const char* path, const Fields& fields, std::set<std::string>& names) {
  const std::string name = std::filesystem::path(path).filename().string();
  const auto rule = deck::detail::parse_rule_page(name, contents(path));
  if (!rule) return rule.error().message;
  if (!names.insert(rule->name).second) return name + ": another rule is called " + rule->name;
  if (rule->cells.empty()) return {};
  if (rule->cells.back().contains("keywords")) return problem_of_limits(name, *rule, fields);
  const auto cells = deck::detail::CellRule::read(rule->cells);
  if (!cells) return name + ": " + cells.error().message;
  for (const std::string& field : cells->fields()) {
    bool known = false;
    for (const int type : rule->types)
      known = known || fields.at("/INTER/TYPE" + std::to_string(type)).contains(field);
    if (!known) return name + ": no interface of its types has a field " + field;
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  std::string rows;
  std::set<std::string> known, rule_names;
  Fields fields;
  for (int k = 2; k < argc; ++k) {
    if (std::string_view(argv[k]).ends_with(".md")) {
      if (const std::string problem = problem_of_page(argv[k], fields, rule_names);
          !problem.empty()) {
        std::cerr << problem << '\n';
        return 1;
      }
      continue;
    }
    const auto read = deck::detail::read_schemas(argv[k], contents(argv[k]));
    if (!read) {
      std::cerr << read.error().message << '\n';
      return 1;
    }
    const std::string file = std::filesystem::path(argv[k]).filename().string();
    for (const auto& [schema, json] : *read) {
      for (const auto& card : schema.cards)
        for (const auto& field : card.fields)
          fields[schema.keyword][field.name] = field.type != deck::FieldType::text;
      auto keywords = schema.aliases;
      keywords.insert(keywords.begin(), schema.keyword);
      std::string names;
      for (const auto& keyword : keywords) {
        if (!known.insert(keyword).second) {
          std::cerr << argv[k] << ": " << keyword << " has a schema already\n";
          return 1;
        }
        names += (names.empty() ? "" : "\n") + keyword;
      }
      rows += "    {" + literal(file) + ", " + literal(names) + ",\n     " + literal(json) + "},\n";
    }
  }
  std::ofstream(argv[1], std::ios::binary)
      << "// Generated from schemas/keywords; do not edit.\n"
         "#include \"base/shared/embedded.hpp\"\n"
         "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n"
         "namespace deck::detail {\n"
         "const std::vector<EmbeddedSchema>& embedded_schemas() {\n"
         "  static const std::vector<EmbeddedSchema> all = {\n"
      << rows << "  };\n  return all;\n}\n}  // namespace deck::detail\n";
}
