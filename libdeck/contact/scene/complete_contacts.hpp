// The second half of every contact: segments, stiffness, gaps and penetrations, once its members
// are known; and why a contact is not evaluated although the deck is legal: where this program does
// not know its members or their places, a verdict would be invented. Private to the stage.
#pragma once
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
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

/// Why a contact is not evaluated; no text: nothing is in the way, or it has been told before.
struct EvaluationFailure {
  std::string why;
  Severity severity = Severity::error;
  bool of_interface = false;  ///< told once for all contacts of the interface
};

/// A contact of the scene whose members are selected.
struct PendingContact {
  std::size_t place = 0;  ///< in Scene::contacts
  std::optional<SurfaceOutline> surface = {};
  double gapmin = 0, drad = 0;  ///< of the card
  bool thermal = false;
  bool complete = true;          ///< no selection has left out members so far
  std::string card_reason = {};  ///< NotEvaluated::reason_in_card()

  // What came of it.
  EvaluationFailure failure = {};
  Findings found{std::numeric_limits<int>::max()};
  DecisionReport decisions = {};
};

/// Sets Contact::evaluated, and says what is in the way. `card_reason`, `complete`: as above.
EvaluationFailure check_evaluation(const SceneContext& context, const NotEvaluated& not_evaluated,
                                   const std::string& card_reason, bool complete, Contact& contact);

/// Completes contacts, which do not depend on each other but for nodes that Inacti 3 moves. Nothing
/// depends on the number of threads. `progress`: called now and then, in this thread, with the
/// number of those that are complete.
void complete_contacts(SceneContext& context, const NotEvaluated& not_evaluated,
                       std::vector<PendingContact>& pending,
                       const std::function<void(std::size_t)>& progress);

}  // namespace deck::detail
