// The table of the Engine keywords whose lines are known.
#include "keyword/shared/engine_layout.hpp"

#include <string_view>

namespace deck {
namespace {

struct EngineRow {
  std::string_view first, second;  ///< parts of the keyword; second empty: any
  EngineLayout layout;
};

using enum EngineCell;

/// The first row that fits counts.
const std::vector<EngineRow>& engine_rows() {
  static const std::vector<EngineRow> rows = {
      {"RUN", "", {{end}}},
      {"TFILE", "", {{interval}}},
      {"RFILE", "", {{plain}}},
      {"ANIM", "DT", {{first, interval, time}}},
      {"ANIM", "SHELL", {{}, true}},
      {"ANIM", "BRICK", {{}, true}},
      {"ANIM", "ELEM", {{}, true}},
      {"ANIM", "VECT", {{}, true}},
      {"ANIM", "NODA", {{}, true}},
      {"H3D", "DT", {{first, interval, time}}},
      {"H3D", "PART", {{}, true}},
      {"OUTP", "DT", {{first, interval}}},
      {"STATE", "DT", {{first, interval}}},
      {"DYNAIN", "DT", {{first, interval}}},
      {"DT", "", {{plain, time}}},
      {"DTIX", "", {{time, time}}},
      {"PRINT", "", {{plain}}},
      {"STOP", "", {{plain, plain, plain, plain, plain}}},
      {"DEL", "", {{}, true}},
      {"RBODY", "", {{}, true}},
      {"BCS", "", {{}, true}},
  };
  return rows;
}

}  // namespace

std::optional<std::size_t> EngineLayout::find(EngineCell cell) const {
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] == cell) return i;
  return std::nullopt;
}

std::optional<EngineLayout> engine_layout(const EngineBlock& block) {
  for (const EngineRow& row : engine_rows())
    if (block.part(0) == row.first && (row.second.empty() || block.part(1) == row.second))
      return row.layout;
  return std::nullopt;
}

}  // namespace deck
