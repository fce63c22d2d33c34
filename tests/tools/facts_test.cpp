// What whole verbs say of the samples. A file of records holds commands behind '$' and below each
// the exit code and what was written. In tests/tools/facts are the facts of JSON; DECK_RECORD=1
// writes what differs anew: look at the difference before you commit it. In tests/tools/screens is
// what a person sees; tests/tools/tour.py records it in a terminal.
#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "base/shared/hash.hpp"
#include "tools/command_line.hpp"

namespace {

using namespace deck::testing_support;
using Json = nlohmann::ordered_json;

/// Times, and what depends on them.
const std::set<std::string> measured = {"tool",        "machine",      "advice",     "seconds",
                                        "ratio",       "ratio_spread", "measurable", "spread",
                                        "ns_per_pair", "dominated"};

/// A sentence: texts for people are kept in the screens.
bool is_sentence(const std::string& text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i)
    if (text[i] == ' ' && std::isalpha(static_cast<unsigned char>(text[i - 1])) != 0) return true;
  return false;
}

/// What stands for the members of a list or object from `first` on.
Json others(const std::vector<Json>& all, std::size_t first) {
  std::string rest;
  for (std::size_t i = first; i < all.size(); ++i) rest += all[i].dump();
  return {{"more", all.size() - first}, {"hash", fmt::format("{:016x}", deck::content_hash(rest))}};
}

/// Numbers to nine digits, sentences as "~". Of lists and objects with many structured members
/// the first, and a hash of the others: what changed there is seen by the command itself.
Json essence(const Json& v, int depth = 0) {
  constexpr std::size_t most = 3, first = 1;
  if (v.is_object()) {
    Json out = Json::object();
    const bool many = depth > 0 && v.size() > 12;
    std::vector<Json> large;
    for (const auto& [key, value] : v.items()) {
      if (measured.contains(key)) continue;
      Json kept = essence(value, depth + 1);
      if (many && kept.is_structured()) large.push_back({key, kept});
      if (!many || !kept.is_structured() || large.size() <= first) out[key] = kept;
    }
    if (large.size() > first) out["~"] = others(large, first);
    return out;
  }
  if (v.is_array()) {
    std::vector<Json> all;
    for (const Json& e : v) all.push_back(essence(e, depth + 1));
    if (all.size() <= most || (all.size() <= 10 && !all[0].is_structured())) return Json(all);
    Json out(std::vector<Json>(all.begin(), all.begin() + first));
    out.push_back(others(all, first));
    return out;
  }
  if (v.is_number_float()) return Json::parse(fmt::format("{:.9g}", v.get<double>()));
  if (v.is_string() && is_sentence(v.get<std::string>())) return "~";
  return v;
}

/// As JSON, with what fits on a line in one line.
void lay(const Json& v, const std::string& before, std::size_t indent, std::string& out) {
  constexpr std::size_t width = 160;
  const std::string margin(indent, ' ');
  const std::string whole = v.dump();
  if (indent + before.size() + whole.size() <= width || !v.is_structured()) {
    out += margin + before + whole + "\n";
    return;
  }
  out += margin + before + (v.is_object() ? "{\n" : "[\n");
  std::string line;
  const auto end_line = [&] {
    if (!line.empty()) out += margin + " " + line + "\n";
    line.clear();
  };
  for (const auto& [key, value] : v.items()) {
    const std::string name = v.is_object() ? Json(key).dump() + ": " : "";
    const std::string text = name + value.dump();
    if (indent + 1 + text.size() > width) {
      end_line();
      lay(value, name, indent + 1, out);
      continue;
    }
    if (indent + 3 + line.size() + text.size() > width) end_line();
    line += (line.empty() ? "" : ", ") + text;
  }
  end_line();
  out += margin + (v.is_object() ? "}\n" : "]\n");
}

std::string without(std::string text, const std::string& folder) {
  for (std::size_t at; (at = text.find(folder)) != text.npos;)
    text.replace(at, folder.size(), "DIR");
  return text;
}

