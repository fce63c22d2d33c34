// What the numbers of Engine files are: one table, for lint and for unit conversion.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// What a number of an Engine file is: in the working units of the deck, most of them times.
enum class EngineCell : std::uint8_t {
  plain,     ///< an id, a flag, a count, a factor: the same in every unit system
  time,      ///< a smallest time step, the end of outputs
  end,       ///< of the run
  first,     ///< output
  interval,  ///< of outputs
  speed,     ///< length over time
};

/// The cells of the lines below a keyword.
struct EngineLayout {
  std::vector<EngineCell> cells;  ///< of the first line
  bool list = false;              ///< any number of lines with plain cells behind or instead of it
  /// The place of such a cell on the line.
  std::optional<std::size_t> find(EngineCell cell) const;
};

/// What lint and unit conversion know of a keyword; nullopt: its lines are not known.
std::optional<EngineLayout> engine_layout(const EngineBlock& block);

}  // namespace deck
