// Rules about headers: keywords that nobody reads, types that the solver refuses, versions. The
// functions that fill the table are as long as their pages.
#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "lint/check.hpp"
#include "lint/rule_tables.hpp"

namespace deck::detail {
namespace {

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return out;
}

std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  if (a.size() > b.size() + limit || b.size() > a.size() + limit) return limit + 1;
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min(
          {above + 1, row[j - 1] + 1, diagonal + static_cast<std::size_t>(a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// The known keyword closest to an unknown one, if it is close.
std::string_view closest_keyword(const LintContext& c, std::string_view keyword) {
  std::string_view best;
  std::size_t distance = keyword.size() < 8 ? 2 : 3;
  for (const Schema* s : c.schemas.all()) {
    const auto consider = [&](std::string_view name) {
      if (const auto d = edit_distance(keyword, name, distance); d < distance) {
        distance = d;
        best = name;
      }
    };
    consider(s->keyword);
    for (const std::string& alias : s->aliases) consider(alias);
  }
  return best;
}

void check_unknown(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<std::string_view, std::string_view> seen;
  for (const Block& b : c.deck.blocks) {
    if (b.schema != nullptr || b.header.starts_with("//SUBMODEL") ||
        b.header.starts_with("//ENDSUB"))
      continue;
    const std::string big = upper(b.keyword);
    if (big != b.keyword && c.schemas.match(upper(b.header)) != nullptr) continue;  // DK041
    auto [it, fresh] = seen.emplace(b.keyword, std::string_view());
    // A binary file that passed for a deck has no end of them.
    constexpr std::size_t most_suggestions = 200;
    if (fresh && seen.size() <= most_suggestions) it->second = closest_keyword(c, b.keyword);
    const std::string_view close = it->second;
    std::string message = "keyword " + clipped(b.keyword) + " is unknown";
    if (!close.empty()) message += "; did you mean " + std::string(close) + "?";
    Diagnostic* d = r.report(
        rule, b,
        {b.header_span.file, static_cast<std::uint32_t>(b.keyword.size()), b.header_span.offset},
        std::move(message));
    if (d != nullptr && !close.empty())
      d->fix = Fix{"write " + std::string(close),
                   false,
                   {{Span{b.header_span.file, static_cast<std::uint32_t>(b.keyword.size()),
                          b.header_span.offset},
                     std::string(close)}}};
  }
}

void check_lower_case(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema != nullptr) continue;
    const std::string big = upper(b.keyword);
    if (big == b.keyword || c.schemas.match(upper(b.header)) == nullptr) continue;
    const Span span{b.header_span.file, static_cast<std::uint32_t>(b.keyword.size()),
                    b.header_span.offset};
    if (Diagnostic* d =
            r.report(rule, b, span, "keyword " + clipped(b.keyword) + " is not in upper case"))
      d->fix = Fix{"write " + big, false, {{span, big}}};
  }
}

void check_engine(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && b.schema->kind == "engine")
      r.report(rule, b, b.header_span,
               std::string(b.keyword) + " belongs into the Engine file (*_0001.rad)");
}

void check_obsolete(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && b.schema->keyword == "/INTER/TYPE4")
      r.report(rule, b, b.header_span, "/INTER/TYPE4 no longer exists");
}

void check_two_dimensional(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.model == nullptr || !c.model->two_dimensional) return;
  constexpr std::array<std::string_view, 4> allowed = {"/INTER/TYPE1", "/INTER/TYPE2",
                                                       "/INTER/TYPE3", "/INTER/TYPE5"};
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr || b.schema->kind != "inter") continue;
    if (std::find(allowed.begin(), allowed.end(), b.schema->keyword) != allowed.end()) continue;
    if (b.schema->keyword == "/INTER/SUB") continue;
    r.report(rule, b, b.header_span, b.schema->keyword + " in a two-dimensional analysis (/ANALY)");
  }
}

void check_newer_keyword(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && b.schema->from > b.version)
      r.report(rule, b, b.header_span,
               b.schema->keyword + " exists from version " + std::to_string(b.schema->from) +
                   " on; this deck is of version " + std::to_string(b.version));
}

