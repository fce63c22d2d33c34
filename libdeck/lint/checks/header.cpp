// Rules about headers: unread keywords, refused types, versions.
#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "base/shared/words.hpp"
#include "keyword/shared/schema_facts.hpp"
#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// True if the solver takes the keyword for another, or reads none of its lines.
bool is_misread(const Schema& s) { return s.source == "misread.json"; }

/// The solver's message then; 0: none.
int message_of_misread(const Schema& s) {
  if (s.keyword == "/MAT/DPRAG_CAP") return 1012;
  return s.kind == "mat" ? 683 : s.kind == "sensor" ? 43 : s.kind == "prop" ? 0 : 534;
}

/// The known keyword closest to an unknown one, if close.
std::string_view closest_keyword(const LintContext& c, std::string_view keyword) {
  // Leading zeros of a number are ignored.
  if (const std::size_t zero = keyword.find("TYPE0"); zero != keyword.npos) {
    std::string plain(keyword);
    plain.erase(zero + 4,
                std::min(plain.find_first_not_of('0', zero + 4), plain.size()) - zero - 4);
    if (const Schema* s = c.schemas.match(plain); s != nullptr && s->keyword == plain)
      return s->keyword;
  }
  std::string_view best;
  std::size_t distance = keyword.size() < 8 ? 2 : 3;
  for (const Schema* s : c.schemas.all()) {
    if (is_misread(*s)) continue;
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

Span keyword_span(const Block& b) {
  return {b.header_span.file, static_cast<std::uint32_t>(names_of(b).size()), b.header_span.offset};
}

void check_unknown(const LintContext& c, const Rule& rule, Reporter& r) {
  std::map<std::string_view, std::string_view> seen;
  for (const Block& b : c.deck.blocks) {
    const bool misread = b.schema != nullptr && is_misread(*b.schema);
    if ((b.schema != nullptr && !misread) || b.header.starts_with("//SUBMODEL") ||
        b.header.starts_with("//ENDSUB"))
      continue;
    const std::string_view keyword = names_of(b);
    const std::string big = in_capitals(b.keyword);
    if (big != b.keyword && c.schemas.match(in_capitals(b.header)) != nullptr) continue;  // DK041
    auto [it, fresh] = seen.emplace(keyword, std::string_view());
    // A binary file can have any number of unknown keywords.
    constexpr std::size_t most_suggestions = 200;
    if (fresh && seen.size() <= most_suggestions) it->second = closest_keyword(c, keyword);
    const std::string_view close = it->second;
    std::string message =
        "keyword " + clipped(keyword) + (misread ? " is not read as it is meant" : " is unknown");
    if (!close.empty()) message += "; did you mean " + std::string(close) + "?";
    Finding& d = r.report(rule, b, keyword_span(b), std::move(message));
    if (misread) {
      d.keyword = clipped(keyword);
      d.reference.reset();
      if (const int number = message_of_misread(*b.schema)) d.reference = rule.message(number);
      if (d.reference) d.severity = d.reference->severity;
      d.reference_behaviour = b.schema->doc;
    }
    if (!close.empty())
      d.fix = Fix{"write " + std::string(close), false, {{keyword_span(b), std::string(close)}}};
  }
}

void check_lower_case(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema != nullptr) continue;
    const std::string big = in_capitals(b.keyword);
    if (big == b.keyword || c.schemas.match(in_capitals(b.header)) == nullptr) continue;
    r.report(rule, b, keyword_span(b), "keyword " + clipped(b.keyword) + " is not in upper case")
        .fix = Fix{"write " + big, false, {{keyword_span(b), big}}};
  }
}

void check_engine(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && b.schema->kind == "engine")
      r.report(rule, b, b.header_span,
               std::string(b.keyword) + " belongs in the Engine file (*_0001.rad)");
}

