// decode(): assigns the data lines of a block to the cards of its schema. Cards are visited in
// order. A card whose conditions fail for the cells read so far has no line; otherwise it takes the
// next line. A group repeats as often as its count cell says, or to the end of the block. Example:
// if the condition of the third of four cards fails, lines 1, 2, 3 belong to cards 1, 2, 4. Cost:
// one pass over the lines.
#include <algorithm>
#include <span>

#include "base/shared/words.hpp"
#include "keyword/shared/card_forms.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/reader.hpp"
#include "keyword/shared/schema_facts.hpp"

namespace deck {
namespace {

using detail::BlockFindings;
using detail::decode_in_context;
using detail::line_columns;
using detail::trim;

/// One call of decode().
class BlockDecoder {
 public:
  BlockDecoder(const Deck& deck, const Block& block, Findings* findings)
      : deck_(deck),
        block_(block),
        findings_(findings),
        noted_(findings, block),
        cursor_(deck.sources, block) {
    out_.block = &block;
  }

  DecodedBlock run() {
    const Schema* schema = block_.schema;
    if (schema == nullptr) return std::move(out_);
    read_title(*schema);
    if (block_.opaque) return std::move(out_);
    for (std::size_t i = 0; i < schema->cards.size(); ++i) {
      const CardSchema& card = schema->cards[i];
      if (card.repeat == Repeat::group) {
        std::size_t count = 1;
        while (i + count < schema->cards.size() &&
               schema->cards[i + count].repeat == Repeat::group &&
               schema->cards[i + count].count == card.count)
          ++count;
        const bool to_the_end = read_group({schema->cards.data() + i, count});
        if (to_the_end) break;
        i += count - 1;
      } else if (is_met(card) && !read_card(card)) {
        break;
      }
    }
    report_missing();
    read_extra(*schema);
    return std::move(out_);
  }

  /// After run(): cards without a line that the block should have.
  std::vector<const CardSchema*> missing() { return std::move(missing_); }

 private:
  void read_title(const Schema& schema) {
    if (schema.has_title) {
      out_.title_line = cursor_.next();
      out_.title = std::string(detail::trim_right(out_.title_line.text.substr(0, line_columns)));
    }
  }

  /// Cells for conditions: those of the same repetition first, then earlier cards.
  const Cell* search(std::string_view field, std::size_t once, std::size_t round) const {
    for (std::size_t k = out_.cards.size(); k-- > round;)
      if (const Cell* cell = detail::cell_named(out_.cards[k], field)) return cell;
    for (std::size_t k = 0; k < once; ++k)
      if (const Cell* cell = detail::cell_named(out_.cards[k], field)) return cell;
    return nullptr;
  }

  std::int64_t value_of(std::string_view field, std::size_t once, std::size_t round) {
    if (field == Condition::data_lines) return data_lines();
    const Cell* cell = search(field, once, round);
    return cell ? cell->integer : 0;
  }

  /// Number of data lines after the title.
  std::int64_t data_lines() {
    if (lines_ < 0) {
      LineCursor cursor(deck_.sources, block_);
      lines_ = block_.schema->has_title ? -1 : 0;
      while (cursor.next().valid()) ++lines_;
      lines_ = std::max<std::int64_t>(lines_, 0);
    }
    return lines_;
  }

  /// True if the card has a line here. A line without any active cell does not exist.
  bool is_met(const CardSchema& card, std::size_t once, std::size_t round) {
    const auto all = [&](const std::vector<Condition>& when) {
      return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
        return c.field == Condition::data_lines ? c.accepts(data_lines())
                                                : detail::is_met(c, search(c.field, once, round));
      });
    };
    if (!card.in_version(block_.version) || !all(card.when)) return false;
    bool any = false;
    for (const Field& f : card.fields) {
      if (!f.in_version(block_.version)) continue;
      if (f.when.empty() || all(f.when)) return true;
      any = true;
    }
    return !any;
  }
  bool is_met(const CardSchema& card) { return is_met(card, out_.cards.size(), out_.cards.size()); }

  void add(const CardSchema& card, const Line& line, std::size_t once, std::size_t round,
           int number = 0, int cells = 0) {
    const auto of_field = [&](std::string_view field) { return value_of(field, once, round); };
    const std::function<std::int64_t(std::string_view)> value = std::ref(of_field);
    out_.cards.push_back(decode_in_context(deck_, block_, card, line, findings_, {&value, cells}));
    out_.cards.back().round = number;
  }