/// Numbers on a line, cut at blanks; 0: something else stands there.
int count_numbers(std::string_view text) {
  int n = 0;
  for (std::size_t at = 0; at < text.size();) {
    at = std::min(text.find_first_not_of(" \t", at), text.size());
    const auto end = std::min(text.find_first_of(" \t", at), text.size());
    if (end == at) break;
    const NumberStatus status = read_real(text.substr(at, end - at)).status;
    if (status != NumberStatus::ok && status != NumberStatus::implicit_exponent) return 0;
    ++n;
    at = end;
  }
  return n;
}

void check_title(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const Line& title = card.decoded.title_line;
    if (!title.valid() || count_numbers(title.text) < 2) continue;
    r.report(rule, *card.block, title.whole(),
             "the title of " + name_of(card) + " consists of numbers; is the title line missing?");
  }
}

void check_missing_id(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr || !b.schema->has_id || b.id.present) continue;
    if (b.schema->kind.empty() || b.schema->kind == "other" || b.schema->kind == "parameter")
      continue;
    if (b.schema->bulk) continue;
    r.report(rule, b, b.header_span, b.schema->keyword + " without an id");
  }
}

void check_next_version_field(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts)
    for (const DecodedCard& line : card.decoded.cards) {
      if (line.missing() || line.free_format) continue;
      for (const Field& f : line.schema->fields) {
        if (f.in_version(card.block->version) || f.ignored) continue;
        const Span span = line.line.columns(f.first, f.last);
        const std::string_view text = trim(c.text(span));
        if (text.empty() || text.find_first_not_of("0.+-") == std::string_view::npos) continue;
        // Another field of this version may use the same columns.
        const bool shared = std::any_of(
            line.schema->fields.begin(), line.schema->fields.end(), [&](const Field& g) {
              return g.in_version(card.block->version) && g.first <= f.last && f.first <= g.last;
            });
        if (shared) continue;
        const bool later = f.from > card.block->version;
        r.report(rule, *card.block, span,
                 fmt::format("'{}' stands where version {} has {}; version {} has no field there",
                             text, later ? f.from : f.until, f.name, card.block->version));
      }
    }
}

void check_old_layout(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.deck.begin.version_known && c.deck.version < 90)
    r.report(rule, c.deck.begin.version_span,
             "input version " + std::to_string(c.deck.version) +
                 " has other columns and hardly any checks");
}

}  // namespace

