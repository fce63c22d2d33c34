// Why a pair is in contact or not: distance, gap with every term and the place that sets it, and
// what the solver does. Of a node the segment or edge that is nearest to contact.
#include "report/shared/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>

#include "contact/shared/closest.hpp"
#include "contact/shared/reported.hpp"
#include "contact/shared/scene_steps.hpp"
#include "contact/shared/sides.hpp"
#include "deck/cycle.hpp"
#include "model/shared/faces.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

/// Empty if a word is not an id.
std::vector<std::int64_t> read_ids(std::string_view text) {
  std::vector<std::int64_t> ids;
  while (true) {
    const auto end = std::min(text.find('-'), text.size());
    const IntegerCell id = read_integer(text.substr(0, end));
    if (id.status != NumberStatus::ok) return {};
    if (ids.empty() || ids.back() != id.value) ids.push_back(id.value);
    if (end == text.size()) return ids;
    text.remove_prefix(end + 1);
  }
}
bool has(std::span<const NodeIndex> nodes, NodeIndex node) {
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}
bool is_named(const Model& model, std::span<const NodeIndex> nodes,
              const std::vector<std::int64_t>& ids) {
  return std::all_of(ids.begin(), ids.end(),
                     [&](std::int64_t id) { return has(nodes, model.find_node(id)); }) &&
         std::set(nodes.begin(), nodes.end()).size() == ids.size();
}
/// A pair of a contact, whether it penetrates or not.
struct Approach {
  const Contact* contact = nullptr;
  std::uint32_t secondary = 0, main = 0;
  double distance = 0, gap = 0;
  std::array<double, 4> weights{};      ///< of the corners at the nearest point
  const PenetrationRow* row = nullptr;  ///< nullptr: it does not penetrate
  PairNodes nodes() const { return pair_nodes(*contact, secondary, main); }
  double clearance() const { return row != nullptr ? -row->depth : distance - gap; }
  /// Calls use(secondary side, main side) with the two that the contact has in its lists.
  template <class Use>
  void with_sides(const Use& use) const {
    if (contact->kind == ContactKind::edge_edge)
      use(contact->secondary_edges[secondary], contact->main_edges[main]);
    else
      use(contact->secondary[secondary], contact->main[main]);
  }
};
/// Half the thickness of an element, and what says it.
struct Thickness {
  double half = 0;
  std::string said_by;
  Span span;
};
class PairText {
 public:
  PairText(const LoadedDeck& loaded, const ShowTextOptions& options)
      : deck_(loaded.deck()),
        scene_(loaded.scene()),
        options_(options),
        connectivity_(*scene_.model) {}
  Approach approach(const Contact& c, std::uint32_t secondary, std::uint32_t main) const {
    Approach a{&c, secondary, main};
    const Coordinates& x = scene_.coordinates;
    const auto at = [&](NodeIndex n) { return Point3<double>{x.x[n], x.y[n], x.z[n]}; };
    const auto [s, m] = a.nodes();
    if (c.kind == ContactKind::edge_edge) {
      a.distance =
          closest_between_edges<Form::robust>(at(s[0]), at(s[1]), at(m[0]), at(m[1])).distance;
    } else {
      const auto closest = closest_on_segment<Form::robust>(
          at(s[0]), std::array{at(m[0]), at(m[1]), at(m[2]), at(m[3])}, m[2] == m[3]);
      a.distance = closest.distance();
      a.weights = closest.weights;
    }
    a.gap = c.pair_gap(secondary, main);
    return a;
  }
  /// Why a pair takes no part, however near it is; "": it does.
  std::string excluded(const Approach& a) {
    const Contact& c = *a.contact;
    const auto [secondary, main] = a.nodes();
    for (const NodeIndex n : secondary)
      if (has(main, n)) return "of one element: they have a node in common";
    bool searched = true;
    a.with_sides([&](const auto&, const auto& side) { searched = side.stiffness != 0; });
    if (!searched) return "the main side has no stiffness here, the solver does not search it";
    if (c.irem_gap != 2 || is_type24_or_25(c.type)) return {};
    if (of_removed_ != &c) {
      removed_.clear();
      of_removed_ = &c;
      const detail::SearchSides sides(c, detail::SearchSides::Off::included);
      detail::find_removed(scene_, c, sides, removed_);
    }
    const bool removed = detail::is_removed(removed_, {a.secondary, a.main});
    return removed ? "removed by Irem_gap 2: along the mesh they are less than 1.41 gaps apart"
                   : "";
  }
  std::string of(Approach a) {
    const Contact& c = *a.contact;
    const bool edges = c.kind == ContactKind::edge_edge, tie = c.is_tied_contact();
    for (const PenetrationRow& row : c.penetrations)
      if (row.secondary == a.secondary && row.main == a.main) a.row = &row;
    const auto [secondary, main] = a.nodes();
    std::string out =
        fmt::format("Interface {} {}: {} {} on {} {}\n", c.inter->id, kind_name(c),
                    edges ? "edge" : "node", ids_text(*scene_.model, secondary, '-'),
                    main.size() == 2 ? "edge" : "segment", ids_text(*scene_.model, main, '-'));
    if (a.row == nullptr)
      return out + (tie ? "not tied: " : "not in contact: ") + why_not(a) + "\n" + gap_text(a);
    const PenetrationRow& row = *a.row;
    out += pair_equation(row.depth, row.gap, row.distance) + "\n" + gap_text(a) +
           "the solver: " + (tie ? "pair tied" : action_words(row.action, 1));
    if (row.action == PenetrationAction::gap_reduced) out += fmt::format(" to {:.6g}", row.gap0);
    if (!row.in_contact) out += "; its round-off alone makes a penetration of it";
    const std::string inacti = place(*c.inter, "Inacti");
    return out + (inacti.empty() ? "\n" : fmt::format(" (Inacti {}, {})\n", c.inacti, inacti));
  }

