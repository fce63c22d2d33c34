// Builds each stage of a deck on first use, within the limits of loading.
#include "deck/loaded_deck.hpp"

#include <optional>
#include <utility>

#include "contact/shared/scene_steps.hpp"
#include "contact/shared/tie_steps.hpp"
#include "cycle/shared/contact_run.hpp"
#include "deck/rule_id.hpp"
#include "front/findings.hpp"
#include "model/shared/kinematics.hpp"
#include "model/shared/mesh.hpp"

namespace deck {

/// In the order of construction: each member refers to earlier ones.
struct LoadedDeck::Parts {
  Parts(Deck&& read, LoadOptions how)
      : options(std::move(how)),
        schemas(options.schemas != nullptr ? *options.schemas : SchemaSet::built_in()),
        deck(std::move(read)),
        found(deck.findings, options.read.limits.findings_per_rule) {
    options.read.overlay = nullptr;  // only valid during reading
    path = deck.sources.size() > 0 ? deck.sources[0].path() : "";
    scene_options.threads = options.threads;
    scene_options.limits = options.read.limits;
    scene_options.nodal_stiffness = true;
  }

  void begin(Stage stage) const {
    if (observer) observer(stage);
  }
  const EngineFiles& the_engine() {
    return engine ? *engine : engine.emplace(read_engine_files(deck, options.read.limits));
  }
  const Model& the_model();
  Interfaces& cards();
  const Interfaces& values();
  const Scene& the_scene();
  const Scene& mesh_values(const Progress& progress);
  const std::vector<Tie>& the_ties();
  const std::vector<TiedNodes>& tied_nodes();
  const FirstCycle& the_cycle();
  const Mesh& the_mesh();
  void find(Stage until);
  Scene build(const SceneOptions& wanted, Findings& to) {
    return build_scene(the_model(), cards(), to, wanted);
  }
  /// Builds `scene`; reuses ties found earlier.
  Scene build_whole(Findings& to);
  /// True if the scene has the first contact of each interface, with the values of the deck.
  bool has_values() const {
    return scene && scene_options.only.empty() && scene_options.what_if.empty();
  }

