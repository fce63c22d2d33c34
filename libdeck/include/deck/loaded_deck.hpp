// LoadedDeck: a deck and everything derived from it, built on first use and kept.
//
//   const auto loaded = deck::load("car_0000.rad");
//   if (!loaded) ...loaded.error().message
//   for (const deck::InterType7& inter : loaded->interfaces().type7) ...inter.Gapmin.value
//   for (const deck::Contact& contact : loaded->scene().contacts) ...contact.penetrations
//   for (const deck::Finding& finding : loaded->findings().all()) ...finding.message
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"

namespace deck {

struct Kinematics;  // model/shared/kinematics.hpp
struct Mesh;        // model/shared/mesh.hpp

/// Stages of building, in this order. Each stage needs all stages before it.
enum class Stage : std::uint8_t {
  deck,        ///< the text, cut into blocks
  model,       ///< nodes, elements, parts ...
  interfaces,  ///< interface cards with their defaults applied
  cells,       ///< every cell was read, except bulk data
  scene,       ///< contacts, and the groups that they are made from
};

struct LoadOptions {
  ReadOptions read;  ///< its limits also apply to model, contacts and forces
  int threads = 1;   ///< does not change results
  /// interfaces() resolves the values that follow from the mesh.
  bool geometry = true;
  bool engine_files = false;  ///< with the deck; false: at the first call of engine_files()
  const SchemaSet* schemas = nullptr;  ///< nullptr: the built-in ones; must outlive the LoadedDeck
};

/// The first force evaluation of all contacts.
struct FirstCycle {
  cycle::State state;
  cycle::SceneOutcome outcome;
};

/// A deck and what is derived from it. References stay valid for its lifetime, also after a move,
/// unless a getter says less. Not thread-safe: getters build on first use, also const ones.
class LoadedDeck {
 public:
  /// Called with (contacts done, all contacts).
  using Progress = std::function<void(std::size_t, std::size_t)>;

  /// Makes a LoadedDeck from a Deck that was read already, for example from text in memory.
  static LoadedDeck from(Deck&& deck, const LoadOptions& options = {});
  /// Reads the deck again with new texts for some files (key: path as the deck opened it) and the
  /// options of this deck. Texts of files that exist only in memory are kept.
  Result<LoadedDeck> with(const std::map<std::string, std::string>& changed) const;
  LoadedDeck(LoadedDeck&&) noexcept;
  LoadedDeck& operator=(LoadedDeck&&) noexcept;
  ~LoadedDeck();

  const std::string& path() const;  ///< as given
  const SchemaSet& schemas() const;
  const LoadOptions& options() const;
  const Limits& limits() const { return options().read.limits; }

  /// The text and its blocks. After the first call of findings(), Deck::findings has all findings.
  const Deck& deck() const;
  Deck& deck();  ///< model, interfaces and scene refer to it
  /// The Engine files beside the deck; their texts are added to the sources of the deck.
  const EngineFiles& engine_files() const;
  /// True if a file of the include tree could not be read.
  bool incomplete() const;
  const Model& model() const;
  /// Time steps, masses and stiffness of elements and nodes, and sums per part, at the node
  /// positions after Inacti 3. Valid until another scene is made.
  const Mesh& mesh() const;
  /// The kinematic conditions of all nodes, and the conditions that conflict.
  const Kinematics& kinematics() const;
  /// Effective values. With LoadOptions::geometry they include those that follow from the mesh.
  const Interfaces& interfaces() const;
  /// Builds contacts without a search of penetrations if some value depends on the mesh, else an
  /// empty scene. Side effect: interfaces() has these values afterwards. Valid until scene() is
  /// made.
  const Scene& mesh_values(const Progress& progress = {}) const;

  /// Options of scene(): threads and limits of LoadOptions, and nodal stiffness, which forces need.
  const SceneOptions& scene_options() const;
  /// Sets the options for scene(). Frees the scene, ties and cycle made before: references to them
  /// become invalid.
  void set_scene_options(const SceneOptions& options);
  /// The contacts of the deck: segments, gaps, stiffness, penetrations.
  const Scene& scene() const;
  /// The ties of every /INTER/TYPE2, node by node. They come from scene() if it was built with
  /// SceneOptions::ties; otherwise the first call finds them.
  const std::vector<Tie>& ties() const;
  /// Frees scene(), ties() and cycle(); the next call builds them again. For programs that keep
  /// many decks.
  void drop_scene();
  /// Forces of the first cycle, with every pair, at the initial velocities of the deck.
  const FirstCycle& cycle() const;

  /// All findings, each once, in this order: reading, model, interfaces, contacts, unreadable
  /// cells, groups (errors only, because they can stop the solver), and those added by report().
  /// Builds the scene. Findings of groups that are resolved later are not included. Valid until
  /// report() or another scene.
  const Findings& findings() const;
  /// findings() without the stages after `until`.
  Findings findings(Stage until) const;
  /// Findings of one stage alone.
  const Findings& found_by(Stage stage) const;
  /// Findings about the cells of all blocks except bulk data, infos included.
  const Findings& cell_findings() const;
  /// Adds a finding of the caller to findings().
  void report(Finding finding);

  /// Contacts with other settings, limits or accuracy than scene(); start from scene_options().
  /// Findings go to `found`. The result must not outlive this object.
  Scene scene_with(const SceneOptions& options, Findings& found) const;
  /// findings() with the findings of another scene in place of those of scene().
  Findings findings_with(const Findings& of_scene) const;

  /// The last stage that was built.
  Stage reached() const;
  /// Sets a function that is called before each stage is built; may be empty.
  void observe(std::function<void(Stage)> observer);

 private:
  struct Parts;
  explicit LoadedDeck(std::unique_ptr<Parts> parts);
  friend Result<LoadedDeck> load(const std::string& path, const LoadOptions& options);
  std::unique_ptr<Parts> parts_;
};

/// Reads a deck with everything it includes. Only a main file that cannot be read is an error; all
/// else is a finding.
Result<LoadedDeck> load(const std::string& path, const LoadOptions& options = {});

}  // namespace deck
