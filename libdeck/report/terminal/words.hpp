// Words, names and tables that texts for people share.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/shared/count.hpp"
#include "deck/contact/scene.hpp"
#include "report/shared/text_table.hpp"

namespace deck {

/// "TYPE7", "TYPE19 reversed".
inline std::string kind_name(const Contact& c) {
  std::string name = fmt::format("TYPE{}", c.inter->type);
  if (c.inter->type == 19) name += fmt::format(" {}", to_string(c.role));
  return name;
}

/// A table with these titles; '>' before one sets its column to the right, '=' keeps its texts
/// whole.
inline TextTable make_table(std::initializer_list<const char*> titles) {
  std::vector<TextTable::Column> columns;
  for (const char* t : titles)
    columns.push_back(*t == '>'   ? TextTable::Column{t + 1, Align::right}
                      : *t == '=' ? TextTable::Column{t + 1, Align::left, true}
                                  : TextTable::Column{t, Align::left});
  return TextTable(std::move(columns));
}

/// Positions in `list` of the contacts of each interface, in the order in which the interfaces
/// first occur; `interface_of` gives that of an element.
template <class List, class InterfaceOf>
std::vector<std::vector<std::size_t>> by_interface(const List& list,
                                                   const InterfaceOf& interface_of) {
  std::vector<std::vector<std::size_t>> out;
  std::map<const InterBase*, std::size_t> place;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto [it, first] = place.try_emplace(interface_of(list[i]), out.size());
    if (first) out.emplace_back();
    out[it->second].push_back(i);
  }
  return out;
}

/// "  3 clean interfaces: 4, 5, 6" as a line; "" for none. Of very many the first.
inline std::string folded_ids(const std::vector<std::int64_t>& ids, const char* one,
                              const char* many) {
  constexpr std::size_t most = 40;
  if (ids.empty()) return {};
  std::string out = "  " + count(ids.size(), one, many) + ":";
  for (std::size_t i = 0; i < std::min(most, ids.size()); ++i)
    out += fmt::format("{} {}", i == 0 ? "" : ",", ids[i]);
  if (ids.size() > most) out += fmt::format(", … and {} more (-v)", ids.size() - most);
  return out + "\n";
}

}  // namespace deck
