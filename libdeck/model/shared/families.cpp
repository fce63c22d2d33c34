// Looks up the family of elements behind a name.
#include "model/shared/families.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace deck::detail {
namespace {

using Name = std::pair<std::string_view, ElementKind>;

constexpr Name kinds[] = {{"shell", ElementKind::shell4},   {"sh3n", ElementKind::shell3},
                          {"brick", ElementKind::solid8},   {"solid", ElementKind::solid8},
                          {"tetra4", ElementKind::solid8},  {"penta6", ElementKind::solid8},
                          {"tetra10", ElementKind::solid8}, {"bric20", ElementKind::solid8},
                          {"shel16", ElementKind::solid8},  {"quad", ElementKind::quad},
                          {"tria", ElementKind::tria},      {"truss", ElementKind::truss},
                          {"beam", ElementKind::beam},      {"spring", ElementKind::spring}};

constexpr Name groups[] = {{"grshel", ElementKind::shell4}, {"grsh3n", ElementKind::shell3},
                           {"grbric", ElementKind::solid8}, {"grquad", ElementKind::quad},
                           {"grtria", ElementKind::tria},   {"grtrus", ElementKind::truss},
                           {"grbeam", ElementKind::beam},   {"grspri", ElementKind::spring}};

template <class Names>
std::optional<ElementKind> find(const Names& names, std::string_view name) {
  const auto it = std::find_if(std::begin(names), std::end(names),
                               [&](const Name& n) { return n.first == name; });
  return it == std::end(names) ? std::nullopt : std::optional(it->second);
}

}  // namespace

std::optional<ElementKind> family_of_kind(std::string_view kind) { return find(kinds, kind); }
std::optional<ElementKind> family_of_group(std::string_view kind) { return find(groups, kind); }

}  // namespace deck::detail
