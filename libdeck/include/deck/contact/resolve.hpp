// Effective values that only the mesh knows: the default gap of an interface, its radiation
// distance.
#pragma once
#include <string_view>

#include "deck/contact/scene.hpp"

namespace deck {

/// Fills in every value of Origin::geometry from the first contact of its interface in `scene`,
/// which was built from `interfaces` (without WhatIf, or the values are those of other settings; a
/// scene without penetrations will do). Interfaces that have no contact there stay unresolved.
void resolve(Interfaces& interfaces, const Scene& scene);

/// True if some value waits for `resolve`.
bool waits_for_geometry(const Interfaces& interfaces);

/// The first part of an interface that is not dropped; nullptr if there is none.
const Contact* first_contact(const Scene& scene, const InterBase& inter);

/// What one contact makes of a field of Origin::geometry. The parts of a TYPE19 may differ.
double geometry_value(const Contact& contact, std::string_view field);

}  // namespace deck
