// Groups losses and refusals of many decks by their causes.
#include "verbs/convert/convert_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "report/shared/text_table.hpp"
#include "verbs/convert/convert_losses.hpp"

namespace deck::cli {
namespace conversion_check {
namespace {

/// Every number as "#": the ids and values of one place.
std::string without_numbers(std::string_view text) {
  std::string out;
  bool in_number = false;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit)
      out += c;
    else if (!in_number)
      out += '#';
    in_number = digit;
  }
  return out;
}

/// "Irem_gap = 2 would be lost" without the value.
std::string without_value(const std::string& field) {
  const auto value = field.find(" = ");
  if (value == field.npos) return field;
  const auto rest = field.find(' ', value + 3);
  return field.substr(0, value) + (rest == field.npos ? "" : field.substr(rest));
}

const char* name_of(Loss loss) {
  switch (loss) {
    case Loss::approximated:
      return "approximated";
    case Loss::dropped:
      return "dropped";
    case Loss::undecided:
      return "undecided";
    case Loss::kept:
      break;
  }
  return "kept";
}

}  // namespace
}  // namespace conversion_check

void ConversionCheck::add_cause(const std::string& deck, const char* kind, const LossEntry& e) {
  std::string field = e.keyword;
  if (!e.field.empty())
    field += (field.empty() ? "" : " ") + conversion_check::without_value(e.field);
  Cause& cause = causes_[{kind, field, conversion_check::without_numbers(e.note)}];
  cause.decks.insert(deck);
  const std::string place = e.file.empty() ? deck : fmt::format("{}:{}", e.file, e.line);
  if (std::string_view(kind) == "undecided" || std::string_view(kind) == "refused") {
    std::string what = e.keyword + (e.id == 0 ? "" : "/" + std::to_string(e.id));
    if (!e.field.empty()) what += (what.empty() ? "" : " ") + e.field;
    if (!e.note.empty()) what += (what.empty() ? "" : ": ") + e.note;
    open_repeats_ |= open_.emplace(place, what).second && cause.times > 0;
  }
  if (cause.times++ > 0) return;
  cause.text = field + (field.empty() || e.note.empty() ? "" : ": ") + e.note;
  cause.place = place;
}

void ConversionCheck::add(const std::string& deck, Outcome outcome,
                          const std::vector<LossEntry>& losses,
                          const std::vector<std::string>& refusals, const std::string& other) {
  decks_[deck] = outcome;
  for (const std::string& refusal : refusals) add_cause(deck, "refused", refused_entry(refusal));
  for (const LossEntry& e : losses)  // those of a refused deck are its refusals
    if (e.loss != Loss::kept && refusals.empty())
      add_cause(deck, e.without_effect ? "without effect" : conversion_check::name_of(e.loss), e);
  if (other.empty()) return;
  LossEntry entry;
  entry.note = other;
  add_cause(deck, outcome == Outcome::unreadable ? "unreadable" : "refused", entry);
}

/// Every place by itself where the table of causes names the first of several only.
std::string ConversionCheck::open_text(bool color, std::size_t width) const {
  if (!open_repeats_) return {};
  constexpr std::size_t most = 40;
  TextTable table({{"left to a person, at"}, {"what"}});
  for (const auto& [place, what] : open_) {
    if (table.size() == most) break;
    table.row({place, what});
  }
  std::string out = table.fitted(width, color);
  if (open_.size() > most)
    out += fmt::format("… and {} more (--report FILE lists all)\n", open_.size() - most);
  return out + "\n";
}

std::string ConversionCheck::text(bool color, std::size_t width, Tense tense) const {
  std::vector<std::pair<std::string, const Cause*>> sorted;
  for (const auto& [key, cause] : causes_) sorted.emplace_back(std::get<0>(key), &cause);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.second->decks.size() > b.second->decks.size();
  });
  TextTable table(
      {{"decks", Align::right}, {"times", Align::right}, {"what"}, {"cause"}, {"first at"}});
  for (const auto& [kind, cause] : sorted) {
    const bool stops = kind == "refused" || kind == "unreadable";
    table.row({std::to_string(cause->decks.size()),
               std::to_string(cause->times),
               {kind, stops                 ? Tone::red
                      : kind == "undecided" ? Tone::yellow
                                            : Tone::plain},
               cause->text,
               cause->place});
  }
  std::string out = table.size() == 0 ? "" : table.fitted(width, color, 0, 3) + "\n";
  out += open_text(color, width);
  std::size_t of[4] = {};
  for (const auto& [deck, outcome] : decks_) ++of[static_cast<std::size_t>(outcome)];
  const std::size_t not_written = of[2] + of[3];
  out += fmt::format("{} of {} {} converted", of[0] + of[1], count(decks_.size(), "deck", "decks"),
                     tense == Tense::can ? "can be" : "were");
  if (of[1] > 0) out += fmt::format(", {} with something to decide by hand", of[1]);
  if (of[2] > 0) out += fmt::format("; {} refused", of[2]);
  if (of[3] > 0) out += fmt::format("; {} cannot be read", of[3]);
  out += ".\n";
  if (not_written > 0 && decks_.size() > 1) {
    out += "Decks of one call are written together or not at all: leave these out:\n";
    for (const auto& [deck, outcome] : decks_)
      if (outcome == Outcome::refused || outcome == Outcome::unreadable)
        out += "  " + terminal_text(deck) + "\n";
  }
  return out;
}

}  // namespace deck::cli
