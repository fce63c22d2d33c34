// Replay of recorded contact states: evaluates the kernel on each pair and compares force or heat.
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
  std::size_t row = 0;  ///< 1-based, without header
  double relative_error = 0.0;
  std::vector<double> reference;  ///< force on the main side; heat: Q_s, Q_1..Q_4
  std::vector<double> computed;
};

/// Comparison of a group of columns, row by row as vectors. NaN or infinity on a side is an
/// infinite error.
struct ReplayColumn {
  std::string name;                           ///< stem of the columns: "F" for F_x, F_y, F_z
  std::size_t rows = 0, acting = 0;           ///< acting: rows with a non-zero recorded vector
  double median = 0.0, p99 = 0.0, max = 0.0;  ///< relative, over acting rows
  double zero_max = 0.0;  ///< other rows, relative to K0 gap (forces) or the largest recorded value
};

/// Statistics as in `deck replay --json`. Relative errors are Euclidean, over rows with a non-zero
/// recorded vector; zero rows: |computed| / (K0 gap) (heat: / largest heat).
struct ReplayReport {
  std::string error;  ///< empty: the states are readable
  std::string kind;   ///< node_segment, edge_edge, tied, heat or heat_edges
  std::size_t records = 0;
  std::size_t compared = 0;
  std::size_t acting = 0;  ///< rows with force, stiffness or heat; a few prove little
  double median = 0.0, p99 = 0.0, max = 0.0;
  std::size_t zero_rows = 0;
  double zero_max_over_k0_gap = 0.0;
  std::vector<ReplayWorst> worst;     ///< largest first, at most 10
  std::vector<ReplayColumn> columns;  ///< every group of recorded results
  std::string csv;                    ///< with ReplayOptions::csv: the computed columns
};

struct ReplayOptions {
  int interface_id = 0;  ///< other interfaces are skipped; 0: all
  Model model = Model::reference;
  PlanOptions plan;
  bool csv = false;
  /// true: compute inputs from deck and state, also those recorded "as used"; the robust model
  /// always does.
  bool own_inputs = false;
  /// Deck of the record: source of conductivity, friction by parts and candidate order, if the rows
  /// lack them. May be null.
  const Scene* scene = nullptr;
};

/// Compares the kernel of a card with states (CSV with header, whose columns tell the kind). With
/// model reference, values recorded "as used" by the solver (mu0, visf, c1.., d1, cmaj, area,
/// *_used) are used.
[[nodiscard]] ReplayReport replay(const ContactCard& card, std::string_view csv,
                                  const ReplayOptions& options = {});

/// Text of a states file, unpacked if gzip. nullopt: damaged, or larger than `limit` bytes.
[[nodiscard]] std::optional<std::string> states_text(std::string_view bytes,
                                                     std::uint64_t limit = std::uint64_t{1} << 32);

}  // namespace deck::cycle