void add_header_rules(std::vector<Rule>& out) {
  out.push_back({.id = "DK040",
                 .title = "unknown keyword",
                 .severity = Severity::warning,
                 .problem = "The header names a keyword that does not exist.",
                 .why = "The whole block is skipped, so what it defines is missing.",
                 .solver = "it skips the block; open-reader builds do so without a word",
                 .message = 100210,
                 .message_severity = Severity::error,
                 .fix = "correct the spelling, or remove the block",
                 .ignore = "The keyword is newer than this program.",
                 .fixable = Fixable::unsafe,
                 .bad = "/INTER/TYP7/1\nexample\n         2         1\n",
                 .good = "@/INTER/TYPE7/1\n",
                 .check = check_unknown});
  out.push_back({.id = "DK041",
                 .title = "keyword not in upper case",
                 .severity = Severity::error,
                 .problem = "A known keyword is written with small letters.",
                 .why = "Keywords are case-sensitive; the block does not exist.",
                 .solver = "it skips the block as unknown",
                 .message = 100210,
                 .message_severity = Severity::error,
                 .fix = "write the keyword in upper case",
                 .ignore = "Never.",
                 .fixable = Fixable::unsafe,
                 .bad = "/inter/type7/1\nexample\n         2         1\n",
                 .good = "@/INTER/TYPE7/1\n",
                 .check = check_lower_case});
  out.push_back({.id = "DK042",
                 .title = "Engine keyword in a Starter deck",
                 .severity = Severity::info,
                 .problem = "A keyword of the Engine file stands in the Starter deck.",
                 .why = "It has no effect here.",
                 .solver = "it skips the block",
                 .message = 100210,
                 .message_severity = Severity::error,
                 .fix = "move it to the Engine file or remove it",
                 .ignore = "When the file is used for both on purpose.",
                 .bad = "/ANIM/DT\n                 0.0                 1.0\n",
                 .good = "/TITLE\nexample\n",
                 .check = check_engine});
  out.push_back({.id = "DK043",
                 .title = "second /BEGIN",
                 .severity = Severity::warning,
                 .stage = RuleStage::reading,
                 .problem = "The main file has more than one /BEGIN.",
                 .why = "Lines behind the second one may follow another version, hence other "
                        "columns.",
                 .solver = "it takes the version of the last one for the lines that follow",
                 .fix = "keep one /BEGIN",
                 .ignore = "Never.",
                 .bad = "/BEGIN\nagain\n      2024         0\n",
                 .good = "/TITLE\nexample\n"});
  out.push_back({.id = "DK044",
                 .title = "obsolete interface type",
                 .severity = Severity::error,
                 .problem = "/INTER/TYPE4 was removed.",
                 .why = "The run cannot start.",
                 .solver = "it stops with an error",
                 .message = 1615,
                 .message_severity = Severity::error,
                 .fix = "use TYPE7 and, for edges, TYPE11",
                 .ignore = "Never.",
                 .bad = "/INTER/TYPE4/1\nexample\n         1         2\n",
                 .good = "@/INTER/TYPE7/1\n",
                 .check = check_obsolete});
  out.push_back({.id = "DK045",
                 .title = "interface type not available in 2-D",
                 .severity = Severity::error,
                 .problem = "The analysis is two-dimensional; only types 1, 2, 3 and 5 work there.",
                 .why = "Some builds crash on a TYPE11 in 2-D before they can say so.",
                 .solver = "it stops at once",
                 .message = 2097,
                 .message_severity = Severity::error,
                 .fix = "use type 3 or 5, or make the analysis three-dimensional",
                 .ignore = "Never.",
                 .bad = "/ANALY\n         1         0         0\n@/INTER/TYPE11/1\n",
                 .good = "/ANALY\n         0         0         0\n@/INTER/TYPE11/1\n",
                 .check = check_two_dimensional});
  out.push_back({.id = "DK046",
                 .title = "keyword newer than the deck",
                 .severity = Severity::warning,
                 .problem = "The keyword did not exist in the input version of the deck.",
                 .why = "The columns of a later version are used, which may not be those meant.",
                 .solver = "it takes the layout of the next version that has the keyword",
                 .message = 100211,
                 .fix = "raise the version in /BEGIN after checking the other cards",
                 .ignore = "When the card is known to follow the later layout.",
                 .bad = "@version 130\n@/FRICTION/1 Fric=0.2\n",
                 .good = "@version 2022\n@/FRICTION/1 Fric=0.2\n",
                 .check = check_newer_keyword});
  out.push_back({.id = "DK047",
                 .title = "value of another version's field",
                 .severity = Severity::warning,
                 .problem = "A value stands in columns that hold a field in another input version, "
                            "but not in that of the deck.",
                 .why = "The value is lost: the field does not exist for this deck.",
                 .solver = "it drops the text",
                 .message = 100214,
                 .fix = "raise the version in /BEGIN, or remove the value",
                 .ignore = "When losing the value is accepted.",
                 .bad = "@version 110\n/INTER/TYPE7/1\nexample\n         2         1\n"
                        "                                                 0.5\n\n"
                        "                 1.0\n\n\n",
                 .good = "@version 120\n@/INTER/TYPE7/1 Fpenmax=0.5\n",
                 .check = check_next_version_field});
  out.push_back({.id = "DK048",
                 .title = "missing title line",
                 .severity = Severity::warning,
                 .problem = "The line behind the header, which is the title, holds numbers only.",
                 .why = "If the title was left out, its place is taken by the first line of data "
                        "and every line below is read as the one above it.",
                 .solver = "it takes the line for the title",
                 .fix = "insert a title line (it may be blank)",
                 .ignore = "When the title really consists of numbers.",
                 .bad = "/INTER/TYPE7/1\n         2         1\n\n\n                 1.0\n\n\n",
                 .good = "@/INTER/TYPE7/1\n",
                 .check = check_title});
  out.push_back({.id = "DK049",
                 .title = "no id in the header",
                 .severity = Severity::info,
                 .problem = "The header has no id.",
                 .why = "The object gets id 1, which may collide with another or be referred to by "
                        "accident.",
                 .solver = "it takes 1",
                 .fix = "write the id into the header",
                 .ignore = "When 1 is meant.",
                 .bad = "@/INTER/TYPE7\n",
                 .good = "@/INTER/TYPE7/1\n",
                 .check = check_missing_id});
  out.push_back({.id = "DK050",
                 .title = "very old input version",
                 .severity = Severity::warning,
                 .problem = "The deck follows a layout from before version 90.",
                 .why = "Few decks of that kind are left, so neither the reference solver nor this "
                        "program has been tried much on them.",
                 .solver = "it reads the old columns",
                 .fix = "convert the deck to a newer version",
                 .ignore = "When the deck is read correctly.",
                 .bad = "@bare\n@version 51\n",
                 .good = "@bare\n@version 90\n",
                 .check = check_old_layout});
}

