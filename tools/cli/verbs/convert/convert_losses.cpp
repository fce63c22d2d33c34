// Prints losses, converts refusals to entries, groups both by cause.
#include "verbs/convert/convert_losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "report/shared/text_table.hpp"

namespace deck::cli::verb_convert {
namespace {

bool of_engine_file(const LossEntry& e) { return !starter_of_engine_file(e.file).empty(); }

std::string loss_line(const LossEntry& e) {
  constexpr std::string_view names[] = {"kept", "approximated", "dropped", "undecided"};
  return fmt::format(
      "{}:{}: {}: {}{} {}{}{}{}{}", e.file, e.line, names[static_cast<std::size_t>(e.loss)],
      e.keyword, of_engine_file(e) ? "" : fmt::format("/{}", e.id), e.field,
      e.old_text.empty() ? "" : " " + e.old_text, e.new_text.empty() ? "" : " -> " + e.new_text,
      e.note.empty() ? "" : ": ", e.note);
}

}  // namespace

LossEntry refused_entry(const std::string& refusal) {
  LossEntry entry;
  entry.loss = Loss::undecided;
  entry.note = refusal;
  const auto end = refusal.find(": /");
  const auto column = end == refusal.npos || end == 0 ? end : refusal.rfind(':', end - 1);
  const auto line = column == refusal.npos || column == 0 ? column : refusal.rfind(':', column - 1);
  if (line == refusal.npos) return entry;
  const IntegerCell number =
      read_integer(std::string_view(refusal).substr(line + 1, column - line - 1));
  if (number.status != NumberStatus::ok || number.value < 0) return entry;
  entry.file = refusal.substr(0, line);
  entry.line = static_cast<std::uint64_t>(number.value);
  const auto keyword = end + 2, colon = refusal.find(": ", keyword);
  if (colon == refusal.npos) return entry;
  entry.note = refusal.substr(colon + 2);
  std::string what = refusal.substr(keyword, colon - keyword);
  if (const auto blank = what.find(' '); blank != what.npos) {
    entry.field = what.substr(blank + 1);
    what.resize(blank);
  }
  const auto slash = what.rfind('/');
  const IntegerCell id = read_integer(std::string_view(what).substr(slash + 1));
  if (slash > 0 && id.status == NumberStatus::ok) {
    entry.id = id.value;
    what.resize(slash);
  }
  entry.keyword = what;
  return entry;
}

void print_losses(const std::vector<LossEntry>& losses, const CommonOptions& common) {
  if (common.quiet || losses.empty()) return;
  std::map<std::string, std::size_t> alike;  // losses without effect, by keyword, field and reason
  const auto kind = [](const LossEntry& e) { return e.keyword + " " + e.field + ": " + e.note; };
  for (const LossEntry& e : losses)
    if (e.without_effect) ++alike[kind(e)];
  constexpr std::size_t most = 40;
  std::size_t shown = 0, hidden = 0;
  for (const LossEntry& e : losses) {
    std::size_t* same = e.without_effect ? &alike[kind(e)] : nullptr;
    if (e.loss == Loss::kept || (same != nullptr && *same == 0)) continue;
    const std::size_t others = same == nullptr ? 0 : std::exchange(*same, 0) - 1;
    if (shown++ >= most) {
      hidden += 1 + others;
      continue;
    }
    print_messages(terminal_text(loss_line(e)) +
                   (others == 0 ? "\n" : fmt::format(" (and {} more of these)\n", others)));
  }
  if (hidden > 0) print_messages(fmt::format("... and {} more; --report FILE lists all\n", hidden));
  print_loss_counts(losses);
}

void print_loss_counts(const std::vector<LossEntry>& losses) {
  if (losses.empty()) return;
  std::size_t count[4] = {};
  for (const LossEntry& e : losses) ++count[static_cast<std::size_t>(e.loss)];
  print_messages(fmt::format("deck: kept {}, approximated {}, dropped {}, undecided {}\n", count[0],
                             count[1], count[2], count[3]));
}

// ---- by causes

namespace {

/// Replaces every number by "#".
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

/// Removes the value from "Irem_gap = 2 would be lost".
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

void ConversionCheck::add_cause(const std::string& deck, const char* kind, const LossEntry& e) {
  std::string field = e.keyword;
  if (!e.field.empty()) field += (field.empty() ? "" : " ") + without_value(e.field);
  Cause& cause = causes_[{kind, field, without_numbers(e.note)}];
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
  for (const LossEntry& e : losses)  // losses of a refused deck are its refusals
    if (e.loss != Loss::kept && refusals.empty())
      add_cause(deck, e.without_effect ? "without effect" : name_of(e.loss), e);
  if (other.empty()) return;
  LossEntry entry;
  entry.note = other;
  add_cause(deck, outcome == Outcome::unreadable ? "unreadable" : "refused", entry);
}

/// All places of causes that the table lists once.
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

}  // namespace deck::cli::verb_convert
