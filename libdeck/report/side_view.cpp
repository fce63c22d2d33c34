// Draws the side view of a pair, and finds the pair by the ids of its nodes.
#include "report/shared/side_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "base/shared/shown_text.hpp"
#include "contact/shared/scene_steps.hpp"
#include "deck/text.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

constexpr double view_width = 420, view_height = 230, view_left = 10, view_right = 250,
                 view_top = 30, view_bottom = 190;

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

bool same_nodes(const Model& model, std::span<const NodeIndex> nodes,
                const std::vector<std::int64_t>& ids) {
  std::set<std::int64_t> a;
  for (const NodeIndex n : nodes) a.insert(model.node_id(n));
  return a == std::set<std::int64_t>(ids.begin(), ids.end());
}

bool is_named(const Scene& scene, const Contact& c, const PenetrationRow& row,
              const PairName& name) {
  const PairNodes nodes = pair_nodes(c, row.secondary, row.main);
  return same_nodes(*scene.model, nodes.secondary, name.secondary) &&
         same_nodes(*scene.model, nodes.main, name.main);
}

double half_of(const ContactEdge& e) { return 0.5 * std::max(e.shell, e.section); }

/// Half thickness of a secondary node, without factors of its interface.
double half_at_node(const Scene& scene, const Contact& c, std::uint32_t secondary) {
  Connectivity connectivity(*scene.model);
  detail::ShellsAtNodes shells;
  const detail::GapInputs around{*scene.model, connectivity, shells, scene.coordinates};
  return detail::plain_sides(around, c).half_thickness[secondary];
}

std::string short_number(double v) { return fmt::format("{:.4g}", v); }

bool is_near(double a, double b, const PairHeights& v) {
  return std::abs(a - b) <= 1e-6 * std::max(v.gap, v.depth);
}

/// Gap or position of the node after the solver's action; 0: unchanged.
struct Ghost {
  double gap = 0, moved = 0;
  bool node_off = false, segment_off = false;
};
Ghost ghost_of(const PenetrationRow& r) {
  Ghost g;
  if (r.has_gap0) g.gap = r.gap0;
  if (r.action == PenetrationAction::offset_stored) g.gap = r.gap - r.p0;
  if (r.action == PenetrationAction::node_moved)
    g.moved = std::hypot(r.moved_by[0], r.moved_by[1], r.moved_by[2]);
  g.node_off = r.action == PenetrationAction::node_stiffness_zero;
  g.segment_off = r.action == PenetrationAction::segment_stiffness_zero ||
                  r.action == PenetrationAction::edge_stiffness_zero;
  return g;
}

struct SideDrawing {
  double low = 0, high = 1;
  double scale() const { return (view_bottom - view_top) / (high - low); }
  double y(double above) const { return view_bottom - (above - low) * scale(); }
  std::string band(std::string_view kind, double from, double to) const {
    return fmt::format("<rect class='{}' x='{}' width='{}' y='{:.2f}' height='{:.2f}'/>\n", kind,
                       view_left, view_right - view_left, y(to), (to - from) * scale());
  }
  std::string line(std::string_view kind, double x1, double x2, double from, double to) const {
    return fmt::format("<line class='{}' x1='{}' x2='{}' y1='{:.2f}' y2='{:.2f}'/>\n", kind, x1, x2,
                       y(from), y(to));
  }
  std::string level(std::string_view kind, double at) const {
    return line(kind, view_left, view_right, at, at);
  }
  std::string upright(std::string_view kind, double x, double from, double to) const {
    return line(kind, x, x, from, to);
  }
  std::string round(std::string_view kind, double at, double radius) const {
    return fmt::format("<circle class='{}' cx='{}' cy='{:.2f}' r='{:.2f}'/>\n", kind,
                       0.5 * (view_left + view_right), y(at), radius);
  }
};

struct Name {
  double at = 0;
  std::string text, kind;
};

/// Shifts overlapping names, from below.
std::string names_text(const SideDrawing& d, std::vector<Name> names) {
  std::stable_sort(names.begin(), names.end(),
                   [](const Name& a, const Name& b) { return a.at < b.at; });
  std::string out;
  double last = view_height;
  for (const Name& n : names) {
    const double at = std::min(d.y(n.at), last - 16.0);
    last = at;
    out += fmt::format(
        "<path class='leader' d='M{} {:.2f}L{} {:.2f}'/>\n"
        "<text class='{}' x='{}' y='{:.2f}'>{}</text>\n",
        view_right + 2, d.y(n.at), view_right + 14, at, n.kind, view_right + 18, at + 4,
        xml_text(n.text));
  }
  return out;
}

