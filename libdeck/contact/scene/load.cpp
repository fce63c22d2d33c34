// Loads a deck as most programs want it: text, model and interfaces in one owner.
#include "deck/deck.hpp"

#include "deck/model/selection.hpp"

namespace deck {

/// In the order of life: each refers to those above it.
struct LoadedDeck::Parts {
  explicit Parts(Deck&& read) : deck(std::move(read)) {}
  std::string path;
  LoadOptions options;
  Deck deck;
  Diagnostics findings;
  Model model;
  Interfaces interfaces;
};

LoadedDeck::LoadedDeck(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LoadedDeck::LoadedDeck(LoadedDeck&&) noexcept = default;
LoadedDeck& LoadedDeck::operator=(LoadedDeck&&) noexcept = default;
LoadedDeck::~LoadedDeck() = default;

const std::string& LoadedDeck::path() const { return parts_->path; }
const LoadOptions& LoadedDeck::options() const { return parts_->options; }
const SchemaSet& LoadedDeck::schemas() const {
  return parts_->options.schemas != nullptr ? *parts_->options.schemas : SchemaSet::built_in();
}
const Deck& LoadedDeck::deck() const { return parts_->deck; }
Deck& LoadedDeck::deck() { return parts_->deck; }
const Model& LoadedDeck::model() const { return parts_->model; }
const Interfaces& LoadedDeck::interfaces() const { return parts_->interfaces; }
const Diagnostics& LoadedDeck::findings() const { return parts_->findings; }

Scene LoadedDeck::scene(Diagnostics& findings, const SceneOptions& options) const {
  return build_scene(parts_->model, parts_->interfaces, findings, options);
}

Scene LoadedDeck::scene() const {
  Diagnostics unused;
  SceneOptions options;
  options.threads = parts_->options.threads;
  options.limits = parts_->options.read.limits;
  return scene(unused, options);
}

Result<LoadedDeck> load(const std::string& path, const LoadOptions& options) {
  const SchemaSet& schemas = options.schemas != nullptr ? *options.schemas : SchemaSet::built_in();
  auto deck = read_deck(path, schemas, options.read);
  if (!deck) return deck.error();
  auto parts = std::make_unique<LoadedDeck::Parts>(std::move(*deck));
  parts->path = path;
  parts->options = options;
  parts->findings = Diagnostics(options.read.limits.diagnostics_per_rule);
  parts->model =
      build_model(parts->deck, schemas, parts->findings, {options.threads, options.read.limits});
  if (parts->model.selections != nullptr) parts->model.selections->set_limits(options.read.limits);
  parts->interfaces = read_interfaces(parts->deck, parts->model, parts->findings);
  if (options.geometry && waits_for_geometry(parts->interfaces)) {
    SceneOptions scene;
    scene.threads = options.threads;
    scene.limits = options.read.limits;
    scene.candidates = scene.penetrations = false;
    resolve(parts->interfaces,
            build_scene(parts->model, parts->interfaces, parts->findings, scene));
  }
  return LoadedDeck(std::move(parts));
}

}  // namespace deck
