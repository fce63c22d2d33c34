// Finds every use of a LOCAL parameter and renames those that would clash.
#include "edit/convert/flatten_parameters.hpp"

#include <map>
#include <optional>
#include <set>

#include "keyword/shared/reader.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {
namespace {

using Places = std::map<std::string, std::vector<Span>, std::less<>>;

void add_place(Places& places, std::uint32_t file, std::string_view bytes, std::size_t begin,
               std::size_t end) {
  places[std::string(bytes.substr(begin, end - begin))].push_back(
      {file, static_cast<std::uint32_t>(end - begin), begin});
}

/// Where parameters are named (without the &): in cells, headers and expressions.
Places find_places(const Deck& deck) {
  Places places;
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f) {
    const std::string_view bytes = deck.sources[f].bytes();
    for (std::size_t at = bytes.find('&'); at != std::string_view::npos;
         at = bytes.find('&', at + 1)) {
      const auto nl = bytes.rfind('\n', at);
      const char first = bytes[nl == std::string_view::npos ? 0 : nl + 1];
      if (first == '#' || first == '$') continue;
      std::size_t end = at + 1;
      while (end < bytes.size() && name_character(bytes[end])) ++end;
      if (end > at + 1) add_place(places, f, bytes, at + 1, end);
    }
  }
  // Expressions may leave the & away.
  for (const auto& [name, p] : deck.parameters) {
    if (p.expression.empty()) continue;
    const std::string_view bytes = deck.sources[p.span.file].bytes();
    const std::size_t stop = p.span.offset + std::min<std::size_t>(p.span.length, 100);
    for (std::size_t at = p.span.offset + 10; at < stop;) {
      std::size_t end = at;
      while (end < stop && name_character(bytes[end])) ++end;
      const bool number = end > at && bytes[at] >= '0' && bytes[at] <= '9';
      const bool function = end < stop && bytes[end] == '(';
      if (end > at && !number && !function && bytes[at - 1] != '&')
        add_place(places, p.span.file, bytes, at, end);
      at = end + 1;
    }
  }
  return places;
}

/// An unused name of the same length.
std::optional<std::string> free_name(const std::string& name, std::set<std::string>& taken) {
  const auto accept = [&](std::string candidate) -> std::optional<std::string> {
    if (!taken.insert(candidate).second) return std::nullopt;
    return candidate;
  };
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  if (name.size() == 1) {
    for (const char c : letters)
      if (auto found = accept(std::string(1, c))) return found;
    return std::nullopt;
  }
  for (int k = 1; k < 100000; ++k) {
    const std::string suffix = std::to_string(k);
    if (suffix.size() >= name.size()) break;
    if (auto found = accept(name.substr(0, name.size() - suffix.size()) + suffix)) return found;
  }
  return std::nullopt;
}

}  // namespace

std::vector<TextEdit> rename_local_parameters(const Deck& deck, std::vector<std::string>& refusals,
                                              std::vector<std::string>& notes) {
  std::vector<TextEdit> edits;
  bool any_local = false;
  for (const auto& [name, p] : deck.parameters) any_local = any_local || p.local;
  if (!any_local) return edits;
  const Places places = find_places(deck);
  std::set<std::string> taken;
  for (const auto& [name, p] : deck.parameters) taken.insert(name);
  for (const auto& [name, spans] : places) taken.insert(name);
  for (auto it = deck.parameters.begin(); it != deck.parameters.end();) {
    const std::string& name = it->first;
    const auto last = deck.parameters.upper_bound(name);
    const Parameter* merged = nullptr;  // what the name means when all files are one
    for (auto p = it; p != last; ++p)
      if (p->second.local && merged == nullptr) merged = &p->second;
    for (auto p = it; p != last; ++p)
      if (!p->second.local && merged == nullptr) merged = &p->second;
    const auto used = places.find(name);
    bool conflict = false;
    if (used != places.end())
      for (const Span& s : used->second)
        conflict = conflict || deck.find_parameter(name, s.file) != merged;
    for (auto p = it; conflict && p != last; ++p) {
      const Parameter& local = p->second;
      if (!local.local || local.file == 0) continue;
      const auto renamed = free_name(name, taken);
      if (!renamed) {
        refusals.push_back(deck.sources.where(local.span) + ": local parameter '" + name +
                           "' means something else in another file and there is no free name of "
                           "its length; rename it");
        continue;
      }
      notes.push_back("local parameter " + name + " of " + deck.sources[local.file].path() +
                      " is now " + *renamed);
      const std::string_view cell = columns(deck.sources.text(local.span), 1, 10);
      const auto shift = cell.find_first_not_of(" \t");
      edits.push_back({Span{local.span.file, static_cast<std::uint32_t>(name.size()),
                            local.span.offset + (shift == std::string_view::npos ? 0 : shift)},
                       *renamed});
      for (const Span& s : used->second)
        if (deck.find_parameter(name, s.file) == &local) edits.push_back({s, *renamed});
    }
    it = last;
  }
  return edits;
}

}  // namespace deck::detail
