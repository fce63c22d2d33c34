// Collects facts of an entity: lines with cells, figures, references in both directions.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "base/shared/words.hpp"
#include "deck/model.hpp"
#include "inspect/match.hpp"
#include "inspect/shared/show.hpp"
#include "model/shared/families.hpp"
#include "model/shared/kinematics.hpp"

namespace deck {
namespace {

using detail::shown_keyword;

class EntityCollector {
 public:
  EntityCollector(const Deck& deck, const Model& model, const Interfaces& interfaces,
                  const Entity& entity)
      : deck_(deck), model_(model), selections_(*model.selections), definitions_(deck) {
    view_.entity = entity;
    for (const InterBase* inter : interfaces.all)
      if (inter->block == entity.block) view_.inter = inter;
  }

  EntityView run() {
    includes();
    cards();
    refers_to();
    const std::string& kind = entity().kind;
    if (kind == "node")
      node();
    else if (const auto family = detail::family_of_kind(kind))
      element(*family);
    else
      block();
    return std::move(view_);
  }

 private:
  const Entity& entity() const { return view_.entity; }
  void fact(std::string name, FactValue value) {
    view_.facts.emplace_back(std::move(name), std::move(value));
  }
  void count(std::string name, std::size_t n) {
    fact(std::move(name), static_cast<std::int64_t>(n));
  }

  void includes() {
    if (!entity().span.valid()) return;
    std::vector<Span> up;
    for (std::uint32_t f = entity().span.file; f != 0 && f != Span::no_file; f = deck_.parent_of(f))
      for (const IncludeEdge& e : deck_.includes)
        if (e.file == f) {
          up.push_back(e.directive);
          break;
        }
    view_.includes.assign(up.rbegin(), up.rend());
  }

  // ---- the card -------------------------------------------------------------------------------

  void cards() {
    const Block* b = entity().block;
    if (b == nullptr || b->opaque) return;
    if (b->schema == nullptr || !b->schema->bulk) return block_cards(*b);
    LineCursor cursor(deck_.sources, *b);
    Line line = cursor.next();
    while (line.valid() &&
           !(line.file == entity().span.file && line.offset <= entity().span.offset &&
             entity().span.offset <= line.offset + line.text.size()))
      line = cursor.next();
    for (const CardSchema& card : b->schema->cards) {
      if (!card.in_version(b->version) || !line.valid()) continue;
      DecodedCard decoded = decode_line(deck_, *b, card, line, nullptr);
      view_.cards.push_back({&card, line, false, decoded.free_format, std::move(decoded.cells)});
      line = cursor.next();
    }
  }

  void block_cards(const Block& b) {
    if (b.schema == nullptr) {
      LineCursor cursor(deck_.sources, b);
      for (Line line = cursor.next(); line.valid(); line = cursor.next())
        view_.cards.push_back({nullptr, line, false, false, {}});
      return;
    }
    const DecodedBlock d = decode(deck_, b);
    if (d.title_line.valid()) view_.cards.push_back({nullptr, d.title_line, true, false, {}});
    for (const DecodedCard& card : d.cards)
      if (!card.missing())
        view_.cards.push_back({card.schema, card.line, false, card.free_format, card.cells});
    for (const Line& line : d.extra) view_.cards.push_back({nullptr, line, false, false, {}});
  }

  // ---- what it names --------------------------------------------------------------------------

  void refers_to() {
    const Block* b = entity().block;
    if (b == nullptr) return;
    if (b->schema == nullptr || !b->schema->bulk) {
      for (const Reference& r : references_of(deck_, *b))
        link_to(r.field, r.kind, r.id, r.step == 0 ? 0 : r.last);
      return;
    }
    bool own = true;  // the first cell is its own id
    for (const ShownCard& card : view_.cards)
      for (const Cell& cell : card.cells) {
        if (!own && cell.field->type == FieldType::id && cell.integer != 0)
          link_to(cell.field->name, cell.field->ref,
                  std::abs(cell.integer) + deck_.offset_of(*b, cell.field->ref), 0);
        own = false;
      }
    if (const std::string_view kind = header_reference(*b); !kind.empty())
      for (const Reference& r : references_of(deck_, *b)) link_to("header", r.kind, r.id, 0);
  }

