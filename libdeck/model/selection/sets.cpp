// /SET/GENERAL and /SET/COLLECT: evaluates clauses from top to bottom to elements, nodes and
// segments. selection_set_views.cpp has the projections.
#include <fmt/format.h>

#include <algorithm>

#include "keyword/shared/references.hpp"
#include "model/selection/selection_impl.hpp"

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
  std::string_view options;  ///< option letters and '_'
  Span span;                 ///< the clause keyword
  std::vector<const DecodedCard*> lines;
  std::vector<IdRef> ids;  ///< without offset
  bool of_parts() const { return kind == "PART" || kind == "SUBS" || kind == "SUBM"; }
  bool has(char option) const { return options.find(option) != options.npos; }
};

std::vector<Clause> clauses_of(const DecodedBlock& d) {
  std::vector<Clause> clauses;
  for (const DecodedCard& card : d.cards) {
    if (card.cells.empty()) continue;
    const Cell& head = card.cells.front();
    if (!head.blank()) {
      const SetClause word = set_clause(head.text);
      clauses.push_back({word.name, word.options, head.span, {}, {}});
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
  if (op == Operator::subtract) return without(a, b);
  if (op == Operator::intersect) return common(a, b);
  Indices out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

bool same_segment(const Segment& a, const Segment& b) {
  return node_key(a.nodes.data(), 4) == node_key(b.nodes.data(), 4);
}
bool same_edge(const Edge& a, const Edge& b) {
  return std::minmax(a.nodes[0], a.nodes[1]) == std::minmax(b.nodes[0], b.nodes[1]);
}

void add(SetGroup& group, const SetGroup& clause) {
  const auto solids = static_cast<std::size_t>(ElementKind::solid8);
  if (!clause.elements[solids].empty())
    group.against_all = clause.against_all && (group.elements[solids].empty() || group.against_all);
  const auto join = [](Indices& a, const Indices& b) { a = combine(a, b, Operator::add); };
  for (std::size_t k = 0; k < SetGroup::families; ++k) join(group.elements[k], clause.elements[k]);
  join(group.reversed4, clause.reversed4);
  join(group.reversed3, clause.reversed3);
  join(group.all_faces, clause.all_faces);
  join(group.named, clause.named);
  const auto append = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
  append(group.rows, clause.rows);
  append(group.row_edges, clause.row_edges);
  group.external = group.external || clause.external;
}

/// Merges all groups of a set into its own.
SetGroup& unite(SetState& set) {
  for (const SetGroup* group : set.others) add(set.own, *group);
  set.others.clear();
  set.known.clear();
  return set.own;
}

/// Removes the selection of `clause`, or intersects with it.
void reduce_set(SetState& set, const SetState& clause, Operator op) {
  SetGroup& group = unite(set);
  SetGroup other;
  clause.for_each_group([&](const SetGroup& g) { add(other, g); });
  for (std::size_t k = 0; k < SetGroup::families; ++k)
    group.elements[k] = combine(group.elements[k], other.elements[k], op);
  set.parts = combine(set.parts, clause.parts, op);
  const bool removes = op == Operator::subtract;
  group.named = combine(group.named, other.named, op);
  if (removes) set.removed = combine(set.removed, other.named, Operator::add);
  std::erase_if(group.rows, [&](const Segment& s) {
    return std::any_of(other.rows.begin(), other.rows.end(),
                       [&](const Segment& o) { return same_segment(s, o); }) == removes;
  });
  std::erase_if(group.row_edges, [&](const Edge& e) {
    return std::any_of(other.row_edges.begin(), other.row_edges.end(),
                       [&](const Edge& o) { return same_edge(e, o); }) == removes;
  });
}

constexpr std::size_t bytes_of_a_member = sizeof(std::uint32_t);

/// Adds the selection of a clause: clauses of parts to the own group, others as separate groups.
void join(Selections::Impl& all, SetState& set, SetState clause, bool of_parts,
          const Block& block) {
  set.parts = combine(set.parts, clause.parts, Operator::add);
  if (!set.removed.empty())
    clause.for_each_group([&](const SetGroup& group) {
      SegmentsOfGroup last;
      set.removed = combine(set.removed, all.group_nodes(group, last), Operator::subtract);
    });
  if (of_parts) {
    clause.for_each_group([&](const SetGroup& group) { add(set.own, group); });
    return;
  }
  if (!clause.own.empty() && all.reserve_bytes(clause.own.size(), bytes_of_a_member, block)) {
    all.clause_groups.push_back(std::move(clause.own));
    all.share_groups(set, {&all.clause_groups.back()}, block);
  }
  all.share_groups(set, clause.others, block);
}

/// Element kind of a clause; nullopt: not about elements.
std::optional<ElementKind> family_of_clause(std::string_view kind) {
  for (const FamilyName& name : family_names())
    if (name.clause == kind) return name.kind;
  return std::nullopt;
}

/// Evaluates one clause.
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
    } else if (const auto family = family_of_clause(kind)) {
      elements(*family);
    } else if (kind == "PLANE" || kind == "ELLIPS") {
      // Analytical surfaces have no nodes and segments.
    } else if (kind == "RBODY") {
      unsupported("deck does not evaluate clauses of rigid bodies");
    } else {
      report(RuleId::DK160, "'" + std::string(kind) + "' is not a clause of a set");
    }
    apply_options();
    return std::move(state_);
  }

 private:
  void report(RuleId rule, std::string what) {
    all_.report(
        {rule, clause_.span, std::move(what), std::string(block_.keyword), block_.id.value});
  }
  void unsupported(const std::string& what) {
    report(RuleId::DK164, name_of(block_) + ": " + what);
  }

  /// Applies the options, after the members are known.
  void apply_options() {
    if (clause_.kind == "SUBS" || clause_.kind == "SUBM" || clause_.kind == "ALL" ||
        clause_.kind == "BOX" || clause_.kind == "BOX2")
      group().against_all = true;
    for (const char option : clause_.options) {
      if (option == 'O') {
        group().reversed4 = of(ElementKind::shell4);
        group().reversed3 = of(ElementKind::shell3);
      } else if (option == 'A') {
        group().all_faces = of(ElementKind::solid8);
      } else if (option == 'E') {
        group().external = true;
      } else if (option == 'B' || option == 'C') {
        unsupported(fmt::format("deck does not evaluate option {}", option));
      }
    }
  }

  /// Ids of the clause plus offset; option G expands (first, last, increment).
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
      const IdRange range{first, last, increment};
      for (const std::int64_t id : existing)
        if (range.contains(id)) out.push_back({id, clause_.ids[i].span});
    }
    return out;
  }

  void missing(const std::string& what, const std::vector<IdRef>& refs) {
    all_.report_missing(RuleId::DK161, block_, what, refs, 1902);
  }

  void nodes() {
    std::vector<IdRef> absent;
    for (const IdRef& ref : ids("node", all_.model->nodes.id)) {
      const NodeIndex n = all_.node(ref.id);
      if (n == no_index)
        absent.push_back(ref);
      else
        group().named.push_back(n);
    }
    normalise(group().named);
    missing("node", absent);
  }

  void add_parts(const Indices& parts) {
    state_.parts.insert(state_.parts.end(), parts.begin(), parts.end());
    normalise(state_.parts);
    for (std::size_t k = 0; k < SetGroup::families; ++k) {
      const auto kind = static_cast<ElementKind>(k);
      if (all_.model->family(kind).size() == 0) continue;
      const PartElements& rows = all_.elements_of_parts(kind);
      for (const std::uint32_t p : state_.parts) append(group().elements[k], rows.row(p));
      normalise(group().elements[k]);
    }
  }

  void parts() {
    const auto [type, kind] = clause_.kind == "PART"   ? std::pair("PART", "part")
                              : clause_.kind == "SUBS" ? std::pair("SUBSET", "subset")
                                                       : std::pair("SUBMODEL", "submodel");
    std::vector<std::int64_t> existing;
    if (clause_.has('G')) {
      if (clause_.kind == "PART")
        for (const Part& p : all_.model->parts) existing.push_back(p.id);
      else if (clause_.kind == "SUBS")
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
    all_.report_unread(block_, found);
    missing(std::string(kind), absent);
  }

  void everything() {
    Indices parts(all_.model->parts.size());
    for (std::uint32_t p = 0; p < parts.size(); ++p) parts[p] = p;
    add_parts(parts);
    group().named.resize(all_.model->nodes.size());
    for (NodeIndex n = 0; n < group().named.size(); ++n) group().named[n] = n;
  }

  void elements(ElementKind kind) {
    const Elements& family = all_.model->family(kind);
    if (family.size() == 0) {
      report(RuleId::DK163, name_of(block_) + " has a clause " + std::string(clause_.kind) +
                                ", but the model has no such element");
      return;
    }
    std::vector<IdRef> absent;
    Indices& out = of(kind);
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
        add_set(*other);
    }
    missing("set", absent);
  }

  SetGroup& group() { return state_.own; }
  Indices& of(ElementKind kind) { return group().elements[static_cast<std::size_t>(kind)]; }

  /// Adds the groups of another set unchanged.
  void add_set(const SetState& other) {
    if (!other.own.empty()) all_.share_groups(state_, {&other.own}, block_);
    all_.share_groups(state_, other.others, block_);
    state_.parts = combine(state_.parts, other.parts, Operator::add);
  }

  void boxes() {
    const bool any_node = clause_.kind == "BOX2";
    const std::int64_t offset = all_.deck().offset_of(block_, "box");
    for (const IdRef& ref : clause_.ids) {
      const BoxVolume* b = all_.box(ref.id + offset, block_, 796);
      if (b == nullptr) continue;
      for (std::size_t k = 0; k < SetGroup::families; ++k) {
        const Indices in = all_.elements_in_box(*b, static_cast<ElementKind>(k), any_node);
        group().elements[k] = combine(group().elements[k], in, Operator::add);
      }
      group().named = combine(group().named, all_.nodes_in(*b), Operator::add);
    }
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
        group().row_edges.push_back({{n[0], n[1]}, Carrier::none, no_index});
      else
        all_.add_plain_segment({{n[0], n[1], n[2], have == 4 ? n[3] : n[2]}}, group().rows);
    }
    all_.report_missing(RuleId::DK162, block_, "node", absent, 1903);
  }

  Selections::Impl& all_;
  const Block& block_;
  const Clause& clause_;
  SetState state_;
};

}  // namespace

