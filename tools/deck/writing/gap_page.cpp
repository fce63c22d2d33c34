// Adds crossings and forces to a scene and hands it to the report.
#include "writing/gap_page.hpp"

#include "deck/contact/crossings.hpp"
#include "deck/contact/view.hpp"
#include "deck/cycle/scene_cycle.hpp"

namespace deck::cli {

Result<std::string> gap_page(HtmlInput input, const std::atomic<bool>* stop) {
  const std::vector<Crossing> crossings = find_crossings(*input.scene, input.threads);
  const SceneView view = make_view(*input.scene, &crossings);
  cycle::CycleOptions options;
  options.threads = input.threads;
  options.keep_pairs = true;
  const cycle::SceneOutcome forces =
      cycle::run_cycle(*input.scene, cycle::make_state(*input.scene), options);
  if (stop != nullptr && *stop) return Error{Error::Code::config, "cancelled"};
  input.view = &view;
  input.cycle = &forces;
  input.crossings = &crossings;
  return gaps_html(input);
}

}  // namespace deck::cli
