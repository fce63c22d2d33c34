// Selections: node groups, surfaces, lines, element groups, boxes and sets, resolved on demand to
// nodes, segments and edges exactly as the reference solver orders them.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deck/base/limits.hpp"
#include "deck/model/model.hpp"

namespace deck {

class Selections {
 public:
  /// Collects the definitions of `model`'s deck; nothing is resolved yet. The model must stay at
  /// its address (build_model's own selections follow their model when it is moved).
  Selections(const Model& model, const SchemaSet& schemas, const Limits& limits = {});
  /// For what is resolved from now on.
  void set_limits(const Limits& limits);
  /// False: members were left out because the results would need more than
  /// Limits::selection_bytes (DK332).
  bool complete() const;
  ~Selections();
  Selections(const Selections&) = delete;
  Selections& operator=(const Selections&) = delete;

  /// Group / surface / line of that id; if there is none, the projection of the set of that id.
  /// nullptr: the id names nothing. Results are kept. Not thread safe.
  const NodeSet* node_group(std::int64_t id);
  const Surface* surface(std::int64_t id);
  const LineSet* line(std::int64_t id);
  const SetGeneral* set(std::int64_t id);
  /// Elements of an element group: kind is "grshel", "grsh3n", "grbric", "grquad", "grtria",
  /// "grtrus", "grbeam" or "grspri"; indices in group order.
  const std::vector<std::uint32_t>* element_group(std::string_view kind, std::int64_t id);
  /// Parts of a /GRPART, or of the set of that id; indices into Model::parts, ascending.
  const std::vector<std::uint32_t>* part_group(std::int64_t id);
  /// True if the id is that of a plain /GRNOD, /SURF, /LINE (not a set).
  bool is_plain(std::string_view kind, std::int64_t id) const;
  /// Definition of an id, for "defined here" notes: kind is "grnod", "surf", "line", "set", "box",
  /// ...
  std::optional<Span> where(std::string_view kind, std::int64_t id) const;
  /// All ids of a kind in order of definition.
  std::vector<std::int64_t> ids(std::string_view kind) const;

  /// Edges of a surface as /LINE/SURF (all) or /LINE/EDGE (free) would give them.
  std::vector<Edge> edges_of(const std::vector<Segment>& segments, bool free_only) const;
  /// Nodes of a surface, unique, in the reference solver's internal order: ascending ids.
  std::vector<NodeIndex> nodes_of(const std::vector<Segment>& segments) const;

  /// Resolves everything that is defined, so that diagnostics() is complete.
  void resolve_all();
  /// Findings so far (missing members, recursion, empty results: rules DK1xx).
  Diagnostics& diagnostics();

  /// For Model: the model has moved to this address.
  void rebind(const Model& model);

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace deck
