// All that most programs need: a deck read from a path, with its model and the effective values of
// its contact interfaces, owned in one place.
//
//   const auto loaded = deck::load("car_0000.rad");
//   if (!loaded) ...loaded.error().message
//   for (const deck::InterType7& inter : loaded->interfaces().type7) ...inter.Gapmin.value
#pragma once
#include <memory>
#include <string>

#include "deck/contact/resolve.hpp"
#include "deck/contact/scene.hpp"
#include "deck/contact/view.hpp"
#include "deck/edit/edit.hpp"
#include "deck/keyword/deck.hpp"
#include "deck/model/interfaces.hpp"
#include "deck/model/model.hpp"

namespace deck {

struct LoadOptions {
  ReadOptions read;  ///< with the bounds of what is read and of what is made of it
  int threads = 1;
  bool geometry = true;  ///< fill in the values that follow from the mesh; builds the contacts once
  const SchemaSet* schemas = nullptr;  ///< nullptr: the built-in ones; must outlive what is loaded
};

/// A deck and what was made of it. Each part refers to the one before it; they live and end
/// together, and moving this moves none of them, so references to them stay good.
class LoadedDeck {
 public:
  LoadedDeck(LoadedDeck&&) noexcept;
  LoadedDeck& operator=(LoadedDeck&&) noexcept;
  ~LoadedDeck();

  const std::string& path() const;  ///< as given
  const SchemaSet& schemas() const;
  const LoadOptions& options() const;
  const Deck& deck() const;
  Deck& deck();  ///< for join_findings(); what was made of it refers to it
  const Model& model() const;
  const Interfaces& interfaces() const;
  /// What reading and building had to say; that of the deck itself is in deck().diagnostics.
  const Diagnostics& findings() const;

  /// The contacts of the deck: segments, gaps, stiffness, penetrations. Ends before this does.
  Scene scene() const;
  Scene scene(Diagnostics& findings, const SceneOptions& options = {}) const;

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