/// `head`: with what every document says of its deck.
std::string facts_of(const std::string& text, bool head) {
  const Json v = Json::parse(text, nullptr, false);
  if (v.is_discarded()) return text;
  std::string out;
  Json facts = essence(v);
  if (!head && facts.is_object()) facts.erase("deck");
  lay(facts, "", 0, out);
  return out;
}

/// Commands and their answers, in the order of the file.
using Record = std::vector<std::pair<std::string, std::string>>;

Record read_record(const fs::path& path) {
  Record record;
  std::istringstream in(read(path));
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("$ "))
      record.emplace_back(line.substr(2), "");
    else if (!record.empty())
      record.back().second += line + "\n";
  return record;
}

struct Case {
  fs::path file;
  std::string command, answer;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.command; }

std::vector<Case> cases_of(const char* folder) {
  std::set<fs::path> files;
  for (const auto& e :
       fs::directory_iterator(deck::test::source_dir() / "tests" / "tools" / folder))
    files.insert(e.path());
  std::vector<Case> all;
  for (const fs::path& path : files)
    for (const auto& [command, answer] : read_record(path)) all.push_back({path, command, answer});
  return all;
}

/// Screens of samples, without those of errors: tour.py makes the other decks, and only a
/// terminal breaks the lines of errors.
std::vector<Case> screens() {
  std::vector<Case> all = cases_of("screens");
  const std::regex made(R"(.* [^ /]+(/[^ ]*)?_0000\.rad.*|.*(\.json|\.out|\.csv|%s|--max-).*)");
  std::erase_if(all, [&](const Case& c) {
    return c.answer.starts_with("---- exit code 2") ||
           std::regex_match(std::regex_replace(c.command, std::regex("samples/[^ ]*"), ""), made);
  });
  return all;
}

std::string name_of(const testing::TestParamInfo<Case>& c) {
  std::string out;
  for (const char x : c.param.command)
    if (std::isalnum(static_cast<unsigned char>(x)) != 0)
      out += x;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  return fmt::format("{}_{}", out, c.index);
}

class OfTheSamples : public CommandLine, public testing::WithParamInterface<Case> {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::create_directory_symlink(deck::test::source_dir() / "samples", dir_ / "samples");
  }
};
using Facts = OfTheSamples;
using Screens = OfTheSamples;

TEST_P(Facts, AreThoseThatAreKept) {
  const Case& c = GetParam();
  const int code = shell(c.command);
  const std::string answer =
      fmt::format("---- exit code {}\n{}", code,
                  facts_of(without(out(), dir_.string()), c.file.stem() == "parts"));
  if (answer == c.answer) return;
  if (std::getenv("DECK_RECORD") == nullptr) {
    EXPECT_EQ(answer, c.answer) << c.command << "\n" << err();
    return;
  }
  std::string text;
  for (const auto& [command, kept] : read_record(c.file))
    text += fmt::format("$ {}\n{}", command, command == c.command ? answer : kept);
  write(c.file, text);
}

TEST_P(Screens, AreThoseThatAreKept) {
  const Case& c = GetParam();
  const int code = shell("unset DECK_SCHEMAS; export COLUMNS=80 NO_COLOR=1 LC_ALL=C.UTF-8; " +
                         c.command + " 2>&1");
  std::string text = fmt::format("---- exit code {}\n{}", code, out());
  for (std::smatch rules; std::regex_search(text, rules, std::regex(R"(\d+ of \d+ rules)"));)
    text.replace(static_cast<std::size_t>(rules.position()),
                 static_cast<std::size_t>(rules.length()),
                 std::regex_replace(rules.str(), std::regex("\\d"), "#"));
  EXPECT_EQ(text, c.answer.substr(0, c.answer.find_last_not_of('\n') + 2));
}

INSTANTIATE_TEST_SUITE_P(Samples, Facts, testing::ValuesIn(cases_of("facts")), name_of);
INSTANTIATE_TEST_SUITE_P(Samples, Screens, testing::ValuesIn(screens()), name_of);

}  // namespace