  /// Reads a card outside of groups. False: it took all remaining lines.
  bool read_card(const CardSchema& card) {
    const std::size_t once = out_.cards.size();
    if (card.repeat == Repeat::once) {
      const Line line = cursor_.next();
      if (!line.valid() && card.optional) return true;
      if (!line.valid()) note_missing(card);
      add(card, line, once, once);
      return true;
    }
    if (card.words) {
      // The first line is a line of words, whatever its first character.
      bool first = true;
      for (LineCursor ahead = cursor_;; cursor_ = ahead, first = false) {
        const Line line = ahead.next();
        if (!line.valid() || (!first && !begins_with_word(line.text))) return true;
        add(card, line, once, once);
      }
    }
    if (card.repeat == Repeat::ids && !card.count.empty()) {
      const std::int64_t count = count_of(card, once);
      int number = 0;
      for (std::int64_t done = 0; done < count; done += card.per_line) {
        const Line line = cursor_.next();
        if (!line.valid()) {
          if (!card.optional) note_missing(card);
          return true;
        }
        add(card, line, once, once, ++number,
            static_cast<int>(std::min<std::int64_t>(card.per_line, count - done)));
      }
      return true;
    }
    return !read_group({&card, 1});
  }

  static bool begins_with_word(std::string_view text) {
    const std::string_view word = trim(text.substr(0, 10));
    return !word.empty() && std::isalpha(static_cast<unsigned char>(word.front())) != 0;
  }

  std::int64_t count_of(const CardSchema& card, std::size_t once) {
    const IntegerCell number = read_integer(card.count);
    return number.status == NumberStatus::ok ? number.value : value_of(card.count, once, once);
  }

  /// `round`: first card of an incomplete repetition.
  void note_missing(const CardSchema& card, const DecodedCard* round = nullptr) {
    missing_.push_back(&card);
    if (round != nullptr) broken_round_ = round->line;
  }

  /// One finding for all missing lines. It is an info if they are the last lines of a property,
  /// load or another block without lists: blank lines would have the same effect.
  void report_missing() {
    if (missing_.empty() || !noted_.wants(RuleId::DK029)) return;
    const CardSchema& card = *missing_.front();
    std::string text = std::string(block_.keyword) + " ends before its line '" + card.name + "'";
    for (const Condition& c : card.when) {
      const Cell* cause = out_.find(c.field);
      text += " (present because " + c.field + " = " +
              (cause == nullptr || cause->blank() ? "0" : std::string(cause->text)) + ")";
    }
    if (const std::size_t more = missing_.size() - 1; more > 0)
      text += " and " + std::to_string(more) + (more == 1 ? " more line" : " more lines");
    Overrides overrides;
    if (!broken_round_ && block_.schema->opaque_tail) overrides.severity = Severity::info;
    Finding* d =
        noted_.keep(RuleId::DK029, block_.header_span, std::move(text), std::move(overrides));
    for (const Condition& c : card.when)
      if (const Cell* cause = out_.find(c.field))
        d->notes.emplace_back(cause->span, c.field + " asks for the line");
    if (broken_round_)
      d->notes.emplace_back(broken_round_->whole(), "the incomplete part begins here");
  }

  /// True if a repetition has a line with text: blank lines at the end of a block start none.
  bool has_content(std::size_t round) const {
    return std::any_of(out_.cards.begin() + static_cast<std::ptrdiff_t>(round), out_.cards.end(),
                       [](const DecodedCard& card) { return !trim(card.line.text).empty(); });
  }

  /// Reads repeated cards. True: they took all remaining lines.
  bool read_group(std::span<const CardSchema> group) {
    if (std::none_of(group.begin(), group.end(),
                     [&](const CardSchema& c) { return c.in_version(block_.version); }))
      return false;
    const std::size_t once = out_.cards.size();
    const bool counted = !group[0].count.empty();
    const std::int64_t rounds = counted ? count_of(group[0], once) : 0;
    for (std::int64_t number = 1; !counted || number <= rounds; ++number) {
      const std::size_t round = out_.cards.size();
      for (const CardSchema& card : group) {
        if (!is_met(card, once, round)) continue;
        const Line line = cursor_.next();
        if (!line.valid()) {
          if ((counted || has_content(round)) && !card.optional)
            note_missing(card, out_.cards.size() > round ? &out_.cards[round] : nullptr);
          return true;
        }
        add(card, line, once, round, static_cast<int>(std::min<std::int64_t>(number, 1 << 30)));
      }
      // If all conditions of a repetition are false, it has no line.
      if (out_.cards.size() == round) return false;
    }
    return false;
  }