  std::string path;
  LoadOptions options;
  const SchemaSet& schemas;
  std::function<void(Stage)> observer;
  Deck deck;
  detail::FindingLists found;
  std::optional<EngineFiles> engine;
  std::optional<Model> model;
  std::optional<Interfaces> interfaces;
  bool joined = false;    ///< Deck::findings has all findings
  bool resolved = false;  ///< the interfaces have the values from the mesh
  SceneOptions scene_options;
  std::optional<Scene> mesh, scene, cycle_scene;  ///< cycle_scene: only if `scene` cannot be used
  std::optional<std::vector<Tie>> ties, early;    ///< not in `scene`; found before it
  std::optional<std::vector<TiedNodes>> tied;     ///< of all interfaces
  std::optional<FirstCycle> cycle;
  std::optional<Mesh> elements;
  std::optional<Kinematics> kinematics;
};

const Model& LoadedDeck::Parts::the_model() {
  if (!model) {
    begin(Stage::model);
    model =
        build_model(deck, schemas, found.of(Stage::model), {options.threads, options.read.limits});
  }
  return *model;
}

Interfaces& LoadedDeck::Parts::cards() {
  if (!interfaces) {
    const Model& of = the_model();
    begin(Stage::interfaces);
    interfaces = read_interfaces(deck, of, found.of(Stage::interfaces));
  }
  return *interfaces;
}

const Scene& LoadedDeck::Parts::the_scene() {
  if (!scene) {
    cards();
    begin(Stage::scene);
    mesh.reset();
    scene = build_whole(found.of(Stage::scene));
    scene_options.progress = nullptr;  // its caller may no longer exist when another scene is built
  }
  return *scene;
}

Scene LoadedDeck::Parts::build_whole(Findings& to) {
  SceneOptions wanted = scene_options;
  // Ties do not depend on contacts that do not move nodes.
  const bool reuses_ties = early && wanted.ties && wanted.only.empty() && wanted.what_if.empty() &&
                           !detail::moves_nodes(cards());
  wanted.ties = wanted.ties && !reuses_ties;
  Scene out = build(wanted, to);
  if (!reuses_ties) return out;
  out.ties = std::move(*early);
  out.examined = Examined::contacts_and_ties;
  early.reset();
  return out;
}

const Scene& LoadedDeck::Parts::mesh_values(const Progress& progress) {
  if (!has_values() && !mesh) {
    mesh.emplace();
    if (waits_for_geometry(cards())) {
      SceneOptions sides;
      sides.threads = options.threads;
      sides.limits = options.read.limits;
      sides.candidates = sides.penetrations = false;
      sides.progress = progress;
      mesh = build(sides, found.of_mesh());
    }
  }
  const Scene& values = has_values() ? *scene : *mesh;
  if (!std::exchange(resolved, true) && waits_for_geometry(cards())) resolve(cards(), values);
  return values;
}

const std::vector<Tie>& LoadedDeck::Parts::the_ties() {
  const Scene& of = the_scene();
  if (scene_options.ties) return of.ties;
  if (!ties) ties = detail::ties_of(of, scene_options);
  return *ties;
}

/// Ties of all interfaces, independent of SceneOptions::only. Without contacts if none moves nodes.
const std::vector<TiedNodes>& LoadedDeck::Parts::tied_nodes() {
  if (tied) return *tied;
  tied.emplace();
  if (cards().type2.empty()) return *tied;
  const auto add_ties = [&](const std::vector<Tie>& list) {
    for (const Tie& tie : list) tied->push_back(detail::tied_nodes_of(tie));
  };
  if (scene && scene_options.ties && scene_options.only.empty()) {
    add_ties(scene->ties);
    return *tied;
  }
  SceneOptions all = scene_options;
  all.only.clear();
  all.progress = nullptr;
  Scene places;
  const Scene* of = &places;
  if (scene || detail::moves_nodes(cards())) {
    of = &the_scene();
  } else {
    places.model = &the_model();
    places.interfaces = &cards();
    places.coordinates = {the_model().nodes.x, the_model().nodes.y, the_model().nodes.z};
  }
  std::vector<Tie> list = detail::ties_of(*of, all);
  add_ties(list);
  if (!scene) early = std::move(list);
  return *tied;
}

const FirstCycle& LoadedDeck::Parts::the_cycle() {
  if (cycle) return *cycle;
  const Scene* of = &the_scene();
  if (!scene_options.nodal_stiffness || !scene_options.penetrations) {
    SceneOptions wanted = scene_options;
    wanted.nodal_stiffness = wanted.penetrations = true;
    Findings known;  // scene() has reported these
    of = &cycle_scene.emplace(build(wanted, known));
  }
  cycle::CycleOptions how;
  how.threads = options.threads;
  how.keep_pairs = true;
  FirstCycle out{cycle::make_state(*of, {}, &the_engine(), options.threads), {}};
  out.outcome = cycle::run_cycle(*of, out.state, how);
  return cycle.emplace(std::move(out));
}

const Mesh& LoadedDeck::Parts::the_mesh() {
  if (elements) return *elements;
  MeshOptions how;
  how.threads = options.threads;
  how.engine = &the_engine();
  const Model& of = the_model();
  if (detail::moves_nodes(cards())) how.coordinates = &the_scene().coordinates;
  how.ties = &tied_nodes();
  return elements.emplace(make_mesh(of, how));
}

const Interfaces& LoadedDeck::Parts::values() {
  cards();
  if (options.geometry && !resolved) {
    const bool kept = mesh.has_value();
    mesh_values({});
    if (!kept) mesh.reset();
  }
  return *interfaces;
}

void LoadedDeck::Parts::find(Stage until) {
  if (until >= Stage::model) the_model();
  if (until >= Stage::interfaces) cards();
  if (until >= Stage::cells) {
    values();
    if (found.wants_cells()) {
      begin(Stage::cells);
      found.read_cells(deck, options.threads);
    }
  }
}

LoadedDeck::LoadedDeck(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LoadedDeck::LoadedDeck(LoadedDeck&&) noexcept = default;
LoadedDeck& LoadedDeck::operator=(LoadedDeck&&) noexcept = default;
LoadedDeck::~LoadedDeck() = default;

LoadedDeck LoadedDeck::from(Deck&& deck, const LoadOptions& options) {
  LoadedDeck out(std::make_unique<Parts>(std::move(deck), options));
  if (options.engine_files) out.engine_files();
  return out;
}

Result<LoadedDeck> LoadedDeck::with(const std::map<std::string, std::string>& changed) const {
  std::map<std::string, std::string> texts = changed;
  const SourceSet& sources = deck().sources;
  for (std::uint32_t f = 0; f < sources.size(); ++f)
    if (sources[f].inode() == 0) texts.try_emplace(sources[f].path(), sources[f].bytes());
  LoadOptions how = options();
  how.read.overlay = &texts;
  auto out = load(sources[0].path(), how);
  if (out) out->parts_->path = path();
  return out;
}

const std::string& LoadedDeck::path() const { return parts_->path; }
const SchemaSet& LoadedDeck::schemas() const { return parts_->schemas; }
const LoadOptions& LoadedDeck::options() const { return parts_->options; }
const Deck& LoadedDeck::deck() const { return parts_->deck; }
Deck& LoadedDeck::deck() { return parts_->deck; }
const Model& LoadedDeck::model() const { return parts_->the_model(); }

const EngineFiles& LoadedDeck::engine_files() const { return parts_->the_engine(); }

bool LoadedDeck::incomplete() const { return parts_->found.incomplete(); }

const Mesh& LoadedDeck::mesh() const { return parts_->the_mesh(); }

const Kinematics& LoadedDeck::kinematics() const {
  Parts& p = *parts_;
  if (!p.kinematics) p.kinematics = read_kinematics(p.the_model(), &p.tied_nodes());
  return *p.kinematics;
}

const Interfaces& LoadedDeck::interfaces() const { return parts_->values(); }

const Scene& LoadedDeck::mesh_values(const Progress& progress) const {
  return parts_->mesh_values(progress);
}

const SceneOptions& LoadedDeck::scene_options() const { return parts_->scene_options; }

void LoadedDeck::drop_scene() {
  Parts& p = *parts_;
  p.elements.reset();
  p.tied.reset();
  p.cycle.reset();
  p.cycle_scene.reset();
  p.ties.reset();
  p.early.reset();
  p.scene.reset();
  p.found.forget_scene();
  p.joined = false;
}

void LoadedDeck::set_scene_options(const SceneOptions& options) {
  drop_scene();
  parts_->scene_options = options;
}

const Scene& LoadedDeck::scene() const { return parts_->the_scene(); }
const std::vector<Tie>& LoadedDeck::ties() const { return parts_->the_ties(); }
const FirstCycle& LoadedDeck::cycle() const { return parts_->the_cycle(); }

const Findings& LoadedDeck::findings() const {
  Parts& p = *parts_;
  p.the_scene();
  if (!std::exchange(p.joined, true)) p.deck.findings = findings_with(p.found.of(Stage::scene));
  return p.deck.findings;
}

Findings LoadedDeck::findings(Stage until) const {
  if (until >= Stage::scene) return findings();
  parts_->find(until);
  return parts_->found.joined(until);
}

Findings LoadedDeck::findings_with(const Findings& of_scene) const {
  parts_->find(Stage::cells);
  return parts_->found.joined(parts_->the_model(), of_scene);
}

const Findings& LoadedDeck::found_by(Stage stage) const {
  if (stage >= Stage::scene)
    parts_->the_scene();
  else
    parts_->find(stage);
  return parts_->found.of(stage);
}

const Findings& LoadedDeck::cell_findings() const {
  parts_->find(Stage::cells);
  return parts_->found.of_all_cells();
}

void LoadedDeck::report(Finding finding) {
  parts_->found.add(std::move(finding));
  parts_->joined = false;
}

Scene LoadedDeck::scene_with(const SceneOptions& options, Findings& found) const {
  return parts_->build(options, found);
}

Stage LoadedDeck::reached() const {
  const Parts& p = *parts_;
  return p.scene                  ? Stage::scene
         : !p.found.wants_cells() ? Stage::cells
         : p.interfaces           ? Stage::interfaces
         : p.model                ? Stage::model
                                  : Stage::deck;
}

void LoadedDeck::observe(std::function<void(Stage)> observer) {
  parts_->observer = std::move(observer);
}

Result<LoadedDeck> load(const std::string& path, const LoadOptions& options) {
  const SchemaSet& schemas = options.schemas != nullptr ? *options.schemas : SchemaSet::built_in();
  auto deck = read_deck(path, schemas, options.read);
  if (!deck) return deck.error();
  LoadedDeck out = LoadedDeck::from(std::move(*deck), options);
  out.parts_->path = path;
  return out;
}

}  // namespace deck
