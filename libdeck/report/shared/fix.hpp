// Reports of penetration fixes as text and JSON.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "deck/edit.hpp"
#include "deck/verdict.hpp"

namespace deck {

struct FixTextOptions {
  std::size_t rows = 10;  ///< of the lists of moved nodes and of refusals
  bool color = false;
  std::size_t width = 0;      ///< columns of a line of a table; 0: any
  std::string deck = "DECK";  ///< in commands, quoted for the shell
  bool examined = true;       ///< false: nothing to examine, so nothing to fix
  UnitSystem units = {};      ///< of the deck, to be named
};

/// One sentence: done and left.
std::string fix_verdict(const PenetrationFix& fix);
/// Verdict, interface table, changed fields, moved nodes, refusals with reasons.
std::string fix_text(const PenetrationFix& fix, const FixTextOptions& options = {});

/// Refusals with common strategy and reason, and the next command.
struct RefusedGroup {
  std::string text, command;
};
/// The largest groups, at most eight; `more`: number of the others. `deck`: quoted for the shell.
std::vector<RefusedGroup> refused_groups(const std::vector<PenetrationFix>& fixes,
                                         std::string_view deck, std::size_t* more = nullptr);

/// Behaviour of the Starter: "The Starter will still stop: 4 nodes on a segment of interface 2,
/// error 611." `fixed`: the deck was changed before.
std::string starter_text(const Verdict& verdict, const Scene& scene, bool fixed);

/// A command to continue with, and its effect.
struct NextCommand {
  std::string does, command;
};
/// Commands that follow one another, and the deck after the last one.
struct FixPlan {
  std::vector<NextCommand> steps;
  std::uint64_t untreated = 0;  ///< penetrations that the solver does not treat
  std::string starter;          ///< starter_text()
};
/// "to do it:" with the commands and what each does, and the result.
std::string fix_plan_text(const FixPlan& plan);

/// Table of the strategies, with what each does not treat and the reasons.
std::string fix_proposals_text(const std::vector<PenetrationFix>& proposals,
                               const FixTextOptions& options = {});

/// Document of `deck fix --json`. `steps`: results of several strategies; `fix` is then combined()
/// of them, or unchanged() without strategy. `next`: see FixPlan.
std::string fix_json(const LoadedDeck& loaded, const PenetrationFix& fix, std::string_view written,
                     const std::vector<PenetrationFix>& steps = {},
                     const std::vector<NextCommand>& next = {});

/// Data of the page of `deck fix --html` besides moved nodes (HtmlInput::repair).
std::string repair_json(const PenetrationFix& fix, std::string_view deck,
                        const std::vector<NextCommand>& next, std::string_view starter,
                        std::string_view patch);
class SchemaDefinitions;
void repair_form(SchemaDefinitions& definitions);

}  // namespace deck