  void read_extra(const Schema& schema) {
    for (Line line = cursor_.next(); line.valid(); line = cursor_.next())
      out_.extra.push_back(line);
    if (!noted_.on() || schema.opaque_tail || schema.cards.empty()) return;
    if (!detail::reads_lines(schema, block_.version)) return;  // DK060 reports this
    // One finding for all: text without its comment mark may have many lines.
    const auto blank = [](const Line& line) { return trim(line.text).empty(); };
    const auto first = std::find_if_not(out_.extra.begin(), out_.extra.end(), blank);
    if (first == out_.extra.end() || !noted_.wants(RuleId::DK030)) return;
    const auto more = out_.extra.end() - first - std::count_if(first, out_.extra.end(), blank) - 1;
    noted_.keep(
        RuleId::DK030, first->whole(),
        std::string(block_.keyword) + " is complete; this line is extra" +
            (more > 0 ? ", and " + std::to_string(more) + " more follow" : ""),
        {.fix =
             "check the flags that ask for optional lines, then delete the line or set the flag"});
  }

  const Deck& deck_;
  const Block& block_;
  Findings* findings_;
  BlockFindings noted_;
  LineCursor cursor_;
  DecodedBlock out_;
  std::vector<const CardSchema*> missing_;
  std::optional<Line> broken_round_;
  std::int64_t lines_ = -1;  ///< number of data lines once counted, else -1
};

}  // namespace

DecodedBlock decode(const Deck& deck, const Block& block, Findings* findings) {
  if (findings != nullptr && detail::report_missing_blank_lines(deck, block, *findings))
    findings = nullptr;
  return BlockDecoder(deck, block, findings).run();
}

std::vector<const CardSchema*> detail::missing_cards(const Deck& deck, const Block& block) {
  BlockDecoder decoder(deck, block, nullptr);
  decoder.run();
  return decoder.missing();
}

const Cell* detail::cell_named(const DecodedCard& card, std::string_view field) {
  for (const Cell& cell : card.cells)
    if (cell.field->name == field) return &cell;
  return nullptr;
}

const Cell* detail::cell_beside(const DecodedBlock& block, const DecodedCard* line,
                                std::string_view field) {
  if (line == nullptr) return block.find(field);
  if (const Cell* cell = cell_named(*line, field)) return cell;
  for (const int round : {line->round, 0})
    for (const DecodedCard& card : block.cards)
      if (card.round == round)
        if (const Cell* cell = cell_named(card, field)) return cell;
  return nullptr;
}

bool detail::is_met(const Condition& c, const Cell* cell) {
  if (c.words.empty()) return c.accepts(cell != nullptr ? cell->integer : 0);
  return cell != nullptr && std::any_of(c.words.begin(), c.words.end(), [&](const auto& word) {
           return in_capitals(cell->text) == in_capitals(word);
         });
}

bool is_met(const std::vector<Condition>& when, const DecodedBlock& block,
            const DecodedCard* card) {
  return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
    return detail::is_met(c, detail::cell_beside(block, card, c.field));
  });
}

Dimension dimension_of(const Field& field, const DecodedBlock& block, const DecodedCard* card) {
  for (const auto& [when, dimension] : field.dimension_when)
    if (is_met(when, block, card)) return dimension;
  return field.dimension;
}

double working_value(const Deck& deck, const DecodedBlock& block, const Cell& cell,
                     const DecodedCard* card) {
  const UnitSystem* units = deck.units_of(*block.block);
  if (units == nullptr || cell.field == nullptr) return cell.real;
  const Field& f = *cell.field;
  const bool own = f.solver_dimension && is_met(f.solver_when, block, card);
  return cell.real * conversion_factor(*units, deck.begin.working,
                                       own ? *f.solver_dimension : dimension_of(f, block, card));
}

double working_value(const Deck& deck, const DecodedBlock& block, std::string_view field) {
  const Cell* cell = block.find(field);
  return cell == nullptr ? 0 : working_value(deck, block, *cell);
}

}  // namespace deck
