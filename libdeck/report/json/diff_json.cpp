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
const Record<EntityOfChange>& record_of(const EntityOfChange*) {
  using Row = EntityOfChange;
  static constexpr Column<Row> columns[] = {
      column<&Row::change, &Change::keyword>("keyword"),
      column<Row>("id", "In the first deck; of an added entity in the second",
                  [](const Row& r) { return known(r.change->id != 0, r.change->id); }),
      column<Row>("id_b", "In the second deck, if it differs",
                  [](const Row& r) { return if_any(r.change->id_b != 0, r.change->id_b); }),
      column<&Row::change, &Change::title>("title")};
  static const Record<Row> record{"changed_entity", "", columns, true};
  return record;
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
const Record<ChangeRow>& record_of(const ChangeRow*) {
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
      column<Row>("effective_old", "Of a field of a contact",
                  [](const Row& r) { return r.evaluated(r.change->effective_old); }),
      column<Row>("effective_new", "",
                  [](const Row& r) { return r.evaluated(r.change->effective_new); }),
      column<Row>("why",
                  "Origin of the new effective value: card, default-block, built-in, derived",
                  [](const Row& r) { return r.evaluated(r.change->why); }),
      column<Row>("gained", "Ids of members",
                  [](const Row& r) { return r.members(r.change->gained); }),
      column<Row>("lost", "", [](const Row& r) { return r.members(r.change->lost); }),
      column<Row>("altered", "", [](const Row& r) { return r.members(r.change->altered); }),
      column<&Row::a>("a", "Place in the first deck"),
      column<&Row::b>("b", "Place in the second deck")};
  static const Record<Row> record{"change", "", columns};
  return record;
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
const Record<SideOfDiff>& record_of(const SideOfDiff*) {
  using Row = SideOfDiff;
  static constexpr Column<Row> columns[] = {column<&Row::deck>("deck"),
                                            column<&Row::verdict>("verdict")};
  static const Record<Row> record{"side", "", columns};
  return record;
}

struct PenetrationsRow {
  const DeckDiff* diff = nullptr;
  static Rows<PenetrationChange> rows(const std::vector<PenetrationChange>& list) {
    return {[&list](const auto& add) {
      for (const PenetrationChange& p : list) add(p);
    }};
  }
};
const Record<PenetrationsRow>& record_of(const PenetrationsRow*) {
  using Row = PenetrationsRow;
  static constexpr Column<Row> columns[] = {
      column<Row>("new", "", [](const Row& r) { return Row::rows(r.diff->appeared); }),
      column<Row>("gone", "", [](const Row& r) { return Row::rows(r.diff->gone); }),
      column<Row>("worse", "", [](const Row& r) { return Row::rows(r.diff->worse); }),
      column<Row>("better", "", [](const Row& r) { return Row::rows(r.diff->better); }),
      column<Row>("same", "How many", [](const Row& r) { return r.diff->same.size(); })};
  static const Record<Row> record{"penetrations", "", columns};
  return record;
}

struct DiffDocument {
  const DiffSide &side_a, &side_b;
  const DeckDiff& diff;
  SideOfDiff a() const { return {&side_a}; }
  SideOfDiff b() const { return {&side_b}; }
  bool equal() const { return diff.equal(); }
  std::string text() const { return diff_verdict(diff); }
  Rows<std::string> notes() const {
    return {[this](const auto& add) {
      for (const std::string& note : diff.notes) add(note);
    }};
  }
  Rows<ChangeRow> changes() const {
    return {[this](const auto& add) {
      for (const Change& c : diff.changes) add({side_a.loaded.deck(), side_b.loaded.deck(), &c});
    }};
  }
  PenetrationsRow penetrations() const { return {&diff}; }
};
const Record<DiffDocument>& record_of(const DiffDocument*) {
  using Row = DiffDocument;
  static constexpr Column<Row> columns[] = {column<&Row::a>("a"),
                                            column<&Row::b>("b"),
                                            column<&Row::equal>("equal"),
                                            column<&Row::text>("text", "The result as a sentence"),
                                            column<&Row::notes>("notes"),
                                            column<&Row::changes>("changes"),
                                            column<&Row::penetrations>("penetrations")};
  static const Record<Row> record{"document", "", columns};
  return record;
}

constexpr DocumentHead head{"deck/diff", 1, "Written by deck diff A B --json.", false};

}  // namespace

template <>
inline constexpr std::size_t word_count<ChangeKind> = 4;

const Record<PenetrationChange>& record_of(const PenetrationChange*) {
  using Row = PenetrationChange;
  static constexpr Column<Row> columns[] = {
      column<&Row::interface_id>("interface"),
      column<&Row::role>("role"),
      column<Row>("node", "Secondary node",
                  [](const Row& r) { return if_any(r.secondary[1] == 0, r.secondary[0]); }),
      column<Row>("edge", "Secondary edge",
                  [](const Row& r) { return if_any(r.secondary[1] != 0, r.secondary); }),
      column<&Row::depth_old>("depth_old"),
      column<&Row::depth_new>("depth_new"),
      column<&Row::gap_old>("gap_old"),
      column<&Row::gap_new>("gap_new")};
  static const Record<Row> record{"changed_penetration", "A node or edge, by its deepest pair.",
                                  columns, true};
  return record;
}

DocumentSchema diff_schema() { return document_schema<DiffDocument>(head); }

std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff) {
  return write_document(head, DiffDocument{a, b, diff});
}

}  // namespace deck
