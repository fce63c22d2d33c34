// /SET/GENERAL and /SET/COLLECT: clauses evaluated from top to bottom into elements, nodes and
// segments. The three projections are in selection_set_views.cpp.
#include <algorithm>

#include "model/selection_impl.hpp"

namespace deck {

using detail::Definition;
using detail::IdRef;
using detail::Indices;
using detail::SetState;

namespace detail {
namespace {

enum class Operator { add, subtract, intersect };

/// One clause with its continuation lines.
struct Clause {
  std::string_view kind;
  std::string options;  ///< option letters
  Span span;            ///< the clause keyword
  std::vector<const DecodedCard*> lines;
  std::vector<IdRef> ids;  ///< no offset yet
  bool has(char option) const { return options.find(option) != std::string::npos; }
};

std::vector<Clause> clauses_of(const DecodedBlock& d) {
  std::vector<Clause> clauses;
  for (const DecodedCard& card : d.cards) {
    if (card.cells.empty()) continue;
    const Cell& head = card.cells.front();
    if (!head.blank()) {
      Clause clause;
      std::string_view text = head.text;
      const std::size_t cut = std::min(text.find('_'), text.size());
      clause.kind = text.substr(0, cut);
      for (const char ch : text.substr(cut))
        if (ch != '_') clause.options += ch;
      clause.span = head.span;
      clauses.push_back(std::move(clause));
    }
    if (clauses.empty()) continue;
    Clause& clause = clauses.back();
    clause.lines.push_back(&card);
    for (std::size_t i = 1; i < card.cells.size(); ++i)
      if (card.cells[i].integer != 0)
        clause.ids.push_back({card.cells[i].integer, card.cells[i].span});
  }
  return clauses;
}

Indices combine(const Indices& a, const Indices& b, Operator op) {
  Indices out;
  switch (op) {
    case Operator::add:
      std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
      break;
    case Operator::subtract:
      std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
      break;
    case Operator::intersect:
      std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
      break;
  }
  return out;
}

bool same_segment(const Segment& a, const Segment& b) {
  return node_key(a.nodes.data(), 4) == node_key(b.nodes.data(), 4);
}
bool same_edge(const Edge& a, const Edge& b) {
  return std::minmax(a.nodes[0], a.nodes[1]) == std::minmax(b.nodes[0], b.nodes[1]);
}

/// Adds, removes or keeps what `clause` selects.
void apply(SetState& set, const SetState& clause, Operator op) {
  for (std::size_t k = 0; k < SetState::families; ++k)
    set.elements[k] = combine(set.elements[k], clause.elements[k], op);
  set.parts = combine(set.parts, clause.parts, op);
  if (op == Operator::add) {
    set.reversed4 = combine(set.reversed4, clause.reversed4, op);
    set.reversed3 = combine(set.reversed3, clause.reversed3, op);
    set.all_faces = combine(set.all_faces, clause.all_faces, op);
    set.nodes = combine(set.nodes, clause.nodes, op);
    set.removed = combine(set.removed, clause.nodes, Operator::subtract);
    set.segments.insert(set.segments.end(), clause.segments.begin(), clause.segments.end());
    set.edges.insert(set.edges.end(), clause.edges.begin(), clause.edges.end());
    set.external = set.external || clause.external;
    return;
  }
  const bool removes = op == Operator::subtract;
  set.nodes = combine(set.nodes, clause.nodes, op);
  if (removes) set.removed = combine(set.removed, clause.nodes, Operator::add);
  std::erase_if(set.segments, [&](const Segment& s) {
    return std::any_of(clause.segments.begin(), clause.segments.end(),
                       [&](const Segment& other) { return same_segment(s, other); }) == removes;
  });
  std::erase_if(set.edges, [&](const Edge& e) {
    return std::any_of(clause.edges.begin(), clause.edges.end(),
                       [&](const Edge& other) { return same_edge(e, other); }) == removes;
  });
}

struct ElementClause {
  std::string_view keyword;
  ElementKind kind;
};
constexpr ElementClause element_clauses[] = {
    {"SHELL", ElementKind::shell4}, {"SH3N", ElementKind::shell3},  {"SOLID", ElementKind::solid8},
    {"QUAD", ElementKind::quad},    {"TRIA", ElementKind::tria},    {"BEAM", ElementKind::beam},
    {"TRUSS", ElementKind::truss},  {"SPRING", ElementKind::spring}};

/// Evaluates one clause into an own state.
class ClauseReader {
 public:
  ClauseReader(Selections::Impl& all, const Block& block, const Clause& clause)
      : all_(all), block_(block), clause_(clause) {}