void add_linter_rules(std::vector<Rule>& out) {
  constexpr auto linter = RuleStage::linter;
  out.push_back({.id = "DK090",
                 .title = "suppression without a reason",
                 .severity = Severity::warning,
                 .stage = linter,
                 .problem = "A '# decklint: ignore[...]' comment has no reason=.",
                 .why = "In a year nobody knows whether the finding may still be ignored.",
                 .solver = "nothing, the line is a comment",
                 .fix = "add reason=... behind the bracket",
                 .ignore = "Never; the suppression has no effect without a reason.",
                 .bad = "# decklint: ignore[DK203]\n@/INTER/TYPE7/1\n",
                 .good = "# decklint: ignore[DK223] reason=known and accepted\n"
                         "@/INTER/TYPE7/1 Stfac=-1.0\n"});
  out.push_back({.id = "DK091",
                 .title = "unused suppression",
                 .severity = Severity::warning,
                 .stage = linter,
                 .problem = "A suppression covers no finding.",
                 .why = "It hides the next mistake of that kind.",
                 .solver = "nothing, the line is a comment",
                 .fix = "delete the comment",
                 .ignore = "In an included file that another deck needs it for: --fix leaves "
                           "included files alone, and --unsafe-fixes deletes a suppression only if "
                           "no deck of the call needs it.",
                 .fixable = Fixable::safe,
                 .bad = "# decklint: ignore[DK223] reason=known\n@/INTER/TYPE7/1 Stfac=1.0\n",
                 .good = "# decklint: ignore[DK223] reason=known\n@/INTER/TYPE7/1 Stfac=-1.0\n"});
  out.push_back({.id = "DK092",
                 .title = "suppression of an unknown rule",
                 .severity = Severity::warning,
                 .stage = linter,
                 .problem = "A suppression names a rule that does not exist.",
                 .why = "It has no effect; a typing error is likely.",
                 .solver = "nothing, the line is a comment",
                 .fix = "write an id that 'deck rules' lists, or a prefix of it",
                 .ignore = "Never.",
                 .bad = "# decklint: ignore[DK999] reason=known\n@/INTER/TYPE7/1\n",
                 .good = "# decklint: ignore[DK223] reason=known\n@/INTER/TYPE7/1 Stfac=-1.0\n"});
  out.push_back({.id = "DK093",
                 .title = "suppression that cannot be read",
                 .severity = Severity::warning,
                 .stage = linter,
                 .problem =
                     "A comment starts with 'decklint:' but has another form, or ignore-file "
                     "does not stand at the top of its file.",
                 .why = "It has no effect.",
                 .solver = "nothing, the line is a comment",
                 .fix = "write '# decklint: ignore[DK203] reason=...' in or before the block",
                 .ignore = "Never.",
                 .bad = "# decklint: off\n@/INTER/TYPE7/1\n",
                 .good = "# decklint: ignore[DK223] reason=known\n@/INTER/TYPE7/1 Stfac=-1.0\n"});
}

}  // namespace deck::detail
