// Records of several documents: deck, places, verdict, counts, decisions, gate.
#pragma once
#include "deck/contacts.hpp"
#include "deck/edit.hpp"
#include "deck/verdict.hpp"
#include "report/record.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/inspection.hpp"

namespace deck {

class LoadedDeck;

/// A place in the text of a deck.
struct SourcePlace {
  std::string_view file;
  std::size_t line = 0, column = 0;
  IfAny<std::size_t> end_column = {};
};
Record<SourcePlace> record_of(const SourcePlace*);
/// nullopt if the span is not valid.
std::optional<SourcePlace> place_of(const Deck& deck, const Span& span);

/// The member "deck". `model` and `interfaces` may be nullptr if not built.
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
/// Members "examined" (number of interfaces) and "not_examined" (others by keyword), for rows with
/// a member `coverage`.
inline constexpr ColumnsOf coverage_columns(
    COLUMN("examined", "Interfaces of TYPE2, 7, 10, 11, 19, 24 and 25", r.coverage.examined),
    COLUMN("not_examined", "Interfaces of other types, by keyword", r.coverage.not_examined));
struct CoverageRow {
  Coverage coverage;
};
Record<CoverageRow> record_of(const CoverageRow*);
Record<Verdict> record_of(const Verdict*);
Record<ItemCounts> record_of(const ItemCounts*);
Record<PartPair> record_of(const PartPair*);
Record<ContactTotals> record_of(const ContactTotals*);

/// The member "accuracy".
struct DecisionsRow {
  const Scene* scene = nullptr;
};
Record<DecisionsRow> record_of(const DecisionsRow*);

/// Numbers of findings, for rows with a member `linted`.
inline constexpr ColumnsOf finding_columns(COLUMN("errors", "", r.linted->result->errors),
                                           COLUMN("warnings", "", r.linted->result->warnings),
                                           COLUMN("infos", "", r.linted->result->infos));

/// The entity that a finding is about.
struct EntityRow {
  const Finding* d = nullptr;
};
Record<EntityRow> record_of(const EntityRow*);
inline std::optional<EntityRow> entity_of(const Finding& d) {
  return d.keyword.empty() ? std::nullopt : std::optional(EntityRow{&d});
}
Record<ReferenceMessage> record_of(const ReferenceMessage*);
Record<NotChecked> record_of(const NotChecked*);
Record<LossEntry> record_of(const LossEntry*);
Record<StepDifference> record_of(const StepDifference*);
Record<ListedPair> record_of(const ListedPair*);
Record<ComparedSteps> record_of(const ComparedSteps*);

Record<RepeatedTies> record_of(const RepeatedTies*);
Record<TieCounts> record_of(const TieCounts*);
/// `all`: every secondary node; else untied nodes and those that the solver lists.
struct TieRow {
  const Model& model;
  bool all = false;
  const Tie* tie;
};
Record<TieRow> record_of(const TieRow*);

/// A finding of a gate.
struct GateFinding {
  const Deck* deck = nullptr;
  const Finding* d = nullptr;
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
/// For the gate: null without bounds; no member without a gate.
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

template <std::size_t N>
std::array<std::int64_t, N> node_ids(const Model& model, const std::array<NodeIndex, N>& nodes) {
  std::array<std::int64_t, N> ids{};
  for (std::size_t i = 0; i < N; ++i) ids[i] = model.node_id(nodes[i]);
  return ids;
}

inline std::vector<std::int64_t> node_ids(const Model& model, const std::vector<NodeIndex>& nodes) {
  std::vector<std::int64_t> ids;
  for (const NodeIndex n : nodes) ids.push_back(model.node_id(n));
  return ids;
}

/// Ids of a pair: of two edges, or of a node and a segment.
struct PairSides {
  const Model* model = nullptr;
  const Contact* contact = nullptr;
  std::uint32_t secondary = 0, main = 0;

  /// Node ids of an item of one side, if the contact has such items.
  template <class Item>
  auto ids_of(bool has_items, const std::vector<Item>& items, std::uint32_t i) const {
    using Ids = decltype(node_ids(*model, items[i].nodes));
    return has_items ? IfAny<Ids>{node_ids(*model, items[i].nodes)} : IfAny<Ids>();
  }
  bool edges() const { return contact->kind == ContactKind::edge_edge; }
  auto edge() const { return ids_of(edges(), contact->secondary_edges, secondary); }
  auto main_edge() const { return ids_of(contact->main.empty(), contact->main_edges, main); }
  auto segment() const { return ids_of(!contact->main.empty(), contact->main, main); }
  IfAny<std::int64_t> node() const {
    if (edges()) return {};
    return {model->node_id(contact->secondary[secondary].node)};
  }
};

/// Measured loop of one contact; null without measurement.
std::optional<ContactCost> measured_cost(const CycleInput& input,
                                         const cycle::ContactOutcome& contact);
Record<ContactCost> record_of(const ContactCost*);
Record<EffectSum> record_of(const EffectSum*);
/// Sum over all contacts; null without measurement.
struct CostsRow {
  const CycleInput* input = nullptr;
  CostSummary sums;
};
std::optional<CostsRow> measured_costs(const CycleInput& input);
Record<CostsRow> record_of(const CostsRow*);

/// The value if known, else null.
template <class T>
std::optional<T> known(bool is_known, const T& value) {
  return is_known ? std::optional<T>(value) : std::nullopt;
}
/// The value if the object has it, else no member.
template <class T>
IfAny<T> if_any(bool is_there, const T& value) {
  return {known(is_there, value)};
}

}  // namespace deck
