// Finishes contacts side by side: what they share is formed first, findings are kept apart.
#include "contact/scene/finish.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/shared/parallel.hpp"
#include "base/shared/side_by_side.hpp"

namespace deck::detail {
namespace {

/// The last node of the items that has no place; no_index: all have one.
template <class Items, class EachNodeOf>
NodeIndex last_lost(const Coordinates& x, int threads, const Items& items,
                    const EachNodeOf& each_node_of) {
  std::vector<NodeIndex> parts(pieces_of(threads, items.size()), no_index);
  parallel_pieces(threads, items.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    NodeIndex lost = no_index;
    for (std::size_t i = begin; i < end; ++i)
      each_node_of(items[i], [&](NodeIndex n) {
        if (!std::isfinite(x.x[n]) || !std::isfinite(x.y[n]) || !std::isfinite(x.z[n])) lost = n;
      });
    parts[part] = lost;
  });
  NodeIndex last = no_index;
  for (const NodeIndex n : parts)
    if (n != no_index) last = n;
  return last;
}

/// The largest gap shows none that is not a number.
bool gaps_are_finite(const Contact& c) {
  const auto finite = [](const auto& list) {
    return std::all_of(list.begin(), list.end(),
                       [](const auto& item) { return std::isfinite(item.gap); });
  };
  return std::isfinite(c.max_gap) && std::isfinite(c.gapmin) && finite(c.secondary) &&
         finite(c.main) && finite(c.secondary_edges) && finite(c.main_edges);
}

}  // namespace

Obstacle obstacle_to(const SceneContext& c, const NotEvaluated& not_evaluated,
                     const std::string& card_reason, bool complete, Contact& contact) {
  contact.evaluated = false;
  const std::string why =
      card_reason.empty() ? not_evaluated.reason_in_nodes(contact) : card_reason;
  if (!why.empty()) return {why, Severity::warning, true};
  NodeIndex lost = no_index;
  const auto look = [&](const auto& items, const auto& each_node_of) {
    const NodeIndex last =
        last_lost(c.scene.coordinates, effective_threads(c.options.threads), items, each_node_of);
    if (last != no_index) lost = last;
  };
  if (!c.all_placed) {
    look(contact.secondary, [](const SecondaryNode& s, const auto& f) { f(s.node); });
    look(contact.main, [](const MainSegment& m, const auto& f) {
      for (const NodeIndex n : m.nodes) f(n);
    });
    for (const auto* edges : {&contact.secondary_edges, &contact.main_edges})
      look(*edges, [](const ContactEdge& e, const auto& f) {
        for (const NodeIndex n : e.nodes) f(n);
      });
  }
  if (lost != no_index)
    return {"node " + std::to_string(c.model.nodes.id[lost]) +
            " has a coordinate that is not a finite number"};
  if (std::string cell = unusable_cell(*c.model.deck, *contact.inter); !cell.empty())
    return {std::move(cell), Severity::error, true};
  if (!gaps_are_finite(contact)) return {"the gap is not a finite number"};
  contact.evaluated = complete;
  return {};
}

namespace {

void finish_nodes(SceneContext& c, const NotEvaluated& not_evaluated, OpenContact& open,
                  Contact& contact) {
  if (open.surface) make_main_segments(c, open.surface->segments, contact);
  set_main_stiffness(c, contact);
  set_gaps(c, contact, open.gapmin);
  contact.drad =
      radiation_distance(open.thermal, open.drad, contact.max_gap, contact.shortest_side);
  if (c.options.penetrations) {
    open.obstacle = obstacle_to(c, not_evaluated, open.card_reason, open.complete, contact);
    if (contact.evaluated) find_penetrations(c, contact, open.decisions);
  }
  report_one_place(c, contact);
  if (c.options.nodal_stiffness && contact.istf >= 2) set_nodal_stiffness(c, contact);
}

void finish_edges(SceneContext& c, const NotEvaluated& not_evaluated, OpenContact& open,
                  Contact& contact) {
  set_edge_stiffness(c, contact.main_edges, contact);
  set_edge_stiffness(c, contact.secondary_edges, contact);
  set_edge_gaps(c, contact, open.gapmin);
  contact.drad =
      radiation_distance(open.thermal, open.drad, contact.max_gap, contact.shortest_side);
  if (c.options.penetrations) {
    open.obstacle = obstacle_to(c, not_evaluated, open.card_reason, open.complete, contact);
    if (contact.evaluated) find_edge_penetrations(c, contact, open.decisions);
  }
  report_one_place(c, contact);
}

constexpr ElementKind lines[] = {ElementKind::truss, ElementKind::beam, ElementKind::spring};
constexpr ElementKind areas[] = {ElementKind::solid8, ElementKind::shell4, ElementKind::shell3};

/// What contacts look up in common. It is formed before several threads read it.
struct Common {
  std::array<bool, 8> families{};
  bool half_thickness = false, nodal_stiffness = false;

