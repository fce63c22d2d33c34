// Rows of a deck comparison that text and Markdown share. Private to the report stage.
#pragma once
#include <string>
#include <vector>

#include "report/shared/diff.hpp"

namespace deck {

/// A table of a comparison: titles, and rows of texts.
struct DiffTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::size_t left_out = 0;  ///< further rows
};

/// All tables that have a row; at most `rows` of nodes and penetrations in each, 0: all.
std::vector<DiffTable> diff_tables(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                                   std::size_t rows);

}  // namespace deck
