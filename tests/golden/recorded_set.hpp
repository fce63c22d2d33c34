// A set of recorded states of the reference solver: its deck with contacts, its tables.
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "deck/contacts.hpp"
#include "golden/reference.hpp"
#include "replay/replay.hpp"

namespace deck::test {

/// The file of a folder whose name ends so.
inline fs::path file_like(const fs::path& dir, const std::string& ending) {
  for (const auto& entry : fs::directory_iterator(dir))
    if (entry.path().filename().string().ends_with(ending)) return entry.path();
  return {};
}

/// A packed table as text; nothing if it is damaged.
inline std::optional<std::string> states_of(const fs::path& path) {
  return cycle::states_text(text_of(path));
}

/// The deck of a set. Stays at its address.
struct RecordedSet {
  RecordedSet(const std::string& text, const SceneOptions& options)
      : deck(std::move(*read_deck_text("deck_0000.rad", text, SchemaSet::built_in()))),
        model(build_model(deck, SchemaSet::built_in(), findings)),
        interfaces(read_interfaces(deck, model, findings)),
        scene(build_scene(model, interfaces, findings, options)) {}
  RecordedSet(const RecordedSet&) = delete;
  RecordedSet& operator=(const RecordedSet&) = delete;
  Findings findings;
  Deck deck;
  Model model;
  Interfaces interfaces;
  Scene scene;
};

}  // namespace deck::test
