// The contact interfaces as plain structs of effective values: what the solver will use for every
// field of /INTER/TYPE2, 7, 10, 11, 19, 24, 25, where each value came from, and what the card said.
#pragma once
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "deck/model/interface_fields.hpp"
#include "deck/model/model.hpp"

namespace deck {

/// What sets the interface types apart, one row a type. A side is the field that names it and what
/// its id refers to, in the words of the schemas.
struct InterfaceTraits {
  struct Side {
    std::string_view field, refers_to;
  };
  int type;
  std::string_view keyword;
  Side secondary, main;
  std::string_view gap;  ///< field of the minimum gap; empty: there is none
};

/// What every interface has.
struct InterBase {
  std::int64_t id = 0;
  int type = 0;  ///< 2, 7, 10, 11, 19, 24, 25
  std::string title;
  const Block* block = nullptr;
  Span span;              ///< header
  bool resolved = false;  ///< values of Origin::geometry are filled in (deck/contact/scene.hpp)
};

/// An interface with its fields, which are those of its schema (deck/model/interface_fields.hpp).
template <class Fields>
struct InterFields : InterBase, Fields {
  /// Calls f(name, field) for every field in the order of the card.
  template <class F>
  void for_each(F&& f) {
    Fields::visit(*this, f);
  }
  template <class F>
  void for_each(F&& f) const {
    Fields::visit(*this, f);
  }
};

/// A tie. Its fields mean something else than those of contacts, so it is in no list with them.
struct InterType2 : InterFields<Type2Fields> {
  static constexpr InterfaceTraits traits{
      2, "/INTER/TYPE2", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "dsearch"};
};

struct InterType7 : InterFields<Type7Fields> {
  static constexpr InterfaceTraits traits{
      7, "/INTER/TYPE7", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "Gapmin"};
};

struct InterType10 : InterFields<Type10Fields> {
  static constexpr InterfaceTraits traits{
      10, "/INTER/TYPE10", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "Gap"};
};

struct InterType11 : InterFields<Type11Fields> {
  static constexpr InterfaceTraits traits{
      11, "/INTER/TYPE11", {"line_IDs", "line"}, {"line_IDm", "line"}, "Gapmin"};
};

struct InterType19 : InterFields<Type19Fields> {
  static constexpr InterfaceTraits traits{
      19, "/INTER/TYPE19", {"surf_IDs", "surf"}, {"surf_IDm", "surf"}, "Gapmin"};
};

/// Segments against nodes, of one surface or of two; no minimum gap: gaps follow the thicknesses.
struct InterType24 : InterFields<Type24Fields> {
  static constexpr InterfaceTraits traits{
      24, "/INTER/TYPE24", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
};

/// The same with both sides of the mesh joined to a whole: what current models use.
struct InterType25 : InterFields<Type25Fields> {
  static constexpr InterfaceTraits traits{
      25, "/INTER/TYPE25", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
};

/// /DEFAULT/INTER/TYPEn: the non-zero fields.
struct DefaultInter {
  int type = 0;
  std::vector<std::pair<std::string, Effective<std::int64_t>>> values;
  Span span;
  const Effective<std::int64_t>* find(std::string_view field) const;
};

/// One /FRICTION: global values, then part pairs.
struct FrictionValues {
  std::array<double, 6> C{};
  double Fric = 0, VISF = 0;
};
struct FrictionPair {
  std::int64_t grpart_ID1 = 0, grpart_ID2 = 0, part_ID1 = 0, part_ID2 = 0;
  int Idir = 0;
  FrictionValues values, second;  ///< second: orthotropic direction, only if Idir = 1
  Span span;
};
struct Friction {
  std::int64_t id = 0;
  std::string title;
  std::int64_t Ifric = 0, Ifiltr = 0, Iform = 0;
  double Xfreq = 0;
  FrictionValues values;
  std::vector<FrictionPair> pairs;
  Span span;
};

/// The contacts and ties of a deck. `ordered` and `all` point into the lists, so it can be moved,
/// not copied.
struct Interfaces {
  std::vector<InterType7> type7;
  std::vector<InterType10> type10;
  std::vector<InterType11> type11;
  std::vector<InterType19> type19;
  std::vector<InterType24> type24;
  std::vector<InterType25> type25;
  std::vector<InterType2> type2;       ///< ties; not in `ordered`
  std::vector<DefaultInter> defaults;  ///< honoured ones only, at most one of a type
  std::vector<Friction> frictions;
  /// All contacts in the solver's order (file by file, then by id), as in the lists above.
  std::vector<const InterBase*> ordered;
  /// The same with ties: all whose cards are read as values.
  std::vector<const InterBase*> all;
  /// The first with this id, contact or tie; nullptr: there is none.
  const InterBase* find(std::int64_t id) const {
    for (const InterBase* inter : all)
      if (inter->id == id) return inter;
    return nullptr;
  }
  const Friction* friction(std::int64_t id) const;
  /// The default block that interfaces of this type take; nullptr if there is none.
  const DefaultInter* defaults_of(int type) const;

