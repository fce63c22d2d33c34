// A listing of the Starter (NAME_0000.out) as data: messages, contacts with initial penetrations,
// tables of time steps. report/shared/inspection.hpp compares it with its deck.
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

/// An entity in a message: "INTERFACE", 3.
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
  std::array<std::int64_t, 4> main{};       ///< all 0: segment not listed
  bool on_segment = false;                  ///< exactly: no depth is listed
  std::optional<double> depth;              ///< printed at printout level 5
};

/// A contact in the last pass of the Starter.
struct ListedContact {
  std::int64_t interface = 0;  ///< 0: part of a TYPE19 without header and message
  int type = 0;                ///< 7, 10, 11, 19 ...; 0: no header
  std::size_t line = 0;
  std::vector<ListedPair> pairs;
  /// From its message (a TYPE25 has one for nodes and one for edges); nullopt: no message.
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
  int printout = 0;  ///< /IOFLAG Ipri: >= 1 lists pairs, >= 5 lists depths
  std::vector<ListedMessage> messages;
  std::vector<ListedContact> contacts;  ///< in the order of work
  std::map<ElementKind, std::vector<ListedStep>> element_steps;
  std::vector<ListedStep> node_steps;
  std::optional<std::uint64_t> errors, warnings;  ///< from its last lines; else nullopt
  std::optional<std::uint64_t> nodes;             ///< of the model
};

/// Error: no file, or not a listing of the Starter. Reads gzip, too.
Result<Listing> read_listing(const std::string& path, const Limits& limits);
/// read_listing for text in memory.
Result<Listing> read_listing_text(const std::string& path, std::string_view text);

}  // namespace deck
