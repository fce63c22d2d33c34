// Words, names and lists of the texts.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "deck/contacts.hpp"
#include "report/shared/text_table.hpp"

namespace deck {

inline std::string type_name(const InterBase& inter) { return fmt::format("TYPE{}", inter.type); }

/// "TYPE7", "TYPE19 reversed".
inline std::string kind_name(const Contact& c) {
  return type_name(*c.inter) + (c.inter->type == 19 ? fmt::format(" {}", to_string(c.role)) : "");
}

/// Appends `item`, after `separator` unless `list` is empty.
inline void append(std::string& list, std::string_view separator, std::string_view item) {
  if (!list.empty()) list += separator;
  list += item;
}

/// "1, 2, 3" and " and 4 more" for more than `most` items; `text` converts an item.
template <class List, class Text = std::identity>
std::string first_of(const List& list, std::size_t most, const Text& text = {}) {
  std::string out;
  std::size_t shown = 0;
  for (const auto& item : list) {
    if (shown == most) return out + fmt::format(" and {} more", list.size() - most);
    out += fmt::format("{}{}", shown++ == 0 ? "" : ", ", text(item));
  }
  return out;
}

/// A number, or a dash if unknown.
template <class T>
TextTable::Cell known_cell(bool known, const T& number) {
  return known ? TextTable::Cell(number) : TextTable::Cell("-");
}

/// A text below its title; "" without text.
inline std::string titled(std::string_view title, const std::string& text, bool color) {
  return text.empty() ? text : fmt::format("\n{}\n{}", toned(title, Tone::bold, color), text);
}

/// "  … and 5 more (--json)" as a line; "" if all are shown.
inline std::string more_line(std::size_t all, std::size_t shown, std::string_view where = {}) {
  return all <= shown ? std::string() : fmt::format("  … and {} more{}\n", all - shown, where);
}

/// Contacts per interface, interfaces in order of first occurrence; `interface_of` gives that of an
/// item.
template <class T, class InterfaceOf>
std::vector<std::vector<const T*>> by_interface(const std::vector<T>& list,
                                                const InterfaceOf& interface_of) {
  std::vector<std::vector<const T*>> out;
  std::map<const InterBase*, std::size_t> place;
  for (const T& contact : list) {
    const auto [it, first] = place.try_emplace(interface_of(contact), out.size());
    if (first) out.emplace_back();
    out[it->second].push_back(&contact);
  }
  return out;
}

/// "  3 clean interfaces (ids 4, 5, 6)" as a line; "" for none. Only the first of very many.
inline std::string folded_ids(const std::vector<std::int64_t>& ids, const char* one,
                              const char* many) {
  constexpr std::size_t most = 8;
  if (ids.empty()) return {};
  std::string out =
      fmt::format("  {} ({} {}", count(ids.size(), one, many), ids.size() == 1 ? "id" : "ids",
                  fmt::join(std::span(ids).first(std::min(most, ids.size())), ", "));
  if (ids.size() > most) out += fmt::format(", … and {} more: -v", ids.size() - most);
  return out + ")\n";
}

/// "kg mm ms"; "" if the deck does not name its units.
inline std::string units_text(const UnitSystem& u) {
  return terminal_text(fmt::format("{} {} {}", u.mass_code, u.length_code, u.time_code));
}
/// Node ids as text; the repeated node of a triangle once.
std::string ids_text(const Model& model, std::span<const NodeIndex> nodes, char between);

/// Nodes of a pair: a node and a segment, or two edges.
struct PairNodes {
  std::span<const NodeIndex> secondary, main;
};
PairNodes pair_nodes(const Contact& contact, std::uint32_t secondary, std::uint32_t main);

/// Secondary node of a penetration (edge: its first node), and of a list.
NodeIndex first_node(const Scene& scene, const NamedPenetrations::Place& penetration);
std::vector<NodeIndex> first_nodes(const Scene& scene, const NamedPenetrations& list);

/// Element with the edge of a crossing, and the one of its segment.
ElementName edge_element(const Model& model, const Crossing& crossing);
ElementName segment_element(const Scene& scene, const Crossing& crossing);

/// Where the solver's arithmetic decides otherwise about contact; without `always` "" if nowhere.
std::string decisions_text(const Scene& scene, bool always);

}  // namespace deck