std::size_t SetGroup::size() const {
  std::size_t sum = reversed4.size() + reversed3.size() + all_faces.size() + named.size() +
                    sizeof(Segment) / sizeof(std::uint32_t) * rows.size() +
                    sizeof(Edge) / sizeof(std::uint32_t) * row_edges.size();
  for (const Indices& e : elements) sum += e.size();
  return sum;
}

}  // namespace detail

void Selections::Impl::share_groups(SetState& set,
                                    const std::vector<const detail::SetGroup*>& groups,
                                    const Block& block) {
  if (!reserve_bytes(groups.size(), sizeof groups[0], block)) return;
  // A chain of sets, each with all groups of the one before, must not hash them for every set.
  constexpr std::size_t few = 8;
  const std::size_t before = set.others.size();
  const bool by_one =
      set.known.empty() && (before <= few || (groups.size() <= few && ++set.scans <= few));
  if (!by_one && set.known.empty()) set.known.insert(set.others.begin(), set.others.end());
  for (const detail::SetGroup* group : groups) {
    const auto end = set.others.begin() + static_cast<std::ptrdiff_t>(before);
    if (by_one ? std::find(set.others.begin(), end, group) == end : set.known.insert(group).second)
      set.others.push_back(group);
  }
}

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
        // Nodes of elements and named nodes.
        detail::SegmentsOfGroup of_selected, of_state;
        detail::unite(selected).named = set_node_list(selected, *def.block, of_selected);
        detail::unite(state).named = set_node_list(state, *def.block, of_state);
        detail::normalise(selected.own.named);
        detail::normalise(state.own.named);
      }
      if (op == detail::Operator::add)
        detail::join(*this, state, std::move(selected), clause.of_parts(), *def.block);
      else
        detail::reduce_set(state, selected, op);
    }
  }
  open.erase(guard);
  state.known = {};
  if (!reserve_bytes(state.own.size(), detail::bytes_of_a_member, *defs->second.front().block))
    state = {};
  return &set_states.emplace(id, std::move(state)).first->second;
}

}  // namespace deck
