// Kinds of numbers in Engine files, for lint and unit conversion.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// Kind of a number; in working units of the deck, mostly times.
enum class EngineCell : std::uint8_t {
  plain,     ///< an id, flag, count or factor: the same in every unit system
  time,      ///< smallest time step, end of outputs
  end,       ///< end of the run
  first,     ///< time of the first output
  interval,  ///< interval between outputs
  speed,     ///< length over time
};

/// The cells of the lines after a keyword.
struct EngineLayout {
  std::vector<EngineCell> cells;  ///< of the first line
  bool list = false;              ///< any number of lines of plain cells after or instead of it
  /// Position of such a cell on the line.
  std::optional<std::size_t> find(EngineCell cell) const;
};

/// Layout for a keyword; nullopt: unknown.
std::optional<EngineLayout> engine_layout(const EngineBlock& block);

}  // namespace deck
