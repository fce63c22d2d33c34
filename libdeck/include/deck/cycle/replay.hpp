// Replays recorded contact states: evaluates the kernel on each recorded pair and compares its
// force (or heat) with the recorded one.
#ifndef DECK_CYCLE_REPLAY_HPP_
#define DECK_CYCLE_REPLAY_HPP_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/cycle/plan.hpp"

namespace deck::cycle {

struct ReplayWorst {
  std::size_t row = 0;  ///< 1-based, the header not counted
  double relative_error = 0.0;
  std::vector<double> reference;  ///< force on the main side; heat: Q_s, Q_1..Q_4
  std::vector<double> computed;
};

/// Statistics as `deck replay --json` gives them. Relative errors are Euclidean, over rows whose
/// recorded vector is not zero; zero rows give |computed| / (K0 gap) (heat: |computed|).
struct ReplayReport {
  std::string error;  ///< empty when the states could be read
  std::string kind;   ///< node_segment, edge_edge, tied or heat
  std::size_t records = 0;
  std::size_t compared = 0;
  double median = 0.0, p99 = 0.0, max = 0.0;
  std::size_t zero_rows = 0;
  double zero_max_over_k0_gap = 0.0;
  std::vector<ReplayWorst> worst;  ///< largest first, at most 10
  // Beside the contract: the largest relative error of further outputs, where recorded.
  double max_weights = 0.0, max_nodal_stiffness = 0.0, max_p0 = 0.0;
  double max_friction_memory = 0.0, max_tie = 0.0;
};

struct ReplayOptions {
  int interface_id = 0;  ///< rows of other interfaces are left out; 0 takes all
  Model model = Model::reference;
  PlanOptions plan;
};

/// Compares a card's kernel with states given as CSV text with a header. The columns tell the kind.
[[nodiscard]] ReplayReport replay(const ContactCard& card, std::string_view csv,
                                  const ReplayOptions& options = {});

/// The text of a states file: gzip data is inflated, anything else returned as it is. Nothing when
/// the data is damaged or would exceed `limit` bytes.
[[nodiscard]] std::optional<std::string> states_text(std::string_view bytes,
                                                     std::size_t limit = std::size_t{1} << 32);

}  // namespace deck::cycle

#endif  // DECK_CYCLE_REPLAY_HPP_
