// Build tool: checks keyword schemas as `--schemas DIR` does and writes them as a C++ file with
// embedded_schemas(), one entry per keyword. Checks rule pages: unique names, and predicates of
// cells with existing fields.
//   embed_schemas OUT SCHEMAS.json... RULE.md...
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "keyword/schema/json.hpp"
#include "lint/rule_pages.hpp"

namespace {

/// String literals compile faster than arrays of numbers.
std::string literal(const std::string& text) { return nlohmann::json(text).dump(); }

std::string contents(const char* path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  std::string rows;
  std::set<std::string> known, rule_names;
  std::map<std::string, deck::Schema> schemas;
  for (int k = 2; k < argc; ++k) {
    const std::string file = std::filesystem::path(argv[k]).filename().string();
    if (file.ends_with(".md")) {
      const auto page =
          deck::detail::read_rule_page(file, contents(argv[k]), [&](const std::string& keyword) {
            const auto found = schemas.find(keyword);
            return found == schemas.end() ? nullptr : &found->second;
          });
      if (!page || !rule_names.insert(page->rule.name).second) {
        std::cerr << (page ? page->problem("name", "another rule has this name")
                           : page.error().message)
                  << '\n';
        return 1;
      }
      continue;
    }
    const auto read = deck::detail::read_schemas(argv[k], contents(argv[k]));
    if (!read) {
      std::cerr << read.error().message << '\n';
      return 1;
    }
    for (const auto& [schema, json] : *read) {
      schemas.emplace(schema.keyword, schema);
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
