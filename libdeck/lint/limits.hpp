// Values of which the reference solver speaks before the run: schemas/limits. Private to the lint
// stage.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/schema.hpp"
#include "deck/text/diagnostic.hpp"

namespace deck::detail {

/// A number in a cell of that name. A cell that is blank or not there is 0.
struct NumberTest {
  std::string field;
  std::vector<double> is, is_not;  ///< one of these (empty: not tested), and none of these
  std::optional<double> above, below, at_least, at_most;
  bool holds(double value) const;
};

/// Values of one cell, while all of `when` hold. Without a cell the solver speaks of the keyword.
struct Limit {
  std::string keyword;
  NumberTest of;
  bool sum = false;   ///< the sum of all cells of that name is tested
  std::string not_a;  ///< an id: what it names exists, and is no such keyword ("/MAT/GAS")
  std::vector<NumberTest> when;
  Severity severity = Severity::error;  ///< info: only some builds of the solver speak of it
  int message = 0;
  std::string rule;        ///< rule that reports it
  std::string says;        ///< what the message says, one line
  std::string fix;         ///< what to write instead, where that is more than the legal range
  std::string known_from;  ///< what shows that the solver does so
};

const std::vector<Limit>& all_limits();
/// Those of a keyword.
const std::vector<const Limit*>& limits_of(const Schema& schema);

}  // namespace deck::detail