  void link_to(std::string_view field, std::string_view kind, std::int64_t id, std::int64_t last) {
    Link link;
    link.field = field;
    link.kind = kind;
    link.id = id;
    link.last = last;
    if (const Block* target = definitions_.find(kind, id)) {
      link.kind = target->schema->kind;
      link.keyword = shown_keyword(*target);
      link.title = title_of(*target);
      link.span = target->header_span;
    } else if (kind == "node") {
      if (const NodeIndex n = model_.nodes.map.find(id); n != no_index) {
        link.keyword = "/NODE";
        link.span = model_.node_span(n);
      }
    } else if (const auto family = detail::family_of_kind(kind)) {
      if (const std::uint32_t e = model_.family(*family).map.find(id); e != no_index) {
        link.keyword = detail::keyword_of_family(*family);
        link.span = model_.element_span(*family, e);
      }
    }
    view_.refers_to.push_back(std::move(link));
  }

  std::string title_of(const Block& b) const {
    return b.schema != nullptr && b.schema->has_title && !b.schema->bulk ? decode(deck_, b).title
                                                                         : std::string();
  }

  // ---- what names it --------------------------------------------------------------------------

  /// Reason why an effect cannot be removed from the pair loop: always on, or outside it.
  const std::vector<std::pair<const Block*, std::vector<Reference>>>& all_references() {
    if (!references_.empty()) return references_;
    const bool items = entity().kind == "node" || detail::family_of_kind(entity().kind).has_value();
    for (const Block& b : deck_.blocks) {
      auto list = references_of(deck_, b);
      if (!items)
        std::erase_if(list, [](const Reference& r) {
          return r.kind == "node" || detail::family_of_kind(r.kind).has_value();
        });
      if (!list.empty()) references_.emplace_back(&b, std::move(list));
    }
    return references_;
  }

  bool names(const Reference& r, const Entity& e) const {
    if (r.step != 0) return r.kind == e.kind && r.covers(e.id);
    const auto family = detail::family_of_kind(e.kind);
    if (family) return detail::family_of_kind(r.kind) == family && r.id == e.id;
    if (e.kind == "node") return r.kind == e.kind && r.id == e.id;
    return definitions_.find(r.kind, r.id) == e.block;
  }

  Link user(const Block& b, std::string_view field, Span span) const {
    Link link;
    link.field = field;
    link.keyword = shown_keyword(b);
    link.kind = b.schema != nullptr ? b.schema->kind : "";
    link.id = id_of(deck_, b);
    link.title = title_of(b);
    link.span = span;
    return link;
  }

  void named_by() {
    for (const auto& [b, list] : all_references()) {
      if (b == entity().block || (b->schema != nullptr && b->schema->bulk)) continue;
      for (const Reference& r : list)
        if (names(r, entity())) view_.used_by.push_back(user(*b, r.field, r.span));
    }
  }

  /// Contacts that use it through groups, surfaces and parts.
  void reached_by_names() {
    std::set<const Block*> seen = {entity().block};
    std::vector<Entity> open = {entity()};
    while (!open.empty()) {
      const Entity e = open.back();
      open.pop_back();
      for (const auto& [b, list] : all_references()) {
        if (seen.contains(b) || b->schema == nullptr || b->schema->bulk) continue;
        for (const Reference& r : list) {
          if (!names(r, e)) continue;
          seen.insert(b);
          if (b->schema->kind == "inter") {
            if (e.block != entity().block) view_.interfaces.push_back(user(*b, r.field, r.span));
          } else if (!b->schema->kind.empty() && b->schema->has_id) {
            Entity next;
            next.kind = b->schema->kind;
            next.id = id_of(deck_, *b);
            next.block = b;
            open.push_back(std::move(next));
          }
          break;
        }
      }
    }
  }

  // ---- members --------------------------------------------------------------------------------

