// Reports of penetration fixes, as text for people and as JSON. Pure functions.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "deck/edit.hpp"
#include "deck/model.hpp"
#include "deck/verdict.hpp"

namespace deck {

struct FixTextOptions {
  std::size_t rows = 10;  ///< of the lists of moved nodes and of what was not treated
  bool color = false;
  std::size_t width = 0;      ///< columns of a line of a table; 0: any
  std::string deck = "DECK";  ///< in commands, as a word of the shell
  bool examined = true;       ///< something was: without penetrations there is nothing to fix
};

/// One sentence: what was done, what is left.
std::string fix_verdict(const PenetrationFix& fix);
/// Verdict, interface table, changed fields, moved nodes, what was not treated and why.
std::string fix_text(const PenetrationFix& fix, const FixTextOptions& options = {});

/// What was not treated, put together by strategy and reason, and what to call next.
struct RefusedGroup {
  std::string text, command;
};
/// The largest groups first, at most eight of them; `more`: how many are left out. `deck`: a word
/// of the shell.
std::vector<RefusedGroup> refused_groups(const std::vector<PenetrationFix>& fixes,
                                         std::string_view deck, std::size_t* more = nullptr);

/// What the Starter does with a deck: "The Starter will still stop: 4 nodes on a segment of
/// interface 2, error 611." `fixed`: something was changed before.
std::string starter_text(const Verdict& verdict, const Scene& scene, bool fixed);

/// What each strategy would do, as a table, what each leaves and why, and `command` with the
/// strategy that leaves least, to be copied. Without penetrations and crossed elements one
/// sentence.
std::string fix_proposals_text(const std::vector<PenetrationFix>& proposals,
                               const std::function<std::string(std::string_view)>& command,
                               const FixTextOptions& options = {});

/// The document of `deck fix --json`, with the verdict of the deck as it was read. `written`: "no",
/// "diff", "in-place" or the directory. `steps`: of several strategies what each did; `fix` is then
/// all of them combined(), or, where none was asked for, unchanged().
std::string fix_json(const LoadedDeck& loaded, const PenetrationFix& fix, std::string_view written,
                     const std::vector<PenetrationFix>& steps = {});

/// A call that goes on from a fix, and what it does.
struct NextCommand {
  std::string does, command;
};
/// What the page of `deck fix --html` says beside the moved nodes (HtmlInput::repair): what was not
/// treated, what to call next, and the patch.
std::string repair_json(const PenetrationFix& fix, std::string_view deck,
                        const std::vector<NextCommand>& next, std::string_view patch);
/// Its form.
class SchemaDefinitions;
void repair_form(SchemaDefinitions& definitions);

}  // namespace deck
