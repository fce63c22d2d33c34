// Build tool: reads the files of keyword schemas, checks them as `--schemas DIR` does, and writes
// them as a C++ file that defines embedded_schemas(): one entry for each keyword.
//   embed_schemas OUT FILE...
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "keyword/schema/json.hpp"

namespace {

/// As literals of one line: a compiler reads them faster than a number for each byte.
std::string literal(const std::string& text) { return nlohmann::json(text).dump(); }

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  std::string rows;
  std::set<std::string> known;
  for (int k = 2; k < argc; ++k) {
    std::ifstream in(argv[k], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto read = deck::detail::read_schemas(argv[k], text);
    if (!read) {
      std::cerr << read.error().message << '\n';
      return 1;
    }
    const std::string file = std::filesystem::path(argv[k]).filename().string();
    for (const auto& [schema, json] : *read) {
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
