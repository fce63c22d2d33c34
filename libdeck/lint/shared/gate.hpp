// The gate: bounds of a team for its contacts. Exceeding one is a finding (see is_gate_rule), for
// every verb.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "deck/text.hpp"

namespace deck {

class ChangedLines {
 public:
  /// Adds `count` lines from `first` of a file, by the path under which it is read.
  void add(const std::string& path, std::uint64_t first, std::uint64_t count);
  /// Adds the new side of the hunks of a patch without context lines.
  void add_hunks(const std::string& path, std::string_view patch);
  bool empty() const { return files_.empty(); }

 private:
  friend class ChangedPlaces;
  /// Absolute path -> ranges of lines, ascending.
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::uint64_t>>> files_;
};

/// Changed lines of the files of one deck. Not thread-safe.
class ChangedPlaces {
 public:
  ChangedPlaces(const ChangedLines& lines, const SourceSet& sources)
      : lines_(lines), sources_(sources) {}
  /// The part of the span in the first changed line that it reaches; invalid: none.
  Span first_in(const Span& span);

 private:
  const ChangedLines& lines_;
  const SourceSet& sources_;
  /// Line ranges by file of the sources.
  std::map<std::uint32_t, const std::vector<std::pair<std::uint64_t, std::uint64_t>>*> of_file_;
};

/// Moves a finding on an unchanged line with a note on a changed one there; the old place becomes a
/// note.
void stand_at_changes(std::vector<Finding>& findings, const SourceSet& sources,
                      const ChangedLines& lines);

/// Bounds; unset ones do not apply.
struct GateLimits {
  std::optional<double> max_depth;          ///< of a penetration, working units
  std::optional<double> max_ratio;          ///< penetration over gap
  std::optional<double> max_dt_loss;        ///< 1 - contact step / step of the mesh
  std::optional<std::uint64_t> max_count;   ///< distinct penetrating nodes and edges
  std::optional<std::uint64_t> max_untied;  ///< untied nodes of /INTER/TYPE2
};

/// Bounds for some interfaces or part pairs, instead of the general ones.
struct GateScope {
  std::vector<std::string> match;  ///< patterns for id or title: one, or two for part pairs
  GateLimits limits;
};

struct Gate {
  GateLimits general;                       ///< max_count, max_untied: of the whole deck
  std::vector<GateScope> interfaces;        ///< [[gate.interface]]; the last match applies
  std::vector<GateScope> part_pairs;        ///< [[gate.part-pair]], either order; before interfaces
  bool on_fresh = false, on_worse = false;  ///< --fail-on new, worse: compared with an earlier run

  /// True if a bound or comparison is set.
  bool any() const;
  /// True if there is a time step bound, which needs forces.
  bool needs_forces() const;
};

/// Exceeded bounds as findings at the interface headers (bounds of the deck: its first line), in
/// deck order, with notes on the deepest node and, with `changed`, on the changed line (see
/// stand_at_changes). Without `forces` or `earlier` (nullptr) bounds that need them are not
/// checked.
std::vector<Finding> check_gate(const Gate& gate, const Scene& scene, const SceneView& view,
                                const cycle::SceneOutcome* forces, const GapBaseline* earlier,
                                const ChangedLines* changed = nullptr);

}  // namespace deck
