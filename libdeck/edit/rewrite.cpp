// Applies the edits of a conversion to the files of a deck; entries of its loss report.
#include "deck/edit/rewrite.hpp"

#include "deck/text/edits.hpp"
#include "keyword/reader.hpp"

namespace deck {

Result<ChangedFiles> apply_edits(const SourceSet& sources, const std::vector<TextEdit>& edits) {
  // A file included twice is two sources with the same path; its edits are made once.
  std::map<std::string_view, std::uint32_t> first_of;
  std::vector<std::vector<const TextEdit*>> by_source(sources.size());
  std::vector<bool> is_copy;
  for (std::uint32_t f = 0; f < sources.size(); ++f)
    is_copy.push_back(!first_of.emplace(sources[f].path(), f).second);
  for (const TextEdit& e : edits) by_source[e.span.file].push_back(&e);
  ChangedFiles changed;
  for (const bool copies : {false, true}) {
    for (std::uint32_t file = 0; file < sources.size(); ++file) {
      if (is_copy[file] != copies || by_source[file].empty()) continue;
      auto text = apply_edit_pointers(sources[file], std::move(by_source[file]));
      if (!text) return text.error();
      if (*text == sources[file].bytes()) continue;
      const std::string& path = sources[file].path();
      const auto it = changed.find(path);
      if (it == changed.end()) {
        changed.emplace(path, std::move(*text));
        continue;
      }
      if (it->second == *text) continue;
      return Error{Error::Code::config,
                   path +
                       " is included more than once and would have to become two different "
                       "files; give the second include a file of its own"};
    }
  }
  return changed;
}

Result<ChangedFiles> apply_rewrite(const SourceSet& sources, const Rewrite& rewrite) {
  if (!rewrite.new_text) return apply_edits(sources, rewrite.edits);
  ChangedFiles changed;
  if (*rewrite.new_text != sources[0].bytes()) changed[sources[0].path()] = *rewrite.new_text;
  return changed;
}

LossEntry loss_entry(const Deck& deck, Loss loss, const Block& block, Span span) {
  LossEntry entry;
  entry.loss = loss;
  entry.keyword = std::string(block.keyword);
  entry.id = block.id.value;
  const Span place = span.valid() ? span : block.header_span;
  entry.file = deck.sources[place.file].path();
  entry.line = deck.sources.position(place).line;
  return entry;
}

void leave_undecided(Rewrite& out, const Deck& deck, const Block& block, Span place,
                     std::string field, std::string why, bool accepted) {
  const Span at = place.valid() ? place : block.header_span;
  if (accepted) {
    constexpr std::size_t longest = 100;
    LossEntry entry = loss_entry(deck, Loss::undecided, block, at);
    entry.field = std::move(field);
    entry.old_text = std::string(detail::trim(deck.sources.text(at)).substr(0, longest));
    entry.note = std::move(why);
    out.losses.push_back(std::move(entry));
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
