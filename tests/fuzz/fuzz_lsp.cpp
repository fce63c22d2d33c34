// The language server's view of a text that is being edited: after any sequence of edits, looked at
// now and then, its findings and its answers are those of a server that was given the last text at
// once. The input is a deck and, behind a line that begins with "=== ", edits, one a line:
//   e L C L C TEXT   the range of the protocol becomes TEXT ("\n" in it is a line feed)
//   h L C            something is asked about that place
//   w TEXT           the whole text becomes TEXT
//   anything else    is put in as a line of its own, somewhere
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <vector>

#include "lsp/analysis.hpp"
#include "lsp/view.hpp"
#include "lsp/workspace.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using namespace deck::lsp;
using fuzz::require;

constexpr const char* path = "/nowhere/fuzz_0000.rad";
constexpr const char* uri = "file:///nowhere/fuzz_0000.rad";
constexpr std::size_t most_edits = 8;

using Method = Answer (*)(const View&, const Json&);
struct Named {
  const char* name;
  Method method;
};
constexpr Named of_a_place[] = {{"hover", hover},
                                {"definition", definition},
                                {"references", references},
                                {"highlight", document_highlight},
                                {"card", card_at}};
constexpr Named of_the_text[] = {{"completion", completion},  {"symbols", document_symbols},
                                 {"folding", folding_ranges}, {"hints", inlay_hints},
                                 {"lenses", code_lenses},     {"actions", code_actions}};

/// One document, its deck, and what is known about it.
class Session {
 public:
  Session(std::string text, Encoding encoding) {
    client_.encoding = encoding;
    client_.hierarchical_symbols = true;
    Settings settings;
    settings.limits.files = 4;
    workspace_.configure(SchemaSet::built_in(), settings);
    workspace_.open(path, uri, 1, std::move(text));
  }

  const std::string& text() { return workspace_.text(path); }
  std::uint64_t lines() { return workspace_.find(path)->lines->size(); }

  void edit(Place from, Place to, std::string_view by) {
    Document& document = *workspace_.find(path);
    std::string& text = workspace_.text(path);
    const std::uint64_t begin = document.lines->offset(text, from, client_.encoding);
    const std::uint64_t end = document.lines->offset(text, to, client_.encoding);
    require(begin <= text.size() && end <= text.size(), "a place lies in the text");
    replace(text, document, begin, std::max(begin, end), by);
    workspace_.changed();
  }
  void become(std::string_view all) {
    std::string& text = workspace_.text(path);
    text = std::string(all);
    workspace_.find(path)->lines = std::make_shared<const LineTable>(text);
    workspace_.changed();
  }

  /// Model and rules of the text as it is now. False: it is no deck at all.
  bool look() {
    OpenDeck* open = workspace_.deck_of(path);
    if (open == nullptr) return false;
    open->semantics = analyse(open->path, workspace_.texts(), open->syntax->generation,
                              workspace_.schemas(), workspace_.settings(), go_);
    return true;
  }

  /// What the server says about a place, or about the whole text; null where it is no deck.
  Json answer(const Named& asked, Place at, bool whole) {
    OpenDeck* open = workspace_.deck_of(path);
    if (open == nullptr) return nullptr;
    const View view(workspace_, client_, *open, path);
    const Json position = {{"line", at.line}, {"character", at.character}};
    const Json range = {{"start", whole ? Json{{"line", 0}, {"character", 0}} : position},
                        {"end", {{"line", lines()}, {"character", 0}}}};
    try {
      return asked.method(view, {{"textDocument", {{"uri", uri}}},
                                 {"position", position},
                                 {"range", range},
                                 {"newName", "77"},
                                 {"context", {{"includeDeclaration", true}}}});
    } catch (const Refusal& refusal) {
      return {{"refused", refusal.message}};
    }
  }

  std::string findings() {
    OpenDeck* open = workspace_.deck_of(path);
    if (open == nullptr || open->semantics == nullptr) return "no deck";
    const Semantics& s = *open->semantics;
    std::string out = s.refusal + "|" + s.config_error + "\n";
    const std::uint64_t size = text().size();
    for (const Finding& d : s.lint.findings) {
      require(!d.span.valid() || d.span.offset + d.span.length <= size,
              "a finding lies in the text", d.message);
      out += std::string(id_text(d.rule)) + " " + where(d.span) + " " + d.message + "\n";
      for (const auto& [span, note] : d.notes) out += "  " + where(span) + " " + note + "\n";
      if (!d.fix) continue;
      out += "  fix: " + d.fix->title + (d.fix->safe ? "\n" : " (unsafe)\n");
      for (const TextEdit& e : d.fix->edits) out += "    " + where(e.span) + " " + e.text + "\n";
    }
    return out;
  }

