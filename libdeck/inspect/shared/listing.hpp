// A listing of the reference Starter (NAME_0000.out) read back: its messages, the contacts with
// their initial penetrations and the tables of time steps. report/shared/inspection.hpp holds it
// beside its deck.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/model.hpp"
#include "deck/text.hpp"

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
  /// Of its message (of a TYPE25 that of nodes, and that of edges); nullopt: no message.
  std::optional<std::uint64_t> total, edges;
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
  std::optional<std::uint64_t> nodes;             ///< of the model
};

/// Error: no file, or no listing of the Starter. Also packed with gzip.
Result<Listing> read_listing(const std::string& path, const Limits& limits);
/// The same of text in memory.
Result<Listing> read_listing_text(const std::string& path, std::string_view text);

}  // namespace deck
