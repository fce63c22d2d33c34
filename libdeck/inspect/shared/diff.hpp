// What two decks mean differently: interfaces field by field with their effective values, groups by
// their members, parts, properties, materials, nodes, and initial penetrations. Comments, order of
// blocks, number formats and, on request, ids make no difference.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "deck/loaded_deck.hpp"

namespace deck {

/// How an entity of one deck finds its counterpart in the other.
enum class MatchBy : std::uint8_t {
  id,        ///< the same kind and id
  title,     ///< the same kind and title; without one, and nodes and elements, the same id
  position,  ///< nodes by coordinates, elements by their nodes, all else as with `title`, then by
             ///< rank
};

struct Verdict;  // deck/verdict.hpp

/// One side of a comparison.
struct DiffSide {
  const LoadedDeck& loaded;
  const SceneView* view = nullptr;   ///< of its scene; nullptr: contacts are not compared
  const Verdict* verdict = nullptr;  ///< what is said of this deck; nullptr: not asked
};

enum class ChangeKind : std::uint8_t { added, removed, changed, moved };
const char* to_string(ChangeKind kind);  ///< "added", "removed", "changed", "moved"

/// Nothing, a whole number, a number, text, or coordinates.
using DiffValue =
    std::variant<std::monostate, std::int64_t, double, std::string, std::array<double, 3>>;

struct Change {
  ChangeKind kind = ChangeKind::changed;
  std::string
      group;  ///< "deck", "interface", "group", "part", "property", "material", "node", "other"
  std::string keyword;    ///< of the entity: "/INTER/TYPE7"; "" for "deck"
  std::int64_t id = 0;    ///< in the first deck, of what is added in the second
  std::int64_t id_b = 0;  ///< in the second deck, where it is another; else 0
  std::string title;
  std::string field;               ///< "" where the entity as a whole came or went
  DiffValue old_value, new_value;  ///< as the cards say, in working units of the first deck
  bool evaluated = false;          ///< the next three are filled: a field of a contact
  DiffValue effective_old, effective_new;
  std::string why;  ///< where the new effective value comes from: "card" ...
  std::vector<std::int64_t> gained, lost, altered;  ///< ids of members; gained: of the second deck
  Span a, b;                                        ///< place in either deck
};

struct PenetrationChange {
  std::int64_t interface_id = 0;            ///< in the second deck, of what is gone in the first
  std::string role;                         ///< "primary", "reversed", "edges"
  std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or nodes of an edge, likewise
  double depth_old = 0, depth_new = 0;      ///< working units of each deck
  double gap_old = 0, gap_new = 0;
};

struct DeckDiff {
  std::vector<Change> changes;
  /// Deepest penetration of each secondary node or edge, deepest first. "Worse" and "better" count
  /// from a billionth of the gap on.
  std::vector<PenetrationChange> appeared, gone, worse, better, same;
  std::vector<std::string> notes;         ///< for people
  bool stops_a = false, stops_b = false;  ///< the solver stops at this side, by its verdict
  bool equal() const {
    return stops_a == stops_b && changes.empty() && appeared.empty() && gone.empty() &&
           worse.empty() && better.empty();
  }
};

/// Numbers within this share of the larger one are equal, and coordinates and lengths within this
/// share of the size of the model.
inline constexpr double diff_tolerance = 1e-12;

DeckDiff diff_decks(const DiffSide& a, const DiffSide& b, MatchBy match,
                    double tolerance = diff_tolerance);

}  // namespace deck
