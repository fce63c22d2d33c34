// What this program does not know about the members of a contact or their places, although the
// deck is legal: a verdict about such a contact would be invented. Private to the stage.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "contact/shared/scene_parts.hpp"
#include "keyword/shared/references.hpp"

namespace deck::detail {

/// "Gapmin is 'NaN', which is not a finite number in working units": a cell of the card; empty: all
/// can be used.
std::string unusable_cell(const Deck& deck, const InterBase& inter);

class NotEvaluated {
 public:
  /// Looks for transforms that are not evaluated here (DK110). Both must outlive this.
  NotEvaluated(const Model& model, Selections& selections);

  /// Why the contact is not to be judged; empty: everything is known. Of its card and groups: its
  /// sides must have been resolved, so that the findings about their groups are there.
  std::string reason_in_card(const Contact& contact);
  /// Of the places of its nodes. May be asked by several threads.
  std::string reason_in_nodes(const Contact& contact) const;

 private:
  void find_unplaced();
  /// Groups with members that are left out (DK164) and what their finding says.
  void find_partial();
  std::string partial_group(const Block& inter);

  const Model& model_;
  Selections& selections_;
  std::optional<Definitions> definitions_;
  std::size_t looked_at_ = 0;  ///< findings of the selections
  std::map<const Block*, std::string> partial_;
  std::vector<bool> unplaced_;  ///< by node; empty: none
};

}  // namespace deck::detail
