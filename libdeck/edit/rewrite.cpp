// Applies the edits of a conversion to the files of a deck; makes loss entries.
#include "deck/edit.hpp"

#include <algorithm>
#include <optional>

#include "keyword/shared/reader.hpp"
#include "text/shared/edits.hpp"

namespace deck {

Result<ChangedFiles> apply_edits(const SourceSet& sources, const std::vector<TextEdit>& edits) {
  std::vector<std::vector<const TextEdit*>> by_source(sources.size());
  for (const TextEdit& e : edits) by_source[e.span.file].push_back(&e);
  // A file included twice is two sources with one path. All copies must get the same text.
  std::map<std::string_view, std::vector<std::uint32_t>> copies_of;
  for (std::uint32_t f = 0; f < sources.size(); ++f) copies_of[sources[f].path()].push_back(f);
  ChangedFiles changed;
  for (const auto& [path, copies] : copies_of) {
    if (std::all_of(copies.begin(), copies.end(),
                    [&](std::uint32_t f) { return by_source[f].empty(); }))
      continue;
    std::optional<std::string> agreed;
    for (const std::uint32_t file : copies) {
      auto text = apply_edit_pointers(sources[file], std::move(by_source[file]));
      if (!text) return text.error();
      if (agreed && *agreed != *text)
        return Error{Error::Code::config,
                     std::string(path) +
                         " is included more than once and would have to become two different "
                         "files; give the second include a file of its own, or flatten the deck "
                         "first"};
      agreed = std::move(*text);
    }
    if (*agreed != sources[copies.front()].bytes())
      changed.emplace(std::string(path), std::move(*agreed));
  }
  return changed;
}

Result<ChangedFiles> apply_rewrite(const SourceSet& sources, const Rewrite& rewrite) {
  if (!rewrite.new_text) return apply_edits(sources, rewrite.edits);
  ChangedFiles changed;
  if (*rewrite.new_text != sources[0].bytes()) changed[sources[0].path()] = *rewrite.new_text;
  return changed;
}

LossEntry loss_entry(const Deck& deck, Loss loss, const Block& block, Span span, LossText text) {
  const Span place = span.valid() ? span : block.header_span;
  LossEntry entry;
  entry.loss = loss;
  entry.keyword = std::string(block.keyword);
  entry.id = block.id.value;
  entry.file = deck.sources[place.file].path();
  entry.line = deck.sources.position(place).line;
  entry.field = std::move(text.field);
  entry.old_text = std::move(text.old_text);
  entry.new_text = std::move(text.new_text);
  entry.note = std::move(text.note);
  return entry;
}

void leave_undecided(Rewrite& out, const Deck& deck, const Block& block, Span place,
                     std::string field, std::string why, bool accepted) {
  const Span at = place.valid() ? place : block.header_span;
  if (accepted) {
    constexpr std::size_t longest = 100;
    std::string old_text(detail::trim(deck.sources.text(at)).substr(0, longest));
    out.losses.push_back(loss_entry(deck, Loss::undecided, block, at,
                                    {std::move(field), std::move(old_text), {}, std::move(why)}));
    return;
  }
  constexpr std::size_t most = 1000;
  if (out.refusals.size() == most) out.refusals.push_back("further places are not listed");
  if (out.refusals.size() > most) return;
  std::string text = deck.sources.where(at) + ": " + std::string(block.keyword);
  if (block.id.present) text += "/" + std::to_string(block.id.value);
  if (!field.empty()) text += " " + field;
  out.refusals.push_back(text + ": " + why);
}

}  // namespace deck
