// Texts and documents of `deck show` and `deck diff`, and of a listing of the Starter beside its
// deck.
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

// ---- one entity with its card, figures and references -----------------------------------------

struct ParamsInput;  // report/shared/params_report.hpp

struct ShowTextOptions {
  bool color = false;
  bool all = false;       ///< every line and every user, however many
  std::size_t width = 0;  ///< columns of a line; 0: any
};

/// `params` has the same deck and, if the geometry was evaluated, the default gaps.
std::string show_text(const ParamsInput& params, const EntityView& view,
                      const ShowTextOptions& options = {});
/// The document of `deck show --json` (schemas/output/show.schema.json).
std::string show_json(const ParamsInput& params, const EntityView& view);

// ---- two decks ---------------------------------------------------------------------------------

struct DiffTextOptions {
  bool color = false;
  std::size_t rows = 20;  ///< of moved nodes, of ids and of penetrations; 0: all
  std::size_t width = 0;  ///< columns of a line; 0: any
};

/// "Equal in meaning ..." or how much of what differs.
std::string diff_verdict(const DeckDiff& diff);
std::string diff_text(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                      const DiffTextOptions& options = {});
/// For a review comment: tables of GitHub and GitLab flavour.
std::string diff_markdown(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                          const DiffTextOptions& options = {});
/// The document of `deck diff --json` (schemas/output/diff.schema.json).
std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff);

// ---- a listing ---------------------------------------------------------------------------------

/// What one kind of message is about in one place.
struct MessagePlace {
  std::string name;  ///< "interface 2 'web'", "node 105"; empty: it names nothing
  std::int64_t id = 0;
  Span span;  ///< of it in the deck; not valid: the deck has no such thing
  std::uint64_t times = 0;
  std::vector<std::uint64_t> counted;  ///< numbers that its messages show, each once
  std::vector<std::int64_t> nodes;     ///< that its messages name
  std::vector<std::size_t> lines;      ///< of the listing
  std::vector<std::size_t> findings;   ///< in ListingReport::findings: what deck says of it
};

struct MessageGroup {
  int number = 0;
  Severity severity = Severity::error;
  std::uint64_t times = 0;
  std::string title, means, action;  ///< of summary_of_message
  std::vector<MessagePlace> places;
  std::vector<std::size_t> findings;  ///< with the same message, about something else
};

/// A penetration that the deck has.
struct ComparedPair {
  NamedPenetration pair;
  bool listed = false;
  std::optional<double> listed_depth;
};

struct ComparedContact {
  std::uint32_t contact = 0;              ///< in the scene
  const ListedContact* listed = nullptr;  ///< nullptr: the listing does not work on it
  std::vector<ComparedPair> pairs;        ///< deepest first
  std::vector<ListedPair> only_listed;    ///< pairs of the listing that the deck does not have
  std::uint64_t listed_count = 0;         ///< of the message, else of the pairs
  bool by_pair = false;                   ///< the listing shows the pairs
  double largest_difference = 0;          ///< of depths, as a share of the gap
  /// Same number, and same pairs where they are shown.
  bool agrees() const;
};

struct StepDifference {
  std::int64_t id = 0;
  double listed = 0, computed = 0;  ///< computed NaN: the deck has no step of it
};

struct ComparedSteps {
  std::optional<ElementKind> kind;  ///< nullopt: nodes
  std::uint64_t listed = 0, equal = 0, not_computed = 0;
  double smallest = 0;  ///< of the listing
  std::int64_t smallest_id = 0;
  double largest_difference = 0;  ///< relative, of those that are equal
  std::vector<StepDifference> different;
};
/// "shell4", "node"
std::string_view listed_kind(const ComparedSteps& steps);

/// Steps that differ by less than this share are equal.
inline constexpr double step_tolerance = 1e-6;

struct ListingReport {
  std::vector<MessageGroup> messages;  ///< errors first, then warnings; by number
  std::vector<ComparedContact> contacts;
  std::vector<ComparedSteps> steps;
  std::vector<Finding> findings;  ///< of deck lint
  /// Findings about an error or a warning of the solver that the listing does not have.
  std::vector<std::size_t> not_listed;
  std::uint64_t unnamed_contacts = 0;  ///< contacts of the listing that the deck does not have
  bool agrees() const;
};

/// The messages alone, explained: where there is no deck.
ListingReport explain_listing(const Listing& listing);
/// Beside the deck. Makes its scene, and lints it with its contacts. References into `listing`.
ListingReport compare_listing(const Listing& listing, LoadedDeck& loaded);

struct ListingTextOptions {
  bool color = false;
  std::size_t width = 0;  ///< columns of a line; 0: any
  std::size_t worst = 3;  ///< rows of the deepest penetrations of each contact
  bool verbose = false;   ///< every place and finding; else the first of many
};

/// `loaded` may be nullptr: the messages alone.
std::string listing_text(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded, const ListingTextOptions& options = {});
/// The document of `deck explain NAME_0000.out --json` (schemas/output/explain.schema.json).
std::string listing_json(const Listing& listing, const ListingReport& report,
                         const LoadedDeck* loaded);

}  // namespace deck