  /// Contacts with such a node or segment on a side.
  template <class HasNode, class HasCarrier>
  void reached_by_members(HasNode&& has_node, HasCarrier&& has_carrier) {
    for (const Block& b : deck_.blocks) {
      if (b.schema == nullptr || b.schema->kind != "inter") continue;
      for (const Reference& r : references_of(deck_, b)) {
        const auto has_one = [&](const auto& list) {
          return std::any_of(list.begin(), list.end(), [&](const auto& x) {
            return has_carrier(x.carrier, x.element, x.nodes);
          });
        };
        bool in = false;
        if (r.kind == "grnod") {
          if (const NodeSet* s = selections_.node_group(r.id))
            in = std::any_of(s->nodes.begin(), s->nodes.end(), has_node);
        } else if (r.kind == "surf") {
          if (const Surface* s = selections_.surface(r.id)) in = has_one(s->segments);
        } else if (r.kind == "line") {
          if (const LineSet* s = selections_.line(r.id)) in = has_one(s->edges);
        }
        if (in) view_.interfaces.push_back(user(b, r.field, r.span));
      }
    }
  }

  void node() {
    const NodeIndex n = entity().index;
    fact("X", model_.nodes.x[n]);
    fact("Y", model_.nodes.y[n]);
    fact("Z", model_.nodes.z[n]);
    if (const auto& before = model_.before_transforms;
        before != nullptr &&
        (before->x[n] != model_.nodes.x[n] || before->y[n] != model_.nodes.y[n] ||
         before->z[n] != model_.nodes.z[n])) {
      fact("X before /TRANSFORM", before->x[n]);
      fact("Y before /TRANSFORM", before->y[n]);
      fact("Z before /TRANSFORM", before->z[n]);
    }
    for (const auto& [a, b] : model_.merged_nodes)
      if (a == n) fact("merged into node", model_.node_id(b));
    named_by();
    std::set<std::uint32_t> parts;
    for (const ElementKind kind : detail::all_families) {
      const Elements& family = model_.family(kind);
      for (std::uint32_t e = 0; e < family.size(); ++e) {
        if (std::find(family.of(e), family.of(e) + family.width, n) == family.of(e) + family.width)
          continue;
        Link link;
        link.field = "node";
        link.keyword = detail::keyword_of_family(kind);
        link.kind = in_lower_case(link.keyword.substr(1));
        link.id = family.id[e];
        link.span = model_.element_span(kind, e);
        view_.used_by.push_back(std::move(link));
        if (family.part[e] != no_index) parts.insert(family.part[e]);
      }
    }
    std::string names;
    for (const std::uint32_t p : parts) names += (names.empty() ? "" : ", ") + part_name(p);
    if (!names.empty()) fact("parts", names);
    conditions(n);
    reached_by_members([&](NodeIndex x) { return x == n; },
                       [&](Carrier, std::uint32_t, const auto& nodes) {
                         return std::find(nodes.begin(), nodes.end(), n) != nodes.end();
                       });
  }

