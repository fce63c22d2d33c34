// Adds crossings and forces to the scene of a deck and hands it to the report.
#include "verbs/gap_page.hpp"

#include "deck/contact/crossings.hpp"

namespace deck::cli {

Result<std::string> gap_page(LoadedDeck& loaded, HtmlInput input, const std::atomic<bool>* stop) {
  const SceneOptions made = loaded.scene_options();
  if (!made.ties || !made.candidates || !made.nodal_stiffness) {
    SceneOptions all = made;
    all.ties = all.candidates = all.nodal_stiffness = true;
    loaded.set_scene_options(all);
  }
  loaded.findings();  // the page says where the solver stops before its contacts
  const Scene& scene = loaded.scene();
  if (input.path.empty()) input.path = loaded.path();
  input.deck = &loaded.deck();
  input.scene = &scene;
  input.what_if = loaded.scene_options().what_if;
  input.only = loaded.scene_options().only;
  input.threads = loaded.options().threads;
  const std::vector<Crossing> crossings = find_crossings(scene, input.threads);
  const SceneView view = make_view(scene, &crossings);
  const FirstCycle& forces = loaded.cycle();
  if (stop != nullptr && *stop) return Error{Error::Code::config, "cancelled"};
  input.view = &view;
  input.cycle = &forces.outcome;
  input.acted = acted_in_page(forces.state, forces.outcome);
  input.crossings = &crossings;
  return gaps_html(input);
}

}  // namespace deck::cli
