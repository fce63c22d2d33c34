// Evaluates the deck before and after, and hands both to the report.
#include "writing/fix_page.hpp"

#include "deck/contact/crossings.hpp"
#include "deck/report/gaps.hpp"
#include "deck/report/json.hpp"
#include "writing/gap_page.hpp"

namespace deck::cli {

Result<std::string> fix_page(const LoadedDeck& before, const SchemaSet& schemas,
                             const ChangedFiles& changed, const CommonOptions& options) {
  SceneOptions scene_options;
  scene_options.threads = options.thread_count();
  scene_options.limits = options.limits;
  scene_options.nodal_stiffness = true;
  Diagnostics unused;
  std::string was;
  {
    const Scene scene = build_scene(before.model(), before.interfaces(), unused, scene_options);
    const std::vector<Crossing> crossings = find_crossings(scene, scene_options.threads);
    was = gaps_json(before.path(), before.deck(), scene, make_view(scene, &crossings), false);
  }
  const auto earlier = read_earlier_gaps("as it was", was, before.path());
  if (!earlier) return earlier.error();
  Overlay overlay(changed.begin(), changed.end());
  const std::string& main = before.deck().sources[0].path();
  overlay.try_emplace(main, before.deck().sources[0].bytes());  // standard input is no file
  ReadOptions read;
  read.include_paths = options.include_paths;
  read.overlay = &overlay;
  auto deck = read_deck(main, schemas, read);
  if (!deck) return deck.error();
  ModelOptions build;
  build.threads = scene_options.threads;
  const Model model = build_model(*deck, schemas, unused, build);
  const Interfaces interfaces = read_interfaces(*deck, model, unused);
  const Scene scene = build_scene(model, interfaces, unused, scene_options);
  HtmlInput input;
  input.path = before.path();
  input.deck = &*deck;
  input.scene = &scene;
  input.earlier = &*earlier;
  input.threads = scene_options.threads;
  return gap_page(input);
}

}  // namespace deck::cli
