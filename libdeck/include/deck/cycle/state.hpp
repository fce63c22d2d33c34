// State of a deck at t = 0, node by node: lumped masses, initial velocities and temperatures. And
// what the structure itself allows as time step.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/cycle/assemble.hpp"

namespace deck::cycle {

/// A velocity to try: all nodes of the elements of one part.
struct PartVelocity {
  std::int64_t part = 0;  ///< id
  std::array<double, 3> velocity{};
};

/// One entry per node, working units.
struct State {
  std::array<std::vector<double>, 3> velocity;  ///< empty: the deck gives none, all are 0
  std::vector<double> mass;         ///< 0 where no element with density and no /ADMAS is
  std::vector<double> temperature;  ///< of /INITEMP, else of the material, else 0; empty: all are 0
  bool moving = false;              ///< some velocity is not 0
  bool heated = false;              ///< the deck gives a temperature to some node
  std::vector<std::string> not_evaluated;  ///< what the deck says about the state and was left out
};

/// Masses lumped from elements: quads rho t A / 4 per node, triangles by their angles, solids
/// rho V / 8 per slot (10- and 20-node solids by their shares), trusses and beams rho A l / 2,
/// springs half their mass; plus /ADMAS 0 and 1. Velocities of /INIVEL TRA and T+G on node groups
/// (a skew other than a fixed one is noted as left out), then `velocities`, in order. Rotational
/// initial velocities act on nodal rotations and move no node. Temperatures of /INITEMP, elsewhere
/// T0 of /HEAT/MAT.
[[nodiscard]] State make_state(const Scene& scene,
                               const std::vector<PartVelocity>& velocities = {});

/// Smallest time step that the elements allow, with the factor 0.9.
struct StructureStep {
  double dt = 1e30;
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;  ///< no_index: no element limits
};

/// Simple estimate: 0.9 l / c with c^2 = E/(rho (1 - nu^2)) for shells, the pressure wave for
/// solids, E/rho for trusses and beams; l from the area over the longest diagonal (quads) or side,
/// the volume over the largest face, the length. Good to some ten per cent; formulations, damping
/// and mass scaling are not looked at, and springs are left out: what limits them are the masses
/// and rigid bodies around them.
[[nodiscard]] StructureStep structure_step(const Scene& scene);

}  // namespace deck::cycle
