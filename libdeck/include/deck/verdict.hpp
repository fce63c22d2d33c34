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
  stops,       ///< the solver would stop: an error of the deck, a node on a segment, an empty side
  penetrates,  ///< initial penetrations that are no ties
  crossed,     ///< crossed elements
  untied,      ///< nodes of a tie without a segment
  not_examined,  ///< nothing was examined, or a part of it could not be
  warnings,      ///< of lint
  remarks,       ///< of lint: information only
  clean          ///< examined, and nothing found
};
std::string_view to_string(VerdictLevel level);  ///< "stops", ..., "not-examined", ...

/// Numbers by name, in order of what they are about.
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
  VerdictCounts counts;             ///< of all sentences, and those that are 0
  bool stops_before_pairs = false;  ///< the deck or a contact as such stops the solver
  bool undecided = false;           ///< a contact could not be evaluated
  bool warns = false;               ///< something that --fail-on warning stops at

  /// 0 where there is no such count.
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
  std::uint64_t untied = 0;         ///< nodes that no tie of their interface holds and none should
  std::uint64_t solver_errors = 0;  ///< of those: the solver stops (1078)
  std::uint64_t main_and_tied = 0;  ///< main nodes that are tied themselves: it stops (556)
  std::vector<Losses> losses;       ///< interfaces that lose nodes
};

/// Numbers of contacts and penetrations for a verdict; the scene is not needed afterwards.
struct ContactFacts {
  std::size_t contacts = 0, not_evaluated = 0;
  std::size_t left_out =
      0;  ///< of not_evaluated: too large for a quick look of lint, and only that
  std::array<std::size_t, 7> obstacles{};  ///< evaluated contacts by NotCleanReason
  ContactTotals total;
  double deepest = 0, deepest_gap = 0;  ///< of the deepest pair: its depth, and its gap
  std::uint64_t unbounded = 0;  ///< pairs that are left out of these: beyond largest_bounded_gap
  std::vector<TieFacts::Losses> untied;  ///< TYPE10 that do not tie all of their nodes
  std::optional<TieFacts> ties;          ///< of TYPE2; nullopt: not looked for
};
ContactFacts contact_facts(const Scene& scene, const SceneView& view);
TieFacts tie_facts(const std::vector<Tie>& ties);

/// Numbers of findings of a lint run, without those of gates, after suppressions, baselines and
/// changed severities. If lint was run, these errors and warnings decide the verdict.
struct LintFacts {
  std::uint64_t errors = 0, warnings = 0, remarks = 0;
  bool contacts_left_out = false;  ///< the model was too large for a quick look
};

/// The input of a verdict. An absent part (nullptr or nullopt) was not examined.
struct VerdictInput {
  const Deck* deck = nullptr;  ///< its findings hold all that was found, of the scene as well
  const Interfaces* interfaces = nullptr;  ///< nullptr: not formed, contacts are not spoken of
  std::optional<ContactFacts> contacts;
  const cycle::SceneOutcome* cycle = nullptr;
  const Model* model = nullptr;                ///< with `cycle`
  const cycle::StepsOutcome* steps = nullptr;  ///< where `cycle` is the last of several
  std::optional<LintFacts> lint;
};

/// Makes the verdict; every verdict of the program comes from here.
Verdict make_verdict(const VerdictInput& input);
/// The verdict that `deck gaps` prints: contacts, ties and crossed elements of a deck.
Verdict verdict_of(const LoadedDeck& loaded);
/// The verdict with another scene of the deck, whose findings hold all findings.
Verdict verdict_of(const Deck& deck, const Scene& scene, const SceneView& view);

/// When a verdict makes an exit code of 1.
struct ExitRules {
  bool on_warning = false;        ///< --fail-on warning
  bool never = false;             ///< --fail-on never
  bool require_examined = false;  ///< --require-examined
  bool pairs_accepted = false;    ///< a baseline holds the pairs: they alone stop nothing
};
/// 0 or 1. Gates come on top of it.
int exit_code_of(const Verdict& verdict, const ExitRules& rules = {});

/// "node 57" or "edge 1-2" of a contact's secondary side.
std::string secondary_name(const Model& model, const Contact& contact, std::uint32_t secondary);
/// Nodes or edges that dtmin removes from their interface.
std::size_t removed_by_step(const cycle::ContactOutcome& outcome);

}  // namespace deck
