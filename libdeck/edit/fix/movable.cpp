// Builds the model whose nodes a strategy moves.
#include "edit/fix/movable.hpp"

namespace deck::detail {

MovableDeck::MovableDeck(const LoadedDeck& context, const MoveNodesOptions& options)
    : context_(context), options_(options), cells_(context) {
  ModelOptions build;
  build.threads = options.threads;
  build.limits = context.options().read.limits;
  Diagnostics unused;
  model_ = build_model(context.deck(), context.schemas(), unused, build);
  interfaces_ = read_interfaces(context.deck(), model_, unused);
  start_ = {model_.nodes.x, model_.nodes.y, model_.nodes.z};
  now_ = start_;
}

}  // namespace deck::detail
