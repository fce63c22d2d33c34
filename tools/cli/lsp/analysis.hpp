// What is known about a deck at one moment: its blocks (of the text as it is now), and what model
// and rules make of it (of the text as it was when the analysis began).
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deck/lint.hpp"
#include "deck/loaded_deck.hpp"
#include "keyword/shared/place.hpp"
#include "keyword/shared/references.hpp"
#include "lint/shared/config.hpp"
#include "lsp/text.hpp"

namespace deck::lsp {

/// A deck cut into blocks. Immutable but for the tables of lines, which the server's thread fills.
struct Syntax {
  Syntax(Deck&& read, std::uint64_t text_generation)
      : generation(text_generation), deck(std::move(read)), index(deck) {}

  std::uint64_t generation;  ///< of the open documents when it was read
  Deck deck;
  BlockIndex index;

  /// Index of the file at that path; Span::no_file.
  std::uint32_t file_of(const std::string& path) const;
  const LineTable& lines(std::uint32_t file) const;
  void set_lines(std::uint32_t file, std::shared_ptr<const LineTable> table) const {
    tables_[file] = std::move(table);
  }

 private:
  mutable std::map<std::uint32_t, std::shared_ptr<const LineTable>> tables_;
};

/// What the model and the rules say about a deck; owns all it refers to.
struct Semantics {
  std::uint64_t generation = 0;      ///< of the open documents when it was read
  std::optional<LoadedDeck> loaded;  ///< has its interfaces; places are as in the text read
  LintResult lint;
  std::string config_error;  ///< of .decklint.toml; empty: none
  std::string refusal;       ///< not empty: the file is no Starter deck, and why
};

/// What the geometry of a saved deck says; owns all it refers to.
struct Geometry {
  struct Interface {
    std::int64_t id = 0;
    int type = 0;
    std::uint64_t nodes = 0, edges = 0, pairs = 0, errors = 0;
    double depth = 0;
    bool evaluated = true;
    std::vector<std::pair<std::string, std::string>> values;  ///< field, value from the mesh
  };
  struct PlacedFinding {
    std::string path;
    std::string line_text;  ///< of the line that it is about, to be found again after edits
    std::uint64_t line = 0, line_offset = 0;
    Finding finding;
  };
  std::vector<Interface> interfaces;
  std::vector<PlacedFinding> findings;
  const Interface* find(std::int64_t id, int type) const;
};

/// Settings of the client.
struct Settings {
  std::vector<std::string> include_paths;
  int threads = 1;
  Limits limits;
};

/// How a deck with these texts over its files is loaded.
LoadOptions load_options(const Settings& settings, const std::map<std::string, std::string>& texts,
                         const SchemaSet& schemas);

/// Reads the deck at `path` with the given texts over the files, and finds what `deck lint
/// --no-geometry` finds, with the configuration beside the deck. nullptr: stopped.
std::shared_ptr<const Semantics> analyse(const std::string& path,
                                         const std::map<std::string, std::string>& texts,
                                         std::uint64_t generation, const SchemaSet& schemas,
                                         const Settings& settings, const std::atomic<bool>& stop);

/// Builds the contacts of the deck at `path` with the given texts over the files. `progress` gets
/// contacts done and in all. nullptr: stopped, or no deck.
std::shared_ptr<const Geometry> examine(
    const std::string& path, const std::map<std::string, std::string>& texts,
    const SchemaSet& schemas, const Settings& settings,
    const std::function<void(std::size_t, std::size_t)>& progress, const std::atomic<bool>& stop);

}  // namespace deck::lsp
