// Time steps and masses of elements, nodes and parts, as listed by the Starter, without scale
// factors. Unknown values are NaN; Mesh::left_out has the reasons.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/model.hpp"

namespace deck {

/// The nodes that one /INTER/TYPE2 ties at the start.
struct TiedNodes {
  struct Row {
    NodeIndex node = no_index;
    std::array<NodeIndex, 4> main{};  ///< triangle: last repeated
    /// Position on the segment, -1 to 1. Triangles with Spotflag 27: weights of corners 1, 2.
    double s = 0, t = 0;
    bool penalty = false;
  };
  const Block* block = nullptr;
  int spotflag = 0;       ///< effective; 0 is the standard formulation
  bool rim = false;       ///< masses of nodes outside of the border go to it (Iproj 1)
  bool evaluated = true;  ///< false: its nodes are unknown
  std::vector<Row> rows;  ///< ascending node id
};

/// Step without a limit.
inline constexpr double no_step = 1e30;

/// One entry per element of a family.
struct ElementFigures {
  std::vector<double> dt;    ///< no_step: no limit; NaN: not computed
  std::vector<double> mass;  ///< NaN: not computed
};

/// One entry per node, as listed by the solver; of contacts only ties contribute.
struct NodeFigures {
  std::vector<double> dt;  ///< no_step: no mass or no stiffness; NaN: not computed
  std::vector<double> mass, inertia, stiffness, rotational_stiffness;
  std::vector<double> lumped_mass;  ///< of elements and added masses, without bodies and ties
};

/// An element by its family.
struct ElementRef {
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;  ///< no_index: none
};

/// Sums of a part, or of all.
struct PartFigures {
  double mass = 0;                  ///< NaN: not computed
  std::array<double, 3> centre{};   ///< if mass is not 0
  std::array<double, 6> inertia{};  ///< about the centre, from the nodes: xx yy zz xy yz zx
  double dt = no_step;              ///< smallest computed step of its elements
  ElementRef slowest;               ///< the element with this step
  std::uint64_t not_computed = 0;   ///< elements with unknown step
};

/// Reason for unknown values.
struct LeftOut {
  std::string what, why;
  std::uint64_t count = 0;
};

struct Mesh {
  std::array<ElementFigures, 8> elements;  ///< by ElementKind
  /// Beams: factor of the stiffness in the solver, 1 or length / (a + s). It depends on the unit of
  /// length; the step is proportional to 1 / sqrt(factor).
  std::vector<double> beam_factors;
  NodeFigures nodes;
  std::vector<PartFigures> parts;  ///< as Model::parts
  PartFigures total;               ///< of all elements
  std::vector<LeftOut> left_out;

  const ElementFigures& of(ElementKind kind) const {
    return elements[static_cast<std::size_t>(kind)];
  }
};

struct MeshOptions {
  int threads = 1;                           ///< does not change results
  const Coordinates* coordinates = nullptr;  ///< of moved nodes; nullptr: of the model
  const EngineFiles* engine = nullptr;       ///< Engine files; some options change lengths
  /// Ties. nullptr: unknown; nodes that /INTER/TYPE2 can change have no step.
  const std::vector<TiedNodes>* ties = nullptr;
};

Mesh make_mesh(const Model& model, const MeshOptions& options = {});

}  // namespace deck