  /// Kinematic conditions of a node, in the solver's order.
  void conditions(NodeIndex n) {
    const Kinematics k = read_kinematics(model_);
    const auto name = [&](std::uint32_t source) {
      const ConditionSource& c = k.sources[source];
      return c.block->schema->keyword + " " + std::to_string(c.id);
    };
    for (const std::uint32_t s : k.of(n)) {
      // Only the search of ties decides if a tie binds the node.
      const bool tie = k.sources[s].block->schema->keyword == "/INTER/TYPE2";
      fact("kinematic condition", name(s) + (tie ? " (if it finds a segment)" : ""));
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> told;  // a pair conflicts in both directions
    for (const KinematicConflict& b : k.bookings) {
      if (b.node != n || !told.emplace(b.earlier, b.later).second) continue;
      fact("kinematic conflict", name(b.earlier) + " and " + name(b.later));
    }
  }

  std::string part_name(std::uint32_t p) const {
    const Part& part = model_.parts[p];
    return std::to_string(part.id) + (part.title.empty() ? "" : " " + part.title);
  }

  void element(ElementKind kind) {
    const Elements& family = model_.family(kind);
    const std::uint32_t e = entity().index;
    if (family.part[e] != no_index) fact("part", part_name(family.part[e]));
    if (e < family.thickness.size() && family.thickness[e] > 0)
      fact("own thickness", family.thickness[e]);
    named_by();
    const auto mine = [&](NodeIndex n) {
      return std::find(family.of(e), family.of(e) + family.width, n) != family.of(e) + family.width;
    };
    reached_by_members(mine, [&](Carrier c, std::uint32_t i, const auto&) {
      return i == e && detail::family_of_carrier(c) == kind;
    });
  }

  void part() {
    const std::uint32_t p = entity().index;
    if (p == no_index) return;
    const Part& part = model_.parts[p];
    if (part.thickness > 0) fact("contact thickness", part.thickness);
    std::vector<std::uint8_t> node(model_.nodes.size(), 0);
    for (const ElementKind kind : detail::all_families) {
      const Elements& family = model_.family(kind);
      std::size_t n = 0;
      for (std::uint32_t e = 0; e < family.size(); ++e) {
        if (family.part[e] != p) continue;
        ++n;
        for (int i = 0; i < family.width; ++i)
          if (family.of(e)[i] != no_index) node[family.of(e)[i]] = 1;
      }
      if (n == 0) continue;
      Link link;
      link.field = "part";
      link.keyword = detail::keyword_of_family(kind);
      link.count = n;
      for (const BulkBlock& b : model_.element_blocks)
        if (!link.span.valid() && b.block != nullptr && b.count > 0 && b.first < family.size() &&
            b.block->schema != nullptr && detail::family_of_kind(b.block->schema->kind) == kind &&
            family.part[b.first] == p)
          link.span = b.block->header_span;
      view_.used_by.push_back(std::move(link));
    }
    count("nodes", static_cast<std::size_t>(std::count(node.begin(), node.end(), 1)));
    const auto in_part = [&](Carrier c, std::uint32_t e, const auto&) {
      const auto kind = detail::family_of_carrier(c);
      return kind && e != no_index && model_.family(*kind).part[e] == p;
    };
    reached_by_members([&](NodeIndex n) { return n != no_index && node[n] != 0; }, in_part);
  }

  void block() {
    const std::string& kind = entity().kind;
    const std::int64_t id = entity().id;
    named_by();
    if (kind == "grnod") {
      if (const NodeSet* s = selections_.node_group(id)) count("nodes", s->nodes.size());
    } else if (kind == "surf") {
      if (const auto s = selections_.outline(id)) {
        count("segments", s->segments.size());
        count("nodes", selections_.nodes_of(s->segments).size());
      }
    } else if (kind == "line") {
      if (const LineSet* s = selections_.line(id)) count("edges", s->edges.size());
    } else if (kind == "set") {
      if (const SetGeneral* s = selections_.set(id)) {
        count("nodes", s->nodes.size());
        count("segments", s->segments.size());
        count("edges", s->edges.size());
        count("parts", s->parts.size());
      }
    } else if (kind == "grpart") {
      if (const auto* s = selections_.part_group(id)) count("parts", s->size());
    } else if (kind.starts_with("gr")) {
      if (const auto* s = selections_.element_group(kind, id)) count("elements", s->size());
    } else if (kind == "prop" && entity().index != no_index) {
      const Property& p = model_.properties[entity().index];
      if (p.thickness > 0) fact("thickness", p.thickness);
      if (p.area > 0) fact("area", p.area);
    } else if (kind == "mat" && entity().index != no_index) {
      const Material& m = model_.materials[entity().index];
      fact("density", m.density);
      if (m.young > 0) fact("E for the contact stiffness", m.young);
      if (m.bulk > 0) fact("bulk modulus for the contact stiffness", m.bulk);
      if (!m.stiffness_known)
        fact("contact stiffness", std::string("not established for this law"));
    } else if (kind == "funct") {
      if (const auto it = model_.curves.find(id);
          it != model_.curves.end() && !it->second.x.empty()) {
        const auto [x0, x1] = std::minmax_element(it->second.x.begin(), it->second.x.end());
        const auto [y0, y1] = std::minmax_element(it->second.y.begin(), it->second.y.end());
        count("points", it->second.x.size());
        fact("least abscissa", *x0);
        fact("largest abscissa", *x1);
        fact("least ordinate", *y0);
        fact("largest ordinate", *y1);
      }
    }
    if (kind == "part")
      part();
    else if (kind != "inter")
      reached_by_names();
  }

  const Deck& deck_;
  const Model& model_;
  Selections& selections_;
  Definitions definitions_;
  std::vector<std::pair<const Block*, std::vector<Reference>>> references_;
  EntityView view_;
};

}  // namespace

EntityView view_entity(const Deck& deck, const Model& model, const Interfaces& interfaces,
                       const Entity& entity) {
  return EntityCollector(deck, model, interfaces, entity).run();
}

}  // namespace deck
