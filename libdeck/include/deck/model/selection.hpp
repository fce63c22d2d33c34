// Selections: node groups, surfaces, lines, element groups, boxes and sets, resolved on demand to
// nodes, segments and edges exactly as the reference solver orders them.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deck/model/model.hpp"

namespace deck {

class Selections {
 public:
  /// Collects the definitions of `model`'s deck; nothing is resolved yet. The model must stay at
  /// its address.
  Selections(const Model& model, const SchemaSet& schemas);
  ~Selections();

  /// Group / surface / line of that id; if there is none, the projection of the set of that id.
  /// nullptr: the id names nothing. Results are kept. Not thread safe.
  const NodeSet* node_group(std::int64_t id);
  const Surface* surface(std::int64_t id);
  const LineSet* line(std::int64_t id);
  const SetGeneral* set(std::int64_t id);
  /// True if the id is that of a plain /GRNOD, /SURF, /LINE (not a set).
  bool is_plain(std::string_view kind, std::int64_t id) const;
  /// Definition of an id, for "defined here" notes: kind is "grnod", "surf", "line", "set", "box", ...
  std::optional<Span> where(std::string_view kind, std::int64_t id) const;
  /// All ids of a kind in order of definition.
  std::vector<std::int64_t> ids(std::string_view kind) const;

  /// Edges of a surface as /LINE/SURF (all) or /LINE/EDGE (free) would give them.
  std::vector<Edge> edges_of(const std::vector<Segment>& segments, bool free_only) const;
  /// Nodes of a surface, unique, ascending internal order.
  std::vector<NodeIndex> nodes_of(const std::vector<Segment>& segments) const;

  /// Findings so far (missing members, recursion, empty results: rules DK1xx).
  Diagnostics& diagnostics();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace deck
