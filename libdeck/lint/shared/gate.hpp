// The gate: bounds that a team sets for its contacts. What passes over one is a finding of the
// rules DK370 to DK375, whichever verb looks.
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
  /// Lines `first` and on of a file, by the path under which it is read.
  void add(const std::string& path, std::uint64_t first, std::uint64_t count);
  /// The new side of the hunks of a patch of that file, without lines of context around them.
  void add_hunks(const std::string& path, std::string_view patch);
  bool empty() const { return files_.empty(); }

 private:
  friend class ChangedPlaces;
  /// Absolute path -> first and last lines of stretches, ascending.
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::uint64_t>>> files_;
};

/// Changed lines among the files of one deck. Not for several threads at once.
class ChangedPlaces {
 public:
  ChangedPlaces(const ChangedLines& lines, const SourceSet& sources)
      : lines_(lines), sources_(sources) {}
  /// The first changed line that the span reaches into, as far as the span goes; an invalid span if
  /// there is none.
  Span first_in(const Span& span);

 private:
  const ChangedLines& lines_;
  const SourceSet& sources_;
  /// Stretches by file of the sources.
  std::map<std::uint32_t, const std::vector<std::pair<std::uint64_t, std::uint64_t>>*> of_file_;
};

/// A finding that stands on an unchanged line, with a note on a changed one, is moved there; its
/// old place becomes a note.
void stand_at_changes(std::vector<Finding>& findings, const SourceSet& sources,
                      const ChangedLines& lines);

/// Bounds; what is not set does not bound.
struct GateLimits {
  std::optional<double> max_depth;          ///< of a penetration, working units
  std::optional<double> max_ratio;          ///< penetration over gap
  std::optional<double> max_dt_loss;        ///< 1 - contact step / step of the mesh
  std::optional<std::uint64_t> max_count;   ///< penetrating nodes and edges, each once
  std::optional<std::uint64_t> max_untied;  ///< nodes of /INTER/TYPE2 that are not tied
};

/// Bounds for some interfaces, or for some pairs of parts, instead of the general ones.
struct GateScope {
  std::vector<std::string> match;  ///< patterns of id or title: one of an interface, two of parts
  GateLimits limits;
};

struct Gate {
  GateLimits general;                 ///< max_count, max_untied: of the whole deck
  std::vector<GateScope> interfaces;  ///< [[gate.interface]]; the last that matches holds
  std::vector<GateScope> part_pairs;  ///< [[gate.part-pair]], either way round; before interfaces
  bool on_fresh = false, on_worse = false;  ///< --fail-on new, worse: against an earlier run

  /// True if some bound or comparison was asked for.
  bool any() const;
  /// True if a bound on the time step was: forces have to be evaluated for it.
  bool needs_forces() const;
};

/// What passes over the gate, as findings at the interfaces' headers (the deck's first line where
/// all of them are meant), in deck order; with a note on the deepest node and, with `changed`, on
/// the changed line that they follow from (see stand_at_changes). `forces` and `earlier` may be
/// nullptr; then what they are needed for is not looked at.
std::vector<Finding> check_gate(const Gate& gate, const Scene& scene, const SceneView& view,
                                const cycle::SceneOutcome* forces, const GapBaseline* earlier,
                                const ChangedLines* changed = nullptr);

}  // namespace deck
