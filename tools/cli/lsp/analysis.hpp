// Knowledge about a deck: its blocks (of the current text), and results of model and rules (of the
// text at the start of the analysis).
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

/// A deck cut into blocks. Immutable, except the line tables, which the server's thread fills.
struct Syntax {
  Syntax(Deck&& read, std::uint64_t text_generation)
      : generation(text_generation), deck(std::move(read)), index(deck) {}
  std::uint64_t generation;  ///< of the open documents at that time
  Deck deck;
  BlockIndex index;
  /// Index of a file; Span::no_file: not in the deck.
  std::uint32_t file_of(const std::string& path) const;
  const LineTable& lines(std::uint32_t file) const;
  void set_lines(std::uint32_t file, std::shared_ptr<const LineTable> table) const {
    tables_[file] = std::move(table);
  }

 private:
  mutable std::map<std::uint32_t, std::shared_ptr<const LineTable>> tables_;
};

/// Results of model and rules; owns all data.
struct Semantics {
  std::uint64_t generation = 0;      ///< of the open documents at that time
  std::optional<LoadedDeck> loaded;  ///< with interfaces; places refer to the text read
  LintResult lint;
  std::string config_error;  ///< of .decklint.toml; empty: none
  std::string refusal;       ///< not empty: why the file is not a Starter deck
};

/// Results of geometry for a saved deck; owns all data.
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
    std::string line_text;  ///< text of its line, to find it again after edits
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

/// Load options for a deck with these texts in place of its files.
LoadOptions load_options(const Settings& settings, const std::map<std::string, std::string>& texts,
                         const SchemaSet& schemas);

/// Reads a deck with these texts; finds the findings of `deck lint --no-geometry` with its
/// configuration. nullptr: cancelled.
std::shared_ptr<const Semantics> analyse(const std::string& path,
                                         const std::map<std::string, std::string>& texts,
                                         std::uint64_t generation, const SchemaSet& schemas,
                                         const Settings& settings, const std::atomic<bool>& stop);

/// Builds the contacts of a deck with these texts. `progress`: contacts done, all. nullptr:
/// cancelled, or no deck.
std::shared_ptr<const Geometry> examine(
    const std::string& path, const std::map<std::string, std::string>& texts,
    const SchemaSet& schemas, const Settings& settings,
    const std::function<void(std::size_t, std::size_t)>& progress, const std::atomic<bool>& stop);

}  // namespace deck::lsp
