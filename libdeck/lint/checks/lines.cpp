// Optional lines: a flag without its line, or a line without its flag. The solver then reads all
// later lines as the wrong cards, so the message names the flag.
#include <algorithm>
#include <optional>
#include <vector>

#include "lint/check.hpp"

namespace deck::detail {
namespace {

/// Card of the release flags (IBC, Inacti) of an interface, and its position.
struct Flags {
  std::size_t index = 0;
  const DecodedCard* card = nullptr;
};

std::optional<Flags> flags_card(const DecodedBlock& block) {
  for (std::size_t i = 0; i < block.cards.size(); ++i)
    if (cell_named(block.cards[i], "IBCX") != nullptr) return Flags{i, &block.cards[i]};
  return std::nullopt;
}

char column(std::string_view text, std::size_t c) { return c <= text.size() ? text[c - 1] : ' '; }

bool blank_columns(std::string_view text, std::size_t first, std::size_t last) {
  for (std::size_t c = first; c <= last; ++c)
    if (static_cast<unsigned char>(column(text, c)) > ' ') return false;
  return true;
}

/// Result of the test for a line with IBC: before column 31 only columns 8-10 have text.
enum class Look { no, maybe, yes };
Look looks_like_flags(const Line& line) {
  if (!line.valid()) return Look::no;
  if (!blank_columns(line.text, 1, 7) || !blank_columns(line.text, 11, 30)) return Look::no;
  int digits = 0;
  for (std::size_t c = 8; c <= 10; ++c) {
    const char k = column(line.text, c);
    if (k >= '0' && k <= '9')
      ++digits;
    else if (static_cast<unsigned char>(k) > ' ')
      return Look::no;
  }
  return digits >= 2 ? Look::yes : Look::maybe;
}

/// Optional cards of the schema at this version, with the flag that requires each.
struct Optional {
  const CardSchema* card = nullptr;
  std::string flag;
  bool present = false;
  std::int64_t wants = 0;  ///< a value of the flag that requires the line
};

std::vector<Optional> optional_cards(const ContactCard& contact) {
  std::vector<Optional> out;
  for (const CardSchema& card : contact.block->schema->cards) {
    if (!card.in_version(contact.block->version) || card.when.empty()) continue;
    const Condition& when = card.when.front();
    Optional o;
    o.card = &card;
    o.flag = when.field;
    o.present = when.accepts(contact.decoded.integer(when.field));
    o.wants = !when.in.empty() ? when.in.front() : when.min.value_or(1);
    out.push_back(std::move(o));
  }
  return out;
}

std::size_t missing_lines(const DecodedBlock& block) {
  return static_cast<std::size_t>(std::count_if(block.cards.begin(), block.cards.end(),
                                                [](const DecodedCard& c) { return c.missing(); }));
}

std::size_t extra_lines(const DecodedBlock& block) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < block.extra.size(); ++i)
    if (!trim(block.extra[i].text).empty()) last = i + 1;
  return last;
}

bool second_line_missing(const ContactCard& contact) {
  const auto flags = flags_card(contact.decoded);
  return contact.type == 11 && contact.block->version >= 110 && flags && flags->index == 3 &&
         looks_like_flags(flags->card->line) != Look::yes &&
         looks_like_flags(contact.decoded.cards[2].line) == Look::yes;
}

bool second_line_extra(const ContactCard& contact) {
  const auto flags = flags_card(contact.decoded);
  if (contact.type != 11 || contact.block->version >= 110 || !flags || flags->index != 2)
    return false;
  if (looks_like_flags(flags->card->line) == Look::yes || contact.decoded.extra.empty())
    return false;
  return looks_like_flags(contact.decoded.extra.front()) == Look::yes;
}

void check_second_line(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const bool missing = second_line_missing(card);
    if (!missing && !second_line_extra(card)) return;
    Finding& d = r.report(
        rule, *card.block, card.decoded.cards[1].line.whole(),
        missing ? fmt::format("{} lacks its second line (Stmin, Stmax, ...), which exists from "
                              "version 110 on; this deck is of version {}",
                              name_of(card), card.block->version)
                : fmt::format("{} has a second line (Stmin, Stmax, ...), which exists from version "
                              "110 on only; this deck is of version {}",
                              name_of(card), card.block->version));
    if (!missing) d.help = "Delete the line, or raise the version in /BEGIN.";
    if (missing) {
      Span at = card.decoded.cards[1].line.whole();
      at.length = 0;
      // Line end of the previous line.
      const std::string_view before = c.deck.sources[at.file].bytes().substr(0, at.offset);
      const char* const end = before.ends_with("\r\n") ? "\r\n" : "\n";
      d.fix = Fix{"insert a blank second line", false, {{at, end}}};
    }
  });
}