constexpr std::string_view side_style =
    "<style>text{font:12px system-ui,sans-serif;fill:#17202b} .ground{fill:#fff} "
    ".band{fill:#1f5fd0;opacity:.1} .main{fill:#17202b;opacity:.22} "
    ".half{fill:#1f5fd0;opacity:.22} "
    ".surface{stroke:#17202b;stroke-width:2} .off{stroke-dasharray:4 3} "
    ".gap-end{stroke:#1f5fd0;stroke-dasharray:5 3} .gap-length{stroke:#1f5fd0;stroke-width:1.5} "
    ".distance{stroke:#17202b;stroke-width:1.5;stroke-dasharray:2 2} "
    ".depth{stroke:#d11030;stroke-width:3} .dot{fill:#1f5fd0} "
    ".dot.off{fill:none;stroke:#1f5fd0;stroke-width:2} "
    ".ghost{fill:none;stroke:#5c6979;stroke-dasharray:3 3} .leader{fill:none;stroke:#5c6979} "
    ".deep{fill:#d11030;font-weight:600} .dim{fill:#5c6979}</style>\n";

std::string drawn(const PairHeights& v, const Ghost& ghost, bool edge, const SideDrawing& d) {
  const bool solid = v.main == 0.0;
  std::string out = d.band("band", 0, v.gap);
  out += solid ? d.band("main", d.low, 0) : d.band("main", -v.main, v.main);
  out += d.round("half", v.at, std::max(v.secondary, 0.0) * d.scale());
  out += d.level(ghost.segment_off ? "surface off" : "surface", 0) + d.level("gap-end", v.gap);
  if (ghost.gap > 0) out += d.level("ghost", ghost.gap);
  out += d.upright("gap-length", view_left + 8, 0, v.gap);
  const double middle = 0.5 * (view_left + view_right);
  out += d.upright("distance", middle, 0, v.at) + d.upright("depth", middle, v.at, v.gap);
  std::vector<Name> names{{0, edge ? "main edge" : "segment", ""},
                          {v.gap, "gap " + short_number(v.gap), ""},
                          {0.5 * (v.at + v.gap), "depth " + short_number(v.depth), "deep"}};
  if (ghost.gap > 0 && ghost.gap < 0.97 * v.gap)
    names.push_back({ghost.gap, "left of the gap " + short_number(ghost.gap), "dim"});
  if (ghost.moved > 0) {
    out += d.round("ghost", v.at + ghost.moved, std::max(v.secondary, 0.0) * d.scale());
    out += d.round("ghost", v.at + ghost.moved, 4);
    names.push_back({v.at + ghost.moved, "moved here", "dim"});
  }
  out += d.round(ghost.node_off ? "dot off" : "dot", v.at, 4);
  return out + names_text(d, std::move(names));
}

std::string title_of(const Scene& scene, const Contact& c, const PenetrationRow& r) {
  const bool edges = c.kind == ContactKind::edge_edge;
  const PairNodes nodes = pair_nodes(c, r.secondary, r.main);
  return fmt::format("Interface {} TYPE{}: {} {} on {} {}", c.inter->id, c.inter->type,
                     edges ? "edge" : "node", ids_text(*scene.model, nodes.secondary, '-'),
                     nodes.main.size() == 2 ? "edge" : "segment",
                     ids_text(*scene.model, nodes.main, '-'));
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
      fmt::format("{}: expected a node or edge and a segment or edge, by the ids of their nodes, "
                  "such as pair:57/30-38-44-31 or pair:11-12/30-31",
                  text)};
}

