// Decks in memory with everything the conversions read, and what comes out of them.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "deck/edit/rewrite.hpp"
#include "deck/model/interfaces.hpp"
#include "where.hpp"

namespace deck::edit_test {

/// A deck read from disk or from texts by path. Stays where it is.
struct Whole {
  using Files = std::map<std::string, std::string>;

  Whole(LoadedDeck&& read, Files with) : files(std::move(with)), loaded(std::move(read)) {
    diagnostics = loaded.found_by(Stage::model);
    diagnostics.merge(Diagnostics(loaded.found_by(Stage::interfaces)));
  }

  static std::unique_ptr<Whole> read(const std::string& path, Files files = {}) {
    LoadOptions options;
    options.read.overlay = &files;
    options.geometry = false;
    auto read = load(path, options);
    EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.error().message);
    if (!read) read = LoadedDeck::from(Deck());
    return std::make_unique<Whole>(std::move(*read), std::move(files));
  }
  static std::unique_ptr<Whole> text(const std::string& main) {
    return read("memory_0000.rad", {{"memory_0000.rad", main}});
  }

  const LoadedDeck& context() const { return loaded; }

  /// The deck after a rewrite.
  std::unique_ptr<Whole> after(const Rewrite& rewrite) const {
    EXPECT_TRUE(rewrite.refusals.empty())
        << (rewrite.refusals.empty() ? "" : rewrite.refusals.front());
    auto changed = apply_rewrite(deck.sources, rewrite);
    EXPECT_TRUE(changed.ok()) << (changed.ok() ? "" : changed.error().message);
    Files now = files;
    if (changed)
      for (auto& [path, content] : *changed) now[path] = content;
    return read(deck.sources[0].path(), std::move(now));
  }
  std::string main_text() const { return std::string(deck.sources[0].bytes()); }
  bool contains(const std::string& text) const {
    return main_text().find(text) != std::string::npos;
  }

  Files files;
  LoadedDeck loaded;
  const Deck& deck = loaded.deck();
  const Model& model = loaded.model();
  const Interfaces& interfaces = loaded.interfaces();
  Diagnostics diagnostics;  ///< of model and interfaces
};

/// (keyword, id, field, value) of every real cell, bulk blocks included, in deck order.
using RealValue = std::tuple<std::string, std::int64_t, std::string, double>;
inline std::vector<RealValue> real_values(const Deck& deck) {
  std::vector<RealValue> all;
  for (const Block& b : deck.blocks) {
    if (b.schema == nullptr) continue;
    for (const DecodedCard& card : decode(deck, b).cards)
      for (const Cell& cell : card.cells)
        if (cell.field->type == FieldType::real)
          all.emplace_back(std::string(b.keyword), b.id.value, cell.field->name, cell.real);
  }
  return all;
}

inline const Block* block(const Deck& deck, std::string_view header) {
  for (const Block& b : deck.blocks)
    if (b.header == header) return &b;
  ADD_FAILURE() << "no block " << header;
  return nullptr;
}
inline double real(const Whole& w, std::string_view header, std::string_view field) {
  const Block* b = block(w.deck, header);
  return b == nullptr ? 0 : decode(w.deck, *b).real(field);
}

/// Where the real decks are; empty: not here.
inline std::string corpus(const std::string& file) {
  const std::filesystem::path root = test::shared_dir();
  for (const auto& path : {root / "corpus" / file, root / file})
    if (std::filesystem::exists(path)) return path.string();
  return {};
}

}  // namespace deck::edit_test
