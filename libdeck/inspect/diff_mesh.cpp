// Compares nodes and elements, and cells of element rows that the model does not store.
#include "inspect/differ.hpp"

#include <algorithm>
#include <map>

#include "deck/text.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {
namespace {

class ElementRows {
 public:
  ElementRows(const Deck& deck, ElementCells& out) : deck_(deck), out_(out) {}

  void block(const Block& b, const Elements& family) {
    if (b.schema == nullptr || b.opaque) return;
    for (const CardSchema& card : b.schema->cards) {
      if (!card.in_version(b.version) || card.repeat != Repeat::rows) continue;
      wanted_.clear();
      int node = 0;
      for (const Field& f : card.fields) {
        if (!f.in_version(b.version) || &f == &card.fields.front() || f.name == "Thick") continue;
        if (f.ref == "node" && node++ < family.width) continue;
        wanted_.push_back(&f);
      }
      if (!wanted_.empty()) rows(b, card, family);
    }
  }

 private:
  void rows(const Block& b, const CardSchema& card, const Elements& family) {
    const std::int64_t offset = deck_.offset_of(b, b.schema->kind);
    LineCursor cursor(deck_.sources, b);
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      if (!has_wanted_text(line.text)) continue;
      const DecodedCard row = decode_line(deck_, b, card, line, nullptr);
      if (row.cells.empty()) continue;
      const std::uint32_t e = family.map.find(row.cells.front().integer + offset);
      if (e == no_index) continue;
      std::vector<ElementCell> found;
      for (const Cell& c : row.cells) {
        if (std::find(wanted_.begin(), wanted_.end(), c.field) == wanted_.end()) continue;
        ElementCell cell{c.field, c.real, c.integer};
        if (cell.id != 0 && c.field->type == FieldType::id)
          cell.id += (cell.id < 0 ? -1 : 1) * deck_.offset_of(b, c.field->ref);
        if (cell.real != 0 || cell.id != 0) found.push_back(cell);
      }
      if (!found.empty())
        out_[static_cast<std::size_t>(family.kind)].insert_or_assign(e, std::move(found));
    }
  }

  /// True if a wanted cell has text, or if columns do not decide.
  bool has_wanted_text(std::string_view text) const {
    if (text.find(',') != text.npos) return true;
    return std::any_of(wanted_.begin(), wanted_.end(), [&](const Field* f) {
      const auto first = static_cast<std::size_t>(f->first - 1);
      if (first >= text.size()) return false;
      const auto cell = text.substr(first, static_cast<std::size_t>(f->last - f->first + 1));
      return cell.find_first_not_of(" \t\r") != cell.npos;
    });
  }

  const Deck& deck_;
  ElementCells& out_;
  std::vector<const Field*> wanted_;
};

/// Reads the rows of all elements once; skips rows that end behind the nodes.
ElementCells element_cells(const Deck& deck, const Model& model) {
  ElementCells out;
  ElementRows rows(deck, out);
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && b.schema->bulk)
      if (const auto kind = family_of_kind(b.schema->kind)) rows.block(b, model.family(*kind));
  return out;
}

}  // namespace

Change& Differ::loose(ChangeKind kind, std::string group, std::string keyword, std::int64_t id) {
  Change c;
  c.kind = kind;
  c.group = std::move(group);
  c.keyword = std::move(keyword);
  c.id = id;
  out_.changes.push_back(std::move(c));
  return out_.changes.back();
}

void Differ::nodes() {
  const Nodes& na = a_.loaded.model().nodes;
  const Nodes& nb = b_.loaded.model().nodes;
  std::vector<std::uint8_t> used(nb.size(), 0);
  std::vector<std::int64_t> lost, gained;
  for (NodeIndex n = 0; n < na.size(); ++n) {
    const NodeIndex m = pairs_.node_to_b[n];
    if (m == no_index) {
      lost.push_back(na.id[n]);
      continue;
    }
    used[m] = 1;
    const bool same = same_length(na.x[n], nb.x[m]) && same_length(na.y[n], nb.y[m]) &&
                      same_length(na.z[n], nb.z[m]);
    if (same) continue;
    Change& c = loose(ChangeKind::moved, "node", "/NODE", na.id[n]);
    if (nb.id[m] != na.id[n]) c.id_b = nb.id[m];
    c.field = "position";
    c.old_value = std::array{na.x[n], na.y[n], na.z[n]};
    c.new_value = std::array{nb.x[m] / length_, nb.y[m] / length_, nb.z[m] / length_};
    if (placed_++ < most_places) {
      c.a = a_.loaded.model().node_span(n);
      c.b = b_.loaded.model().node_span(m);
    }
  }
  for (NodeIndex m = 0; m < nb.size(); ++m)
    if (used[m] == 0) gained.push_back(nb.id[m]);
  tolerances();
  if (lost.empty() && gained.empty()) return;
  Change& c = loose(ChangeKind::changed, "node", "/NODE", 0);
  c.field = "nodes";
  c.old_value = static_cast<std::int64_t>(na.size());
  c.new_value = static_cast<std::int64_t>(nb.size());
  c.lost = std::move(lost);
  c.gained = std::move(gained);
}

bool Differ::same_length(double x, double y) {
  return equal_(x * length_, y, extent_ * length_, other_units_);
}

auto Differ::tolerances_of(const DiffSide& side) const -> std::vector<Tolerance> {
  std::vector<Tolerance> out;
  for (const Block& b : side.loaded.deck().blocks) {
    constexpr std::string_view keyword = "/CNODE/";
    if (!b.header.starts_with(keyword)) continue;
    const double x = read_real(b.header.substr(keyword.size())).value;
    const UnitSystem* units = side.loaded.deck().units_of(b);
    out.push_back(
        {x * conversion_factor(units == nullptr ? units_a_ : *units, units_a_, length_dimension),
         b.header_span});
  }
  return out;
}