Result<FoundPair> find_pair(const Scene& scene, const PairName& name, std::int64_t interface) {
  std::vector<FoundPair> found;
  std::set<std::int64_t> interfaces;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    if (interface != 0 && contact.inter->id != interface) continue;
    for (std::size_t r = 0; r < contact.penetrations.size(); ++r) {
      if (!is_named(scene, contact, contact.penetrations[r], name)) continue;
      found.push_back({c, r});
      interfaces.insert(contact.inter->id);
    }
  }
  if (found.empty())
    return Error{Error::Code::config,
                 interface == 0
                     ? std::string("no pair of these nodes penetrates")
                     : fmt::format("no pair of these nodes penetrates in interface {}", interface)};
  if (interfaces.size() > 1)
    return Error{Error::Code::config,
                 fmt::format("the pair penetrates in interfaces {}: choose one with --interface",
                             fmt::join(interfaces, ", "))};
  // Both directions of a TYPE19 may match: take the deeper one.
  return *std::max_element(found.begin(), found.end(), [&](const FoundPair& a, const FoundPair& b) {
    return scene.contacts[a.contact].penetrations[a.row].depth <
           scene.contacts[b.contact].penetrations[b.row].depth;
  });
}

PairHeights pair_heights(const Scene& scene, const FoundPair& pair) {
  const Contact& c = scene.contacts[pair.contact];
  const PenetrationRow& r = c.penetrations[pair.row];
  PairHeights v{r.gap, r.depth, r.gap - r.depth, r.distance, 0, 0};
  const bool formed = is_type24_or_25(c.type), edge = c.kind == ContactKind::edge_edge;
  if (edge) {
    const ContactEdge &s = c.secondary_edges[r.secondary], &m = c.main_edges[r.main];
    v.secondary = formed ? s.gap : half_of(s);
    v.main = formed ? m.gap : half_of(m);
    return v;
  }
  const MainSegment& m = c.main[r.main];
  const bool shell = m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3;
  v.main = formed ? m.gap : shell ? 0.5 * m.thickness : 0.0;
  v.secondary = formed ? c.secondary[r.secondary].gap : half_at_node(scene, c, r.secondary);
  return v;
}

std::string pair_equation(const PairHeights& v) {
  const auto n = [](double x) { return fmt::format("{:.5g}", x); };
  if (is_near(v.at, v.distance, v))
    return fmt::format("depth {} = gap {} - distance {}", n(v.depth), n(v.gap), n(v.distance));
  if (is_near(v.at, -v.distance, v))
    return fmt::format("depth {} = gap {} + distance {}: the node is behind the surface",
                       n(v.depth), n(v.gap), n(v.distance));
  return fmt::format("depth {} of a gap of {}: at the rim of a surface the gap is rounded off",
                     n(v.depth), n(v.gap));
}

std::string side_view_text(const Scene& scene, const FoundPair& pair) {
  const Contact& c = scene.contacts[pair.contact];
  const PenetrationRow& r = c.penetrations[pair.row];
  return fmt::format("{}\n{}\n", title_of(scene, c, r), pair_equation(pair_heights(scene, pair)));
}

std::string side_view_svg(const Scene& scene, const FoundPair& pair) {
  const Contact& c = scene.contacts[pair.contact];
  const PenetrationRow& r = c.penetrations[pair.row];
  const PairHeights v = pair_heights(scene, pair);
  const Ghost ghost = ghost_of(r);
  const double below = v.main == 0.0 ? -0.12 * std::max(v.gap, v.depth) : -v.main;
  SideDrawing d;
  d.low = std::min({below, v.at - v.secondary, 0.0});
  d.high = std::max({v.gap, v.at + v.secondary, v.at + ghost.moved + v.secondary});
  if (!(d.high > d.low)) d.high = d.low + 1.0;
  const std::string title = title_of(scene, c, r);
  // Long ids make long titles; a character is at most 7.5 wide.
  const double wide = std::max(view_width, 2 * view_left + 7.5 * static_cast<double>(title.size()));
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "role='img' aria-label='{2}' data-scale='{3}' data-gap='{4}' data-depth='{5}' "
      "data-distance='{6}'>\n{7}<rect class='ground' width='{0}' height='{1}'/>\n",
      wide, view_height, xml_text(pair_equation(v)), d.scale(), v.gap, v.depth, v.distance,
      side_style);
  out += fmt::format("<text x='{}' y='18'>{}</text>\n", view_left, xml_text(title));
  out += drawn(v, ghost, c.kind == ContactKind::edge_edge, d);
  return out + fmt::format("<text x='{}' y='{}'>{}</text>\n</svg>\n", view_left, view_height - 12,
                           xml_text(pair_equation(v)));
}

}  // namespace deck
