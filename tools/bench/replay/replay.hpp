// Replays recorded contact states: evaluates the kernel on each recorded pair and compares its
// force (or heat) with the recorded one.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/cycle.hpp"

namespace deck {
struct Scene;
}

namespace deck::cycle {

struct ReplayWorst {
  std::size_t row = 0;  ///< 1-based, the header not counted
  double relative_error = 0.0;
  std::vector<double> reference;  ///< force on the main side; heat: Q_s, Q_1..Q_4
  std::vector<double> computed;
};

/// How one group of result columns compares, each row as a vector. A row in which either side has a
/// NaN or an infinity is a mismatch of infinite error.
struct ReplayColumn {
  std::string name;                           ///< stem of the columns: "F" for F_x, F_y, F_z
  std::size_t rows = 0, acting = 0;           ///< acting: the recorded vector is not zero
  double median = 0.0, p99 = 0.0, max = 0.0;  ///< relative, over acting rows
  double zero_max = 0.0;  ///< elsewhere, over K0 gap (forces) or the largest recorded value
};

/// Statistics as `deck replay --json` gives them. Relative errors are Euclidean, over rows whose
/// recorded vector is not zero; zero rows give |computed| / (K0 gap) (heat: over the largest heat).
struct ReplayReport {
  std::string error;  ///< empty when the states could be read
  std::string kind;   ///< node_segment, edge_edge, tied, heat or heat_edges
  std::size_t records = 0;
  std::size_t compared = 0;
  std::size_t acting = 0;  ///< rows with any force, stiffness or heat: few prove little
  double median = 0.0, p99 = 0.0, max = 0.0;
  std::size_t zero_rows = 0;
  double zero_max_over_k0_gap = 0.0;
  std::vector<ReplayWorst> worst;     ///< largest first, at most 10
  std::vector<ReplayColumn> columns;  ///< every group of recorded results
  std::string csv;                    ///< with ReplayOptions::csv: the computed columns, row by row
};

struct ReplayOptions {
  int interface_id = 0;  ///< rows of other interfaces are left out; 0 takes all
  Model model = Model::reference;
  PlanOptions plan;
  bool csv = false;
  /// Inputs that rows carry "as used" are formed from the deck and the state instead, also in model
  /// reference; the robust model always does that.
  bool own_inputs = false;
  /// The deck beside the record: conductivities, friction by parts and the order of candidates come
  /// from it where rows do not carry them. May be null.
  const Scene* scene = nullptr;
};

/// Compares a card's kernel with states given as CSV text with a header. The columns tell the kind.
/// What rows carry "as used" by the reference solver (mu0, visf, c1.., d1, cmaj, area, *_used) is
/// taken from them in model reference.
[[nodiscard]] ReplayReport replay(const ContactCard& card, std::string_view csv,
                                  const ReplayOptions& options = {});

/// The text of a states file: gzip data is inflated, anything else returned as it is. Nothing when
/// the data is damaged or would exceed `limit` bytes.
[[nodiscard]] std::optional<std::string> states_text(std::string_view bytes,
                                                     std::uint64_t limit = std::uint64_t{1} << 32);

}  // namespace deck::cycle