 private:
  /// "file:line" of a cell, or the origin of its value; "": no such field.
  std::string place(const InterBase& inter, std::string_view field) const {
    const auto found = cycle::field_place(inter, field);
    if (!found) return {};
    return found->span.valid() ? deck_.sources.where(found->span) : to_string(found->origin);
  }
  std::string why_not(const Approach& a) {
    const Contact& c = *a.contact;
    if (!c.evaluated) return "the contact was not evaluated";
    if (std::string why = excluded(a); !why.empty()) return why;
    if (a.distance < a.gap)
      return fmt::format("distance {:.6g} is less than the gap, but {}", a.distance,
                         is_type24_or_25(c.type)
                             ? "the node is behind or beside the segment, or nearer to another"
                             : "the solver's round-off hides it");
    return fmt::format("distance {:.6g} is {:.6g} more than the gap{}", a.distance, a.clearance(),
                       is_beyond_rim(a) ? ", beyond the rim of the main side" : "");
  }
  /// The nearest point is on a side that no other main segment has.
  static bool is_beyond_rim(const Approach& a) {
    const std::vector<MainSegment>& main = a.contact->main;
    if (a.contact->kind == ContactKind::edge_edge || is_type24_or_25(a.contact->type)) return false;
    const auto& n = main[a.main].nodes;
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex from = n[k], to = n[(k + 1) % 4];
      if (from == to || a.weights[(k + 2) % 4] + a.weights[(k + 3) % 4] > 0) continue;
      if (std::count_if(main.begin(), main.end(), [&](const MainSegment& m) {
            return has(m.nodes, from) && has(m.nodes, to);
          }) == 1)
        return true;
    }
    return false;
  }
  Thickness thickness_of(ElementKind kind, std::uint32_t e) const {
    const Model& model = *scene_.model;
    const Elements& family = model.family(kind);
    const bool shell = kind == ElementKind::shell4 || kind == ElementKind::shell3;
    const double half =
        shell ? 0.5 * detail::gap_thickness(model, kind, e) : detail::half_of_line(model, kind, e);
    if (family.part[e] == no_index) return {half, "", {}};
    const Part& part = model.parts[family.part[e]];
    if (part.thickness == 2 * half) return {half, fmt::format("/PART/{}", part.id), part.span};
    if (part.prop != no_index)
      if (const Property& p = model.properties[part.prop]; !shell || p.thickness == 2 * half)
        return {half, fmt::format("{}/{}", p.type, p.id), p.span};
    return {half, fmt::format("element {}", family.id[e]), model.element_span(kind, e)};
  }
  /// Of the thickest shell, truss, beam or spring at a node; the third node of a beam orients it.
  Thickness thickest_at(NodeIndex node) {
    Thickness best;
    for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::truss,
                                   ElementKind::beam, ElementKind::spring})
      for (const std::uint32_t e : connectivity_.elements(kind, node))
        if (detail::any_is(scene_.model->family(kind).of(e), detail::carrying_nodes(kind), node))
          if (Thickness t = thickness_of(kind, e); t.half > best.half) best = std::move(t);
    return best;
  }
  /// "gap 1.6 = max(Gapmin 0.5, secondary gs 0.6 + main gm 1)", and the place of each of these.
  std::string gap_text(const Approach& a) {
    const Contact& c = *a.contact;
    const PairGap& rule = c.gap_rule;
    const bool modern = is_type24_or_25(c.type);
    const double gap = a.row != nullptr ? a.row->gap : a.gap;
    const std::string_view gapmin = traits_of(*c.inter).gap;
    const auto n = [](double x) { return length_text(x); };
    TextTable terms({"term", ">value", "from", "=set at"});
    const auto field = [&](std::string_view name, double value, const std::string& by = {}) {
      if (const std::string at = place(*c.inter, name); !at.empty())
        terms.row({name, n(value), by, at});
    };
    field("Igap", c.igap);
    const bool given = c.gapmin_origin == GapminOrigin::card;
    if (!modern) field(gapmin, c.gapmin, given ? "" : to_string(c.gapmin_origin));
    if (rule.rule == GapRule::constant)
      return fmt::format("gap {} = {}\n", n(gap), gapmin) + terms.below_heading(options_);
    const auto side = [&](const char* name, double value, const Thickness& t) {
      std::string by = "no shell or line";
      if (t.half > 0) by = fmt::format("{:.6g} / 2, {}", 2 * t.half, t.said_by);
      if (t.half > 0 && c.gap_scale != 1) by = fmt::format("{:.6g} x ", c.gap_scale) + by;
      if (value < c.gap_scale * t.half) by += ", limited by the card";
      terms.row({name, n(value), by, t.span.valid() ? deck_.sources.where(t.span) : ""});
    };
    std::string text;
    a.with_sides([&](const auto& one, const auto& other) {
      const auto carried = [&](const auto& item) {
        const auto kind = detail::family_of_carrier(item.carrier);
        const bool none = !kind || *kind == ElementKind::solid8 || item.element == no_index;
        return none ? Thickness() : thickness_of(*kind, item.element);
      };
      if constexpr (requires { one.node; })
        side("gs", one.gap, thickest_at(one.node));
      else
        side("gs", one.gap, carried(one));
      side("gm", other.gap, carried(other));
      text = fmt::format("secondary gs {} + main gm {}", n(one.gap), n(other.gap));
      if (modern && gap < 0.999999 * c.pair_gap(a.secondary, a.main))
        text += " (less where the nearest corners are thinner)";
      if (rule.rule != GapRule::sum_limited) return;
      const double ls = sweep::at(c.secondary_length, a.secondary, 0),
                   lm = sweep::at(c.main_length, a.main, 0);
      text = fmt::format("min({}, ls {} + lm {})", text, n(ls), n(lm));
      const std::string share = fmt::format("{:.6g} of the shortest side", c.mesh_fraction);
      const std::string at = place(*c.inter, "%mesh_size");
      terms.row({"ls", n(ls), ls < 1e30 ? share : "on no main segment", at});
      terms.row({"lm", n(lm), share, at});
    });
    if (rule.gapmax < 1e30) {
      text = fmt::format("min(Gapmax {}, {})", n(rule.gapmax), text);
      field("Gapmax", rule.gapmax);
    }
    if (c.gap_scale != 1) field("Fscalegap", c.gap_scale);
    if (rule.gapmin > 0) text = fmt::format("max({} {}, {})", gapmin, n(rule.gapmin), text);
    return fmt::format("gap {} = {}\n", n(gap), text) + terms.below_heading(options_);
  }
  const Deck& deck_;
  const Scene& scene_;
  const ShowTextOptions& options_;
  Connectivity connectivity_;
  detail::RemovalLists removed_;  ///< of the contact below
  const Contact* of_removed_ = nullptr;
};
/// Lengths of the lists of a contact; 0 where a side is empty. Points on edges have no ids.
std::array<std::uint32_t, 2> sizes_of(const Contact& c) {
  const bool edges = c.kind == ContactKind::edge_edge;
  const std::size_t secondary = edges ? c.secondary_edges.size() : c.secondary.size();
  const std::size_t main = edges ? c.main_edges.size() : c.main.size();
  if (!c.points.empty() || main == 0) return {};
  return {static_cast<std::uint32_t>(secondary), static_cast<std::uint32_t>(main)};
}
/// A node of a TYPE2.
std::string tied_text(const Model& model, NodeIndex node, const Tie& tie, const std::string& head) {
  for (const TiedNode& n : tie.nodes) {
    if (n.node != node) continue;
    const std::uint32_t segment = n.segment != no_index ? n.segment : n.nearest;
    return head +
           (segment == no_index ? "" : " on segment " + ids_text(model, tie.main[segment], '-')) +
           (n.tied ? "\ntied: " : "\nnot tied: ") + why_text(tie, n) + "\n";
  }
  return head + " is not tied: grnd_IDs does not name it\n";
}
}  // namespace

