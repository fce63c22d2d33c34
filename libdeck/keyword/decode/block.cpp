// decode(): which line of a block is which card, by conditions, counts and repetitions.
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

/// One decode() call: the state that its steps share.
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
      } else if (holds(card) && !read_card(card)) {
        break;
      }
    }
    report_missing();
    read_extra(*schema);
    return std::move(out_);
  }

  /// Behind run(): the cards that the block ends before although it should have them.
  std::vector<const CardSchema*> missing() { return std::move(missing_); }

 private:
  void read_title(const Schema& schema) {
    if (schema.has_title) {
      out_.title_line = cursor_.next();
      out_.title = std::string(detail::trim_right(out_.title_line.text.substr(0, line_columns)));
    }
  }

  /// The cells that conditions look at: those of the same round first, then the cards before.
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

  /// Data lines of the block behind its title.
  std::int64_t data_lines() {
    if (lines_ < 0) {
      LineCursor cursor(deck_.sources, block_);
      lines_ = block_.schema->has_title ? -1 : 0;
      while (cursor.next().valid()) ++lines_;
      lines_ = std::max<std::int64_t>(lines_, 0);
    }
    return lines_;
  }

  /// True if the card has a line here. A line none of whose cells is read does not exist.
  bool holds(const CardSchema& card, std::size_t once, std::size_t round) {
    const auto all = [&](const std::vector<Condition>& when) {
      return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
        return c.field == Condition::data_lines ? c.holds(data_lines())
                                                : detail::holds(c, search(c.field, once, round));
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
  bool holds(const CardSchema& card) { return holds(card, out_.cards.size(), out_.cards.size()); }

  void add(const CardSchema& card, const Line& line, std::size_t once, std::size_t round,
           int number = 0, int cells = 0) {
    const std::function<std::int64_t(std::string_view)> value = [&](std::string_view field) {
      return value_of(field, once, round);
    };
    out_.cards.push_back(decode_in_context(deck_, block_, card, line, findings_, {&value, cells}));
    out_.cards.back().round = number;
  }

  /// A card that is no group. False if it took all lines to the end of the block.
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
      // The first line is one of words, whatever it begins with.
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

  /// `round`: the first card of what repeats and is cut short.
  void note_missing(const CardSchema& card, const DecodedCard* round = nullptr) {
    missing_.push_back(&card);
    if (round != nullptr) broken_round_ = round->line;
  }

  /// One finding for all of them. It is a remark where the missing lines are the last ones of a
  /// property, a load or another block without a list: blank lines would mean the same there.
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

  /// True if a round has a line with text: blank lines at the end of a block begin none.
  bool says_something(std::size_t round) const {
    return std::any_of(out_.cards.begin() + static_cast<std::ptrdiff_t>(round), out_.cards.end(),
                       [](const DecodedCard& card) { return !trim(card.line.text).empty(); });
  }

  /// Cards that repeat. True if they take all lines to the end of the block.
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
        if (!holds(card, once, round)) continue;
        const Line line = cursor_.next();
        if (!line.valid()) {
          if ((counted || says_something(round)) && !card.optional)
            note_missing(card, out_.cards.size() > round ? &out_.cards[round] : nullptr);
          return true;
        }
        add(card, line, once, round, static_cast<int>(std::min<std::int64_t>(number, 1 << 30)));
      }
      // A round with all conditions false takes no line.
      if (out_.cards.size() == round) return false;
    }
    return false;
  }

  void read_extra(const Schema& schema) {
    for (Line line = cursor_.next(); line.valid(); line = cursor_.next())
      out_.extra.push_back(line);
    if (!noted_.on() || schema.opaque_tail || schema.cards.empty()) return;
    if (!detail::reads_lines(schema, block_.version)) return;  // DK060 says so
    // One finding for all of them: a text that lost its comment mark has many lines.
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
  std::int64_t lines_ = -1;  ///< data lines of the block, once they are counted
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

bool detail::holds(const Condition& c, const Cell* cell) {
  if (c.words.empty()) return c.holds(cell != nullptr ? cell->integer : 0);
  return cell != nullptr && std::any_of(c.words.begin(), c.words.end(), [&](const auto& word) {
           return in_capitals(cell->text) == in_capitals(word);
         });
}

bool holds(const std::vector<Condition>& when, const DecodedBlock& block, const DecodedCard* card) {
  return std::all_of(when.begin(), when.end(), [&](const Condition& c) {
    return detail::holds(c, detail::cell_beside(block, card, c.field));
  });
}

Dimension dimension_of(const Field& field, const DecodedBlock& block, const DecodedCard* card) {
  for (const auto& [when, dimension] : field.dimension_when)
    if (holds(when, block, card)) return dimension;
  return field.dimension;
}

double working_value(const Deck& deck, const DecodedBlock& block, const Cell& cell,
                     const DecodedCard* card) {
  const UnitSystem* units = deck.units_of(*block.block);
  if (units == nullptr || cell.field == nullptr) return cell.real;
  const Field& f = *cell.field;
  const bool own = f.solver_dimension && holds(f.solver_when, block, card);
  return cell.real * conversion_factor(*units, deck.begin.working,
                                       own ? *f.solver_dimension : dimension_of(f, block, card));
}

double working_value(const Deck& deck, const DecodedBlock& block, std::string_view field) {
  const Cell* cell = block.find(field);
  return cell == nullptr ? 0 : working_value(deck, block, *cell);
}

}  // namespace deck
