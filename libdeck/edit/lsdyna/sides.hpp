// The two sides of an LS-DYNA contact as surfaces, node groups and lines of a Radioss deck. Private
// to the LS-DYNA reader.
#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "edit/lsdyna/cards.hpp"
#include "edit/lsdyna/sets.hpp"

namespace deck::detail {

/// One side as the card names it.
struct DynaSide {
  std::int64_t id = 0, type = 0;  ///< SSID and SSTYP, or MSID and MSTYP
  bool single = false;            ///< of a contact of a surface with itself: 0 is the whole model
};

class DynaSides {
 public:
  /// What a side has become.
  struct Made {
    std::int64_t id = 0;  ///< of the surface, group or line; 0: none
    std::string doubt;    ///< why a person has to look at it; empty: nothing to look at
  };
  DynaSides(int version, DynaSets& sets, DynaHelpers& helpers)
      : version_(version), sets_(sets), helpers_(helpers) {}

  Made surface(const DynaSide& side);
  Made nodes(const DynaSide& side);
  Made line(const DynaSide& side);
  /// Nodes of a surface that was made.
  std::int64_t group_of(std::int64_t surface);
  /// Sets that are not in the files: their ids, and the types of the sides that name them.
  const std::set<std::pair<std::int64_t, std::int64_t>>& outside() const { return outside_; }

 private:
  bool whole_model(const DynaSide& side) const;
  Made all_parts(const DynaSide& side);
  Made set(const DynaSide& side, const DynaSet& set, DynaSetKind kind);

  int version_;
  DynaSets& sets_;
  DynaHelpers& helpers_;
  std::set<std::pair<std::int64_t, std::int64_t>> outside_;
};

}  // namespace deck::detail