Result<PairName> parse_pair(std::string_view text) {
  const auto slash = std::min(text.find('/'), text.size());
  PairName out{read_ids(text.substr(0, slash)), {}};
  if (slash < text.size()) out.main = read_ids(text.substr(slash + 1));
  const bool edges = out.secondary.size() == 2 && out.main.size() == 2;
  const bool node = out.secondary.size() == 1 && (out.main.size() == 3 || out.main.size() == 4);
  if (edges || node) return out;
  return Error{
      Error::Code::config,
      fmt::format("{}: expected node ids as in pair:57/30-38-44-31 or pair:11-12/30-31", text)};
}
std::string pair_equation(double depth, double gap, double distance) {
  const auto n = [](double x) { return fmt::format("{:.5g}", x); };
  const auto is_at = [&](double height) {
    return std::abs(gap - depth - height) <= 1e-6 * std::max(gap, depth);
  };
  if (is_at(distance))
    return fmt::format("depth {} = gap {} - distance {}", n(depth), n(gap), n(distance));
  if (is_at(-distance))
    return fmt::format("depth {} = gap {} + distance {}: the node is behind the surface", n(depth),
                       n(gap), n(distance));
  return fmt::format("depth {} of a gap of {}: at the rim of a surface the gap is rounded off",
                     n(depth), n(gap));
}
Result<std::string> pair_text(const LoadedDeck& loaded, const PairName& name,
                              std::int64_t interface, const ShowTextOptions& options) {
  const Model& model = loaded.model();
  PairText text(loaded, options);
  std::string out;
  for (const Contact& c : loaded.scene().contacts) {
    if (interface != 0 && c.inter->id != interface) continue;
    const auto [secondaries, mains] = sizes_of(c);
    for (std::uint32_t s = 0; s < secondaries; ++s)
      for (std::uint32_t m = 0;
           m < mains && is_named(model, pair_nodes(c, s, 0).secondary, name.secondary); ++m)
        if (is_named(model, pair_nodes(c, s, m).main, name.main))
          append(out, "\n", text.of(text.approach(c, s, m)));
  }
  if (!out.empty()) return out;
  return Error{Error::Code::config,
               "no contact has the first on its secondary and the second on its main side"};
}
Result<std::string> node_text(const LoadedDeck& loaded, NodeIndex node, const InterBase& inter,
                              const ShowTextOptions& options) {
  const std::string head = fmt::format("Interface {} TYPE{}: node {}", inter.id, inter.type,
                                       loaded.model().node_id(node));
  if (inter.type == 2)
    for (const Tie& tie : loaded.ties())
      if (tie.inter == &inter) return tied_text(loaded.model(), node, tie, head);
  PairText text(loaded, options);
  std::string out;
  for (const Contact& c : loaded.scene().contacts) {
    if (c.inter != &inter || !c.points.empty()) continue;
    std::optional<Approach> best;
    std::map<std::string, std::size_t> left_out;
    const auto [secondaries, mains] = sizes_of(c);
    for (std::uint32_t s = 0; s < secondaries; ++s)
      for (std::uint32_t m = 0; m < mains && has(pair_nodes(c, s, 0).secondary, node); ++m) {
        const Approach a = text.approach(c, s, m);
        const std::string why = text.excluded(a);
        if (!why.empty() && a.clearance() < 0) ++left_out[why];
        if (why.empty() && (!best || a.clearance() < best->clearance())) best = a;
      }
    for (const PenetrationRow& row : c.penetrations)
      if (has(pair_nodes(c, row.secondary, row.main).secondary, node) &&
          (!best || best->row == nullptr || best->row->depth < row.depth))
        best = Approach{&c, row.secondary, row.main, row.distance, row.gap, {}, &row};
    if (best) append(out, "\n", text.of(*best));
    for (const auto& [why, n] : left_out)
      out += fmt::format("left out, though nearer than the gap: {}, {}\n",
                         count(n, "pair", "pairs"), why);
  }
  return !out.empty() ? out
                      : fmt::format("{} is in no pair: it is not on the secondary side ({})\n",
                                    head, traits_of(inter).secondary.field);
}

}  // namespace deck