void check_obsolete(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && b.schema->keyword == "/INTER/TYPE4")
      r.report(rule, b, b.header_span, "/INTER/TYPE4 no longer exists");
}

void check_lagrange(const LintContext& c, const Rule& rule, Reporter& r) {
  constexpr std::string_view front = "/INTER/LAGMUL/";
  constexpr std::array<std::string_view, 4> allowed = {"TYPE2", "TYPE7", "TYPE16", "TYPE17"};
  for (const Block& b : c.deck.blocks) {
    if (!b.header.starts_with(front)) continue;
    const std::string_view rest = std::string_view(b.header).substr(front.size());
    const std::string_view type = trim(rest.substr(0, std::min(rest.find('/'), rest.size())));
    if (!type.starts_with("TYPE") ||
        std::find(allowed.begin(), allowed.end(), type) != allowed.end())
      continue;
    r.report(rule, b, b.header_span,
             fmt::format("{}{}: only types 2, 7, 16 and 17 work with Lagrange multipliers", front,
                         type));
  }
}

void check_two_dimensional(const LintContext& c, const Rule& rule, Reporter& r) {
  if (!c.model->two_dimensional) return;
  constexpr std::array<std::string_view, 4> allowed = {"/INTER/TYPE1", "/INTER/TYPE2",
                                                       "/INTER/TYPE3", "/INTER/TYPE5"};
  for (const Block& b : c.deck.blocks) {
    // An unknown type is an interface, too.
    const bool unknown = b.schema == nullptr && b.keyword.starts_with("/INTER/");
    if (!unknown && (b.schema == nullptr || b.schema->kind != "inter")) continue;
    const std::string keyword = unknown ? clipped(b.keyword) : b.schema->keyword;
    if (std::find(allowed.begin(), allowed.end(), keyword) != allowed.end()) continue;
    if (keyword == "/INTER/SUB") continue;
    r.report(rule, b, b.header_span, keyword + " does not work in a 2D analysis (/ANALY)");
  }
}

void check_newer_keyword(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && b.schema->from > b.version && reads_lines(*b.schema, b.version))
      r.report(rule, b, b.header_span,
               fmt::format("{} exists from version {} on, and its lines are read as in that "
                           "version; this deck is of version {}",
                           b.schema->keyword, b.schema->from, b.version));
}

void check_unread_keyword(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && !reads_lines(*b.schema, b.version))
      r.report(
          rule, b, b.header_span,
          fmt::format("{} {}: its lines are read from version {} on; this deck is of version {}",
                      b.schema->keyword, b.id.value, b.schema->from, b.version));
}

/// Reports a triple of /GEN_INCR without its third number.
void check_increment(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr || !b.schema->keyword.ends_with("/GEN_INCR")) continue;
    for (const DecodedCard& card : decode(c.deck, b).cards) {
      if (card.cells.size() < 3 || card.cells[2].integer != 0) continue;
      r.report(rule, b, card.line.whole(),
               fmt::format("{} {}: the range {} to {} has no increment", b.schema->keyword,
                           b.id.value, card.cells[0].integer, card.cells[1].integer));
    }
  }
}

/// Number of numbers on a line; 0: other text.
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
  // Ids in place of the title are missing in the group.
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr || !b.schema->has_title || b.opaque ||
        (b.schema->kind != "grnod" && b.schema->kind != "surf" && b.schema->kind != "line"))
      continue;
    const Line title = LineCursor(c.deck.sources, b).next();
    if (!title.valid() || title.text.find_first_not_of("-0123456789 \t\r") != title.text.npos ||
        count_numbers(title.text) < 2)
      continue;
    r.report(rule, b, title.whole(),
             fmt::format("the title of {} {} consists of numbers; is the title line missing?",
                         b.schema->keyword, b.id.value));
  }
}

void check_title_length(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const Line& title = card.decoded.title_line;
    if (!title.valid() || title.text.size() <= 100) continue;
    r.report(rule, *card.block, title.columns(101, static_cast<int>(title.text.size())),
             fmt::format("the title of {} has {} characters; the solver keeps the first 100",
                         name_of(card), title.text.size()));
  }
}