 private:
  static std::string where(const Span& s) {
    if (!s.valid()) return "-";
    return std::to_string(s.file) + ":" + std::to_string(s.offset) + "+" + std::to_string(s.length);
  }

  Workspace workspace_;
  Client client_;
  std::atomic<bool> go_{false};  ///< never stopped
};

/// The numbers at the begin of a line; what is behind them stays.
std::vector<std::uint64_t> numbers(std::string_view& line, std::size_t count) {
  std::vector<std::uint64_t> out;
  while (out.size() < count) {
    std::string_view rest = line;
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    std::uint64_t n = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), n);
    if (error != std::errc()) break;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    out.push_back(n);
    line = rest;
  }
  if (line.starts_with(' ')) line.remove_prefix(1);
  return out;
}

std::string with_line_feeds(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool feed = text.substr(i, 2) == "\\n";
    out += feed ? '\n' : text[i];
    if (feed) ++i;
  }
  return fuzz::without_includes(std::move(out));
}

/// One line of the second part of the input. True: the text is looked at after it.
bool apply(Session& session, std::string_view line) {
  const std::string_view whole = line;
  const char what = line.size() > 1 && line[1] == ' ' ? line[0] : '\0';
  line.remove_prefix(std::min<std::size_t>(2, line.size()));
  if (what == 'w') {
    session.become(with_line_feeds(line));
    return true;
  }
  if (what == 'h') {
    const auto n = numbers(line, 2);
    if (n.size() == 2)
      session.answer(of_a_place[fuzz::hash_of(whole) % std::size(of_a_place)],
                     {n[0] % (session.lines() + 1), n[1]}, false);
    return false;
  }
  if (what == 'e') {
    if (const auto n = numbers(line, 4); n.size() == 4) {
      // Most numbers of a mutation lie far behind the end.
      const std::uint64_t count = session.lines() + 1;
      session.edit({n[0] % count, n[1]}, {n[2] % count, n[3]}, with_line_feeds(line));
      return n[1] % 3 != 0;
    }
  }
  const std::uint64_t h = fuzz::hash_of(whole);
  const Place place{h % session.lines(), 0};
  session.edit(place, place, with_line_feeds(std::string(whole) + "\\n"));
  return h / 8 % 3 != 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 12288) return 0;
  std::string text = fuzz::text_of(data, size);
  const std::uint64_t h = fuzz::hash_of(text);
  std::string edits;
  if (const auto mark = text.find("\n=== "); mark != std::string::npos) {
    edits = text.substr(std::min(text.find('\n', mark + 1), text.size() - 1) + 1);
    text.resize(mark + 1);
  }
  const Encoding encoding = h % 4 == 0 ? Encoding::utf8 : Encoding::utf16;
  Session session(fuzz::without_includes(std::move(text)), encoding);
  session.look();
  std::string_view rest = edits;
  for (std::size_t n = 0; n < most_edits && !rest.empty(); ++n) {
    const auto end = std::min(rest.find('\n'), rest.size());
    if (apply(session, rest.substr(0, end))) session.look();
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  session.look();
  Session fresh(session.text(), encoding);
  fresh.look();
  require(session.lines() == fresh.lines(), "edits keep the table of lines");
  const std::string before = session.findings(), after = fresh.findings();
  require(before == after, "findings are those of a fresh server", before + "\nfresh:\n" + after);
  // All answers together would cost many times what the edits do.
  const Place place{h / 4 % fresh.lines(), h / 64 % 100};
  const bool all = h / 128 % 4 == 0;
  const Named& asked = all ? of_the_text[h / 512 % std::size(of_the_text)]
                           : of_a_place[h / 512 % std::size(of_a_place)];
  const Json said = session.answer(asked, place, all), expected = fresh.answer(asked, place, all);
  if (said == expected) return 0;
  const auto shown = [](const Json& j) {
    return j.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  require(false, "answers are those of a fresh server",
          std::string(asked.name) + " " + shown(said) + "\nfresh:\n" + shown(expected));
  return 0;
}
