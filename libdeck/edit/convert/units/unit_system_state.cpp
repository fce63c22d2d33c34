// Puts converted numbers into cells and notes what could not be converted.
#include "edit/convert/units/unit_system_state.hpp"

#include <algorithm>

#include "deck/text/number.hpp"
#include "deck/text/rule_id.hpp"
#include "keyword/shared/line_check.hpp"
#include "text/shared/columns.hpp"
#include "text/shared/edits.hpp"

namespace deck::detail {

void UnitConversion::undecided(const Block& block, Span place, std::string field, std::string why) {
  leave_undecided(out, deck, block, place, std::move(field), std::move(why), options.partial);
  if (options.partial) left.insert(&block);
}

UnitConversion::OpenShare::OpenShare(UnitConversion& c, const Block& block)
    : c_(c), block_(block), share_{c.out.edits.size(), 0, c.out.losses.size(), 0} {}

UnitConversion::OpenShare::~OpenShare() {
  share_.edits_end = c_.out.edits.size();
  share_.losses_end = c_.out.losses.size();
  if (share_.edits_end > share_.edits || share_.losses_end > share_.losses)
    c_.shares.emplace(&block_, share_);
}

UnitConversion::Place UnitConversion::place_of(const Block& block, const DecodedCard& card,
                                               const Cell& cell) {
  Place place{&block,           cell.span,       cell.field->name, card.line, cell.field->first,
              cell.field->last, card.free_format};
  // The cells of a list stand side by side; the field has the columns of the first.
  if (card.schema->repeat == Repeat::ids && !card.free_format) {
    const int shift = static_cast<int>(cell.span.offset - card.line.offset) + 1 - place.first;
    place.first += shift;
    place.last += shift;
  }
  return place;
}

bool UnitConversion::put(const Place& place, const std::string& text) {
  if (!place.free_format) {
    if (static_cast<int>(text.size()) > place.last - place.first + 1) return false;
    replace_fixed(place.line, place.first, place.last, text);
    return true;
  }
  if (place.line.text.size() + text.size() > line_columns + std::size_t{place.span.length})
    return false;
  out.edits.push_back({place.span, text});
  return true;
}

void UnitConversion::leave_blocks() {
  std::vector<bool> edit_goes(out.edits.size()), loss_goes(out.losses.size());
  for (const Block* block : left) {
    const auto [first, last] = shares.equal_range(block);
    for (auto share = first; share != last; ++share) {
      const Share& s = share->second;
      for (std::size_t i = s.edits; i < s.edits_end; ++i) edit_goes[i] = true;
      for (std::size_t i = s.losses; i < s.losses_end; ++i)
        loss_goes[i] = out.losses[i].loss != Loss::undecided;
    }
  }
  const auto keep = [](auto& list, const std::vector<bool>& goes) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!goes[i]) {
        if (to != i) list[to] = std::move(list[i]);
        ++to;
      }
    list.resize(to);
  };
  keep(out.edits, edit_goes);
  keep(out.losses, loss_goes);
}

void UnitConversion::changed(const Block& block, Span place, std::string_view field,
                             std::string_view before, const ScaledText& after, int width) {
  ++changed_cells;
  if (after.exact) return;
  LossEntry entry = loss_entry(deck, Loss::approximated, block, place);
  entry.field = std::string(field);
  entry.old_text = std::string(before);
  entry.new_text = after.text;
  entry.note = std::to_string(width) + " columns hold no more digits; converting back gives a " +
               "slightly different value";
  out.losses.push_back(std::move(entry));
}

void UnitConversion::replace_fixed(const Line& line, int first, int last, std::string_view text) {
  out.edits.push_back(CellWriter::edit_in_place(deck.sources, line.whole(), first, last, text));
}

