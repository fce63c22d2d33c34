// Adds crossings and forces to a scene for the report, alone or compared with an earlier deck.
#include "verbs/gap_page.hpp"

#include <filesystem>
#include <utility>

#include "deck/lint.hpp"
#include "deck/report.hpp"
#include "report/shared/json.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cli {

std::string no_viewer(const std::string& html) {
  std::string why;
  if (html.empty() || html_available(&why)) return {};
  return "--html: this build has no viewer: " + why;
}

Result<void> check_html(const CommonOptions& options, const std::string& html) {
  if (const std::string why = no_viewer(html); !why.empty()) return config_error(why);
  if (!html.empty() && options.decks.size() > 1)
    return config_error("--html takes one deck at a time");
  return {};
}

HtmlInput page_input(const LoadedDeck& loaded, const SceneView& view, HtmlInput input) {
  if (input.path.empty()) input.path = loaded.path();
  input.deck = &loaded.deck();
  input.scene = &loaded.scene();
  input.view = &view;
  input.what_if = loaded.scene_options().what_if;
  input.only = loaded.scene_options().only;
  input.threads = loaded.options().threads;
  return input;
}

Result<void> write_vtk(const CommonOptions& options, const std::string& directory,
                       std::string_view deck, const std::vector<VtkFile>& vtk,
                       const std::optional<VtkFile>& script) {
  namespace fs = std::filesystem;
  fs::path place = directory;
  if (options.decks.size() > 1) place /= fs::path(without_gz(deck)).stem();
  std::vector<OutputFile> files;
  for (const VtkFile& f : vtk) files.push_back({(place / f.name).string(), f.bytes});
  if (script) files.push_back({(place / script->name).string(), script->bytes});
  return options.session->write_outputs(files, {}, {"", true, true, true, directory});
}

Result<std::string> gap_page(LoadedDeck& loaded, HtmlInput input, const std::atomic<bool>* stop) {
  const SceneOptions made = loaded.scene_options();
  if (!made.ties || !made.candidates || !made.nodal_stiffness) {
    SceneOptions all = made;
    all.ties = all.candidates = all.nodal_stiffness = true;
    loaded.set_scene_options(all);
  }
  loaded.findings();  // the page shows where the solver stops before contacts
  const Scene& scene = loaded.scene();
  const std::vector<Crossing> crossings = find_crossings(scene, loaded.options().threads);
  const SceneView view = make_view(scene, &crossings);
  const FirstCycle& forces = loaded.cycle();
  if (stop != nullptr && *stop) return config_error("cancelled");
  input = page_input(loaded, view, std::move(input));
  input.cycle = &forces.outcome;
  input.acted = acted_in_page(forces.state, forces.outcome);
  input.crossings = &crossings;
  return gaps_html(input);
}

namespace {

Result<GapBaseline> gaps_before(const LoadedDeck& before, int threads) {
  SceneOptions options = before.scene_options();
  options.ties = true;
  Findings ignored;
  const Scene scene = before.scene_with(options, ignored);
  const std::vector<Crossing> crossings = find_crossings(scene, threads);
  const std::string document =
      gaps_json(before.path(), before.deck(), scene, make_view(scene, &crossings), false);
  return read_earlier_gaps("as it was", document, before.path());
}

}  // namespace

Result<std::string> difference_page(const LoadedDeck& before, LoadedDeck& after, const char* verb,
                                    std::string_view path, std::string_view told,
                                    const std::vector<PageTrend>* trends) {
  GapBaseline named;
  named.path = "as it was";
  named.deck_path = before.path();
  const auto earlier = trends != nullptr ? Result<GapBaseline>(std::move(named))
                                         : gaps_before(before, after.options().threads);
  if (!earlier) return earlier.error();
  HtmlInput input;
  input.trends = trends;
  input.path = path;
  input.verb = verb;
  input.earlier = &*earlier;
  input.before = &before.model();
  (trends != nullptr ? input.changes : input.repair) = told;
  return gap_page(after, input);
}

Result<std::string> fix_page(const LoadedDeck& before, const ChangedFiles& changed,
                             std::string_view repair, const CommonOptions& options) {
  Overlay overlay(changed.begin(), changed.end());
  const std::string& main = before.deck().sources[0].path();
  overlay.try_emplace(main, before.deck().sources[0].bytes());  // standard input is not a file
  auto after = load(main, load_options(options, before.schemas(), &overlay));
  if (!after) return after.error();
  return difference_page(before, *after, "fix", before.path(), repair);
}

}  // namespace deck::cli