void Differ::tolerances() {
  const auto ta = tolerances_of(a_), tb = tolerances_of(b_);
  for (std::size_t i = 0; i < ta.size() && i < tb.size(); ++i) {
    if (equal_(ta[i].length, tb[i].length, extent_, true)) continue;
    Change& c = loose(ChangeKind::changed, "node", "/CNODE", 0);
    c.field = "tolerance";
    c.old_value = ta[i].length;
    c.new_value = tb[i].length;
    c.a = ta[i].place;
    c.b = tb[i].place;
  }
}

void Differ::elements() {
  std::map<std::pair<std::int64_t, std::string_view>, PartElements> parts;
  std::map<std::int64_t, std::int64_t> part_to_a;
  for (const Part& p : a_.loaded.model().parts)
    if (const std::int64_t to = pairs_.mapped(a_, b_, "part", p.id); to != 0)
      part_to_a.emplace(to, p.id);
  const auto part_a = [&](const Elements& f, std::uint32_t e) {
    return f.part[e] == no_index ? 0 : a_.loaded.model().parts[f.part[e]].id;
  };
  const auto part_b = [&](const Elements& f, std::uint32_t e) {
    if (f.part[e] == no_index) return std::int64_t{0};
    const std::int64_t id = b_.loaded.model().parts[f.part[e]].id;
    const auto it = part_to_a.find(id);
    return it == part_to_a.end() ? id : it->second;
  };
  const ElementCells cells_a = element_cells(a_.loaded.deck(), a_.loaded.model());
  const ElementCells cells_b = element_cells(b_.loaded.deck(), b_.loaded.model());
  for (const ElementKind kind : all_families) {
    const char* keyword = keyword_of_family(kind);
    const Elements& fa = a_.loaded.model().family(kind);
    const Elements& fb = b_.loaded.model().family(kind);
    const auto& to = pairs_.element_to_b[static_cast<std::size_t>(kind)];
    std::vector<std::uint8_t> used(fb.size(), 0);
    for (std::uint32_t e = 0; e < fa.size(); ++e) {
      PartElements& p = parts[{part_a(fa, e), keyword}];
      ++p.before;
      const std::uint32_t f = to[e];
      if (f != no_index) used[f] = 1;
      if (f == no_index || part_a(fa, e) != part_b(fb, f)) {
        p.lost.push_back(fa.id[e]);
        if (f != no_index) parts[{part_b(fb, f), keyword}].gained.push_back(fb.id[f]);
      } else if (!same_element(fa, e, fb, f) ||
                 !same_cells(cells_of(cells_a, kind, e), cells_of(cells_b, kind, f))) {
        p.altered.push_back(fa.id[e]);
      }
    }
    for (std::uint32_t f = 0; f < fb.size(); ++f) {
      PartElements& p = parts[{part_b(fb, f), keyword}];
      ++p.after;
      if (used[f] == 0) p.gained.push_back(fb.id[f]);
    }
  }
  for (auto& [key, p] : parts) {
    if (p.lost.empty() && p.gained.empty() && p.altered.empty()) continue;
    Change& c = loose(ChangeKind::changed, "part", "/PART", key.first);
    const auto title = [id = key.first](const Model& m) {
      const auto it = m.part_of_id.find(id);
      return it == m.part_of_id.end() ? std::string() : m.parts[it->second].title;
    };
    c.title = title(a_.loaded.model());
    if (c.title.empty()) c.title = title(b_.loaded.model());
    c.field = std::string(key.second) + " elements";
    c.old_value = p.before;
    c.new_value = p.after;
    c.lost = std::move(p.lost);
    c.gained = std::move(p.gained);
    c.altered = std::move(p.altered);
  }
}

bool Differ::same_element(const Elements& fa, std::uint32_t e, const Elements& fb,
                          std::uint32_t f) {
  for (int i = 0; i < fa.width; ++i)
    if (to_b(fa.of(e)[i]) != fb.of(f)[i]) return false;
  if (!fa.shape.empty() && (fa.shape[e] != fb.shape[f] || !same_mid_nodes(fa, e, fb, f)))
    return false;
  const auto thickness = [](const Elements& x, std::uint32_t i) {
    return i < x.thickness.size() ? x.thickness[i] : 0;
  };
  return same_length(thickness(fa, e), thickness(fb, f));
}

bool Differ::same_mid_nodes(const Elements& fa, std::uint32_t e, const Elements& fb,
                            std::uint32_t f) const {
  const auto mid = [](const Elements& x, std::uint32_t i) {
    return x.extra.empty() || x.extra[i] == no_index ? nullptr : x.extra_nodes.data() + x.extra[i];
  };
  const NodeIndex *x = mid(fa, e), *y = mid(fb, f);
  for (int i = 0; i < extra_node_count(fa.shape[e]); ++i)
    if ((x == nullptr ? no_index : to_b(x[i])) != (y == nullptr ? no_index : y[i])) return false;
  return true;
}

auto Differ::cells_of(const ElementCells& all, ElementKind kind, std::uint32_t e)
    -> const RowCells& {
  static const RowCells none;
  const auto& of_kind = all[static_cast<std::size_t>(kind)];
  const auto it = of_kind.find(e);
  return it == of_kind.end() ? none : it->second;
}

bool Differ::same_cells(const RowCells& x, const RowCells& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [&](const ElementCell& u, const ElementCell& v) {
                      return u.field->name == v.field->name && equal_(u.real, v.real, 0, false) &&
                             same_id(u.field->ref, u.id, v.id);
                    });
}

}  // namespace deck::detail