  static Common all(const SceneOptions& options) {
    Common out;
    out.want(lines);
    out.want(areas);
    out.half_thickness = true;
    out.nodal_stiffness = options.nodal_stiffness;
    return out;
  }
  void want(std::span<const ElementKind> some) {
    for (const ElementKind kind : some) families[static_cast<std::size_t>(kind)] = true;
  }
  void want_for(const SceneOptions& options, const OpenContact& open, const Contact& contact) {
    const bool edges = contact.kind == ContactKind::edge_edge;
    if (edges || (open.surface && !open.surface->segments.held_by_elements())) want(areas);
    if (edges || contact.igap != 0) want(lines);
    half_thickness |= !edges && contact.igap != 0 && !contact.secondary.empty();
    if (edges || !options.nodal_stiffness || contact.istf < 2) return;
    want(lines);
    want(std::span(areas).first(1));
    nodal_stiffness = true;
  }
  void prepare(SceneContext& c, int threads) const {
    parallel_items(threads, families.size(), [&](std::size_t kind) {
      if (families[kind]) c.connectivity.prepare(static_cast<ElementKind>(kind));
    });
    if (half_thickness)
      shell_half_thickness({c.model, c.connectivity, *c.shells, c.scene.coordinates, threads});
    if (nodal_stiffness) shell_stiffness_at_nodes(c);
  }
};

std::size_t elements_of(const Model& model) {
  std::size_t count = 0;
  for (const ElementKind kind : lines) count += model.family(kind).size();
  for (const ElementKind kind : areas) count += model.family(kind).size();
  return count;
}

}  // namespace

Finisher::Finisher(SceneContext& context, const NotEvaluated& not_evaluated, Conclude conclude,
                   Progress progress)
    : c_(context),
      not_evaluated_(not_evaluated),
      conclude_(std::move(conclude)),
      progress_(std::move(progress)),
      alone_(context.options),
      threads_(effective_threads(context.options.threads)) {
  alone_.threads = 1;
}

void Finisher::run(const std::function<void()>& select) {
  // Beyond this the common part costs memory, and contacts are worth all threads.
  constexpr std::size_t most_elements = 500000;
  helped_ = threads_ > 1 && elements_of(c_.model) <= most_elements;
  if (!helped_) {
    select();
    finish_all();
    return;
  }
  Common::all(c_.options).prepare(c_, threads_);
  CancelFlag cancel;
  run_workers(threads_, cancel, [&](std::size_t worker) {
    if (worker > 0) return help();
    try {
      select();
      close();
      finish_all();
    } catch (...) {
      close();
      throw;
    }
  });
}

void Finisher::add(OpenContact open) {
  const Contact& contact = c_.scene.contacts[open.place];
  const std::size_t size = (open.surface ? open.surface->segments.size() : 0) +
                           contact.secondary.size() + contact.secondary_edges.size() +
                           contact.main_edges.size();
  {
    const std::lock_guard lock(mutex_);
    entries_.push_back({std::move(open), size});
  }
  changed_.notify_all();
  if (threads_ == 1) finish_all();
}

void Finisher::finish(Entry& entry, const SceneOptions& options) {
  SceneContext own{c_.model, c_.connectivity, c_.scene,     entry.open.found,
                   options,  c_.shells,       c_.all_placed};
  Contact& contact = c_.scene.contacts[entry.open.place];
  const auto finish = contact.kind == ContactKind::edge_edge ? finish_edges : finish_nodes;
  finish(own, not_evaluated_, entry.open, contact);
}

/// Takes small contacts until no more come.
void Finisher::help() {
  constexpr std::size_t small = 8192;
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto next = std::find_if(entries_.begin(), entries_.end(),
                                   [](const Entry& e) { return !e.taken && e.size < small; });
    if (closed_) return;
    if (next == entries_.end()) {
      changed_.wait(lock);
      continue;
    }
    next->taken = true;
    ++busy_;
    Entry& entry = *next;
    lock.unlock();
    const auto done = [&] {
      lock.lock();
      --busy_;
      changed_.notify_all();
    };
    try {
      finish(entry, alone_);
    } catch (...) {
      done();
      throw;
    }
    done();
  }
}

void Finisher::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

void Finisher::finish_all() {
  std::vector<Entry*> left;
  std::vector<std::size_t> sizes;
  {
    const std::lock_guard lock(mutex_);
    for (Entry& entry : entries_) {
      if (std::exchange(entry.taken, true)) continue;
      left.push_back(&entry);
      sizes.push_back(entry.size);
    }
  }
  if (!helped_ && left.size() > 1) {
    Common common;
    for (const Entry* e : left)
      common.want_for(c_.options, e->open, c_.scene.contacts[e->open.place]);
    common.prepare(c_, threads_);
  }
  std::atomic<std::size_t> finished{entries_.size() - left.size()};
  side_by_side(threads_, sizes, [&](std::size_t i, const Share& share) {
    finish(*left[i], share.threads > 1 ? c_.options : alone_);
    const std::size_t so_far = ++finished;
    if (share.worker == 0 && so_far < entries_.size()) progress_(so_far);
  });
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return busy_ == 0; });
  for (Entry& entry : entries_) conclude_(entry.open);
  entries_.clear();
}

}  // namespace deck::detail
