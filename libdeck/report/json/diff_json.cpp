// The document of `deck diff --json`.
#include "report/shared/inspection.hpp"
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

template <>
inline constexpr std::size_t word_count<ChangeKind> = 4;

LINE_RECORD(PenetrationChange, "changed_penetration", "A node or edge, by its deepest pair.",
            COLUMN("interface", "", r.interface_id), COLUMN("role", "", r.role),
            COLUMN("node", "Secondary node", if_any(r.secondary[1] == 0, r.secondary[0])),
            COLUMN("edge", "Secondary edge", if_any(r.secondary[1] != 0, r.secondary)),
            COLUMN("depth_old", "", r.depth_old), COLUMN("depth_new", "", r.depth_new),
            COLUMN("gap_old", "", r.gap_old), COLUMN("gap_new", "", r.gap_new));

namespace {

struct EntityOfChange {
  const Change* change = nullptr;
};
LINE_RECORD(EntityOfChange, "changed_entity", "", COLUMN("keyword", "", r.change->keyword),
            COLUMN("id", "In the first deck; of an added entity in the second",
                   known(r.change->id != 0, r.change->id)),
            COLUMN("id_b", "In the second deck, if it differs",
                   if_any(r.change->id_b != 0, r.change->id_b)),
            COLUMN("title", "", r.change->title));

struct ChangeRow {
  const Deck &deck_a, &deck_b;
  const Change* change = nullptr;

  IfAny<std::vector<std::int64_t>> members(const std::vector<std::int64_t>& ids) const {
    return if_any(!change->gained.empty() || !change->lost.empty() || !change->altered.empty(),
                  ids);
  }
};
RECORD(ChangeRow, "change", "", COLUMN("kind", "", r.change->kind),
       COLUMN("group", "deck, interface, group, part, property, material, node or other",
              r.change->group),
       COLUMN("entity", "", EntityOfChange{r.change}),
       COLUMN("field", "null: the entity as a whole was added or removed",
              known(!r.change->field.empty(), r.change->field)),
       COLUMN("old", "As on the card; of lists the number of members; null: blank",
              r.change->old_value),
       COLUMN("new", "", r.change->new_value),
       COLUMN("effective_old", "Of a field of a contact",
              if_any(r.change->evaluated, r.change->effective_old)),
       COLUMN("effective_new", "", if_any(r.change->evaluated, r.change->effective_new)),
       COLUMN("why", "Origin of the new effective value: card, default-block, built-in, derived",
              if_any(r.change->evaluated, r.change->why)),
       COLUMN("gained", "Ids of members", r.members(r.change->gained)),
       COLUMN("lost", "", r.members(r.change->lost)),
       COLUMN("altered", "", r.members(r.change->altered)),
       COLUMN("a", "Place in the first deck", place_of(r.deck_a, r.change->a)),
       COLUMN("b", "Place in the second deck", place_of(r.deck_b, r.change->b)));

struct SideOfDiff {
  const DiffSide* side = nullptr;
};
RECORD(SideOfDiff, "side", "", COLUMN("deck", "", deck_row(r.side->loaded)),
       COLUMN("verdict", "",
              r.side->verdict == nullptr ? IfAny<Verdict>{} : if_any(true, *r.side->verdict)));

struct DiffDocument {
  const DiffSide &a, &b;
  const DeckDiff& diff;
};
RECORD(DiffDocument, "document", "", COLUMN("a", "", SideOfDiff{&r.a}),
       COLUMN("b", "", SideOfDiff{&r.b}), COLUMN("equal", "", r.diff.equal()),
       COLUMN("text", "The result as a sentence", diff_verdict(r.diff)),
       COLUMN("notes", "", rows_of(r.diff.notes)),
       COLUMN("changes", "", rows<ChangeRow>(r.diff.changes, r.a.loaded.deck(), r.b.loaded.deck())),
       OBJECT("penetrations", "", COLUMN("new", "", rows_of(r.diff.appeared)),
              COLUMN("gone", "", rows_of(r.diff.gone)), COLUMN("worse", "", rows_of(r.diff.worse)),
              COLUMN("better", "", rows_of(r.diff.better)),
              COLUMN("same", "How many", r.diff.same.size())));

constexpr DocumentHead diff_head{"deck/diff", 1, "Written by deck diff A B --json.", false};

}  // namespace

DocumentSchema diff_schema() { return document_schema<DiffDocument>(diff_head); }

std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff) {
  return write_document(diff_head, DiffDocument{a, b, diff});
}

}  // namespace deck
