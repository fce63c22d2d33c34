// Element families by keyword, group, node and part.
#include "model/shared/families.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace deck {
namespace detail {
namespace {

constexpr std::pair<std::string_view, ElementKind> kinds[] = {
    {"shell", ElementKind::shell4},   {"sh3n", ElementKind::shell3},
    {"brick", ElementKind::solid8},   {"solid", ElementKind::solid8},
    {"tetra4", ElementKind::solid8},  {"penta6", ElementKind::solid8},
    {"tetra10", ElementKind::solid8}, {"bric20", ElementKind::solid8},
    {"shel16", ElementKind::solid8},  {"quad", ElementKind::quad},
    {"tria", ElementKind::tria},      {"truss", ElementKind::truss},
    {"beam", ElementKind::beam},      {"spring", ElementKind::spring}};

}  // namespace

std::optional<ElementKind> family_of_kind(std::string_view kind) {
  const auto it = std::find_if(std::begin(kinds), std::end(kinds),
                               [&](const auto& k) { return k.first == kind; });
  return it == std::end(kinds) ? std::nullopt : std::optional(it->second);
}

std::optional<ElementKind> family_of_group(std::string_view kind) {
  for (const FamilyName& name : family_names())
    if (name.group == kind) return name.kind;
  return std::nullopt;
}

const std::vector<FamilyName>& family_names() {
  static const std::vector<FamilyName> names = {
      {ElementKind::shell4, "grshel", "GRSHEL", "SHEL", "shell", "SHELL", Carrier::shell4},
      {ElementKind::shell3, "grsh3n", "GRSH3N", "SH3N", "sh3n", "SH3N", Carrier::shell3},
      {ElementKind::solid8, "grbric", "GRBRIC", "BRIC", "brick", "SOLID", Carrier::solid},
      {ElementKind::quad, "grquad", "GRQUAD", "QUAD", "quad", "QUAD", Carrier::quad},
      {ElementKind::tria, "grtria", "GRTRIA", "TRIA", "tria", "TRIA", Carrier::shell3},
      {ElementKind::truss, "grtrus", "GRTRUS", "TRUS", "truss", "TRUSS", Carrier::truss},
      {ElementKind::beam, "grbeam", "GRBEAM", "BEAM", "beam", "BEAM", Carrier::beam},
      {ElementKind::spring, "grspri", "GRSPRI", "SPRI", "spring", "SPRING", Carrier::spring},
  };
  return names;
}

const FamilyName& family_name(ElementKind kind) {
  return family_names()[static_cast<std::size_t>(kind)];
}

int carrying_nodes(ElementKind kind) {
  constexpr int nodes[] = {4, 3, 8, 4, 3, 2, 2, 2};
  return nodes[static_cast<std::size_t>(kind)];
}

}  // namespace detail

namespace {

/// Rows of entries. Calls visit(f) twice, to count and to fill; visit calls f(row, entry) for all
/// entries in order.
template <class Entry, class Visit>
void fill_rows(std::size_t rows, std::vector<std::uint32_t>& first, std::vector<Entry>& entries,
               Visit visit) {
  first.assign(rows + 1, 0);
  visit([&](std::uint32_t row, const Entry&) { ++first[row + 1]; });
  for (std::size_t i = 0; i < rows; ++i) first[i + 1] += first[i];
  entries.resize(first[rows]);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  visit([&](std::uint32_t row, const Entry& entry) { entries[next[row]++] = entry; });
}

}  // namespace

int extra_node_count(SolidShape shape) {
  switch (shape) {
    case SolidShape::tetra10:
      return 6;
    case SolidShape::brick20:
      return 12;
    case SolidShape::thick16:
      return 8;
    default:
      return 0;
  }
}

NodeElements connect_nodes(const Elements& family, std::size_t node_count, int slots,
                           bool mid_nodes) {
  const int width = slots > 0 ? std::min(slots, family.width) : family.width;
  NodeElements out;
  fill_rows(node_count, out.first, out.entries, [&](auto&& emit) {
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const NodeIndex* n = family.of(e);
      for (int i = 0; i < width; ++i)
        if (n[i] != no_index && std::find(n, n + i, n[i]) == n + i) emit(n[i], e);
      if (!mid_nodes || family.extra.empty() || family.extra[e] == no_index) continue;
      const NodeIndex* mid = family.extra_nodes.data() + family.extra[e];
      const int count = extra_node_count(family.shape[e]);
      for (int i = 0; i < count; ++i)
        if (mid[i] != no_index && std::find(mid, mid + i, mid[i]) == mid + i &&
            std::find(n, n + width, mid[i]) == n + width)
          emit(mid[i], e);
    }
  });
  return out;
}

PartElements connect_parts(const Elements& family, std::size_t part_count) {
  PartElements out;
  fill_rows(part_count, out.first, out.entries, [&](auto&& emit) {
    const auto count = static_cast<std::uint32_t>(family.size());
    for (ElementRun run; run.first < count; run.first = run.end) {
      const std::uint32_t part = family.part[run.first];
      run.end = run.first + 1;
      while (run.end < count && family.part[run.end] == part) ++run.end;
      if (part != no_index) emit(part, run);
    }
  });
  return out;
}

}  // namespace deck
