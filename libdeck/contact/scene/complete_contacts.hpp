// Second half of every contact: segments, stiffness, gaps and penetrations, after its members are
// known. Also the reasons why a contact of a legal deck is not evaluated: without all members and
// positions a verdict would be a guess.
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contact/shared/scene_steps.hpp"
#include "keyword/shared/references.hpp"

namespace deck::detail {

/// "Gapmin is 'NaN', which is not a finite number in working units": the first cell; empty: none.
std::string unusable_cell(const Deck& deck, const InterBase& inter);

class NotEvaluated {
 public:
  /// Finds transforms that deck does not evaluate (DK110). Both must outlive this object.
  NotEvaluated(const Model& model, Selections& selections);

  /// Reason in the card or groups against evaluation; empty if none. Resolve the contact's sides
  /// first: this creates the findings about their groups.
  std::string reason_in_card(const Contact& contact);
  /// Reason in the positions of its nodes. Thread-safe.
  std::string reason_in_nodes(const Contact& contact) const;

 private:
  /// Finds groups with omitted members (DK164), and the texts of their findings.
  void find_partial();
  std::string partial_group(const Block& inter);

  const Model& model_;
  Selections& selections_;
  std::optional<Definitions> definitions_;
  std::size_t looked_at_ = 0;  ///< findings of the selections read so far
  std::map<const Block*, std::string> partial_;
  std::vector<bool> unplaced_;  ///< by node; empty if all have a position
  /// Nodes of elements whose thickness is not known, and why.
  std::map<NodeIndex, std::string> unsized_;
};

/// Calls f(node) for the nodes of both sides.
template <class F>
void for_each_node(const Contact& contact, const F& f) {
  for (const SecondaryNode& s : contact.secondary) f(s.node);
  for (const MainSegment& m : contact.main) std::for_each(m.nodes.begin(), m.nodes.end(), f);
  for (const auto* edges : {&contact.secondary_edges, &contact.main_edges})
    for (const ContactEdge& e : *edges) std::for_each(e.nodes.begin(), e.nodes.end(), f);
}

/// Reason why a contact is not evaluated; empty if none, or if reported before.
struct EvaluationFailure {
  std::string why;
  Severity severity = Severity::error;
  bool of_interface = false;  ///< reported once per interface
};

/// Edges of a side: those of a line or set, or those of the segments of a surface.
struct EdgeSource {
  const std::vector<Edge>* edges = nullptr;
  std::optional<SurfaceOutline> surface = {};
  bool free_only = false;
};

/// A contact of the scene with its members.
struct PendingContact {
  std::size_t place = 0;  ///< index in Scene::contacts
  std::optional<SurfaceOutline> surface = {};
  EdgeSource secondary = {}, main = {};
  double gapmin = 0, drad = 0;  ///< of the card
  bool thermal = false;
  bool complete = true;          ///< no selection has omitted members so far
  std::string card_reason = {};  ///< NotEvaluated::reason_in_card()

  // Results.
  EvaluationFailure failure = {};
  Findings found{std::numeric_limits<int>::max()};
  DecisionReport decisions = {};
};

/// Sets Contact::evaluated, returns the reason against it. Arguments: as in PendingContact.
EvaluationFailure check_evaluation(const SceneContext& context, const NotEvaluated& not_evaluated,
                                   const std::string& card_reason, bool complete, Contact& contact);

/// Number of members from which a contact is formed.
std::size_t size_of(const PendingContact& pending, const Contact& contact);

/// Completes a contact. Contacts are independent, except for nodes that Inacti 3 moves, and results
/// do not depend on threads. Thread-safe while no place of a contact in the scene changes.
void complete_contact(const SceneContext& context, const NotEvaluated& not_evaluated,
                      PendingContact& pending, int threads);

}  // namespace deck::detail
