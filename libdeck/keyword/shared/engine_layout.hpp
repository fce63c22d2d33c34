// What the numbers of Engine files are: one table, for lint and for unit conversion.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// What a number of an Engine file is. All but `plain` are times, in working units of the deck.
enum class EngineCell : std::uint8_t {
  plain,     ///< an id, a flag, a count, a factor: the same in every unit system
  time,      ///< a smallest time step, the end of outputs
  end,       ///< of the run
  first,     ///< output
  interval,  ///< of outputs
};

/// The cells of the lines below a keyword.
struct EngineLayout {
  std::vector<EngineCell> cells;  ///< of the only line
  bool list = false;              ///< instead: any number of lines with plain cells
  /// The place of such a cell on the line.
  std::optional<std::size_t> find(EngineCell cell) const;
};

/// What lint and unit conversion know of a keyword; nullopt: its lines are not known.
std::optional<EngineLayout> engine_layout(const EngineBlock& block);

}  // namespace deck