  SetState read() {
    const std::string_view kind = clause_.kind;
    if (kind == "NODE" || kind == "NODENS") {
      nodes();
    } else if (kind == "PART" || kind == "SUBS" || kind == "SUBM") {
      parts();
    } else if (kind == "SET" || kind == "SETCOL") {
      sets();
    } else if (kind == "BOX" || kind == "BOX2") {
      boxes();
    } else if (kind == "SEG") {
      segments();
    } else if (kind == "ALL") {
      everything();
    } else if (const auto* e = element_clause(kind)) {
      elements(e->kind);
    } else if (kind == "PLANE" || kind == "ELLIPS") {
      // Analytical surfaces have neither nodes nor segments.
    } else if (kind == "RBODY") {
      unsupported("clauses of rigid bodies are not evaluated here");
    } else {
      all_.report({"DK160", Severity::error, clause_.span,
                   "'" + std::string(kind) + "' is no clause of a set", "it stops with an error",
                   "correct the clause keyword", 1906, Severity::error, std::string(block_.keyword),
                   block_.id.value});
    }
    finish();
    return std::move(state_);
  }

 private:
  static const ElementClause* element_clause(std::string_view kind) {
    for (const ElementClause& e : element_clauses)
      if (e.keyword == kind) return &e;
    return nullptr;
  }

  void unsupported(const std::string& what) {
    all_.report({"DK164", Severity::warning, clause_.span,
                 std::string(block_.keyword) + " " + std::to_string(block_.id.value) + ": " + what,
                 "it evaluates the clause", "use other clauses if the contacts of this set matter",
                 0, Severity::warning, std::string(block_.keyword), block_.id.value});
  }

  /// What the options change after the members are known.
  void finish() {
    for (const char option : clause_.options) {
      if (option == 'O') {
        state_.reversed4 = state_.elements[static_cast<std::size_t>(ElementKind::shell4)];
        state_.reversed3 = state_.elements[static_cast<std::size_t>(ElementKind::shell3)];
      } else if (option == 'A') {
        state_.all_faces = state_.elements[static_cast<std::size_t>(ElementKind::solid8)];
      } else if (option == 'E') {
        state_.external = true;
      } else if (option == 'B' || option == 'C') {
        unsupported(std::string("option ") + option + " is not evaluated here");
      }
    }
  }

  /// Ids of the clause with their offset; option G expands (first, last, increment).
  std::vector<IdRef> ids(std::string_view kind, const std::vector<std::int64_t>& existing) {
    std::vector<IdRef> out;
    const std::int64_t offset = all_.deck().offset_of(block_, kind);
    if (!clause_.has('G')) {
      for (const IdRef& ref : clause_.ids) out.push_back({ref.id + offset, ref.span});
      return out;
    }
    for (std::size_t i = 0; i + 3 <= clause_.ids.size(); i += 3) {
      const std::int64_t first = clause_.ids[i].id + offset;
      const std::int64_t last = clause_.ids[i + 1].id + offset;
      const std::int64_t increment = clause_.ids[i + 2].id;
      if (increment <= 0) continue;
      for (const std::int64_t id : existing)
        if (id >= first && id <= last && (id - first) % increment == 0)
          out.push_back({id, clause_.ids[i].span});
    }
    return out;
  }

  void missing(const std::string& what, const std::vector<IdRef>& refs) {
    all_.report_missing("DK161", block_, what, refs, 1902, Severity::warning);
  }

  void nodes() {
    std::vector<IdRef> absent;
    for (const IdRef& ref : ids("node", all_.model->nodes.id)) {
      const NodeIndex n = all_.node(ref.id);
      if (n == no_index)
        absent.push_back(ref);
      else
        state_.nodes.push_back(n);
    }
    normalise(state_.nodes);
    missing("node", absent);
  }

  void add_parts(const Indices& parts) {
    state_.parts.insert(state_.parts.end(), parts.begin(), parts.end());
    normalise(state_.parts);
    for (std::size_t k = 0; k < SetState::families; ++k) {
      const auto kind = static_cast<ElementKind>(k);
      if (all_.model->family(kind).size() == 0) continue;
      const PartElements& rows = all_.elements_of_parts(kind);
      for (const std::uint32_t p : state_.parts)
        state_.elements[k].insert(state_.elements[k].end(), rows.row(p).begin(), rows.row(p).end());
      normalise(state_.elements[k]);
    }
  }

  void parts() {
    const std::string_view type = clause_.kind == "PART"   ? "PART"
                                  : clause_.kind == "SUBS" ? "SUBSET"
                                                           : "SUBMODEL";
    const std::string_view kind = clause_.kind == "PART"   ? "part"
                                  : clause_.kind == "SUBS" ? "subset"
                                                           : "submodel";
    std::vector<std::int64_t> existing;
    if (clause_.has('G')) {
      if (kind == "part")
        for (const Part& p : all_.model->parts) existing.push_back(p.id);
      else if (kind == "subset")
        for (const auto& [id, children] : all_.model->subset_children) existing.push_back(id);
      else
        for (const auto& [id, span] : all_.model->submodels) existing.push_back(id);
    }
    std::vector<IdRef> absent;
    Indices found;
    for (const IdRef& ref : ids(kind, existing)) {
      bool known = false;
      const Indices some = all_.parts_of(type, ref.id, known);
      if (!known) absent.push_back(ref);
      found.insert(found.end(), some.begin(), some.end());
    }
    add_parts(found);
    missing(std::string(kind), absent);
  }

