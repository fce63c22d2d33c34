// Penetrations and ties as CSV: one line a pair, one line a secondary node.
#include "base/shared/escape.hpp"
#include "base/shared/length_text.hpp"
#include "contact/shared/element_names.hpp"
#include "deck/contact/ties.hpp"
#include "deck/report/gaps.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "report/shared/text_table.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

std::optional<std::int64_t> known_id(std::int64_t id) { return known(id != 0, id); }
std::optional<double> known_length(double v, bool is_there = true) {
  return known(is_there && !is_unbounded(v), v);
}

/// "file,line"
std::array<std::string, 2> place_cells(const Deck& deck, const Span& span) {
  if (!span.valid()) return {};
  return {terminal_text(deck.sources[span.file].path()),
          std::to_string(deck.sources.position(span).line)};
}

struct PenetrationLine {
  const NamedPenetration& pair;
  const Span& span;
  const Contact& contact;
  const PenetrationRow& row;
};

struct TieLine {
  const Tie& tie;
  const TiedNode& node;
  const Span& span;
  bool found() const { return node.segment != no_index; }
  /// Of the segment that it is tied to, or that is nearest.
  std::array<std::optional<std::int64_t>, 4> corners(const Model& model) const {
    std::array<std::optional<std::int64_t>, 4> out;
    const std::uint32_t segment = found() ? node.segment : node.nearest;
    for (std::size_t k = 0; k < 4 && segment != no_index; ++k)
      out[k] = model.node_id(tie.main[segment][k]);
    return out;
  }
};

}  // namespace

std::string gaps_csv(const Deck& deck, const Scene& scene, const SceneView& view,
                     const TextDrain& drain) {
  CsvTable<PenetrationLine> table(
      drain, CSV("interface", r.contact.inter->id), CSV("type", r.contact.inter->type),
      CSV("role", to_string(r.contact.role)), CSV("kind", to_string(r.contact.kind)),
      CSV("secondary_1", r.pair.secondary[0]), CSV("secondary_2", known_id(r.pair.secondary[1])),
      CSV("main_1", r.pair.main[0]), CSV("main_2", r.pair.main[1]),
      CSV("main_3", known_id(r.pair.main[2])), CSV("main_4", known_id(r.pair.main[3])),
      CSV("depth", known_length(r.row.depth)), CSV("gap", known_length(r.row.gap)),
      CSV("distance", known_length(r.row.distance)),
      CSV("ratio", r.row.gap > 0 ? r.row.depth / r.row.gap : 0.0),
      CSV("normal_x,normal_y,normal_z", r.row.normal), CSV("on_surface", r.row.on_surface),
      CSV("in_contact", r.row.in_contact), CSV("action", to_string(r.row.action)),
      CSV("gap0", known_length(r.row.gap0, r.row.has_gap0)),
      CSV("p0", known_length(r.row.p0, r.row.has_gap0)), CSV("x,y,z", r.pair.at),
      CSV("secondary_element", known_id(r.pair.secondary_element.id)),
      CSV("secondary_part", known_id(r.pair.secondary_element.part)),
      CSV("main_element", known_id(r.pair.main_element.id)),
      CSV("main_part", known_id(r.pair.main_element.part)),
      CSV("file,line", place_cells(deck, r.span)));
  const std::vector<Span> spans =
      detail::node_spans(*scene.model, first_nodes(scene, view.penetrations));
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const NamedPenetration& p = view.penetrations[i];
    const Contact& c = scene.contacts[p.contact];
    table.add({p, spans[i], c, c.penetrations[p.row]});
  }
  return table.text();
}

std::string ties_csv(const Deck& deck, const Scene& scene, const TextDrain& drain) {
  const Model& model = *scene.model;
  const Nodes& nodes = model.nodes;
  Connectivity connectivity(model);
  CsvTable<TieLine> table(
      drain, CSV("interface", r.tie.inter->id), CSV("node", model.node_id(r.node.node)),
      CSV("part", known_id(element_at(model, connectivity, r.node.node).part)),
      CSV("tied", r.node.tied), CSV("penalty", r.node.penalty),
      CSV("message", known_id(r.node.message)),
      CSV("main_1,main_2,main_3,main_4", r.corners(model)), CSV("s", known(r.found(), r.node.s)),
      CSV("t", known(r.found(), r.node.t)), CSV("distance", known(r.found(), r.node.distance)),
      CSV("search", known(r.node.search != 0, r.node.search)),
      CSV("nearest_distance", known(r.node.nearest != no_index, r.node.nearest_distance)),
      CSV("why", short_reason(r.tie, r.node)), CSV("x", nodes.x[r.node.node]),
      CSV("y", nodes.y[r.node.node]), CSV("z", nodes.z[r.node.node]),
      CSV("file,line", place_cells(deck, r.span)));
  for (const Tie& tie : scene.ties) {
    std::vector<NodeIndex> list;
    for (const TiedNode& n : tie.nodes) list.push_back(n.node);
    const std::vector<Span> spans = detail::node_spans(model, list);
    for (std::size_t i = 0; i < tie.nodes.size(); ++i) table.add({tie, tie.nodes[i], spans[i]});
  }
  return table.text();
}

}  // namespace deck
