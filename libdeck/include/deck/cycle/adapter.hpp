// From a scene to the contact kernel: the card of every elementary contact with effective values,
// and its pairs with stiffness, gap and initial penetration as the reference solver forms them.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/cycle/assemble.hpp"
#include "deck/cycle/kernel.hpp"
#include "deck/cycle/packet.hpp"

namespace deck::cycle {

/// The card of one contact of a scene, in working units. A TYPE19 part follows the rules of the
/// type it stands for. A blank Drad is 0 here: the default that start-up prints is not handed on to
/// the force stage.
[[nodiscard]] ContactCard make_card(const Scene& scene, const deck::Contact& contact);

/// Where a field of an interface stands, for "because of this field on this line".
struct FieldPlace {
  Span span;  ///< the columns on the card; invalid where the layout has no such cell
  Origin origin = Origin::built_in;
};
/// Nothing when interfaces of this type have no such field.
[[nodiscard]] std::optional<FieldPlace> field_place(const InterBase& inter, std::string_view field);

/// All pairs of a contact within reach, in the order of the search: by secondary, then main. Filled
/// are k0, gap and p0; with Ithe area or edge_width, and what add_conductivity adds; with fric_ID
/// what its pairs of parts say; with Icurv 3 and Iadm the nodal normals.
struct ContactPairs : PairArrays<std::vector<double>> {
  std::vector<CandidatePair> at;  ///< positions in the contact's lists
  PairList nodes;                 ///< node indices of the model, by role
  bool complete = true;           ///< false: too many pairs, none was kept
  [[nodiscard]] std::size_t size() const { return at.size(); }
};

/// Where and how far pairs are searched.
struct PairSearch {
  const Coordinates* at = nullptr;    ///< null: the scene's
  double margin = 0.0;                ///< beyond the reach of every pair
  std::vector<CandidatePair> always;  ///< pairs that are wanted wherever they are
};

/// Finds the pairs closer than their gap (or Drad, or what Icurv adds) at the scene's coordinates
/// and forms their values. The scene must have been built with penetrations and, for Istf 2 to 5,
/// with nodal stiffness.
[[nodiscard]] ContactPairs make_pairs(const Scene& scene, const deck::Contact& contact,
                                      const ContactCard& card, Model model, int threads = 1,
                                      const PairSearch& where = {});

/// Forms the nodal normals (Icurv 3, Iadm) of pairs again, with the nodes at `x`.
void renew_normals(const deck::Contact& contact, const ContactCard& card, const Coordinates& x,
                   ContactPairs& pairs);

/// Adds the conductivity that /HEAT/MAT gives the material of the secondary node's shell, or of the
/// elements that carry both edges, at temperatures given node by node; 0 where there is none.
void add_conductivity(const Scene& scene, const deck::Contact& contact,
                      const std::vector<double>& temperature, ContactPairs& pairs);

}  // namespace deck::cycle