void check_missing(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const std::size_t missing = missing_lines(card.decoded);
    if (missing == 0 || second_line_missing(card)) continue;
    std::string causes;
    std::vector<std::string> flags;
    for (const Optional& o : optional_cards(card)) {
      if (!o.present) continue;
      const bool again = !flags.empty() && flags.back() == o.flag;
      causes += again ? " and" : (causes.empty() ? "" : "; ") + card.show(o.flag) + " asks for";
      causes += " '" + o.card->name + "'";
      if (!again) flags.push_back(o.flag);
    }
    if (causes.empty()) continue;
    Finding& d = r.report(rule, *card.block, card.block->header_span,
                          fmt::format("{} is {} line{} short: {}", name_of(card), missing,
                                      missing > 1 ? "s" : "", causes));
    for (const std::string& f : flags) note_field(d, card, f);
  }
}

void check_extra(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const std::size_t extra = extra_lines(card.decoded);
    if (extra == 0 || second_line_extra(card)) continue;
    std::string causes;
    for (const Optional& o : optional_cards(card))
      if (!o.present)
        causes += (causes.empty() ? "" : ", ") + std::string("'") + o.card->name + "' with " +
                  o.flag + " = " + std::to_string(o.wants);
    if (causes.empty()) continue;
    r.report(rule, *card.block, card.decoded.extra.front().whole(),
             fmt::format("{} has {} extra line{}; optional lines that its flags do not ask for: {}",
                         name_of(card), extra, extra > 1 ? "s" : "", causes));
  }
}

/// True if the line of the release flags has cells in columns that are blank in most types.
bool has_cells_behind(const CardSchema& flags, int version) {
  return std::any_of(flags.fields.begin(), flags.fields.end(), [&](const Field& f) {
    return f.in_version(version) && f.first > 10 && f.first <= 30;
  });
}

void check_shift(const LintContext& c, const Rule& rule, Reporter& r) {
  for_each_contact(c, rule, [&](const ContactCard& card) {
    const auto flags = flags_card(card.decoded);
    if (!flags || !flags->card->line.valid() || flags->card->free_format) return;
    if (has_cells_behind(*flags->card->schema, card.block->version)) return;
    if (looks_like_flags(flags->card->line) == Look::yes) return;
    if (second_line_missing(card) || second_line_extra(card)) return;
    const auto& cards = card.decoded.cards;
    const std::size_t i = flags->index;
    const bool above = i > 0 && looks_like_flags(cards[i - 1].line) == Look::yes;
    const Line next = i + 1 < cards.size()         ? cards[i + 1].line
                      : card.decoded.extra.empty() ? Line{}
                                                   : card.decoded.extra.front();
    const bool below = looks_like_flags(next) == Look::yes;
    if (!above && !below && looks_like_flags(flags->card->line) == Look::maybe) return;
    std::string message = fmt::format("the line read as '{}' of {} does not look like that line: ",
                                      flags->card->schema->name, name_of(card));
    message += above   ? "the line above does, so a line is missing before it"
               : below ? "the line below does, so there is an extra line before it"
                       : "there are data in columns 1-7 or 11-30";
    Finding& d = r.report(rule, *card.block, flags->card->line.whole(), std::move(message));
    for (const Optional& o : optional_cards(card))
      if (o.present && above) note_field(d, card, o.flag);
  });
}

/// Versions up to 100 read heat before adaptive meshing, later versions after it.
void check_order(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const ContactCard& card : c.contacts) {
    const DecodedCard *adaptive = nullptr, *heat = nullptr;
    for (const DecodedCard& line : card.decoded.cards) {
      if (cell_named(line, "NRadm") != nullptr) adaptive = &line;
      if (cell_named(line, "Kthe") != nullptr || cell_named(line, "Rthe") != nullptr) heat = &line;
    }
    if (adaptive == nullptr || heat == nullptr || adaptive->missing() || heat->missing()) continue;
    // NRadm is an integer in columns 1-10; a coefficient in 1-20 exceeds column 10.
    const std::string_view first = adaptive->line.text, second = heat->line.text;
    const bool heat_like = blank_columns(first, 1, 10) && !blank_columns(first, 11, 20);
    const bool adaptive_like = !blank_columns(second, 1, 10);
    if (!heat_like || !adaptive_like) continue;
    r.report(rule, *card.block, adaptive->line.whole(),
             fmt::format("the lines of adaptive meshing and heat exchange of {} seem to be "
                         "swapped: version {} reads {} first",
                         name_of(card), card.block->version,
                         card.block->version < 110 ? "heat exchange" : "adaptive meshing"));
  }
}

}  // namespace

std::vector<Checked> line_checks() {
  return {{RuleId::DK240, check_missing},
          {RuleId::DK241, check_extra},
          {RuleId::DK242, check_second_line},
          {RuleId::DK243, check_shift},
          {RuleId::DK244, check_order}};
}

}  // namespace deck::detail
