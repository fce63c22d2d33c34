// The *CONTACT keywords of an LS-DYNA file, cell by cell. Private to the LS-DYNA reader.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit/lsdyna.hpp"
#include "edit/lsdyna/sets.hpp"

namespace deck::detail {

enum class DynaKind : std::uint8_t {
  single_surface,
  surface_to_surface,
  one_way,
  nodes_to_surface,
  general,
  tied_nodes,
  tied_surface,
  tied_edge,
  other,  ///< not converted
};
inline bool is_tied(DynaKind k) {
  return k == DynaKind::tied_nodes || k == DynaKind::tied_surface || k == DynaKind::tied_edge;
}
/// One side only: the contact of a surface with itself.
inline bool is_single(DynaKind k) {
  return k == DynaKind::single_surface || k == DynaKind::general;
}

struct DynaCell {
  std::string_view name;      ///< "SSID"; unnamed columns have no cell
  std::string_view fallback;  ///< the value that blank means, as text; may be empty
  std::string text;           ///< trimmed, parameters replaced
  std::string written;        ///< as it stands there
  std::uint64_t line = 0;
  bool unknown_parameter = false;
};

struct DynaContact {
  DynaKind kind = DynaKind::other;
  std::string keyword;               ///< "*CONTACT_AUTOMATIC_GENERAL_ID"
  std::vector<std::string> options;  ///< what was stripped: "ID", "MPP", "OFFSET" ...
  std::string file;                  ///< path
  std::uint64_t line = 0;
  std::string heading;
  std::vector<DynaCell> cells;     ///< all named cells of all cards that are there, in order
  int mandatory = 0;               ///< mandatory cards found, 3 if complete
  std::vector<std::string> extra;  ///< lines behind the last known card
  std::uint64_t extra_line = 0;
  bool has(std::string_view option) const;
  const DynaCell* find(std::string_view name) const;
};

/// An *INCLUDE that leads nowhere.
struct DynaMissing {
  std::string file;  ///< that has the line
  std::uint64_t line = 0;
  std::string name, why;
};

/// A file with all that it includes.
struct DynaFile {
  std::vector<DynaContact> contacts;
  DynaSets sets;
  std::vector<DynaMissing> missing;
  std::vector<std::string> notes;
};

DynaFile read_dyna(const LsDynaFile& file, const LsDynaOptions& options);

}  // namespace deck::detail
