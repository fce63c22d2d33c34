// Compares two decks entity by entity: added, removed and changed entities, and penetrations.
// Steps: pair blocks, nodes and elements of both decks (match.cpp); translate every id of the first
// deck to the second; compare values of interfaces and cells (diff_values.cpp), members of groups
// (diff_members.cpp) and the mesh (diff_mesh.cpp); match penetrations by interface, role and nodes.
// Cost: n log n in items of the larger deck.
#include "inspect/differ.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "deck/verdict.hpp"
#include "keyword/shared/references.hpp"
#include "model/shared/families.hpp"

namespace deck {

const char* to_string(ChangeKind kind) {
  constexpr const char* names[] = {"added", "removed", "changed", "moved"};
  return names[static_cast<std::size_t>(kind)];
}

namespace detail {
namespace {

double extent_of(const Nodes& nodes) {
  double extent = 0;
  for (const auto* axis : {&nodes.x, &nodes.y, &nodes.z})
    for (const double x : *axis)
      if (std::isfinite(x)) extent = std::max(extent, std::abs(x));
  return extent;
}

constexpr std::string_view selections[] = {"grnod",  "surf",   "line",   "set",    "grpart",
                                           "grshel", "grsh3n", "grbric", "grquad", "grtria",
                                           "grtrus", "grbeam", "grspri"};

bool is_selection_kind(std::string_view kind) {
  return std::find(std::begin(selections), std::end(selections), kind) != std::end(selections);
}

bool is_function(const Block& b) {
  return b.schema != nullptr && (b.schema->kind == "funct" || b.schema->keyword == "/MOVE_FUNCT");
}

std::int64_t function_id(const DiffSide& side, const Block& b) {
  return b.id.value + side.loaded.deck().offset_of(b, "funct");
}

const InterBase* inter_of(const DiffSide& side, const Block& block) {
  for (const InterBase* i : side.loaded.interfaces().all)
    if (i->block == &block) return i;
  return nullptr;
}

std::string group_of_kind(std::string_view kind) {
  if (kind == "inter" || kind == "default_inter" || kind == "friction") return "interface";
  if (is_selection_kind(kind) || kind == "box" || kind == "subset") return "group";
  if (kind == "part") return "part";
  if (kind == "prop") return "property";
  if (kind == "mat") return "material";
  return "other";
}

}  // namespace

Differ::Differ(const DiffSide& a, const DiffSide& b, MatchBy match, double tolerance)
    : a_(a),
      b_(b),
      units_a_(a.loaded.deck().begin.working),
      units_b_(b.loaded.deck().begin.working),
      other_units_(!(units_a_ == units_b_)),
      length_(conversion_factor(units_a_, units_b_, length_dimension)),
      extent_(
          std::max(extent_of(a.loaded.model().nodes), extent_of(b.loaded.model().nodes) / length_)),
      equal_(tolerance),
      pairs_(find_counterparts(a, b, match, length_)),
      functions_(a, b, pairs_, tolerance) {}

DeckDiff Differ::run() {
  if (other_units_)
    out_.notes.push_back(
        "the working units differ: values of the second deck are shown in those of "
        "the first");
  if (a_.loaded.deck().version != b_.loaded.deck().version)
    out_.notes.push_back(fmt::format("input version {} here, {} there: no difference in itself",
                                     a_.loaded.deck().version, b_.loaded.deck().version));
  added_and_removed();
  for (std::size_t i = 0; i < pairs_.items_a.size(); ++i)
    if (pairs_.block_to_b[i] != no_index)
      item(pairs_.items_a[i], pairs_.items_b[pairs_.block_to_b[i]]);
  nodes();
  elements();
  const auto stops = [](const DiffSide& side) {
    return side.verdict != nullptr && side.verdict->level == VerdictLevel::stops;
  };
  out_.stops_a = stops(a_);
  out_.stops_b = stops(b_);
  if (a_.view != nullptr && b_.view != nullptr) penetrations();
  hint();
  note_number_differences();
  return std::move(out_);
}

Change& Differ::add(ChangeKind kind, const DeckItem& a, const DeckItem* b, std::string field) {
  Change c;
  c.kind = kind;
  c.group = a.block->schema != nullptr ? group_of_kind(a.block->schema->kind) : "other";
  c.keyword = shown_keyword(*a.block);
  c.id = a.id;
  c.a = a.block->header_span;
  if (b != nullptr) c.b = b->block->header_span;
  if (b != nullptr && b->id != a.id) c.id_b = b->id;
  c.title = a.title;
  c.field = std::move(field);
  out_.changes.push_back(std::move(c));
  return out_.changes.back();
}

void Differ::added_and_removed() {
  std::vector<std::uint8_t> used(pairs_.items_b.size(), 0);
  for (std::size_t i = 0; i < pairs_.items_a.size(); ++i) {
    if (pairs_.block_to_b[i] != no_index)
      used[pairs_.block_to_b[i]] = 1;
    else if (!only_a_copy(a_, pairs_.items_a[i]))
      add(ChangeKind::removed, pairs_.items_a[i], nullptr, "");
  }
  for (std::size_t i = 0; i < pairs_.items_b.size(); ++i)
    if (used[i] == 0 && !only_a_copy(b_, pairs_.items_b[i])) {
      Change& c = add(ChangeKind::added, pairs_.items_b[i], nullptr, "");
      std::swap(c.a, c.b);
    }
}

bool Differ::only_a_copy(const DiffSide& side, const DeckItem& item) const {
  return is_function(*item.block) &&
         functions_.only_a_copy(function_id(side, *item.block), &side == &b_);
}

void Differ::item(const DeckItem& a, const DeckItem& b) {
  if (a.title != b.title) {
    Change& c = add(ChangeKind::changed, a, &b, "title");
    c.old_value = a.title;
    c.new_value = b.title;
  }
  const std::string kind = a.block->schema != nullptr ? a.block->schema->kind : "";
  if (is_selection_kind(kind)) return members(a, b, kind);
  if (a.block->schema != b.block->schema) {
    Change& c = add(ChangeKind::changed, a, &b, "keyword");
    c.old_value = shown_keyword(*a.block);
    c.new_value = shown_keyword(*b.block);
    return;
  }
  if (is_function(*a.block) &&
      functions_.same_points(function_id(a_, *a.block), function_id(b_, *b.block)))
    return;
  const InterBase* ia = inter_of(a_, *a.block);
  const InterBase* ib = inter_of(b_, *b.block);
  if (ia != nullptr && ib != nullptr && ia->type == ib->type) return contact(a, b, *ia, *ib);
  cells(a, b);
}

auto Differ::deepest(const DiffSide& side) const -> std::map<PenetrationKey, Depth> {
  std::map<PenetrationKey, Depth> out;
  for (const std::uint32_t i : side.view->deepest_per_node) {
    const NamedPenetration& p = side.view->penetrations[i];
    const Contact& c = side.loaded.scene().contacts[p.contact];
    const PenetrationRow& row = c.penetrations[p.row];
    Depth d{c.inter->id, p.secondary, row.depth, row.gap};
    std::int64_t id = c.inter->id;
    std::array<std::int64_t, 2> nodes = p.secondary;
    if (&side == &a_) {
      id = pairs_.mapped(a_, b_, "inter", id);
      for (std::int64_t& n : nodes)
        if (n != 0) n = pairs_.mapped(a_, b_, "node", n);
      // No contact: keys that the other deck cannot have.
      if (id == 0) id = -c.inter->id;
      if (nodes[0] == 0 || (nodes[1] == 0 && p.secondary[1] != 0))
        nodes = {-p.secondary[0], -p.secondary[1]};
    }
    if (nodes[1] != 0 && nodes[0] > nodes[1]) std::swap(nodes[0], nodes[1]);
    out.try_emplace({id, to_string(c.role), nodes}, d);
  }
  return out;
}

void Differ::penetrations() {
  const auto before = deepest(a_), now = deepest(b_);
  // Depths are differences of coordinates.
  const double nothing = equal_.tolerance() * extent_ * length_;
  for (const auto& [key, d] : before) {
    const auto it = now.find(key);
    if (it == now.end() && d.depth * length_ <= nothing) continue;
    if (it == now.end()) {
      out_.gone.push_back({d.interface_id, std::get<1>(key), d.secondary, d.depth, 0, d.gap, 0});
      continue;
    }
    const Depth& n = it->second;
    const double was = d.depth * length_;
    PenetrationChange p{n.interface_id, std::get<1>(key), n.secondary, d.depth, n.depth, d.gap,
                        n.gap};
    const double noise = std::max(nothing, 1e-9 * std::max(d.gap * length_, n.gap));
    if (n.depth > was + noise)
      out_.worse.push_back(p);
    else if (n.depth < was - noise)
      out_.better.push_back(p);
    else
      out_.same.push_back(p);
  }
  for (const auto& [key, n] : now)
    if (!before.contains(key) && n.depth > nothing)
      out_.appeared.push_back(
          {n.interface_id, std::get<1>(key), n.secondary, 0, n.depth, 0, n.gap});
  const auto sort = [](std::vector<PenetrationChange>& list, auto&& depth) {
    std::stable_sort(list.begin(), list.end(),
                     [&](const auto& x, const auto& y) { return depth(x) > depth(y); });
  };
  sort(out_.appeared, [](const PenetrationChange& p) { return p.depth_new; });
  sort(out_.gone, [](const PenetrationChange& p) { return p.depth_old; });
  sort(out_.worse, [](const PenetrationChange& p) { return p.depth_new - p.depth_old; });
  sort(out_.better, [](const PenetrationChange& p) { return p.depth_old - p.depth_new; });
}

void Differ::hint() {
  std::size_t lost = 0;
  for (const std::uint32_t n : pairs_.node_to_b) lost += n == no_index ? 1 : 0;
  if (2 * lost > pairs_.node_to_b.size())
    out_.notes.push_back(
        fmt::format("{} of {} nodes have no counterpart; decks with other ids are "
                    "compared with --match position",
                    lost, pairs_.node_to_b.size()));
}

void Differ::note_number_differences() {
  const auto values = [](std::size_t n) {
    return fmt::format("{} {}", n, n == 1 ? "value differs" : "values differ");
  };
  const std::size_t within = equal_.used() + functions_.within_tolerance();
  if (within > 0)
    out_.notes.push_back(fmt::format(
        "{} by less than {:g} of its size (coordinates and lengths: of the model's size) and "
        "count as equal (--tolerance)",
        values(within), equal_.tolerance()));
  if (equal_.nearly_equal() > 0)
    out_.notes.push_back(
        fmt::format("{0} by less than {1:g} of its size; with --tolerance {1:g} they count as "
                    "equal",
                    values(equal_.nearly_equal()), EqualNumbers::nearly));
  if (ignored_ > 0)
    out_.notes.push_back(fmt::format(
        "{} that the reference solver does not use: no difference in itself", values(ignored_)));
}

}  // namespace detail

DeckDiff diff_decks(const DiffSide& a, const DiffSide& b, MatchBy match, double tolerance) {
  return detail::Differ(a, b, match, tolerance).run();
}

}  // namespace deck
