// Selections: definitions, id lists, public functions; selection_*.cpp resolve the kinds.
#include "deck/model.hpp"

#include <algorithm>
#include <numeric>

#include "base/shared/words.hpp"
#include "keyword/shared/solver_order.hpp"
#include "model/selection/selection_impl.hpp"

namespace deck {

using detail::Definition;
using detail::IdList;
using detail::IdRef;

namespace detail {

void normalise(Indices& v) {
  if (!std::is_sorted(v.begin(), v.end())) std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

void append(Indices& v, std::span<const ElementRun> runs) {
  for (const ElementRun& run : runs) {
    const std::size_t have = v.size();
    v.resize(have + run.size());
    std::iota(v.begin() + static_cast<std::ptrdiff_t>(have), v.end(), run.first);
  }
}

Indices without(const Indices& all, const Indices& some) {
  Indices out;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(out));
  return out;
}

Indices common(const Indices& a, const Indices& b) {
  Indices out;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace detail

Selections::Impl::Impl(const Model& m, const SchemaSet& s, const Limits& l)
    : model(&m), schemas(&s), limits(l) {
  std::uint64_t members = m.nodes.size();
  for (const detail::FamilyName& name : detail::family_names())
    members += 8 * m.family(name.kind).size();
  most_members = 16 * members + m.deck->total_bytes;  // rows of the deck can be members
  static constexpr std::string_view kinds[] = {"grnod", "surf", "line",  "set",
                                               "box",   "skew", "grpart"};
  const auto is_group = [](const Block& b) {
    return b.schema != nullptr &&
           (std::find(std::begin(kinds), std::end(kinds), b.schema->kind) != std::end(kinds) ||
            detail::family_of_group(b.schema->kind));
  };
  for (const Block* const at : detail::in_solver_order(*m.deck, is_group)) {
    const Block& block = *at;
    const std::string& kind = block.schema->kind;
    const auto fields = detail::header_fields(block);
    Definition def{&block, fields.size() > 1 ? fields[1] : std::string_view(),
                   fields.size() > 2 ? fields[2] : std::string_view()};
    const std::int64_t id = deck().shifted_id(block, kind, block.id.value);
    auto& table = tables[kind];
    auto& list = table.by_id[id];
    if (list.empty()) table.order.push_back(id);
    if (!list.empty() && id == 0) continue;
    if (!list.empty() && !(kind == "set" && def.type == "COLLECT")) {
      Finding d = detail::finding_from(
          {RuleId::DK167, block.header_span,
           std::string(block.keyword) + " " + std::to_string(id) + " is defined twice",
           std::string(block.keyword), id});
      d.notes.emplace_back(list.front().block->header_span, "first defined here");
      found.report(std::move(d));
      continue;
    }
    list.push_back(def);
  }
}

void Selections::Impl::sort_nodes(std::vector<NodeIndex>& nodes) const {
  if (std::is_sorted(nodes.begin(), nodes.end())) return;
  const auto [first, last] = std::minmax_element(nodes.begin(), nodes.end());
  const std::size_t low = *first, range = *last - low + 1;
  // Dense nodes are sorted by walking over all nodes between the first and last.
  constexpr std::size_t steps = 16;  // cost of sorting one node
  std::vector<bool> in(range / steps <= nodes.size() ? range : 0, false);
  bool repeated = in.empty();
  for (std::size_t i = 0; i < nodes.size() && !repeated; ++i) {
    repeated = in[nodes[i] - low];
    in[nodes[i] - low] = true;
  }
  if (repeated) return std::sort(nodes.begin(), nodes.end());
  auto next = nodes.begin();
  for (std::size_t n = 0; n < range; ++n)
    if (in[n]) *next++ = static_cast<NodeIndex>(low + n);
}

const Definition* Selections::Impl::definition(std::string_view kind, std::int64_t id) const {
  const auto table = tables.find(kind);
  if (table == tables.end()) return nullptr;
  const auto it = table->second.by_id.find(id);
  return it == table->second.by_id.end() ? nullptr : &it->second.front();
}

IdList Selections::Impl::id_list(const DecodedBlock& d) const {
  IdList list;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells) {
      if (cell.field->type == FieldType::text || cell.integer == 0) continue;
      const std::int64_t offset = deck().offset_of(*d.block, cell.field->ref);
      if (cell.integer > 0)
        list.positive.push_back({cell.integer + offset, cell.span});
      else
        list.negative.push_back({-cell.integer + offset, cell.span});
    }
  return list;
}

std::vector<detail::IdRange> Selections::Impl::id_ranges(const DecodedBlock& d,
                                                         std::string_view kind) const {
  const std::int64_t offset = deck().offset_of(*d.block, kind);
  std::vector<detail::IdRange> out;
  std::int64_t first = 0;
  for (const DecodedCard& card : d.cards) {
    if (card.schema->repeat == Repeat::rows) {  // one triple per line
      std::int64_t v[3] = {};
      for (std::size_t i = 0; i < std::min<std::size_t>(card.cells.size(), 3); ++i)
        v[i] = card.cells[i].integer;
      if (v[2] > 0) out.push_back({v[0] + offset, v[1] + offset, v[2]});
      continue;
    }
    for (const Cell& cell : card.cells) {  // pairs, across lines
      if (cell.integer == 0) continue;
      if (first != 0) out.push_back({first + offset, cell.integer + offset, 1});
      first = first != 0 ? 0 : cell.integer;
    }
  }
  return out;
}

void Selections::Impl::report_missing(RuleId rule, const Block& block, const std::string& what,
                                      std::vector<IdRef> missing, int number) {
  if (missing.empty() || !found.wants(rule)) return;
  // A blank line in a list of segments is node 0 several times.
  const auto same = [](const IdRef& a, const IdRef& b) { return a.id == b.id; };
  missing.erase(std::unique(missing.begin(), missing.end(), same), missing.end());
  std::vector<std::int64_t> ids;
  for (const IdRef& m : missing) ids.push_back(m.id);
  detail::FindingDraft f = detail::finding_about(
      block, rule,
      detail::name_of(block) + " lists " + what + " " + list_text(ids) +
          (missing.size() == 1 ? ", which does not exist" : ", which do not exist"),
      {.message = number});
  f.span = missing.front().span;
  Finding d = detail::finding_from(std::move(f));
  if (number == 0) d.severity = Severity::warning;  // the solver continues
  found.add(std::move(d));
}

bool Selections::Impl::recursive(std::string_view kind, std::int64_t id, const Block& from,
                                 int number) {
  // Limits recursion; deeper than any real deck.
  constexpr std::size_t deepest = 250;
  if (open.size() >= deepest) {
    report(from, RuleId::DK152,
           detail::name_of(from) + " is nested more than " + std::to_string(deepest) +
               " levels deep; its members are left out",
           {.message = number,
            .solver = "It resolves the references level by level.",
            .fix = "flatten the references"});
    return true;
  }
  if (open.count({std::string(kind), id}) == 0) return false;
  report(from, RuleId::DK152,
         detail::name_of(from) + " contains itself, directly or through others",
         {.message = number, .fix = "remove one of these references"});
  return true;
}

bool Selections::Impl::fits(std::size_t count, std::size_t size, const Block& block) {
  const bool room =
      bytes_held <= limits.selection_bytes && count <= (limits.selection_bytes - bytes_held) / size;
  // Repetitions count, but a list with all members many times is not sensible.
  const bool sensible = count <= most_members;
  if (all_held && room && sensible) return true;
  if (all_held)
    report(block, RuleId::DK332,
           detail::name_of(block) +
               (sensible ? ": the members of all groups, surfaces, lines and sets together would "
                           "take more than " +
                               std::to_string(limits.selection_bytes >> 20) + " MB"
                         : " lists the same members many times: more than " +
                               std::to_string(most_members)) +
               "; from here on members are left out, and so are contacts that use them");
  all_held = false;
  return false;
}

bool Selections::Impl::reserve_bytes(std::size_t count, std::size_t size, const Block& block) {
  if (!fits(count, size, block)) return false;
  bytes_held += std::uint64_t{count} * size;
  return true;
}

Selections::Selections(const Model& model, const SchemaSet& schemas, const Limits& limits)
    : impl_(std::make_unique<Impl>(model, schemas, limits)) {}
void Selections::set_limits(const Limits& limits) { impl_->limits = limits; }
bool Selections::complete() const { return impl_->all_held; }
Selections::~Selections() = default;

const NodeSet* Selections::node_group(std::int64_t id) { return impl_->node_group(id); }
const Surface* Selections::surface(std::int64_t id) { return impl_->surface(id); }
std::optional<SurfaceOutline> Selections::outline(std::int64_t id) { return impl_->outline(id); }
const LineSet* Selections::line(std::int64_t id) { return impl_->line(id); }
const SetGeneral* Selections::set(std::int64_t id) { return impl_->set(id); }

const std::vector<std::uint32_t>* Selections::element_group(std::string_view kind,
                                                            std::int64_t id) {
  for (const detail::FamilyName& name : detail::family_names())
    if (name.group == kind) return impl_->element_group(name, id);
  return nullptr;
}

const std::vector<std::uint32_t>* Selections::part_group(std::int64_t id) {
  return impl_->part_group(id);
}

bool Selections::is_plain(std::string_view kind, std::int64_t id) const {
  return kind != "set" && impl_->definition(kind, id) != nullptr;
}

std::optional<Span> Selections::where(std::string_view kind, std::int64_t id) const {
  const Definition* def = impl_->definition(kind, id);
  if (def == nullptr) return std::nullopt;
  return def->block->header_span;
}

std::vector<std::int64_t> Selections::ids(std::string_view kind) const {
  const auto table = impl_->tables.find(kind);
  return table == impl_->tables.end() ? std::vector<std::int64_t>() : table->second.order;
}

std::vector<Edge> Selections::edges_of(const SegmentList& segments, bool free_only) const {
  return impl_->edges_of(segments, free_only);
}

std::vector<NodeIndex> Selections::nodes_of(const SegmentList& segments) const {
  impl_->start_marks();
  std::vector<NodeIndex> nodes;
  segments.for_each([&](const Segment& s) {
    for (const NodeIndex n : s.nodes) impl_->mark(n, nodes);
  });
  impl_->sort_nodes(nodes);
  return nodes;
}

void Selections::resolve_all() {
  for (const detail::FamilyName& name : detail::family_names())
    for (const std::int64_t id : ids(name.group)) impl_->element_group(name, id);
  for (const std::int64_t id : ids("grpart")) impl_->part_group(id);
  for (const std::int64_t id : ids("grnod")) impl_->node_group(id);
  for (const std::int64_t id : ids("surf")) impl_->outline(id);
  for (const std::int64_t id : ids("line")) impl_->line(id);
  for (const std::int64_t id : ids("set")) impl_->set_state(id);  // its lists have no findings
  for (const std::int64_t id : ids("box")) {
    const Definition* def = impl_->definition("box", id);
    impl_->box(id, *def->block, 0);
  }
}

Findings& Selections::findings() { return impl_->found; }

void Selections::rebind(const Model& model) { impl_->model = &model; }

}  // namespace deck
