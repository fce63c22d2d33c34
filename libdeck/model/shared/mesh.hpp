// The mesh itself, as the reference solver lists it at start-up: time steps and masses of elements,
// nodal masses, stiffness and time steps, and what the parts add up to. No factor is applied to any
// step. What is not established is NaN, and Mesh::left_out says why.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/model.hpp"

namespace deck {

/// The nodes that one /INTER/TYPE2 holds at the start.
struct TiedNodes {
  struct Row {
    NodeIndex node = no_index;
    std::array<NodeIndex, 4> main{};  ///< triangle: last repeated
    /// Place on the segment, -1 to 1 within it. Spotflag 27: weights of corners 1, 2.
    double s = 0, t = 0;
    bool penalty = false;
  };
  const Block* block = nullptr;
  int spotflag = 0;       ///< effective; 0 is the standard formulation
  bool rim = false;       ///< masses of nodes beyond the rim go to the rim (Iproj 1)
  bool evaluated = true;  ///< false: which nodes it holds is not known
  std::vector<Row> rows;  ///< ascending node id
};

/// A step that limits nothing.
inline constexpr double no_step = 1e30;

/// One entry per element of a family.
struct ElementFigures {
  std::vector<double> dt;    ///< no_step: limits nothing; NaN: not computed
  std::vector<double> mass;  ///< NaN: not computed
};

/// One entry per node, as the solver lists them: of contacts, only ties have a share.
struct NodeFigures {
  std::vector<double> dt;  ///< no_step: no mass or no stiffness; NaN: not computed
  std::vector<double> mass, inertia, stiffness, rotational_stiffness;
  std::vector<double> lumped_mass;  ///< of elements and added masses, before bodies and ties
};

/// An element by its family.
struct ElementRef {
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;  ///< no_index: none
};

/// Of a part, or of all.
struct PartFigures {
  double mass = 0;                  ///< NaN: not computed
  std::array<double, 3> centre{};   ///< where mass is not 0
  std::array<double, 6> inertia{};  ///< about the centre, of what the nodes have: xx yy zz xy yz zx
  double dt = no_step;              ///< smallest of its elements that are computed
  ElementRef slowest;               ///< the element that gives dt
  std::uint64_t not_computed = 0;   ///< elements without a step that is established
};

/// Something that is not established.
struct LeftOut {
  std::string what, why;
  std::uint64_t count = 0;
};

struct Mesh {
  std::array<ElementFigures, 8> elements;  ///< by ElementKind
  /// Of beams: by what the solver multiplies their stiffness, 1 or length / (a + s). It depends on
  /// the unit of length, and so do their steps, which go with 1 / sqrt of it.
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
  int threads = 1;                           ///< changes no result
  const Coordinates* coordinates = nullptr;  ///< of moved nodes; nullptr: those of the model
  const EngineFiles* engine = nullptr;  ///< beside the deck: some of its options change lengths
  /// What ties hold. nullptr: not known, nodes that /INTER/TYPE2 may change have no step.
  const std::vector<TiedNodes>* ties = nullptr;
};

Mesh make_mesh(const Model& model, const MeshOptions& options = {});

}  // namespace deck
