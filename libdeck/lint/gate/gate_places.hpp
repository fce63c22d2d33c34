// Where in the deck a finding of the gate comes from: its deepest place, and among all that it
// depends on the line that a change touched. Private to lint.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/contact/view.hpp"
#include "lint/shared/changed_lines.hpp"

namespace deck::detail {

class GatePlaces {
 public:
  using Notes = std::vector<std::pair<Span, std::string>>;

  /// `lines` may be nullptr: no change is known.
  GatePlaces(const Scene& scene, const SceneView& view, const ChangedLines* lines);
  /// Of penetrations (positions in SceneView::penetrations, the deepest first) of an interface, or
  /// of the deck (nullptr).
  Notes of_penetrations(const InterBase* inter, const std::vector<std::uint32_t>& rows);
  /// Of nodes by their ids.
  Notes of_nodes(const InterBase* inter, const std::vector<std::int64_t>& nodes);
  /// The interface's own card alone.
  Notes of_interface(const InterBase* inter);

 private:
  bool add_changed(Notes& notes, const Span& span, const std::string& what);
  bool add_changed(Notes& notes, const Block* block, const std::string& what);
  bool add_node(Notes& notes, std::int64_t id, const char* what);
  bool add_elements(Notes& notes, const std::vector<std::uint32_t>& rows);
  bool add_parts(Notes& notes, const std::vector<std::uint32_t>& rows);
  std::string secondary_text(const NamedPenetration& p) const;

  const Scene& scene_;
  const SceneView& view_;
  const Model& model_;
  std::optional<ChangedPlaces> changed_;
};

}  // namespace deck::detail