void check_missing_id(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr || !b.schema->has_id) continue;
    if (b.schema->kind.empty() || b.schema->kind == "other" || b.schema->kind == "parameter")
      continue;
    if (b.schema->bulk) continue;
    const std::string& keyword = b.schema->keyword;
    if (b.id.present) {
      // An interface keeps its zero.
      if (b.schema->kind != "inter" &&
          c.text(b.id.span).find_first_not_of('0') == std::string_view::npos)
        r.report(rule, b, b.id.span, "the id in the header of " + keyword + " is 0");
      continue;
    }
    const std::string_view after = b.header.substr(b.keyword.size());
    const std::string_view field = after.substr(std::min<std::size_t>(1, after.size()));
    const std::string_view text = trim(field.substr(0, field.find('/')));
    if (text.empty())
      r.report(rule, b, b.header_span, keyword + " without an id");
    else
      r.report(rule, b,
               Span{b.header_span.file, static_cast<std::uint32_t>(text.size()),
                    b.header_span.offset + static_cast<std::size_t>(text.data() - b.header.data())},
               fmt::format("'{}' in the header of {} is not an id", clipped(text), keyword));
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
        // Another field of this version can use these columns.
        const bool shared = std::any_of(
            line.schema->fields.begin(), line.schema->fields.end(), [&](const Field& g) {
              return g.in_version(card.block->version) && g.first <= f.last && f.first <= g.last;
            });
        if (shared) continue;
        const bool later = f.from > card.block->version;
        Finding& d = r.report(
            rule, *card.block, span,
            fmt::format("'{}' is in columns where version {} has {}; version {} has no field there",
                        text, later ? f.from : f.until, f.name, card.block->version));
        const bool between = std::any_of(
            line.schema->fields.begin(), line.schema->fields.end(),
            [&](const Field& g) { return g.in_version(card.block->version) && g.first > f.last; });
        if (!between) d.reference = rule.message(100213);
      }
    }
}

void check_old_layout(const LintContext& c, const Rule& rule, Reporter& r) {
  if (c.deck.begin.version_known && c.deck.version < 90)
    r.report(rule, c.deck.begin.version_span,
             "input version " + std::to_string(c.deck.version) +
                 " has other columns, and deck checks little of it");
}

/// Reports keywords whose entities the solver generates (rigid parts, structured meshes).
void check_made_by_solver(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& b : c.deck.blocks) {
    if (b.schema == nullptr) continue;
    if (b.schema->keyword == "/ALE/STRUCTURED_MESH")
      r.report(rule, b, b.header_span,
               std::string(b.header) + ": its nodes and elements are not in the deck");
    if (b.schema->keyword == "/PART" && decode(c.deck, b).integer("Irigid") == 1)
      r.report(rule, b, b.header_span,
               std::string(b.header) +
                   " is a rigid part (Irigid = 1): the rigid body that the solver makes "
                   "of it is not examined");
  }
}

}  // namespace

std::vector<Checked> header_checks() {
  return {{RuleId::DK040, check_unknown},         {RuleId::DK041, check_lower_case},
          {RuleId::DK042, check_engine},          {RuleId::DK044, check_obsolete},
          {RuleId::DK045, check_two_dimensional}, {RuleId::DK094, check_lagrange},
          {RuleId::DK046, check_newer_keyword},   {RuleId::DK060, check_unread_keyword},
          {RuleId::DK061, check_increment},       {RuleId::DK047, check_next_version_field},
          {RuleId::DK048, check_title},           {RuleId::DK049, check_missing_id},
          {RuleId::DK050, check_old_layout},      {RuleId::DK246, check_title_length},
          {RuleId::DK069, check_made_by_solver}};
}

}  // namespace deck::detail
