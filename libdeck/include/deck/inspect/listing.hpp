// A listing of the reference Starter (NAME_0000.out) read back: its messages, the contacts with
// their initial penetrations and the tables of time steps; and the same beside its deck.
//
//   const auto listing = deck::read_listing("car_0000.out", {});
//   const auto loaded = deck::load("car_0000.rad");
//   const deck::ListingReport report = deck::compare_listing(*listing, *loaded);
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/contact/view.hpp"
#include "deck/front/loaded_deck.hpp"
#include "deck/text/diagnostic.hpp"
#include "deck/text/result.hpp"

namespace deck {

/// What a message names: "INTERFACE", 3.
struct ListedId {
  std::string kind;
  std::int64_t id = 0;
  std::string title;
};

/// One message block.
struct ListedMessage {
  int number = 0;
  Severity severity = Severity::error;
  std::size_t line = 0;  ///< of the listing, from 1
  std::vector<ListedId> ids;
  std::vector<std::int64_t> nodes;
  std::optional<std::uint64_t> count;  ///< "THERE ARE 378 ..."
};

/// A pair of a node and a segment (triangles repeat the last node), or of two edges.
struct ListedPair {
  std::array<std::int64_t, 2> secondary{};  ///< second one 0: a node
  std::array<std::int64_t, 4> main{};       ///< all 0: the listing does not show the segment
  bool on_segment = false;                  ///< exactly: no depth is listed
  std::optional<double> depth;              ///< printed at printout level 5
};

/// One contact as the last pass of the Starter has worked on it.
struct ListedContact {
  std::int64_t interface = 0;  ///< 0: a part of a TYPE19 without a header and without a message
  int type = 0;                ///< 7, 10, 11, 19 ...; 0: no header
  std::size_t line = 0;
  std::vector<ListedPair> pairs;
  std::optional<std::uint64_t> total;  ///< of message 343 or 499; nullopt: no message
  std::size_t total_line = 0;
};

/// A row of a table of time steps.
struct ListedStep {
  std::int64_t id = 0;
  double dt = 0;
};

struct Listing {
  std::string path;
  int printout = 0;  ///< /IOFLAG Ipri: from 1 on pairs are listed, from 5 on with depths
  std::vector<ListedMessage> messages;
  std::vector<ListedContact> contacts;  ///< in the order of work
  std::map<ElementKind, std::vector<ListedStep>> element_steps;
  std::vector<ListedStep> node_steps;
  std::optional<std::uint64_t> errors, warnings;  ///< as its end says; nullopt: it has no end
};

/// Error: no file, or no listing of the Starter. Also packed with gzip.
Result<Listing> read_listing(const std::string& path, const Limits& limits);
/// The same of text in memory.
Result<Listing> read_listing_text(const std::string& path, std::string_view text);

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

/// Steps that differ by less than this share are equal.
inline constexpr double step_tolerance = 1e-6;

struct ListingReport {
  std::vector<MessageGroup> messages;  ///< errors first, then warnings; by number
  std::vector<ComparedContact> contacts;
  std::vector<ComparedSteps> steps;
  std::vector<Diagnostic> findings;  ///< of deck lint
  /// Findings about an error or a warning of the solver that the listing does not have.
  std::vector<std::size_t> not_listed;
  std::uint64_t unnamed_contacts = 0;  ///< contacts of the listing that the deck does not have
  bool agrees() const;
};

/// The messages alone, explained: where there is no deck.
ListingReport explain_listing(const Listing& listing);
/// Beside the deck. Makes its scene, and lints it with its contacts. References into `listing`.
ListingReport compare_listing(const Listing& listing, LoadedDeck& loaded);

}  // namespace deck
