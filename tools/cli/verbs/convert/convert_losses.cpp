// Writes the lines about lost values, and reads refusals back into entries.
#include "verbs/convert/convert_losses.hpp"

#include <fmt/format.h>

#include <map>
#include <string_view>
#include <utility>

#include "base/shared/escape.hpp"
#include "deck/keyword/engine_file.hpp"
#include "deck/text/number.hpp"

namespace deck::cli {
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
  std::map<std::string, std::size_t> alike;  // without effect, by keyword, field and reason
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

}  // namespace deck::cli
