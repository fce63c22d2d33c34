// The geometry stage as VTK files for ParaView: surfaces and lines of every contact with stiffness,
// gap and depth, and the penetrations as points with arrows.
#pragma once
#include <string>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"

namespace deck {

struct CycleInput;  // report/shared/cycle.hpp

struct VtkFile {
  std::string name;   ///< file name without directory
  std::string bytes;  ///< VTK XML PolyData, little endian, base64; equal on every machine
};

/// Files of a scene, in the order of its contacts:
///
/// * interface_ID[_reversed|_edges]_main.vtp: main segments as polygons (edge pairs: lines). Cell
///   data stiffness, gap, depth (largest penetration, 0: none), element, part, off (1: switched off
///   by Inacti); point data node (id), gap (of the node if it is secondary too, else the largest of
///   its segments).
/// * interface_ID..._secondary.vtp: secondary nodes as vertices (edge pairs: lines). Cell data
///   stiffness, gap, depth, off; point data node.
/// * interface_ID_ties.vtp: lines from secondary nodes of a TYPE2 to the nearest point of their
///   segment, or of the nearest segment. Cell data node, tied, lost (1: neither tied nor bound by
///   another condition), message, distance, search (search distance of the solver).
/// * penetrations.vtp, always: one vertex per pair, deepest first. Point data arrow (unit normal
///   times depth: the way out), normal, depth, gap, ratio, action (number in the order of
///   PenetrationAction), on_surface, in_contact (0: only by the solver's round-off), node,
///   interface.
///
/// Coordinates are those of the deck in working units. Contacts without any item on a side get no
/// file for it.
std::vector<VtkFile> gaps_vtk(const Scene& scene, const SceneView& view);

/// Two files, always; the outcome must have kept its pairs:
///
/// * contact_pairs.vtp: a vertex per pair with a penetration or force, at the secondary node
///   (edges: at the point of contact). Point data force (vector, on the secondary side),
///   force_size, normal_force (negative pushes apart), penetration, gap (after Inacti), distance,
///   left_of_gap (share), k0, k_nodal, status (bits of cycle::Status), interface, role (0 primary,
///   1 reversed, 2 edges), node, node2 (second end of an edge, else 0), main_element, main_part.
/// * contact_nodes.vtp: a vertex per node that any contact acts on. Point data force (vector, of
///   all contacts), force_size, acceleration and dt (0 without mass), stiffness, mass, heat,
///   removed (1: leaves its interface), node.
///
/// Coordinates are those that were evaluated, in working units. Nodes also carry released (bits of
/// the translations that IBC frees, 4 X + 2 Y + Z) and the figures of Iadm: radius (0: none),
/// relative_penetration and angle. A `suffix` such as "_0003" makes files of a series.
std::vector<VtkFile> cycle_vtk(const CycleInput& input, const std::string& suffix = {});

/// The two collections that put a series in time: contact_pairs.pvd and contact_nodes.pvd.
std::vector<VtkFile> cycle_vtk_series(const cycle::StepsOutcome& steps,
                                      const std::vector<std::string>& suffixes);

/// open.py, a script for ParaView (paraview.simple) that opens files of gaps_vtk or cycle_vtk in
/// its directory: surfaces by depth, penetrations and forces as arrows. For a series pass the files
/// of cycle_vtk_series.
VtkFile paraview_script(const std::vector<VtkFile>& files);

}  // namespace deck