  void everything() {
    Indices parts(all_.model->parts.size());
    for (std::uint32_t p = 0; p < parts.size(); ++p) parts[p] = p;
    add_parts(parts);
    state_.nodes.resize(all_.model->nodes.size());
    for (NodeIndex n = 0; n < state_.nodes.size(); ++n) state_.nodes[n] = n;
  }

  void elements(ElementKind kind) {
    const Elements& family = all_.model->family(kind);
    if (family.size() == 0) {
      all_.report({"DK163", Severity::warning, clause_.span,
                   std::string(block_.keyword) + " " + std::to_string(block_.id.value) +
                       " has a clause " + std::string(clause_.kind) +
                       ", but the model has no such element",
                   "it warns and ignores the clause", "remove the clause", 2007, Severity::warning,
                   std::string(block_.keyword), block_.id.value});
      return;
    }
    std::vector<IdRef> absent;
    Indices& out = state_.elements[static_cast<std::size_t>(kind)];
    for (const IdRef& ref : ids(family_name(kind).id_kind, family.id)) {
      const std::uint32_t e = family.map.find(ref.id);
      if (e == no_index)
        absent.push_back(ref);
      else
        out.push_back(e);
    }
    normalise(out);
    missing("element", absent);
  }

  void sets() {
    const auto table = all_.tables.find("set");
    std::vector<std::int64_t> existing;
    if (table != all_.tables.end()) existing = table->second.order;
    std::vector<IdRef> absent;
    for (const IdRef& ref : ids("set", existing)) {
      if (all_.recursive("set", ref.id, block_, 176)) continue;
      const SetState* other = all_.set_state(ref.id);
      if (other == nullptr)
        absent.push_back(ref);
      else
        apply(state_, *other, Operator::add);
    }
    missing("set", absent);
  }

  void boxes() {
    const bool any_node = clause_.kind == "BOX2";
    const std::int64_t offset = all_.deck().offset_of(block_, "box");
    for (const IdRef& ref : clause_.ids) {
      const Box* b = all_.box(ref.id + offset, block_, 796);
      if (b == nullptr) continue;
      for (std::size_t k = 0; k < SetState::families; ++k) {
        const Indices in = all_.elements_in_box(*b, static_cast<ElementKind>(k), any_node);
        state_.elements[k] = combine(state_.elements[k], in, Operator::add);
      }
      for (NodeIndex n = 0; n < all_.model->nodes.size(); ++n) {
        const auto p = all_.box_point(n);
        if (b->contains(p[0], p[1], p[2])) state_.nodes.push_back(n);
      }
    }
    normalise(state_.nodes);
  }

  void segments() {
    std::vector<IdRef> absent;
    const std::int64_t offset = all_.deck().offset_of(block_, "node");
    for (const DecodedCard* card : clause_.lines) {
      // Cells: clause, segment id, four nodes.
      std::array<NodeIndex, 4> n{no_index, no_index, no_index, no_index};
      std::size_t have = 0;
      bool complete = true;
      for (std::size_t i = 2; i < 6 && i < card->cells.size(); ++i) {
        const Cell& cell = card->cells[i];
        if (cell.integer == 0) continue;
        n[have] = all_.node(cell.integer + offset);
        if (n[have] == no_index) {
          absent.push_back({cell.integer + offset, cell.span});
          complete = false;
        }
        ++have;
      }
      if (!complete || have < 2) continue;
      if (have == 2)
        state_.edges.push_back({{n[0], n[1]}, Carrier::none, no_index});
      else
        all_.add_plain_segment({{n[0], n[1], n[2], have == 4 ? n[3] : n[2]}}, state_.segments);
    }
    all_.report_missing("DK162", block_, "node", absent, 1903, Severity::error);
  }

  Selections::Impl& all_;
  const Block& block_;
  const Clause& clause_;
  SetState state_;
};

}  // namespace
}  // namespace detail

const SetState* Selections::Impl::set_state(std::int64_t id) {
  if (const auto it = set_states.find(id); it != set_states.end()) return &it->second;
  const auto table = tables.find("set");
  if (table == tables.end()) return nullptr;
  const auto defs = table->second.by_id.find(id);
  if (defs == table->second.by_id.end()) return nullptr;
  if (recursive("set", id, *defs->second.front().block, 176)) return nullptr;
  const auto guard = open.emplace("set", id).first;
  SetState state;
  for (const Definition& def : defs->second) {
    const DecodedBlock d = decode(deck(), *def.block);
    for (const detail::Clause& clause : detail::clauses_of(d)) {
      const auto op = clause.has('D')   ? detail::Operator::subtract
                      : clause.has('I') ? detail::Operator::intersect
                                        : detail::Operator::add;
      SetState selected = detail::ClauseReader(*this, *def.block, clause).read();
      if (op == detail::Operator::intersect) {
        // Nodes of elements count as well as nodes named; a clause of nodes keeps no element.
        selected.nodes = node_projection(selected);
        state.nodes = node_projection(state);
      }
      detail::apply(state, selected, op);
    }
  }
  open.erase(guard);
  return &set_states.emplace(id, std::move(state)).first->second;
}

}  // namespace deck
