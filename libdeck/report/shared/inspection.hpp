// Texts and documents of `deck show`, `deck diff`, and of a listing of the Starter compared with
// its deck.
//
//   const auto listing = deck::read_listing("car_0000.out", {});
//   auto loaded = deck::load("car_0000.rad");
//   const deck::ListingReport report = deck::compare_listing(*listing, *loaded);
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/loaded_deck.hpp"
#include "inspect/shared/diff.hpp"
#include "inspect/shared/listing.hpp"
#include "inspect/shared/show.hpp"

namespace deck {

class SchemaDefinitions;

// ---- one entity with its card, figures and references -----------------------------------------

struct ParamsInput;  // report/shared/params_report.hpp

struct ShowTextOptions {
  bool color = false;
  bool all = false;       ///< every line and every referring entity
  std::size_t width = 0;  ///< columns of a line; 0: any
};

/// `params` has this deck and, if its geometry was evaluated, the default gaps.
std::string show_text(const ParamsInput& params, const EntityView& view,
                      const ShowTextOptions& options = {});
/// The document of `deck show --json` (schemas/output/show.schema.json).
std::string show_json(const ParamsInput& params, const EntityView& view);

/// "57/30-38-44-31" or "11-12/30-31": a node or edge, and a segment or main edge by its nodes, in
/// any order.
struct PairName {
  std::vector<std::int64_t> secondary, main;
};
Result<PairName> parse_pair(std::string_view text);
/// "depth 0.35 = gap 1.25 - distance 0.9".
std::string pair_equation(double depth, double gap, double distance);
/// Of every contact that has the pair (of `interface`; 0: any): depth or distance, the gap with
/// each term and what sets it, the reason, and what the solver does. Error if no contact has it.
Result<std::string> pair_text(const LoadedDeck& loaded, const PairName& name,
                              std::int64_t interface, const ShowTextOptions& options);
/// The same of a node of an interface, with the segment or edge that is nearest to contact.
Result<std::string> node_text(const LoadedDeck& loaded, NodeIndex node, const InterBase& inter,
                              const ShowTextOptions& options);

// ---- two decks ---------------------------------------------------------------------------------

struct DiffTextOptions {
  bool color = false;
  std::size_t rows = 20;  ///< of moved nodes, of ids and of penetrations; 0: all
  std::size_t width = 0;  ///< columns of a line; 0: any
};

/// "Equal in meaning ...", or numbers of differences.
std::string diff_verdict(const DeckDiff& diff);
std::string diff_text(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                      const DiffTextOptions& options = {});
/// For review comments: tables for GitHub and GitLab.
std::string diff_markdown(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                          const DiffTextOptions& options = {});
/// The document of `deck diff --json` (schemas/output/diff.schema.json).
std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff);
/// What the page of `deck diff --html` says beside the penetrations (HtmlInput::changes).
std::string changes_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff);
/// Its form.
void changes_form(SchemaDefinitions& definitions);

// ---- a listing ---------------------------------------------------------------------------------

/// Entity of a kind of messages.
struct MessagePlace {
  std::string name;  ///< "interface 2 'web'", "node 105"; empty: none
  std::int64_t id = 0;
  Span span;  ///< in the deck; not valid if missing there
  std::uint64_t times = 0;
  std::vector<std::uint64_t> counted;  ///< distinct numbers of its messages
  std::vector<std::int64_t> nodes;     ///< named by its messages
  std::vector<std::size_t> lines;      ///< of the listing
  std::vector<std::size_t> findings;   ///< in ListingReport::findings: deck's findings about it
};

struct MessageGroup {
  int number = 0;
  Severity severity = Severity::error;
  std::uint64_t times = 0;
  std::string title, means, action;  ///< from summary_of_message
  std::vector<MessagePlace> places;
  std::vector<std::size_t> findings;  ///< with this message, about other entities
};

/// A penetration of the deck.
struct ComparedPair {
  NamedPenetration pair;
  bool listed = false;
  std::optional<double> listed_depth;
};

struct ComparedContact {
  std::uint32_t contact = 0;              ///< in the scene
  const ListedContact* listed = nullptr;  ///< nullptr: not in the listing
  std::vector<ComparedPair> pairs;        ///< deepest first
  std::vector<ListedPair> only_listed;    ///< pairs only in the listing
  std::uint64_t listed_count = 0;         ///< of the message, else number of pairs
  bool by_pair = false;                   ///< the listing has the pairs
  double largest_difference = 0;          ///< of depths, relative to the gap
  /// True for equal numbers, and equal pairs if listed.
  bool agrees() const;
};

struct StepDifference {
  std::int64_t id = 0;
  double listed = 0, computed = 0;  ///< computed NaN: no such step in the deck
};

struct ComparedSteps {
  std::optional<ElementKind> kind;  ///< nullopt: nodes
  std::uint64_t listed = 0, equal = 0, not_computed = 0;
  double smallest = 0;  ///< of the listing
  std::int64_t smallest_id = 0;
  double largest_difference = 0;  ///< relative, of equal ones
  std::vector<StepDifference> different;
};
/// "shell4", "node"
std::string_view listed_kind(const ComparedSteps& steps);

/// Steps within this relative difference are equal.
inline constexpr double step_tolerance = 1e-6;

struct ListingReport {
  std::vector<MessageGroup> messages;  ///< errors first, then warnings; by number
  std::vector<ComparedContact> contacts;
  std::vector<ComparedSteps> steps;
  std::vector<Finding> findings;  ///< of lint
  /// Findings with an error or warning of the solver that the listing lacks.
  std::vector<std::size_t> not_listed;
  std::uint64_t unnamed_contacts = 0;  ///< contacts only in the listing
  bool agrees() const;
};

/// Explains the messages only, without deck.
ListingReport explain_listing(const Listing& listing);
/// Compares with the deck; makes its scene and lints it with contacts. Refers to `listing`.
ListingReport compare_listing(const Listing& listing, LoadedDeck& loaded);

struct ListingTextOptions {
  bool color = false;
  std::size_t width = 0;  ///< columns of a line; 0: any
  std::size_t worst = 3;  ///< deepest penetrations per contact
  bool verbose = false;   ///< every place and finding; else the first of many
};

/// `loaded` may be nullptr: messages only.
std::string listing_text(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded, const ListingTextOptions& options = {});
/// The document of `deck explain NAME_0000.out --json` (schemas/output/explain.schema.json).
std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded);

}  // namespace deck
