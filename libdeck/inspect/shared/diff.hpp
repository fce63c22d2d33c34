// Differences of two decks: interfaces by effective values, groups by members, parts, properties,
// materials, nodes, initial penetrations. Ignores comments, order of blocks, number formats and, on
// request, ids.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "deck/loaded_deck.hpp"

namespace deck {

/// Key for matching entities of two decks.
enum class MatchBy : std::uint8_t {
  id,        ///< equal kind and id
  title,     ///< equal kind and title; without title, and for nodes and elements, equal id
  position,  ///< nodes by coordinates, elements by nodes, others by title, then by rank
};

struct Verdict;  // deck/verdict.hpp

/// One side of a comparison.
struct DiffSide {
  const LoadedDeck& loaded;
  const SceneView* view = nullptr;   ///< of its scene; nullptr: contacts are not compared
  const Verdict* verdict = nullptr;  ///< nullptr: not wanted
};

enum class ChangeKind : std::uint8_t { added, removed, changed, moved };
const char* to_string(ChangeKind kind);  ///< "added", "removed", "changed", "moved"

/// Empty, a whole number, a number, text, or coordinates.
using DiffValue =
    std::variant<std::monostate, std::int64_t, double, std::string, std::array<double, 3>>;

struct Change {
  ChangeKind kind = ChangeKind::changed;
  std::string
      group;  ///< "deck", "interface", "group", "part", "property", "material", "node", "other"
  std::string keyword;    ///< of the entity: "/INTER/TYPE7"; "" for "deck"
  std::int64_t id = 0;    ///< in the first deck; of added entities in the second
  std::int64_t id_b = 0;  ///< in the second deck if different, else 0
  std::string title;
  std::string field;               ///< "" if the whole entity was added or removed
  DiffValue old_value, new_value;  ///< as written, in working units of the first deck
  bool evaluated = false;          ///< the next three are set: a field of a contact
  DiffValue effective_old, effective_new;
  std::string why;  ///< origin of the new effective value: "card" ...
  std::vector<std::int64_t> gained, lost, altered;  ///< ids of members; gained: of the second deck
  Span a, b;                                        ///< place in either deck
};

struct PenetrationChange {
  std::int64_t interface_id = 0;            ///< in the second deck; of removed ones in the first
  std::string role;                         ///< "primary", "reversed", "edges"
  std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or nodes of an edge, as above
  double depth_old = 0, depth_new = 0;      ///< working units of each deck
  double gap_old = 0, gap_new = 0;
};

struct DeckDiff {
  std::vector<Change> changes;
  /// Deepest penetration of each secondary node or edge, deepest first. "Worse" and "better" mean a
  /// difference of at least a billionth of the gap.
  std::vector<PenetrationChange> appeared, gone, worse, better, same;
  std::vector<std::string> notes;
  bool stops_a = false, stops_b = false;  ///< the verdict says that the solver stops
  bool equal() const {
    return stops_a == stops_b && changes.empty() && appeared.empty() && gone.empty() &&
           worse.empty() && better.empty();
  }
};

/// Numbers within this share of the larger one are equal; coordinates and lengths within this share
/// of the size of the model.
inline constexpr double diff_tolerance = 1e-12;

DeckDiff diff_decks(const DiffSide& a, const DiffSide& b, MatchBy match,
                    double tolerance = diff_tolerance);

}  // namespace deck
