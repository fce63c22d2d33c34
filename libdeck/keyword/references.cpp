// Collects the ids that blocks refer to: cells of type id, clauses of sets, ranges, header numbers.
#include "keyword/shared/references.hpp"

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "deck/text.hpp"
#include "text/shared/columns.hpp"

namespace deck {

SetClause set_clause(std::string_view cell) {
  const std::size_t cut = std::min(cell.find('_'), cell.size());
  return {cell.substr(0, cut), cell.substr(cut)};
}

bool set_may_stand_for(std::string_view kind) {
  return kind == "grnod" || kind == "surf" || kind == "line" || kind == "grpart";
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

std::string_view kind_of_id(const DecodedBlock& decoded, const Cell& cell) {
  // From 2026 on the node group can be a smoothed surface.
  const std::string_view kind = cell.field->ref;
  const bool smoothed =
      kind == "grnod" && decoded.block->schema->kind == "inter" && decoded.integer("Ists") != 0;
  return smoothed ? "surf" : kind;
}

std::int64_t id_of(const Deck& deck, const Block& block) {
  return block.id.value + (block.schema == nullptr ? 0 : deck.offset_of(block, block.schema->kind));
}

namespace {

class IdCells {
 public:
  explicit IdCells(const DecodedBlock& d) : d_(d) {}

  std::vector<IdCell> read() {
    const Schema& s = *d_.block->schema;
    if (s.kind == "set")
      clauses();
    else if (s.keyword.ends_with("/GENE"))
      pairs();
    else if (s.keyword.ends_with("/GEN_INCR"))
      triples();
    else
      single_ids();
    return std::move(out_);
  }

 private:
  void single_ids() {
    for (const DecodedCard& card : d_.cards)
      for (const Cell& c : card.cells)
        if (c.field->type == FieldType::id && c.integer != 0)
          add(card, c, kind_of_id(d_, c), c.field->name);
  }

  void pairs() {
    for (const DecodedCard& card : d_.cards)
      for (const Cell& c : card.cells)
        if (c.field->type == FieldType::id && c.integer != 0) waiting_.emplace_back(&card, &c);
    ranges(2);
  }

  /// Ranges (first, last, step), one per line.
  void triples() {
    for (const DecodedCard& card : d_.cards)
      if (card.cells.size() == 3 && card.cells[0].integer != 0 && card.cells[1].integer != 0)
        for (const Cell& c : card.cells) waiting_.emplace_back(&card, &c);
    ranges(3);
  }

  void clauses() {
    std::string_view clause;
    bool triplets = false;
    int rows = 0;  // lines of the clause so far
    const auto flush = [&] {
      if (triplets) ranges(3, kind_of_clause(clause), clause);
      waiting_.clear();
    };
    for (const DecodedCard& card : d_.cards) {
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
        add(card, card.cells[7], "skew", clause);
      const std::string_view kind = kind_of_clause(clause);
      if (kind.empty() && clause != "RBODY") continue;
      // The first number of a segment row is its own id.
      for (std::size_t i = clause == "SEG" ? 2 : 1; i < card.cells.size(); ++i) {
        if (card.cells[i].integer == 0) continue;
        if (triplets)
          waiting_.emplace_back(&card, &card.cells[i]);
        else
          add(card, card.cells[i], kind, clause);
      }
    }
    flush();
  }

  void add(const DecodedCard& card, const Cell& c, std::string_view kind, std::string_view field) {
    out_.push_back({.kind = kind, .field = field, .card = &card, .cell = &c});
  }

  /// Reads (first, last) or (first, last, increment) from the collected cells.
  void ranges(std::size_t group, std::string_view kind, std::string_view field) {
    for (std::size_t i = 0; i + group <= waiting_.size(); i += group) {
      add(*waiting_[i].first, *waiting_[i].second, kind, field);
      IdCell& c = out_.back();
      std::tie(c.last_card, c.last) = waiting_[i + 1];
      c.step = group == 3 ? std::max<std::int64_t>(waiting_[i + 2].second->integer, 1) : 1;
    }
  }
  void ranges(std::size_t group) {
    if (!waiting_.empty()) ranges(group, waiting_[0].second->field->ref, "range");
  }

  const DecodedBlock& d_;
  std::vector<std::pair<const DecodedCard*, const Cell*>> waiting_;
  std::vector<IdCell> out_;
};

class References {
 public:
  References(const Deck& deck, const Block& block) : deck_(deck), block_(block) {}

  void header() {
    const std::string_view kind = header_reference(block_);
    if (kind.empty()) return;
    // Not all schemas declare that the header number is an id.
    const std::size_t slash = block_.header.rfind('/');
    const std::int64_t id =
        block_.id.present ? block_.id.value : read_integer(block_.header.substr(slash + 1)).value;
    if (id != 0) add(kind, id, "", block_.id.present ? block_.id.span : block_.header_span);
  }

  void cells(const DecodedBlock& d) {
    for (const IdCell& c : id_cells(d)) {
      if (c.kind.empty()) continue;
      add(c.kind, c.cell->integer, c.field, c.cell->span);
      if (!c.range()) continue;
      out_.back().last = c.last->integer + deck_.offset_of(block_, c.kind);
      out_.back().step = c.step;
    }
  }

  std::vector<Reference> result() { return std::move(out_); }

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

std::vector<IdCell> id_cells(const DecodedBlock& decoded) { return IdCells(decoded).read(); }

std::vector<Reference> references_of(const Deck& deck, const DecodedBlock& decoded) {
  References r(deck, *decoded.block);
  r.header();
  r.cells(decoded);
  return r.result();
}

std::vector<Reference> references_of(const Deck& deck, const Block& block) {
  References r(deck, block);
  r.header();
  if (block.schema != nullptr && !block.opaque && !block.schema->bulk && names_ids(*block.schema))
    r.cells(decode(deck, block));
  return r.result();
}

Definitions::Definitions(const Deck& deck) {
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && !b.schema->bulk && b.schema->has_id && !b.schema->kind.empty())
      blocks_.emplace(std::pair{b.schema->kind, id_of(deck, b)}, &b);
}

const Block* Definitions::find(std::string_view kind, std::int64_t id) const {
  auto it = blocks_.find(std::pair{std::string(kind), id});
  if (it == blocks_.end() && set_may_stand_for(kind))
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
