// The verdict on a deck: level, sentences and counts, made by one function. Terminal, JSON, page,
// batch, editor and Python show it and add nothing; the exit code follows from it.
//
//   const deck::Verdict verdict = deck::verdict_of(*deck::load("car_0000.rad"));
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "deck/keyword.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/model.hpp"

namespace deck {

/// Levels, the worst first. A deck has the first one that applies.
enum class VerdictLevel : std::uint8_t {
  stops,         ///< the solver stops: an error of the deck, a node on a segment, an empty side
  penetrates,    ///< initial penetrations (ties are not counted)
  crossed,       ///< crossed elements
  untied,        ///< nodes of a tie without a segment
  not_examined,  ///< some or all interfaces could not be examined
  warnings,      ///< lint has warnings
  remarks,       ///< lint has infos
  clean          ///< everything was examined, no finding
};
std::string_view to_string(VerdictLevel level);  ///< "stops", ..., "not-examined", ...

/// Numbers by name, grouped by subject.
using VerdictCounts = std::vector<std::pair<std::string, std::uint64_t>>;

struct VerdictSentence {
  std::string what;  ///< "penetrations", "ties", "errors", "forces", ...
  std::string text;  ///< a whole sentence
  VerdictCounts counts;
};

struct Verdict {
  VerdictLevel level = VerdictLevel::clean;
  std::string text;  ///< all sentences
  std::vector<VerdictSentence> sentences;
  VerdictCounts counts;             ///< of all sentences; also those that are 0
  bool stops_before_pairs = false;  ///< the solver stops at the deck or a whole contact
  bool undecided = false;           ///< a contact could not be evaluated
  bool warns = false;               ///< there is a warning for --fail-on warning

  /// 0 if there is no count of that name.
  std::uint64_t count(std::string_view name) const;
};

/// Numbers of the ties of /INTER/TYPE2 for a verdict.
struct TieFacts {
  struct Losses {
    std::int64_t id = 0;  ///< of the interface
    std::uint64_t nodes = 0, untied = 0;
  };
  std::size_t ties = 0, not_evaluated = 0;  ///< interfaces
  std::uint64_t nodes = 0, tied = 0;
  std::uint64_t untied = 0;         ///< nodes that no interface ties
  std::uint64_t solver_errors = 0;  ///< untied nodes at which the solver stops (message 1078)
  std::uint64_t main_and_tied = 0;  ///< tied main nodes: the solver stops (message 556)
  std::vector<Losses> losses;       ///< interfaces that lose nodes
};

/// Numbers of contacts and penetrations for a verdict; the scene is not needed afterwards.
struct ContactFacts {
  std::size_t contacts = 0, not_evaluated = 0;
  std::size_t left_out = 0;  ///< of not_evaluated: too large for lint without --geometry
  std::array<std::size_t, 7> not_clean{};  ///< evaluated contacts by NotCleanReason
  ContactTotals total;
  double deepest = 0, deepest_gap = 0;  ///< depth and gap of the deepest pair
  std::uint64_t unbounded = 0;  ///< pairs with a gap above SceneView::largest_gap; not in deepest
  std::vector<TieFacts::Losses> untied;  ///< TYPE10 with untied nodes
  std::optional<TieFacts> ties;          ///< of TYPE2; nullopt: not looked for
};
ContactFacts contact_facts(const Scene& scene, const SceneView& view);
TieFacts tie_facts(const std::vector<Tie>& ties);

/// Numbers of findings of a lint run, without those of gates, after suppressions, baselines and
/// changed severities. If lint was run, these errors and warnings decide the verdict.
struct LintFacts {
  std::uint64_t errors = 0, warnings = 0, remarks = 0;
  bool contacts_left_out = false;  ///< the model was too large to build contacts during lint
};

/// The input of a verdict. An absent part (nullptr or nullopt) was not examined.
struct VerdictInput {
  const Deck* deck = nullptr;              ///< its findings include those of the scene
  const Interfaces* interfaces = nullptr;  ///< nullptr: not built, no sentence about contacts
  std::optional<ContactFacts> contacts;
  const cycle::SceneOutcome* cycle = nullptr;
  const Model* model = nullptr;                ///< with `cycle`
  const cycle::StepsOutcome* steps = nullptr;  ///< if `cycle` is the last of several steps
  std::optional<LintFacts> lint;
};

/// Makes the verdict. All outputs use this function.
Verdict make_verdict(const VerdictInput& input);
/// The verdict of `deck gaps`: contacts, ties and crossed elements.
Verdict verdict_of(const LoadedDeck& loaded);
/// The verdict of `deck gaps` for another scene; deck.findings must include its findings.
Verdict verdict_of(const Deck& deck, const Scene& scene, const SceneView& view);

/// Conditions under which exit_code_of() returns 1.
struct ExitRules {
  bool on_warning = false;        ///< --fail-on warning
  bool never = false;             ///< --fail-on never
  bool require_examined = false;  ///< --require-examined
  bool pairs_accepted = false;    ///< a baseline accepts the pairs: they do not fail
};
/// 0 or 1. Gates are not included.
int exit_code_of(const Verdict& verdict, const ExitRules& rules = {});

/// "node 57" or "edge 1-2": one item of the contact's secondary side.
std::string secondary_name(const Model& model, const Contact& contact, std::uint32_t secondary);
/// Number of nodes or edges that dtmin removes from the interface.
std::size_t removed_by_step(const cycle::ContactOutcome& outcome);

}  // namespace deck
