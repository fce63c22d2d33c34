// Elements without area, volume or length; elements with the property of another kind; functions
// with unordered points.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/shared/vec.hpp"
#include "base/shared/words.hpp"
#include "deck/point3.hpp"
#include "lint/check.hpp"
#include "model/shared/item_spans.hpp"

namespace deck::detail {
namespace {

using Vec = Point3<double>;

double length(const Vec& a) { return length3(a.x, a.y, a.z); }

/// Corners of an element, in the slots of its family.
struct ElementCorners {
  std::array<Vec, 8> at;
  std::size_t count = 0;
  std::size_t size() const { return count; }
  const Vec& operator[](std::size_t i) const { return at[i]; }
};

/// Round-off of products of coordinate differences, relative to the product of their lengths.
constexpr double rounding = 1e-13;

/// Corners of an element with `width` nodes; false: a node is missing.
template <class Width>
[[gnu::always_inline]] inline bool corners_of(const Nodes& nodes, const NodeIndex* n, Width width,
                                              ElementCorners& out) {
  out.count = width;
  for (std::size_t i = 0; i < width; ++i) {
    if (n[i] >= nodes.size()) return false;
    out.at[i] = {nodes.x[n[i]], nodes.y[n[i]], nodes.z[n[i]]};
  }
  return true;
}

/// Quick test for most elements: true if the product is far from zero and no square can over- or
/// underflow, so that exact lengths are not needed.
bool surely_apart(double product2, double a2, double b2) {
  constexpr double least = 1e-100, most = 1e100, far = 1e6;
  return a2 > least && a2 < most && b2 > least && b2 < most &&
         product2 > far * rounding * rounding * a2 * b2;
}

/// True if half the cross product of the diagonals is zero: corners on a line, or a crossed quad.
/// Inlined into the loop over shells, so that corners stay in registers.
[[gnu::always_inline]] inline bool without_area(const ElementCorners& p) {
  const Vec a = p[2] - p[0];
  const Vec b = (p.size() > 3 ? p[3] : p[1]) - p[1];
  const Vec side = p.size() > 3 ? b : p[1] - p[0];
  const Vec normal = cross(a, side);
  if (surely_apart(dot(normal, normal), dot(a, a), dot(side, side))) return false;
  return length(normal) <= rounding * length(a) * length(side);
}

/// True if the one-point volume of the eight slots is zero.
bool without_volume(const ElementCorners& p) {
  const Vec a = p[6] - p[0], b = p[7] - p[1], c = p[4] - p[2], d = p[5] - p[3];
  const Vec u = (a + b) - (c + d), v = (a + d) + (b + c), w = (a + d) - (b + c);
  return std::abs(dot(u, cross(v, w))) <= rounding * length(u) * length(v) * length(w);
}

/// Reports the number of bad elements per part, at the first.
template <class Bad>
void count_bad(const LintContext& c, const Rule& rule, Reporter& r, const Elements& family,
               std::string_view what, std::string_view lack, Bad&& bad) {
  const Model& m = *c.model;
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> found;  // part: count, first
  const auto walk = [&](auto width) {
    ElementCorners p;
    for (std::size_t e = 0, size = family.size(); e < size; ++e) {
      if (!corners_of(m.nodes, family.of(e), width, p) || !bad(p, e)) continue;
      auto& [count, first] = found[family.part[e]];
      if (count++ == 0) first = static_cast<std::uint32_t>(e);
    }
  };
  // Constant width for the most frequent loop.
  if (family.width == 4)
    walk(std::integral_constant<std::size_t, 4>());
  else
    walk(static_cast<std::size_t>(family.width));
  for (const auto& [part, tally] : found) {
    const std::string of = part == no_index ? "" : " of part " + std::to_string(m.parts[part].id);
    Finding& d =
        r.report(rule, m.element_span(family.kind, tally.second),
                 fmt::format("{} {}{}{} {} {}; the first is element {}", tally.first, what,
                             tally.first == 1 ? "" : "s", of, tally.first == 1 ? "is" : "are", lack,
                             family.id[tally.second]));
    if (rule.id == RuleId::DK130 && family.kind == ElementKind::shell3)
      d.reference = rule.message(35);
  }
}

void check_area(const LintContext& c, const Rule& rule, Reporter& r) {
  const auto for_each_family = [&](const Elements& family, std::string_view what) {
    count_bad(c, rule, r, family, what, "without area",
              [](const ElementCorners& p, std::size_t) { return without_area(p); });
  };
  for_each_family(c.model->shell4, "shell");
  for_each_family(c.model->shell3, "triangular shell");
}

void check_volume(const LintContext& c, const Rule& rule, Reporter& r) {
  count_bad(
      c, rule, r, c.model->solid8, "solid", "without volume",
      [](const ElementCorners& p, std::size_t) { return p.size() == 8 && without_volume(p); });
}

/// True if the edges at a corner of an 8-node solid are left-handed beyond round-off. The solver
/// reverses solids of negative volume, but a fold remains.
bool is_folded(const ElementCorners& p) {
  // Next and previous corner of the face, corner of the other face.
  static constexpr std::size_t edges[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                              {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  constexpr double most = 1e-9;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec u = p[edges[i][0]] - p[i], v = p[edges[i][1]] - p[i], w = p[edges[i][2]] - p[i];
    if (dot(cross(u, v), w) < -most * std::sqrt(dot(u, u) * dot(v, v) * dot(w, w))) return true;
  }
  return false;
}

void check_folded(const LintContext& c, const Rule& rule, Reporter& r) {
  const Elements& solids = c.model->solid8;
  count_bad(c, rule, r, solids, "solid", "folded at a corner",
            [&](const ElementCorners& p, std::size_t e) {
              if (solids.shape[e] != SolidShape::brick8 || !is_folded(p)) return false;
              const NodeIndex* n = solids.of(e);
              for (std::size_t i = 1; i < 8; ++i)  // degenerate solids have no such corners
                if (std::find(n, n + i, n[i]) != n + i) return false;
              return true;
            });
}

void check_length(const LintContext& c, const Rule& rule, Reporter& r) {
  const auto short_one = [](const ElementCorners& p, std::size_t) {
    return p[0].x == p[1].x && p[0].y == p[1].y && p[0].z == p[1].z;
  };
  count_bad(c, rule, r, c.model->truss, "truss element", "without length", short_one);
  count_bad(c, rule, r, c.model->beam, "beam", "without length", short_one);
}

/// Kind of elements for a property; nullptr: several or unknown.
const char* made_for(int number) {
  struct Elements {
    const char* name;
    std::initializer_list<int> properties;
  };
  static const Elements all[] = {{"shells", {1, 9, 10, 11, 16, 17, 51}},
                                 {"solids", {6, 14, 20, 21, 22}},
                                 {"trusses", {2}},
                                 {"beams", {3, 18}},
                                 {"springs", {4, 8, 12, 13, 25}}};
  for (const Elements& e : all)
    for (const int property : e.properties)
      if (property == number) return e.name;
  return nullptr;
}

/// Message about an 8-node thick shell whose formulation is for 16 or 6 nodes.
int refused_formulation(const LintContext& c, const Property& prop) {
  if (prop.number < 20 || prop.number > 22 || prop.block == nullptr) return 0;
  const std::int64_t isolid = decode(c.deck, *prop.block).integer("Isolid");
  return isolid == 16 ? 548 : isolid == 24 ? 549 : 0;
}

void check_property_kind(const LintContext& c, const Rule& rule, Reporter& r) {
  const Model& m = *c.model;
  const std::pair<const Elements*, std::string_view> families[] = {
      {&m.shell4, "shells"}, {&m.shell3, "shells"}, {&m.solid8, "solids"},
      {&m.truss, "trusses"}, {&m.beam, "beams"},    {&m.spring, "springs"}};
  for (const auto& [family, what] : families) {
    std::vector<bool> said(m.parts.size(), false);
    std::uint32_t last = no_index;  // elements of a part are mostly consecutive
    for (std::size_t e = 0; e < family->size(); ++e) {
      const std::uint32_t p = family->part[e];
      if (p == last) continue;
      last = p;
      if (p == no_index || m.parts[p].prop == no_index || said[p]) continue;
      said[p] = true;
      const Property& prop = m.properties[m.parts[p].prop];
      const char* kind = made_for(prop.number);
      const bool brick = family == &m.solid8 && m.solid8.shape[e] == SolidShape::brick8;
      const int refused = brick ? refused_formulation(c, prop) : 0;
      if (refused != 0) kind = "solids of 16 nodes (Isolid 16) or 6 nodes (Isolid 24)";
      if (kind == nullptr || what == kind) continue;
      Finding& d = r.report(rule, m.element_span(family->kind, static_cast<std::uint32_t>(e)),
                            fmt::format("part {} has {}, and its {} {} is for {}", m.parts[p].id,
                                        what, prop.type, prop.id, kind));
      if (refused != 0) d.reference = ReferenceMessage{refused, Severity::error};
      d.notes.emplace_back(m.parts[p].span, "the part");
      d.notes.emplace_back(prop.span, "the property");
    }
  }
}

/// Tests the points as written: /MOVE_FUNCT and scales of /FUNCT_SMOOTH can reverse the order.
void check_curves(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& block : c.deck.blocks) {
    if (block.schema == nullptr || block.opaque) continue;
    if (block.schema->keyword != "/FUNCT" && block.schema->keyword != "/FUNCT_SMOOTH") continue;
    const DecodedBlock d = decode(c.deck, block);
    const Cell* last = nullptr;
    for (const DecodedCard& card : d.cards) {
      if (card.cells.size() < 2 || card.cells[0].field->name != "X") continue;
      const Cell& x = card.cells[0];
      if (last != nullptr && !(x.real > last->real)) {
        r.report(rule, block, place_of(d, &x),
                 fmt::format("abscissa {} of {} is not above the previous one, {}",
                             number_text(x.real), name_of(d), number_text(last->real)));
        break;
      }
      last = &x;
    }
  }
}

/// Keywords whose first line must exist; elsewhere a missing line counts as blank.
void check_data(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const Block& block : c.deck.blocks) {
    if (block.schema == nullptr || block.opaque) continue;
    const int stop = block.schema->stop("data").value_or(Schema::goes_on);
    if (stop == Schema::goes_on) continue;
    LineCursor cursor(c.deck.sources, block);
    if (block.schema->has_title) cursor.next();
    if (cursor.next().valid()) continue;
    r.report(rule, block, block.header_span, std::string(block.header) + " has no data").reference =
        ReferenceMessage{stop, Severity::error};
  }
}

/// A row of a shell, as the solver sorts ids and nodes.
struct ShellRow {
  std::int64_t id = 0;
  double angle = 0, thickness = 0;
  Line line;
  bool same_cells(const ShellRow& o) const { return angle == o.angle && thickness == o.thickness; }
};

std::vector<ShellRow> shell_rows(const DecodedBlock& d) {
  std::vector<ShellRow> out;
  for (const DecodedCard& card : d.cards) {
    if (card.missing() || card.cells.empty() || card.cells[0].blank()) continue;
    ShellRow row{card.cells[0].integer, 0, 0, card.line};
    if (const Cell* cell = cell_named(card, "Phi")) row.angle = cell->real;
    if (const Cell* cell = cell_named(card, "Thick")) row.thickness = cell->real;
    out.push_back(row);
  }
  return out;
}

void check_row_order(const LintContext& c, const Rule& rule, Reporter& r) {
  const std::vector<BulkBlock>& runs = c.model->element_blocks;
  for (std::size_t i = 0, next = 0; i < runs.size(); i = next) {
    next = i + runs_of_block(runs, i).size();
    const Block& block = *runs[i].block;
    // A block with ascending rows is one run.
    if (next == i + 1 || (block.schema->kind != "shell" && block.schema->kind != "sh3n")) continue;
    const std::vector<ShellRow> rows = shell_rows(decode(c.deck, block));
    std::vector<const ShellRow*> sorted;
    for (const ShellRow& row : rows) sorted.push_back(&row);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const ShellRow* a, const ShellRow* b) { return a->id < b->id; });
    std::size_t wrong = 0;
    const ShellRow* first = nullptr;
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (!sorted[k]->same_cells(rows[k]) && wrong++ == 0) first = sorted[k];
    if (first == nullptr) continue;
    Finding& d = r.report(
        rule, block, first->line.whole(),
        fmt::format("rows of {} {} do not ascend by id, and {} the thickness or angle of another "
                    "row; first is element {}",
                    block.schema->keyword, block.id.value,
                    count(wrong, "element gets", "elements get"), first->id));
    d.fix = Fix{"sort the rows by id", false, {}};
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (sorted[k]->line.text != rows[k].line.text)
        d.fix->edits.push_back({rows[k].line.whole(), std::string(sorted[k]->line.text)});
  }
}

}  // namespace

std::vector<Checked> element_checks() {
  return {{RuleId::DK129, check_property_kind}, {RuleId::DK130, check_area},
          {RuleId::DK131, check_volume},        {RuleId::DK132, check_length},
          {RuleId::DK133, check_curves},        {RuleId::DK140, check_data},
          {RuleId::DK141, check_row_order},     {RuleId::DK616, check_folded}};
}

}  // namespace deck::detail
