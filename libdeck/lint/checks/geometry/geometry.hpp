// Shared by the geometry checks. Private to the lint stage.
#pragma once
#include <string>
#include <string_view>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "lint/check.hpp"

namespace deck::detail {

/// "/INTER/TYPE19 3 (reversed)"
std::string name_of(const Contact& contact);

/// A scene with its view, and the target of findings.
struct GeometryRun {
  const LintContext& context;
  Reporter& reporter;
  const Scene& scene;
  const SceneView& view;
  const std::vector<Crossing>& crossings;
  const std::vector<Tie>& ties;  ///< of the scene, or computed separately
  int threads = 1;
  std::vector<NotChecked>& left_out;  ///< takes contacts whose forces are not known
  bool quick = false;                 ///< and those that are too large: else these are findings

  const Model& model() const { return *scene.model; }
  /// The card of an interface of this deck; never nullptr.
  const ContactCard* card(const InterBase& inter) const;
  /// Reports at a field of the card. `amount`: Finding::amount. For a contact the message starts
  /// with its name: "/INTER/TYPE19 3 (reversed): ".
  Finding& report(RuleId rule, const InterBase& inter, std::string_view field, std::string message,
                  std::optional<double> amount = {}) const;
  Finding& report(RuleId rule, const Contact& contact, std::string_view field, std::string message,
                  std::optional<double> amount = {}) const {
    return report(rule, *contact.inter, field, name_of(contact) + ": " + message, amount);
  }
};

/// Field of the minimum gap.
inline std::string_view gap_field(const Contact& contact) { return traits_of(*contact.inter).gap; }
/// "1 2 3 4" or, for triangles, "1 2 3".
std::string nodes_text(const Model& model, const MainSegment& segment);
/// "element 7 of part 2", or "no element".
std::string element_text(const ElementName& element);
/// Entry for GeometryRun::left_out: `what` of the contact was not checked.
NotChecked too_many_pairs(const std::string& contact, std::string_view what);
/// "1 segment", "3 segments"
std::string count_text(std::size_t n, std::string_view one);
inline std::string_view are(std::size_t n) { return n == 1 ? "is" : "are"; }

void check_penetrations(const GeometryRun& run);        // penetrations.cpp
void check_segments(const GeometryRun& run);            // segments.cpp
void check_gaps(const GeometryRun& run);                // gaps.cpp
void check_manual_differences(const GeometryRun& run);  // manual_differences.cpp
void check_ties(const GeometryRun& run);                // ties.cpp
void check_cycle(const GeometryRun& run, const cycle::SceneOutcome& outcome);  // cycle.cpp

}  // namespace deck::detail
