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

/// Stages of building, in this order; each needs those before it.
enum class Stage : std::uint8_t {
  deck,        ///< the text, cut into blocks
  model,       ///< nodes, elements, parts ...
  interfaces,  ///< the cards of the interfaces with what holds in place of blanks
  cells,       ///< all cells that contacts depend on have been read
  scene,       ///< contacts, and with them the groups that they are made from
};

struct LoadOptions {
  ReadOptions read;  ///< its limits hold for all that is made of the deck
  int threads = 1;   ///< changes no result
  /// interfaces() has the values that follow from the mesh.
  bool geometry = true;
  bool engine_files = false;  ///< read with the deck; else when engine_files() is asked for them
  const SchemaSet* schemas = nullptr;  ///< nullptr: the built-in ones; must outlive what is loaded
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
  /// Called with (contacts done, contacts in all).
  using Progress = std::function<void(std::size_t, std::size_t)>;

  /// Makes a LoadedDeck from a Deck that was read already, for example from text in memory.
  static LoadedDeck from(Deck&& deck, const LoadOptions& options = {});
  /// This deck with other texts of some of its files, by their paths as it opened them, read again
  /// as it was read. Texts that never lay on a disk are kept.
  Result<LoadedDeck> with(const std::map<std::string, std::string>& changed) const;
  LoadedDeck(LoadedDeck&&) noexcept;
  LoadedDeck& operator=(LoadedDeck&&) noexcept;
  ~LoadedDeck();

  const std::string& path() const;  ///< as given
  const SchemaSet& schemas() const;
  const LoadOptions& options() const;
  const Limits& limits() const { return options().read.limits; }

  /// The text and its blocks. Deck::findings holds all of findings() once these were asked for.
  const Deck& deck() const;
  Deck& deck();  ///< what was made of it refers to it
  /// The Engine files beside the deck; their texts are added to the sources of the deck.
  const EngineFiles& engine_files() const;
  /// True if a file of the include tree could not be read.
  bool incomplete() const;
  const Model& model() const;
  /// Time steps, masses and stiffness of elements and nodes, and what the parts add up to; with the
  /// nodes where contacts that move nodes have put them. Good until another scene.
  const Mesh& mesh() const;
  /// The kinematic conditions of all nodes, and which of them do not go together.
  const Kinematics& kinematics() const;
  /// Effective values; with LoadOptions::geometry also those that follow from the mesh.
  const Interfaces& interfaces() const;
  /// Contacts without penetrations, where an interface has values that follow from the mesh; else
  /// an empty scene. interfaces() has these values from now on, whatever was asked for. Good until
  /// scene() is made.
  const Scene& mesh_values(const Progress& progress = {}) const;

  /// How scene() is made: with threads and limits of loading, and with the nodal stiffness that
  /// forces need.
  const SceneOptions& scene_options() const;
  /// Makes scene() with other options from now on. The scene, ties and cycle that were made before
  /// are freed: references to them are invalid.
  void set_scene_options(const SceneOptions& options);
  /// The contacts of the deck: segments, gaps, stiffness, penetrations.
  const Scene& scene() const;
  /// The ties of every /INTER/TYPE2, node by node: those of scene() if it was made with them
  /// (SceneOptions::ties), else found when first asked for.
  const std::vector<Tie>& ties() const;
  /// Frees the memory of scene(), ties() and cycle(); the next call makes them again. For programs
  /// that keep many decks.
  void drop_scene();
  /// Forces of the first cycle, with every pair. At rest but for initial velocities of the deck.
  const FirstCycle& cycle() const;

  /// All problems found: in reading, in the model, its interfaces, contacts, the cells that
  /// contacts depend on, groups (errors only: they can stop the solver), and those that report()
  /// added; in this order, each once. Builds the scene. Groups that are resolved later do not
  /// count. Valid until report() or another scene.
  const Findings& findings() const;
  /// findings() without those of the stages after `until`.
  Findings findings(Stage until) const;
  /// Findings of one stage alone.
  const Findings& found_by(Stage stage) const;
  /// Adds a finding of the caller to findings().
  void report(Finding finding);

  /// Contacts with other settings, bounds or accuracy than those of scene(), best made of
  /// scene_options(). What they meet goes to `found`. Ends before this does.
  Scene scene_with(const SceneOptions& options, Findings& found) const;
  /// findings() with what such a scene has met instead of what scene() has.
  Findings findings_with(const Findings& of_scene) const;

  /// The last stage that was made.
  Stage reached() const;
  /// Called with every stage when it is made, before its work begins; may be empty.
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
