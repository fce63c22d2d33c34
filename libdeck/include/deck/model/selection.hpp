// Selections: node groups, surfaces, lines, element groups, boxes and sets, resolved on demand to
// nodes, segments and edges exactly as the reference solver orders them.
#pragma once
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deck/model/model.hpp"
#include "deck/text/source.hpp"

namespace deck {

/// Shells of a part that follow each other, as segments of a surface.
struct ShellRun {
  ElementKind kind{};       ///< shell4 or shell3
  bool reversed = false;    ///< with their normals turned
  std::uint32_t first = 0;  ///< element of the family
  std::size_t end = 0;      ///< segments of the surface up to the last of this run
};

/// The segments of a surface in their order. Those of shells of parts follow from the elements and
/// are formed where they are looked at, others are held. Valid as long as the selections and their
/// model; may be read by several threads.
class SegmentList {
 public:
  SegmentList(const Model& model, const std::vector<Segment>& held)
      : model_(&model), held_(&held), size_(held.size()) {}
  SegmentList(const Model& model, const std::vector<ShellRun>& runs)
      : model_(&model), runs_(&runs), size_(runs.empty() ? 0 : runs.back().end) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// They are all shells, and follow from the elements.
  bool held_by_elements() const { return runs_ != nullptr; }
  /// Segments begin ... end-1; `room` is written where they are not held.
  std::span<const Segment> some(std::size_t begin, std::size_t end,
                                std::vector<Segment>& room) const;
  /// Calls f(position of the first, segments) for all of them, some at a time.
  template <class F>
  void each_piece(F&& f) const {
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin < size_; begin += piece_size) {
      const std::size_t end = std::min(size_, begin + piece_size);
      f(begin, some(begin, end, room));
    }
  }
  /// Calls f(segment) for all of them.
  template <class F>
  void each(F&& f) const {
    each_piece([&](std::size_t, std::span<const Segment> piece) {
      for (const Segment& s : piece) f(s);
    });
  }
  /// The first segment for which holds(segment); nullopt: none.
  template <class Holds>
  std::optional<Segment> find(Holds&& holds) const {
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin < size_; begin += piece_size)
      for (const Segment& s : some(begin, std::min(size_, begin + piece_size), room))
        if (holds(s)) return s;
    return std::nullopt;
  }
  static constexpr std::size_t piece_size = 4096;

 private:
  const Model* model_;
  const std::vector<Segment>* held_ = nullptr;
  const std::vector<ShellRun>* runs_ = nullptr;
  std::size_t size_;
};

/// What there is to a surface beside its segments.
struct SurfaceOutline {
  SegmentList segments;
  bool analytical = false;
};

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
  /// The same surface without holding its segments where they follow from elements; nullopt: the
  /// id names nothing.
  std::optional<SurfaceOutline> outline(std::int64_t id);
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
  std::vector<Edge> edges_of(std::span<const Segment> segments, bool free_only) const;
  /// Nodes of a surface, unique, in the reference solver's internal order: ascending ids.
  std::vector<NodeIndex> nodes_of(const SegmentList& segments) const;

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
