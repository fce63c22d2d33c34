// Runs the cases of tests/*/*.cases: a deck, commands, and what they print. CONTRIBUTING.md says
// how they are written. DECK_RECORD=1 writes the output of commands that print something else into
// the file, except where its text has "...".
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "deck/edit.hpp"
#include "deck/loaded_deck.hpp"
#include "lint/shared/example.hpp"
#include "tools/command_line.hpp"

namespace {

using namespace deck::testing_support;
using deck::test::source_dir;
using Lines = std::vector<std::string>;

struct Step {
  std::string command;
  Lines shown = {};  ///< its last line may be "exit N"
};
struct Case {
  std::string title = {};
  Lines deck = {};
  std::vector<Step> steps = {};
};
struct CaseFile {
  fs::path path;
  std::vector<Case> cases = {};
  bool changed = false;
};

Lines lines_of(const std::string& text) {
  Lines out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::string text_of(const Lines& lines) {
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}

void drop_blank_end(Lines& lines) {
  while (!lines.empty() && lines.back().find_last_not_of(' ') == std::string::npos)
    lines.pop_back();
}

CaseFile read_cases(const fs::path& path) {
  CaseFile out{path};
  for (const std::string& line : lines_of(read(path))) {
    if (line.starts_with("== ") || out.cases.empty()) out.cases.emplace_back();
    Case& c = out.cases.back();
    if (line.starts_with("== "))
      c.title = line.substr(3);
    else if (line.starts_with("$ "))
      c.steps.push_back({line.substr(2)});
    else
      (c.steps.empty() ? c.deck : c.steps.back().shown).push_back(line);
  }
  for (Case& c : out.cases)
    for (Step& s : c.steps) drop_blank_end(s.shown);
  return out;
}

void write_cases(const CaseFile& file) {
  std::string out;
  for (const Case& c : file.cases) {
    out += (out.empty() ? "== " : "\n== ") + c.title + "\n" + text_of(c.deck);
    for (const Step& s : c.steps) out += "$ " + s.command + "\n" + text_of(s.shown);
  }
  write(file.path, out);
}

/// In `shown`, "..." stands for any text.
bool line_fits(std::string_view shown, std::string_view line) {
  for (;;) {
    if (shown.starts_with("...")) {
      shown.remove_prefix(3);
      for (std::size_t i = 0; !shown.empty() && i <= line.size(); ++i)
        if (line_fits(shown, line.substr(i))) return true;
      return shown.empty();
    }
    if (shown.empty() || line.empty()) return shown.empty() && line.empty();
    if (shown[0] != line[0]) return false;
    shown.remove_prefix(1);
    line.remove_prefix(1);
  }
}

/// A line "..." alone stands for any lines.
bool text_fits(const Lines& shown, const Lines& printed) {
  std::vector<bool> reached(printed.size() + 1);  // with the shown lines so far
  reached[0] = true;
  for (const std::string& s : shown) {
    std::vector<bool> next(printed.size() + 1);
    for (std::size_t i = 0; i <= printed.size(); ++i)
      if (s == "...")
        next[i] = reached[i] || (i > 0 && next[i - 1]);
      else
        next[i] = i > 0 && reached[i - 1] && line_fits(s, printed[i - 1]);
    reached = next;
  }
  return reached.back();
}

/// The deck once for each item of "{a,b}" in its lines "@/..." and "deck: ...".
std::vector<Lines> variants(const Lines& deck) {
  for (std::size_t i = 0; i < deck.size(); ++i) {
    const std::string& line = deck[i];
    const auto open = line.find('{'), close = line.find('}', std::min(open, line.size()));
    if (close == line.npos || !(line.starts_with("@/") || line.starts_with("deck: "))) continue;
    std::vector<Lines> out;
    for (std::size_t at = open + 1, end = 0; at <= close; at = end + 1) {
      end = std::min(line.find(',', at), close);
      Lines one = deck;
      one[i] = line.substr(0, open) + line.substr(at, end - at) + line.substr(close + 1);
      for (Lines& more : variants(one)) out.push_back(std::move(more));
    }
    return out;
  }
  return {deck};
}

/// A sample under another name; "@/KEYWORD/1 A=1" sets fields, other lines are new blocks.
void write_sample(const fs::path& folder, const Lines& deck) {
  const fs::path sample = source_dir() / deck[0].substr(6), to = folder / "deck_0000.rad";
  fs::copy_file(sample, to);
  std::string stem = sample.stem().string();
  stem.resize(stem.rfind('_'));
  if (fs::exists(sample.parent_path() / stem))
    fs::copy(sample.parent_path() / stem, folder / stem, fs::copy_options::recursive);
  const auto loaded = deck::load(to.string());
  ASSERT_TRUE(loaded) << loaded.error().message;
  deck::Edit edit(*loaded);
  std::string added;
  for (std::size_t i = 1; i < deck.size(); ++i) {
    if (!deck[i].starts_with("@/")) {
      added += deck[i] + "\n";
      continue;
    }
    std::istringstream words(deck[i].substr(1));
    std::string header, word;
    words >> header;
    const auto slash = header.rfind('/');
    while (words >> word)
      edit.set(header.substr(0, slash), std::stoll(header.substr(slash + 1)),
               word.substr(0, word.find('=')), word.substr(word.find('=') + 1));
  }
  if (!added.empty()) edit.insert(added);
  const auto saved = edit.save();
  ASSERT_TRUE(saved) << saved.error().message;
}

void write_deck(const fs::path& folder, const Lines& deck) {
  fs::create_directory_symlink(source_dir() / "samples", folder / "samples");
  if (deck.empty()) return;
  if (deck[0].starts_with("deck: ")) return write_sample(folder, deck);
  const auto example = deck::example_deck(text_of(deck), deck::SchemaSet::built_in());
  write(folder / "deck_0000.rad", example.main);
  for (const auto& [name, content] : example.files) write(folder / name, content);
}

/// Where a case has a deck, a verb without one takes it, and lint says it shortly.
std::string full_command(const std::string& command, bool has_deck) {
  std::smatch verb;
  if (!has_deck || !std::regex_search(command, verb, std::regex("^deck (\\w+)"))) return command;
  const std::string own = command.substr(0, command.find_first_of(";|&"));
  std::string more = own.find(".rad") == own.npos ? " deck_0000.rad" : "";
  if (verb[1] == "lint" && own.find("--format") == own.npos) more += " --format concise";
  return verb.str() + more + verb.suffix().str();
}

struct CaseTest : CommandLine {
  CaseTest(CaseFile& f, Case& c) : file(f), here(c) {}
  void TestBody() override {
    for (const Lines& deck : variants(here.deck)) {
      for (const auto& e : fs::directory_iterator(dir_)) fs::remove_all(e);
      write_deck(dir_, deck);
      for (Step& s : here.steps) {
        const int code =
            shell("( " + full_command(s.command, !deck.empty()) + " ) < /dev/null 2>&1");
        std::string text = std::regex_replace(out(), std::regex(dir_.string()), "DIR");
        text = std::regex_replace(text, std::regex("\\bdeck_0000\\.rad:(?=\\d)"), "");
        judge(s, lines_of(text), code, deck);
      }
    }
  }
  void judge(Step& s, Lines printed, int code, const Lines& deck) {
    for (std::string& line : printed) line.resize(line.find_last_not_of(' ') + 1);
    drop_blank_end(printed);
    const bool exit_shown = !s.shown.empty() && s.shown.back().starts_with("exit ");
    if (exit_shown) printed.push_back("exit " + std::to_string(code));
    const bool same = text_fits(s.shown, printed);
    if (!same && std::getenv("DECK_RECORD") && text_of(s.shown).find("...") == std::string::npos &&
        (!exit_shown || s.shown.back() == printed.back())) {
      s.shown = printed;
      file.changed = true;
      return;
    }
    EXPECT_TRUE(same && (exit_shown || code == 0 || code == 1))
        << text_of({"$ " + s.command, "prints, with exit code " + std::to_string(code)})
        << text_of(printed) << "for the deck\n"
        << text_of(deck) << "and the case shows\n"
        << text_of(s.shown);
  }
  CaseFile& file;
  Case& here;
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  for (const char* v : {"DECK_SCHEMAS=", "NO_COLOR=1", "COLUMNS=80", "LC_ALL=C.UTF-8"})
    putenv(const_cast<char*>(v));
  std::map<fs::path, CaseFile> files;
  std::error_code no_folder;
  for (const auto& room : fs::directory_iterator(source_dir() / "tests"))
    for (const auto& e : fs::directory_iterator(room, no_folder))
      if (e.path().extension() == ".cases") files[e.path()] = read_cases(e.path());
  std::set<std::string> names;
  for (auto& [path, file] : files)
    for (Case& c : file.cases) {
      const std::string suite = path.parent_path().filename().string() + "/" + path.stem().string();
      std::string name = c.title;
      for (char& x : name)
        if (std::isalnum(static_cast<unsigned char>(x)) == 0) x = '_';
      if (!names.insert(suite + name).second || c.steps.empty()) {
        std::fprintf(stderr, "%s: no command, or used twice: %s\n", path.c_str(), name.c_str());
        return 1;
      }
      testing::RegisterTest(suite.c_str(), name.c_str(), nullptr, nullptr, path.c_str(), 1,
                            [&file = file, &c] { return new CaseTest(file, c); });
    }
  const int code = RUN_ALL_TESTS();
  for (const auto& [path, file] : files)
    if (file.changed) write_cases(file);
  return code;
}
