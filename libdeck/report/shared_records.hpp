// Records that several documents have: the deck, places in it, the verdict, counts, decisions,
// gate.
#pragma once
#include "deck/contact/view.hpp"
#include "deck/edit/rewrite.hpp"
#include "deck/verdict.hpp"
#include "report/record.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/listing.hpp"

namespace deck {

class LoadedDeck;

/// A place in the text of a deck.
struct Place {
  std::string_view file;
  std::size_t line = 0, column = 0;
  IfAny<std::size_t> end_column = {};
};
Record<Place> record_of(const Place*);
/// nullopt: the span is not valid.
std::optional<Place> place_of(const Deck& deck, const Span& span);

/// The member "deck". `model` and `interfaces` may be nullptr where they were not built.
struct DeckRow {
  std::string_view path;
  const Deck* deck = nullptr;
  const Model* model = nullptr;
  const Interfaces* interfaces = nullptr;
};
Record<DeckRow> record_of(const DeckRow*);
/// With its model and interfaces.
DeckRow deck_row(const LoadedDeck& loaded);

Record<NotExamined> record_of(const NotExamined*);
Record<Verdict> record_of(const Verdict*);
Record<ItemCounts> record_of(const ItemCounts*);
Record<PartPair> record_of(const PartPair*);
Record<ContactTotals> record_of(const ContactTotals*);

/// The member "accuracy": how decisions were made.
struct DecisionsRow {
  const Scene* scene = nullptr;
};
Record<DecisionsRow> record_of(const DecisionsRow*);

/// The entity that a finding is about.
struct EntityRow {
  const Diagnostic* d = nullptr;
};
Record<EntityRow> record_of(const EntityRow*);
Record<ReferenceMessage> record_of(const ReferenceMessage*);
Record<NotChecked> record_of(const NotChecked*);
Record<LossEntry> record_of(const LossEntry*);
Record<StepDifference> record_of(const StepDifference*);

/// A finding of a gate.
struct GateFinding {
  const Deck* deck = nullptr;
  const Diagnostic* d = nullptr;
};
Record<GateFinding> record_of(const GateFinding*);
/// The members "gate" and "compared".
struct GateRow {
  const Deck* deck = nullptr;
  const GateReport* gate = nullptr;
};
Record<GateRow> record_of(const GateRow*);
struct ComparedRow {
  const Scene* scene = nullptr;
  const SceneView* view = nullptr;
  const GateReport* gate = nullptr;
};
Record<ComparedRow> record_of(const ComparedRow*);
/// Of the gate that was asked for: null without bounds, no member without a gate.
IfAny<std::optional<GateRow>> gate_of(const Deck& deck, const GateReport* gate);
IfAny<std::optional<ComparedRow>> comparison_of(const Scene& scene, const SceneView& view,
                                                const GateReport* gate);
/// An element and its part.
Record<ElementName> record_of(const ElementName*);

template <>
inline constexpr std::size_t word_count<ContactKind> = 2;
template <>
inline constexpr std::size_t word_count<ContactRole> = 3;
template <>
inline constexpr std::size_t word_count<PenetrationAction> = penetration_actions;
template <>
inline constexpr std::size_t word_count<SegmentKind> = 5;
template <>
inline constexpr std::size_t word_count<Accuracy> = 4;
template <>
inline constexpr std::size_t word_count<VerdictLevel> = 8;
template <>
inline constexpr std::size_t word_count<Severity> = 3;

/// Ids of nodes.
template <std::size_t N>
std::array<std::int64_t, N> node_ids(const Model& model, const std::array<NodeIndex, N>& nodes) {
  std::array<std::int64_t, N> ids{};
  for (std::size_t i = 0; i < N; ++i) ids[i] = model.node_id(nodes[i]);
  return ids;
}

/// The ids of a pair: of two edges, or of a node and a segment.
struct PairSides {
  const Model* model = nullptr;
  const Contact* contact = nullptr;
  std::uint32_t secondary = 0, main = 0;

  bool edges() const { return contact->kind == ContactKind::edge_edge; }
  IfAny<std::array<std::int64_t, 2>> edge() const;
  IfAny<std::array<std::int64_t, 2>> main_edge() const;
  IfAny<std::int64_t> node() const;
  IfAny<std::array<std::int64_t, 4>> segment() const;
};

/// A value where it is known, else null.
template <class T>
std::optional<T> known(bool is_known, const T& value) {
  return is_known ? std::optional<T>(value) : std::nullopt;
}
/// A value where the object has it, else no member.
template <class T>
IfAny<T> if_any(bool is_there, const T& value) {
  return {known(is_there, value)};
}

}  // namespace deck