void UnitConversion::convert_fixed(const Block& block, const Line& line, int first, int last,
                                   std::string_view field, const UnitFactor& factor) {
  const std::string_view token = trim(columns(line.text, first, last));
  if (token.empty() || factor.one()) return;
  const Span place = line.columns(first, last);
  const RealCell value = read_real(token);
  if (value.status == NumberStatus::ok && value.value == 0) return;
  const int width = last - first + 1;
  const auto text = scale_text(token, width, factor);
  if (!text) {
    undecided(block, place, std::string(field),
              value.status == NumberStatus::ok || value.status == NumberStatus::implicit_exponent
                  ? "the converted value does not fit its columns"
                  : "'" + std::string(token) + "' is not a plain number");
    return;
  }
  replace_fixed(line, first, last, text->text);
  changed(block, place, field, token, *text, width);
}

void UnitConversion::convert_free(const Block& block, const Line& line, Span cell,
                                  std::string_view field, const UnitFactor& factor) {
  const std::string_view token = deck.sources.text(cell);
  if (token.empty() || factor.one() || read_real(token).value == 0) return;
  const auto key = (std::uint64_t{line.file} << 40) ^ line.offset;
  int& spare = spare_
                   .try_emplace(key, line_columns - static_cast<int>(std::min<std::size_t>(
                                                        line.text.size(), line_columns)))
                   .first->second;
  constexpr int enough = 24;  // every double fits
  const int width = std::min(enough, static_cast<int>(token.size()) + spare);
  const auto text = scale_text(token, width, factor);
  if (!text) {
    undecided(block, cell, std::string(field),
              "the converted value makes this free-format line longer than 100 columns, or '" +
                  std::string(token.substr(0, 30)) + "' is not a plain number");
    return;
  }
  spare -= static_cast<int>(text->text.size()) - static_cast<int>(token.size());
  out.edits.push_back({cell, text->text});
  changed(block, cell, field, token, *text, width);
}

void UnitConversion::note_dimension(const Dimension& d, const UnitFactor& factor) {
  std::string name;
  const auto add = [&](const char* base, int exponent) {
    if (exponent == 0) return;
    name += (name.empty() ? "" : " ") + std::string(base);
    if (exponent != 1) name += "^" + std::to_string(exponent);
  };
  add("mass", d.mass);
  add("length", d.length);
  add("time", d.time);
  if (used_factors.contains(name)) return;
  const auto value = format_real(static_cast<double>(factor.value), 24);
  used_factors[name] = factor.power ? "1e" + std::to_string(*factor.power)
                                    : (value ? value->text : std::string("?"));
}

std::vector<std::string> unread_files(const Deck& deck) {
  std::vector<std::string> refusals;
  for (const Diagnostic& d : deck.diagnostics.all())
    if (d.rule == RuleId::DK004 || d.rule == RuleId::DK005 || d.rule == RuleId::DK006)
      refusals.push_back((d.span.valid() ? deck.sources.where(d.span) : deck.sources[0].path()) +
                         ": " + d.message);
  return refusals;
}

std::vector<std::string> contradicting_copies(const SourceSet& sources,
                                              const std::vector<TextEdit>& edits) {
  std::map<std::string, std::vector<std::uint32_t>> files;
  for (std::uint32_t f = 0; f < sources.size(); ++f) files[sources[f].path()].push_back(f);
  std::map<std::uint32_t, std::map<std::pair<std::uint64_t, std::uint32_t>, std::string>> by_file;
  for (const auto& [path, copies] : files)
    if (copies.size() > 1)
      for (const std::uint32_t f : copies) by_file[f];
  std::vector<std::string> refusals;
  if (by_file.empty()) return refusals;
  for (const TextEdit& e : edits)
    if (const auto it = by_file.find(e.span.file); it != by_file.end())
      it->second[{e.span.offset, e.span.length}] = e.text;
  for (const auto& [path, copies] : files)
    for (std::size_t i = 1; i < copies.size(); ++i)
      if (by_file[copies[i]] != by_file[copies[0]]) {
        refusals.push_back(path +
                           ":1:1: included more than once and would have to become two different "
                           "files; give the second include a file of its own, or flatten the deck "
                           "first");
        break;
      }
  return refusals;
}

}  // namespace deck::detail
