// The document of `deck diff --json`.
#include "report/shared/diff.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"

namespace deck {

/// A number, a text or coordinates; null: blank.
template <>
struct Value<DiffValue> {
  static void write(JsonOut& out, const DiffValue& value) {
    std::visit(
        [&](const auto& v) {
          using T = std::remove_cvref_t<decltype(v)>;
          if constexpr (std::same_as<T, std::monostate>)
            out.json.null();
          else
            Value<T>::write(out, v);
        },
        value);
  }
  static JsonForm form(SchemaDefinitions&) {
    return {"",
            R"("oneOf": [{ "type": ["number", "string", "null"] }, )"
            R"({ "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 }])"};
  }
};

namespace {

using Ids = std::vector<std::int64_t>;

struct EntityOfChange {
  const Change* change = nullptr;
};
Record<EntityOfChange> record_of(const EntityOfChange*) {
  using Row = EntityOfChange;
  static constexpr Column<Row> columns[] = {
      column<&Row::change, &Change::keyword>("keyword"),
      column("id", "In the first deck; of an added entity in the second",
             [](const Row& r) { return known(r.change->id != 0, r.change->id); }),
      column("id_b", "In the second deck, if it differs",
             [](const Row& r) { return if_any(r.change->id_b != 0, r.change->id_b); }),
      column<&Row::change, &Change::title>("title")};
  return {"changed_entity", "", columns, true};
}

struct ChangeRow {
  const Deck &deck_a, &deck_b;
  const Change* change = nullptr;
  EntityOfChange entity() const { return {change}; }
  std::optional<std::string> field() const { return known(!change->field.empty(), change->field); }
  std::optional<Place> a() const { return place_of(deck_a, change->a); }
  std::optional<Place> b() const { return place_of(deck_b, change->b); }
  template <class T>
  IfAny<T> evaluated(const T& value) const {
    return if_any(change->evaluated, value);
  }
  IfAny<Ids> members(const Ids& ids) const {
    return if_any(!change->gained.empty() || !change->lost.empty() || !change->altered.empty(),
                  ids);
  }
};
Record<ChangeRow> record_of(const ChangeRow*) {
  using Row = ChangeRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::change, &Change::kind>("kind"),
      column<&Row::change, &Change::group>(
          "group", "deck, interface, group, part, property, material, node or other"),
      column<&Row::entity>("entity"),
      column<&Row::field>("field", "null: the entity as a whole was added or removed"),
      column<&Row::change, &Change::old_value>(
          "old", "As on the card; of lists the number of members; null: blank"),
      column<&Row::change, &Change::new_value>("new"),
      column("effective_old", "Of a field of a contact",
             [](const Row& r) { return r.evaluated(r.change->effective_old); }),
      column("effective_new", [](const Row& r) { return r.evaluated(r.change->effective_new); }),
      column("why", "Origin of the new effective value: card, default-block, built-in, derived",
             [](const Row& r) { return r.evaluated(r.change->why); }),
      column("gained", "Ids of members", [](const Row& r) { return r.members(r.change->gained); }),
      column("lost", [](const Row& r) { return r.members(r.change->lost); }),
      column("altered", [](const Row& r) { return r.members(r.change->altered); }),
      column<&Row::a>("a", "Place in the first deck"),
      column<&Row::b>("b", "Place in the second deck")};
  return {"change", "", columns};
}

struct SideOfDiff {
  const DiffSide* side = nullptr;
  DeckRow deck() const {
    const LoadedDeck& loaded = side->loaded;
    return {loaded.path(), &loaded.deck(), &loaded.model(), &loaded.interfaces()};
  }
  IfAny<Verdict> verdict() const {
    return side->verdict == nullptr ? IfAny<Verdict>{} : IfAny<Verdict>{*side->verdict};
  }
};
Record<SideOfDiff> record_of(const SideOfDiff*) {
  static constexpr Column<SideOfDiff> columns[] = {column<&SideOfDiff::deck>("deck"),
                                                   column<&SideOfDiff::verdict>("verdict")};
  return {"side", "", columns};
}

struct PenetrationsRow {
  const DeckDiff* diff = nullptr;
  static Rows<PenetrationChange> rows(const std::vector<PenetrationChange>& list) {
    return rows_of(list);
  }
};
Record<PenetrationsRow> record_of(const PenetrationsRow*) {
  using Row = PenetrationsRow;
  static constexpr Column<Row> columns[] = {
      column("new", [](const Row& r) { return Row::rows(r.diff->appeared); }),
      column("gone", [](const Row& r) { return Row::rows(r.diff->gone); }),
      column("worse", [](const Row& r) { return Row::rows(r.diff->worse); }),
      column("better", [](const Row& r) { return Row::rows(r.diff->better); }),
      column("same", "How many", [](const Row& r) { return r.diff->same.size(); })};
  return {"penetrations", "", columns};
}

struct DiffDocument {
  const DiffSide &side_a, &side_b;
  const DeckDiff& diff;
  SideOfDiff a() const { return {&side_a}; }
  SideOfDiff b() const { return {&side_b}; }
  bool equal() const { return diff.equal(); }
  std::string text() const { return diff_verdict(diff); }
  Rows<std::string> notes() const { return rows_of(diff.notes); }
  Rows<ChangeRow> changes() const {
    return rows_of(diff.changes, [this](const Change& c) {
      return ChangeRow{side_a.loaded.deck(), side_b.loaded.deck(), &c};
    });
  }
  PenetrationsRow penetrations() const { return {&diff}; }
};
Record<DiffDocument> record_of(const DiffDocument*) {
  static constexpr Column<DiffDocument> columns[] = {
      column<&DiffDocument::a>("a"),
      column<&DiffDocument::b>("b"),
      column<&DiffDocument::equal>("equal"),
      column<&DiffDocument::text>("text", "The result as a sentence"),
      column<&DiffDocument::notes>("notes"),
      column<&DiffDocument::changes>("changes"),
      column<&DiffDocument::penetrations>("penetrations")};
  return {"document", "", columns};
}

constexpr DocumentHead diff_head{"deck/diff", 1, "Written by deck diff A B --json.", false};

}  // namespace

template <>
inline constexpr std::size_t word_count<ChangeKind> = 4;

Record<PenetrationChange> record_of(const PenetrationChange*) {
  using Row = PenetrationChange;
  static constexpr Column<Row> columns[] = {
      column<&Row::interface_id>("interface"),
      column<&Row::role>("role"),
      column("node", "Secondary node",
             [](const Row& r) { return if_any(r.secondary[1] == 0, r.secondary[0]); }),
      column("edge", "Secondary edge",
             [](const Row& r) { return if_any(r.secondary[1] != 0, r.secondary); }),
      column<&Row::depth_old>("depth_old"),
      column<&Row::depth_new>("depth_new"),
      column<&Row::gap_old>("gap_old"),
      column<&Row::gap_new>("gap_new")};
  return {"changed_penetration", "A node or edge, by its deepest pair.", columns, true};
}

DocumentSchema diff_schema() { return document_schema<DiffDocument>(diff_head); }

std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff) {
  return write_document(diff_head, DiffDocument{a, b, diff});
}

}  // namespace deck
