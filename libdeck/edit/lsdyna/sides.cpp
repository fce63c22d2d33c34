// Finds what a side names, in the sets of the files or by its id, and makes the block for it.
#include "edit/lsdyna/sides.hpp"

#include "edit/lsdyna/names.hpp"
#include "text/columns.hpp"

namespace deck::detail {
namespace {

constexpr int first_with_sets = 2021;  // input version of /SET/GENERAL

std::string needs_sets(const std::string& what, int version) {
  return what + " need /SET/GENERAL, which input version " + std::to_string(version) +
         " does not have; name a surface";
}

std::string title_or(const DynaSet& set, const std::string& otherwise) {
  const std::string title = title_of(set.title);
  return title.empty() ? otherwise : title;
}

}  // namespace

bool DynaSides::whole_model(const DynaSide& side) const {
  return side.type == 5 || (side.single && side.id == 0 && side.type != 6);
}

DynaSides::Made DynaSides::all_parts(const DynaSide& side) {
  if (version_ < first_with_sets) return {0, needs_sets("all parts", version_)};
  if (side.type != 6) return {helpers_.id_of("surf", 5, 0, "/SET/GENERAL/@\nall parts\nALL\n"), {}};
  std::string but = "SET_D     " + list_cell(side.id) + "\n";
  Made out;
  if (const DynaSet* parts = sets_.find(DynaSetKind::part, side.id)) {
    but = clause("PART_D", parts->ids);
    for (const auto& [first, last] : parts->ranges) but += clause("PART_GD", {first, last, 1});
    out.doubt = parts->unread;
  } else {
    outside_.emplace(side.id, 2);
  }
  out.id = helpers_.id_of("surf", 6, side.id, "/SET/GENERAL/@\nall parts but one set\nALL\n" + but);
  return out;
}

DynaSides::Made DynaSides::set(const DynaSide& side, const DynaSet& set, DynaSetKind kind) {
  if (!set.unread.empty()) return {side.id, set.unread};
  if (set.ids.empty() && set.ranges.empty() && set.segments.empty())
    return {side.id, "the set is empty"};
  const std::string title =
      title_or(set, std::string(set_name(side.type)) + " " + std::to_string(side.id));
  std::string block = plain_block(set, kind, title);
  if (block.empty()) {
    if (version_ < first_with_sets)
      return {
          0, needs_sets(kind == DynaSetKind::shell ? "sets of shells" : "ranges of ids", version_)};
    block = general_block(set, kind, title);
  }
  const char* room = kind == DynaSetKind::node ? "grnod" : "surf";
  Made out{helpers_.own_id_of(room, side.type, side.id, std::move(block)), {}};
  if (kind == DynaSetKind::part)
    for (const std::int64_t id : set.ids)
      if (sets_.lacks_part(id)) out.doubt = "part " + std::to_string(id) + " of it does not exist";
  return out;
}

DynaSides::Made DynaSides::surface(const DynaSide& side) {
  if (whole_model(side) || side.type == 6) return all_parts(side);
  if (side.id <= 0 || side.id > largest_id)
    return {0, "no " + std::string(set_name(side.type)) + " is named"};
  if (side.type == 3) {
    Made out{helpers_.id_of("surf", 3, side.id,
                            "/SURF/PART/EXT/@\npart " + std::to_string(side.id) + "\n" +
                                list_cell(side.id) + "\n"),
             {}};
    if (sets_.lacks_part(side.id)) out.doubt = "there is no such part";
    return out;
  }
  DynaSetKind kind{};
  if (!set_kind_of(side.type, kind)) {
    outside_.emplace(side.id, side.type);
    return {side.id, side.type < 0 || side.type > 7 ? "the type of this set is not known" : ""};
  }
  const DynaSet* found = sets_.find(kind, side.id);
  if (kind == DynaSetKind::node && found != nullptr)
    return {0, "a set of nodes has no surface; name a surface"};
  if (found != nullptr) return set(side, *found, kind);
  outside_.emplace(side.id, side.type);
  return {side.id, {}};
}

std::int64_t DynaSides::group_of(std::int64_t surface) {
  if (surface == 0) return 0;
  return helpers_.id_of("grnod", -1, surface,
                        "/GRNOD/SURF/@\nnodes of surface " + std::to_string(surface) + "\n" +
                            list_cell(surface) + "\n");
}

DynaSides::Made DynaSides::nodes(const DynaSide& side) {
  if (side.type != 4) {
    Made out = surface(side);
    out.id = group_of(out.id);
    return out;
  }
  if (side.id <= 0) return {0, "no node set is named"};
  if (const DynaSet* found = sets_.find(DynaSetKind::node, side.id))
    return set(side, *found, DynaSetKind::node);
  outside_.emplace(side.id, 4);
  return {side.id, {}};
}

DynaSides::Made DynaSides::line(const DynaSide& side) {
  Made out = surface(side);
  if (out.id != 0)
    out.id = helpers_.id_of("line", -1, out.id,
                            "/LINE/SURF/@\nedges of surface " + std::to_string(out.id) + "\n" +
                                list_cell(out.id) + "\n");
  return out;
}

}  // namespace deck::detail
