// The second half of every contact: segments, stiffness, gaps and penetrations, once its members
// are known. Contacts do not depend on each other there, but for nodes that Inacti 3 moves.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>

#include "contact/scene/not_evaluated.hpp"
#include "contact/shared/scene_parts.hpp"

namespace deck::detail {

/// Why a contact is not evaluated; no text: nothing is in the way, or it has been told before.
struct Obstacle {
  std::string why;
  Severity severity = Severity::error;
  bool of_interface = false;  ///< told once for all contacts of the interface
};

/// A contact of the scene whose members are selected.
struct OpenContact {
  std::size_t place = 0;  ///< in Scene::contacts
  std::optional<SurfaceOutline> surface = {};
  double gapmin = 0, drad = 0;  ///< of the card
  bool thermal = false;
  bool complete = true;          ///< no selection has left out members so far
  std::string card_reason = {};  ///< NotEvaluated::reason_in_card()

  // What came of it.
  Obstacle obstacle = {};
  Diagnostics found{std::numeric_limits<int>::max()};
  DecisionReport decisions = {};
};

/// Sets Contact::evaluated, and says what is in the way. `card_reason`, `complete`: as above.
Obstacle obstacle_to(const SceneContext& context, const NotEvaluated& not_evaluated,
                     const std::string& card_reason, bool complete, Contact& contact);

/// Finishes contacts while others are still being selected. Nothing depends on the number of
/// threads.
class Finisher {
 public:
  using Conclude = std::function<void(OpenContact&)>;
  using Progress = std::function<void(std::size_t)>;

  /// `conclude` is called for every contact that is finished, in their order; `progress` now and
  /// then with the number of those that are finished but not concluded. Both in the thread that
  /// calls the functions below.
  Finisher(SceneContext& context, const NotEvaluated& not_evaluated, Conclude conclude,
           Progress progress);

  /// Calls select(), which adds contacts, and finishes them all.
  void run(const std::function<void()>& select);
  void add(OpenContact open);
  /// Returns when all that were added are finished.
  void finish_all();

 private:
  struct Entry {
    OpenContact open;
    std::size_t size = 0;
    bool taken = false;
  };
  void finish(Entry& entry, const SceneOptions& options);
  void help();
  void close();

  SceneContext& c_;
  const NotEvaluated& not_evaluated_;
  Conclude conclude_;
  Progress progress_;
  SceneOptions alone_;  ///< those of the scene, for one thread
  int threads_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Entry> entries_;
  std::size_t busy_ = 0;  ///< threads that help with one of them
  bool helped_ = false, closed_ = false;
};

}  // namespace deck::detail
