// State of a deck at t = 0, node by node: lumped masses, initial velocities and temperatures. And
// what the structure itself allows as time step.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/cycle/assemble.hpp"
#include "deck/keyword/engine_file.hpp"

namespace deck::cycle {

/// A velocity to try: all nodes of the elements of one part.
struct PartVelocity {
  std::int64_t part = 0;  ///< id
  std::array<double, 3> velocity{};
};

/// Smallest time step that the elements allow: nine tenths of what the mesh gives.
struct StructureStep {
  double dt = 1e30;
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;  ///< no_index: no element limits
};

/// One entry per node, working units.
struct State {
  std::array<std::vector<double>, 3> velocity;  ///< empty: the deck gives none, all are 0
  std::vector<double> mass;         ///< 0 where no element with density and no /ADMAS is
  std::vector<double> temperature;  ///< of /INITEMP, else of the material, else 0; empty: all are 0
  bool moving = false;              ///< some velocity is not 0
  bool heated = false;              ///< the deck gives a temperature to some node
  StructureStep structure;
  std::vector<std::string> not_evaluated;  ///< what the deck says about the state and was left out
};

/// Masses of elements and added masses, and the step of the structure, as model/shared/mesh.hpp
/// gives them. Velocities of /INIVEL TRA and T+G on node groups (a skew other than a fixed one is
/// noted as left out), then `velocities`, in order. Rotational initial velocities act on nodal
/// rotations and move no node. Temperatures of /INITEMP, elsewhere T0 of /HEAT/MAT. `engine`: the
/// Engine files beside the deck, some options of which change the step.
[[nodiscard]] State make_state(const Scene& scene, const std::vector<PartVelocity>& velocities = {},
                               const EngineFiles* engine = nullptr);

}  // namespace deck::cycle
