// Conditions of the deck that act on nodes of a contact: fixed translations, deleted elements, and
// ties (/INTER/TYPE2) that keep pairs out of it (Irem_i2 = 1).
#include <algorithm>

#include "contact/shared/node_elements.hpp"
#include "contact/shared/tie_steps.hpp"
#include "cycle/shared/contact_run.hpp"
#include "deck/contacts.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"

namespace deck::cycle::detail {
namespace {

template <class F>
void for_each_group(const deck::Model& model, std::string_view keyword, std::string_view field,
                    F&& f) {
  if (model.deck == nullptr || model.selections == nullptr) return;
  const Deck& deck = *model.deck;
  for (const Block& block : deck.blocks) {
    if (block.schema == nullptr || block.schema->keyword != keyword) continue;
    const DecodedBlock decoded = decode(deck, block);
    const std::int64_t id = decoded.integer(field);
    if (id == 0) continue;
    if (const NodeSet* nodes = model.selections->node_group(id + deck.offset_of(block, "grnod")))
      f(decoded, *nodes);
  }
}

bool dead(const CycleOptions& options, ElementKind kind, std::uint32_t element) {
  return std::any_of(options.dead.begin(), options.dead.end(), [&](const DeadElement& d) {
    return d.kind == kind && d.element == element && options.time >= d.from;
  });
}

/// Numbers of living and deleted elements of all kinds around some nodes.
struct ElementCounts {
  std::size_t live = 0, gone = 0;
};

template <std::size_t N>
ElementCounts elements_with(const RunContext& run, const std::array<NodeIndex, N>& nodes) {
  ElementCounts a;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = run.scene.model->family(kind);
    const bool line = kind == ElementKind::beam || kind == ElementKind::spring;
    const int count = line ? 2 : family.width;
    std::uint32_t before = no_index;  // a solid with repeated nodes is listed once per repetition
    for (const std::uint32_t e : run.connectivity.elements(kind, nodes[0])) {
      if (e == before) continue;
      before = e;
      const NodeIndex* n = family.of(e);
      if (!std::all_of(nodes.begin(), nodes.end(),
                       [&](NodeIndex node) { return std::find(n, n + count, node) != n + count; }))
        continue;
      ++(dead(run.options, kind, e) ? a.gone : a.live);
    }
  }
  return a;
}

template <class Item>
bool own_element_lives(const RunContext& run, const Item& item) {
  if (item.element == no_index) return true;
  const Elements* family = elements_of(*run.scene.model, item.carrier);
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::truss, ElementKind::beam, ElementKind::spring})
    if (family == &run.scene.model->family(kind)) return !dead(run.options, kind, item.element);
  return true;
}

/// Positions in a list, by node.
using IndexByNode = std::vector<std::pair<NodeIndex, std::uint32_t>>;

template <class F>
void for_each_at(const IndexByNode& places, NodeIndex n, F&& f) {
  for (auto it = std::lower_bound(places.begin(), places.end(), std::pair{n, std::uint32_t{0}});
       it != places.end() && it->first == n; ++it)
    f(it->second);
}

}  // namespace

std::vector<std::uint8_t> fixed_translations(const deck::Model& model) {
  std::vector<std::uint8_t> fixed(model.nodes.size(), 0);
  for_each_group(model, "/BCS", "grnod_ID", [&](const DecodedBlock& d, const NodeSet& nodes) {
    std::uint8_t code = 0;
    if (d.integer("Tx") == 1) code |= 4;
    if (d.integer("Ty") == 1) code |= 2;
    if (d.integer("Tz") == 1) code |= 1;
    for (const NodeIndex n : nodes.nodes)
      if (n != no_index) fixed[n] |= code;
  });
  return fixed;
}

void follow_dead_elements(const RunContext& run, const Contact& contact, int idel,
                          ContactMemory& memory, std::vector<Removal>& removed) {
  if (idel == 0 || run.options.dead.empty()) return;
  const auto now = static_cast<std::size_t>(
      std::count_if(run.options.dead.begin(), run.options.dead.end(),
                    [&](const DeadElement& d) { return run.options.time >= d.from; }));
  if (now == memory.deaths) return;
  memory.deaths = now;
  const auto main = [&](const auto& list) {
    memory.main_off.assign(list.size(), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const ElementCounts behind = elements_with(run, list[i].nodes);
      if (behind.gone == 0 && own_element_lives(run, list[i])) continue;
      memory.main_off[i] =
          !segment_stays(idel, static_cast<int>(behind.live), own_element_lives(run, list[i]));
    }
  };
  const auto secondary = [&](const auto& list, auto&& nodes_of) {
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      if (memory.off[i] != 0) continue;
      const ElementCounts around = elements_with(run, nodes_of(list[i]));
      if (around.gone > 0 && !secondary_stays(idel, static_cast<int>(around.live)))
        removed.push_back({i, Removal::Because::no_element_left});
    }
  };
  if (contact.kind == deck::ContactKind::edge_edge) {
    main(contact.main_edges);
    secondary(contact.secondary_edges, [](const ContactEdge& e) { return e.nodes; });
  } else {
    main(contact.main);
    secondary(contact.secondary, [](const SecondaryNode& s) { return std::array{s.node}; });
  }
}

std::vector<CandidatePair> pairs_around_ties(const RunContext& run, const Contact& contact) {
  IndexByNode nodes, segments;
  for (std::uint32_t i = 0; i < contact.secondary.size(); ++i)
    nodes.emplace_back(contact.secondary[i].node, i);
  for (std::uint32_t i = 0; i < contact.main.size(); ++i)
    for (const NodeIndex n : contact.main[i].nodes) segments.emplace_back(n, i);
  std::sort(nodes.begin(), nodes.end());
  std::sort(segments.begin(), segments.end());
  std::vector<CandidatePair> out;
  const auto drop = [&](NodeIndex secondary, NodeIndex corner) {
    for_each_at(nodes, secondary, [&](std::uint32_t s) {
      for_each_at(segments, corner, [&](std::uint32_t m) { out.push_back({s, m}); });
    });
  };
  // The scene may lack ties, or have those of some interfaces only.
  const bool known = run.scene.ties.size() == run.scene.interfaces->type2.size();
  SceneOptions options;
  options.threads = run.options.threads;
  options.limits = run.scene.limits;
  const std::vector<Tie> found =
      known ? std::vector<Tie>() : deck::detail::ties_of(run.scene, options);
  for (const Tie& tie : known ? run.scene.ties : found)
    for (const TiedNode& n : tie.nodes) {
      if (!n.tied) continue;
      for (const NodeIndex corner : tie.main[n.segment]) {
        drop(n.node, corner);
        drop(corner, n.node);
      }
    }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace deck::cycle::detail
