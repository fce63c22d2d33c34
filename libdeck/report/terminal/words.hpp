// Words, names and tables that texts for people share.
#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/report/text_table.hpp"

namespace deck {

/// "1 node", "3 nodes".
inline std::string count(std::uint64_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// "TYPE7", "TYPE19 reversed".
inline std::string kind_name(const Contact& c) {
  std::string name = fmt::format("TYPE{}", c.inter->type);
  if (c.inter->type == 19) name += fmt::format(" {}", to_string(c.role));
  return name;
}

/// A table with these titles; '>' before one sets its column to the right.
inline TextTable make_table(std::initializer_list<const char*> titles) {
  std::vector<TextTable::Column> columns;
  for (const char* t : titles)
    columns.push_back(*t == '>' ? TextTable::Column{t + 1, Align::right}
                                : TextTable::Column{t, Align::left});
  return TextTable(std::move(columns));
}

}  // namespace deck
