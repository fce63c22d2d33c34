// Reads the ids that blocks name: cells of type id, clauses of sets, ranges, header numbers.
#include "keyword/shared/references.hpp"

#include <algorithm>
#include <cstdlib>

#include "deck/text/number.hpp"
#include "text/shared/columns.hpp"

namespace deck {

SetClause set_clause(std::string_view cell) {
  const std::size_t cut = std::min(cell.find('_'), cell.size());
  return {cell.substr(0, cut), cell.substr(cut)};
}

std::string_view kind_of_clause(std::string_view clause) {
  constexpr std::pair<std::string_view, std::string_view> clauses[] = {
      {"SET", "set"},     {"SETCOL", "set"},    {"BOX", "box"},     {"BOX2", "box"},
      {"NODE", "node"},   {"NODENS", "node"},   {"SEG", "node"},    {"PART", "part"},
      {"SUBS", "subset"}, {"SUBM", "submodel"}, {"SHELL", "shell"}, {"SH3N", "sh3n"},
      {"SOLID", "brick"}, {"QUAD", "quad"},     {"TRIA", "tria"},   {"BEAM", "beam"},
      {"TRUSS", "truss"}, {"SPRING", "spring"}};
  for (const auto& [name, kind] : clauses)
    if (name == clause) return kind;
  return {};
}

std::string_view header_reference(const Block& b) {
  constexpr std::string_view materials[] = {"/HEAT/MAT", "/EOS",       "/THERM_STRESS/MAT",
                                            "/VISC",     "/FAIL",      "/LEAK/MAT",
                                            "/ALE/MAT",  "/EULER/MAT", "/NONLOCAL/MAT"};
  for (const std::string_view k : materials)
    if (detail::is_below(b.header, k)) return "mat";
  if (detail::is_below(b.header, "/MOVE_FUNCT")) return "funct";
  constexpr std::string_view parts[] = {"/XELEM", "/SPHCEL", "/XREF", "/SPH/RESERVE"};
  for (const std::string_view k : parts)
    if (detail::is_below(b.header, k)) return "part";
  const bool element = b.schema != nullptr && b.schema->bulk && b.schema->kind != "node";
  return element ? "part" : std::string_view();
}

std::int64_t id_of(const Deck& deck, const Block& block) {
  return block.id.value + (block.schema == nullptr ? 0 : deck.offset_of(block, block.schema->kind));
}

namespace {

class References {
 public:
  References(const Deck& deck, const Block& block) : deck_(deck), block_(block) {}

  void header() {
    const std::string_view kind = header_reference(block_);
    if (kind.empty()) return;
    // The schemas do not say of all of them that their number is an id.
    const std::size_t slash = block_.header.rfind('/');
    const std::int64_t id =
        block_.id.present ? block_.id.value : read_integer(block_.header.substr(slash + 1)).value;
    if (id != 0) add(kind, id, "", block_.id.present ? block_.id.span : block_.header_span);
  }

  void cells(const DecodedBlock& d) {
    const std::string& keyword = block_.schema->keyword;
    if (block_.schema->kind == "set") return clauses(d);
    const bool rows = keyword.ends_with("/GEN_INCR");
    std::vector<const Cell*> list;
    for (const DecodedCard& card : d.cards) {
      const bool range = rows && card.cells.size() == 3 && card.cells[0].integer != 0 &&
                         card.cells[1].integer != 0;
      for (const Cell& c : card.cells)
        if (rows ? range : c.field->type == FieldType::id && c.integer != 0) list.push_back(&c);
    }
    if (rows || keyword.ends_with("/GENE"))
      return ranges(list, list.empty() ? "" : list[0]->field->ref, rows ? 3 : 2, "range");
    for (const Cell* c : list) {
      std::string_view kind = c->field->ref;
      // From 2026 on a smoothed surface may stand in the place of the node group.
      if (block_.schema->kind == "inter" && kind == "grnod" && d.integer("Ists") != 0)
        kind = "surf";
      add(kind, c->integer, c->field->name, c->span);
    }
  }

  std::vector<Reference> take() { return std::move(out_); }

