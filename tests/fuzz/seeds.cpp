// Writes the first inputs of the fuzz targets below a directory: fuzz_seeds DIR. They are made of
// the decks in samples/ and of the examples of every rule.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "deck/lint.hpp"
#include "lint/shared/example.hpp"

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Edits for fuzz_lsp, as they are made by hand: a cell, a line taken out, a block put in, a word
/// cut off and typed again.
std::string edits_of(const std::string& text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  const auto line = [&](std::size_t k) {
    return std::to_string((lines * k / 7 + k) % (lines + 1));
  };
  const auto range = [](const std::string& l, int from, int to) {
    return "e " + l + " " + std::to_string(from) + " " + l + " " + std::to_string(to) + " ";
  };
  return "=== edits\n" + range(line(1), 10, 20) + "         7\n" + "h " + line(2) + " 12\n" +
         range(line(3), 40, 60) + "                0.25\n" + "e " + line(4) + " 0 " + line(5) +
         " 0 \n" + range(line(5), 0, 0) + "/GRNOD/NODE/77\\nnew\\n         1         2\\n\n" +
         range(line(6), 1, 5) + "\n" + range(line(6), 1, 1) + "PART\n";
}

class Seeds {
 public:
  explicit Seeds(fs::path root) : root_(std::move(root)) {}
  void put(const std::string& target, const std::string& name, std::string_view text) {
    fs::create_directories(root_ / target);
    std::ofstream(root_ / target / name, std::ios::binary) << text;
    ++count;
  }
  /// For every target whose input is one deck.
  void deck(const std::string& name, const std::string& text) {
    for (const char* t : {"fuzz_deck", "fuzz_pipeline", "fuzz_lint", "fuzz_edits", "fuzz_includes"})
      put(t, name, text);
    if (text.size() < 2800) put("fuzz_lsp", name, text + edits_of(text));
  }
  std::size_t count = 0;

 private:
  fs::path root_;
};

/// A deck too large for a fuzzer, in parts: its head and a run of blocks each.
void parts_of(Seeds& seeds, const std::string& name, const std::string& text) {
  const auto head = text.substr(0, text.find("\n/", text.find("/BEGIN")) + 1);
  std::string part = head;
  int n = 0;
  for (std::size_t at = head.size(); at < text.size();) {
    const auto next = std::min(text.find("\n/", at), text.size() - 1) + 1;
    if (next - at < 3000) part += text.substr(at, next - at);
    if (part.size() > 4000 || next >= text.size()) {
      seeds.deck(name + "_" + std::to_string(n++), part + "/END\n");
      part = head;
    }
    at = next;
  }
}

void samples(Seeds& seeds, const fs::path& directory) {
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (!entry.path().string().ends_with("_0000.rad")) continue;
    std::string name = entry.path().stem().string();
    const std::string text = read(entry.path());
    if (text.size() < 12000)
      seeds.deck(name, text);
    else
      parts_of(seeds, name, text);
  }
  std::string tree = read(directory / "include_tree_0000.rad");
  for (const char* file : {"mesh.inc", "sheets.inc"})
    tree +=
        "=== include_tree/" + std::string(file) + "\n" + read(directory / "include_tree" / file);
  seeds.put("fuzz_includes", "tree", tree);
}

void examples(Seeds& seeds) {
  for (const deck::Rule& rule : deck::all_rules())
    for (const std::string_view text : {rule.bad, rule.good}) {
      if (text.empty()) continue;
      const auto example = deck::example_deck(text, deck::SchemaSet::built_in());
      const std::string name =
          std::string(id_text(rule.id)) + (text == rule.bad ? "_bad" : "_good");
      if (example.main.size() > 12000) continue;
      std::string tree = example.main;
      for (const auto& [file, content] : example.files) tree += "=== " + file + "\n" + content;
      if (!example.files.empty()) seeds.put("fuzz_includes", name, tree);
      seeds.deck(name, example.main);
    }
}

void others(Seeds& seeds) {
  seeds.put(
      "fuzz_config", "toml",
      "select = [\"DK2\", \"DK104\"]\nignore = [\"DK201:Ibag\"]\nfail-on = \"warning\"\nbaseline "
      "= \"b.json\"\n"
      "[severity]\nDK104 = \"error\"\n[per-file-ignores]\n\"legacy/**/*.rad\" = [\"DK1\"]\n");
  seeds.put(
      "fuzz_config", "baseline",
      R"({"deck":"a_0000.rad","rule":"DK104","file":"a_0000.rad","entity":"","field":"","value":2})"
      "\n"
      R"({"deck":"a_0000.rad","interface":1,"kind":"edges","ids":[3,4],"depth":0.5,"gap":1})");
  seeds.put("fuzz_config", "page",
            "---\nid: X101\nname: our-gap\ntitle: \"t\"\nseverity: info\nwhen: flag(Igap) > 1 and "
            "given(at)\nat: Gapmin\nmessage: \"{name}: {= input(Gapmin) / 2}\"\nfix: {Gapmin: "
            "1, safe: true, title: t}\n---\n- **Fires on.** `@/INTER/TYPE7/1 Gapmin=2`\n");
  int n = 0;
  for (const char* glob :
       {"*.rad\na/b_0000.rad", "a/**/b?.rad\na/x/y/b1.rad", "**\n", "**/x\nx", "a*b*c\naabbcc"})
    seeds.put("fuzz_config", "glob" + std::to_string(n++), glob);
  for (const char* number :
       {"  -1.5d3 ", "1e400", "0x10", "       123", "1+5", "9223372036854775808"})
    seeds.put("fuzz_number", "n" + std::to_string(n++), number);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: fuzz_seeds DIR\n"), 2;
  Seeds seeds{argv[1]};
  samples(seeds, fs::path(DECK_SOURCE_DIR) / "samples");
  examples(seeds);
  others(seeds);
  std::printf("%zu inputs\n", seeds.count);
  return 0;
}
