// Hands what the contacts of a scene derived from the mesh back to the fields of their interfaces.
#include "deck/contact/scene.hpp"

#include <type_traits>

namespace deck {

const Contact* first_contact(const Scene& scene, const InterBase& inter) {
  for (const Contact& c : scene.contacts)
    if (c.inter == &inter && !c.dropped) return &c;
  return nullptr;
}

double geometry_value(const Contact& contact, std::string_view field) {
  return field == "Drad" ? contact.drad : contact.gapmin;
}

bool waits_for_geometry(const Interfaces& interfaces) {
  bool waits = false;
  for (const InterBase* inter : interfaces.ordered)
    if (!inter->resolved)
      visit_interface(*inter, [&](const auto& t) {
        t.for_each([&](std::string_view, const auto& e) {
          waits = waits || e.origin == Origin::geometry;
        });
      });
  return waits;
}

void resolve(Interfaces& interfaces, const Scene& scene) {
  interfaces.each_list([&](auto& list) {
    for (auto& inter : list) {
      const Contact* const contact = first_contact(scene, inter);
      if (contact == nullptr) continue;
      inter.for_each([&](std::string_view name, auto& field) {
        if constexpr (std::is_same_v<decltype(field), EffectiveReal&>)
          if (field.origin == Origin::geometry) field.value = geometry_value(*contact, name);
      });
      inter.resolved = true;
    }
  });
}

}  // namespace deck