 private:
  void add(std::string_view kind, std::int64_t id, std::string_view field, Span span) {
    if (kind.empty()) return;
    Reference r;
    r.kind = kind;
    r.minus = id < 0;
    r.id = std::abs(id) + deck_.offset_of(block_, kind);
    r.field = field;
    r.span = span;
    out_.push_back(r);
  }

  /// (first, last) or (first, last, increment).
  void ranges(const std::vector<const Cell*>& list, std::string_view kind, std::size_t group,
              std::string_view field) {
    for (std::size_t i = 0; i + group <= list.size(); i += group) {
      add(kind, list[i]->integer, field, list[i]->span);
      if (kind.empty()) continue;
      out_.back().last = list[i + 1]->integer + deck_.offset_of(block_, kind);
      out_.back().step = group == 3 ? std::max<std::int64_t>(list[i + 2]->integer, 1) : 1;
    }
  }

  void clauses(const DecodedBlock& d) {
    std::string_view clause;
    bool triplets = false;
    int rows = 0;  // of the clause so far
    std::vector<const Cell*> list;
    const auto flush = [&] {
      if (triplets) ranges(list, kind_of_clause(clause), 3, clause);
      list.clear();
    };
    for (const DecodedCard& card : d.cards) {
      if (card.cells.empty()) continue;
      if (!card.cells[0].blank()) {
        flush();
        const SetClause word = set_clause(card.cells[0].text);
        clause = word.name;
        triplets = word.ranges();
        rows = 0;
      }
      ++rows;
      if (clause == "ELLIPS" && rows == 1 && card.cells.size() > 7 && card.cells[7].integer != 0)
        add("skew", card.cells[7].integer, clause, card.cells[7].span);
      const std::string_view kind = kind_of_clause(clause);
      if (kind.empty()) continue;
      // The first number of a segment row is its own id.
      for (std::size_t i = clause == "SEG" ? 2 : 1; i < card.cells.size(); ++i) {
        if (card.cells[i].integer == 0) continue;
        if (triplets)
          list.push_back(&card.cells[i]);
        else
          add(kind, card.cells[i].integer, clause, card.cells[i].span);
      }
    }
    flush();
  }

  const Deck& deck_;
  const Block& block_;
  std::vector<Reference> out_;
};

bool names_ids(const Schema& s) {
  return s.kind == "set" || std::any_of(s.cards.begin(), s.cards.end(), [](const CardSchema& card) {
           return std::any_of(card.fields.begin(), card.fields.end(),
                              [](const Field& f) { return f.type == FieldType::id; });
         });
}

}  // namespace

std::vector<Reference> references_of(const Deck& deck, const DecodedBlock& decoded) {
  References r(deck, *decoded.block);
  r.header();
  r.cells(decoded);
  return r.take();
}

std::vector<Reference> references_of(const Deck& deck, const Block& block) {
  References r(deck, block);
  r.header();
  if (block.schema != nullptr && !block.opaque && !block.schema->bulk && names_ids(*block.schema))
    r.cells(decode(deck, block));
  return r.take();
}

Definitions::Definitions(const Deck& deck) {
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && !b.schema->bulk && b.schema->has_id && !b.schema->kind.empty())
      blocks_.emplace(std::pair{b.schema->kind, id_of(deck, b)}, &b);
}

const Block* Definitions::find(std::string_view kind, std::int64_t id) const {
  auto it = blocks_.find(std::pair{std::string(kind), id});
  constexpr std::string_view may_be_sets[] = {"grnod", "surf", "line", "grpart"};
  if (it == blocks_.end() &&
      std::find(std::begin(may_be_sets), std::end(may_be_sets), kind) != std::end(may_be_sets))
    it = blocks_.find(std::pair{std::string("set"), id});
  return it == blocks_.end() ? nullptr : it->second;
}

std::vector<std::pair<std::string, const Block*>> Definitions::with_id(std::int64_t id) const {
  std::vector<std::pair<std::string, const Block*>> out;
  for (const auto& [key, block] : blocks_)
    if (key.second == id) out.emplace_back(key.first, block);
  return out;
}

}  // namespace deck