  Interfaces() = default;
  Interfaces(Interfaces&&) = default;
  Interfaces& operator=(Interfaces&&) = default;
  Interfaces(const Interfaces&) = delete;
  Interfaces& operator=(const Interfaces&) = delete;
  ~Interfaces() = default;

  /// Calls f(list) for the list of every type of contact.
  template <class F>
  void each_list(F&& f) {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
  template <class F>
  void each_list(F&& f) const {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
};

inline constexpr std::array<const InterfaceTraits*, 6> interface_types{
    &InterType7::traits,  &InterType10::traits, &InterType11::traits,
    &InterType19::traits, &InterType24::traits, &InterType25::traits};
/// The row of an interface type; nullptr for types that are not read.
inline const InterfaceTraits* traits_of(int type) {
  for (const InterfaceTraits* t : interface_types)
    if (t->type == type) return t;
  return nullptr;
}
inline const InterfaceTraits& traits_of(const InterBase& inter) { return *traits_of(inter.type); }
/// TYPE24 and TYPE25: segments with two sides, penetrations that only the first cycle acts on.
inline bool is_modern(int type) { return type == 24 || type == 25; }
/// What such a contact is between: 1 the nodes and segments of one surface, 2 of two surfaces,
/// 3 a node group and the second surface, 0 nothing.
inline int level_of(std::int64_t surf_ID1, std::int64_t surf_ID2) {
  if (surf_ID1 == 0) return surf_ID2 == 0 ? 0 : 3;
  return surf_ID2 == 0 || surf_ID2 == surf_ID1 ? 1 : 2;
}

/// Decodes the interface blocks and forms the effective values in the reference solver's order of
/// evaluation. `model` supplies what some defaults depend on (thermal materials, adaptive meshing,
/// monitored volumes, number of nodes). What follows from the mesh (Origin::geometry) is left at 0:
/// `resolve` (deck/contact/scene.hpp) fills it in. Reading-level findings go to `diagnostics`.
Interfaces read_interfaces(const Deck& deck, const Model& model, Diagnostics& diagnostics);

/// Calls f(contact) with the contact as its own type; `base` must be in Interfaces::ordered.
template <class F>
decltype(auto) visit_interface(const InterBase& base, F&& f) {
  if (base.type == InterType7::traits.type) return f(static_cast<const InterType7&>(base));
  if (base.type == InterType10::traits.type) return f(static_cast<const InterType10&>(base));
  if (base.type == InterType11::traits.type) return f(static_cast<const InterType11&>(base));
  if (base.type == InterType19::traits.type) return f(static_cast<const InterType19&>(base));
  if (base.type == InterType24::traits.type) return f(static_cast<const InterType24&>(base));
  if (base.type == InterType25::traits.type) return f(static_cast<const InterType25&>(base));
  throw std::logic_error("visit_interface: not an element of Interfaces");
}

/// The same for contacts and ties: an element of Interfaces::all.
template <class F>
decltype(auto) visit_any_interface(const InterBase& base, F&& f) {
  if (base.type == InterType2::traits.type) return f(static_cast<const InterType2&>(base));
  return visit_interface(base, std::forward<F>(f));
}

/// Calls f(name, field) for every field of a contact or tie of whatever type.
template <class F>
void for_each_field(const InterBase& base, F&& f) {
  visit_any_interface(base, [&](const auto& inter) { inter.for_each(f); });
}

/// Interfaces of one keyword that are not examined.
struct NotExamined {
  std::string keyword;  ///< "/INTER/TYPE25"
  std::vector<std::int64_t> ids;
};

/// What a verdict covers: every medium that says "clean" says this too.
struct Coverage {
  std::size_t examined = 0;               ///< contacts and, where they are examined, ties
  std::vector<NotExamined> not_examined;  ///< by keyword
  std::vector<std::string> missing;       ///< included files that were not read, as written

  bool complete() const { return missing.empty(); }
  bool nothing() const { return examined == 0; }
};

/// What was looked at: contacts alone, or the ties of /INTER/TYPE2 as well.
enum class Examined : std::uint8_t { contacts, contacts_and_ties };
/// "TYPE7, 10, 11, 19, 24 and 25", with 2 where ties are looked at.
std::string examined_types(Examined examined);
Coverage coverage_of(const Deck& deck, const Interfaces& interfaces,
                     Examined examined = Examined::contacts);

/// "3 interfaces of TYPE25 (ids 4, 5, 6), 1 interface of TYPE2 (id 9)"; empty: nothing was left
/// out.
std::string not_examined_text(const Coverage& coverage);
/// What stands in place of a verdict where there is none: "No verdict: ..." over an incomplete
/// model, "Nothing examined: ..." without any interface that is examined; else empty.
std::string coverage_lead(const Coverage& coverage);
/// What is added to a verdict: " Not examined: ...", or nothing.
std::string coverage_tail(const Coverage& coverage);

}  // namespace deck
