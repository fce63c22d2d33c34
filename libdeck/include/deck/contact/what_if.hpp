// Settings of an interface under test.
#pragma once
#include <cstdint>
#include <optional>

namespace deck {

/// Other values for one interface, to see what they would do; the deck is not read again.
struct WhatIf {
  std::int64_t interface_id = 0;
  std::optional<double> Gapmin, Fscalegap, Gapmax, Fpenmax, mesh_size;
  std::optional<int> Igap, Inacti, Irem_gap;
};

}  // namespace deck
