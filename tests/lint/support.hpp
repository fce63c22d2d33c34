// Runs lint on an example: writes its files, reads the deck, builds the model, lints.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "deck/lint.hpp"
#include "folder.hpp"
#include "lint/shared/example.hpp"
#include "lint/shared/geometry.hpp"

namespace deck::test {

/// A deck with its lint result. Keeps the deck alive, which the result points into.
struct Linted {
  explicit Linted(LoadedDeck&& read) : loaded(std::move(read)), deck(&loaded.deck()) {}

  LoadedDeck loaded;
  const Deck* deck;
  LintResult result;

  bool fires(RuleId rule) const { return find(rule) != nullptr; }
  const Finding* find(RuleId rule) const {
    for (const Finding& d : result.findings)
      if (d.rule == rule) return &d;
    return nullptr;
  }
  std::size_t count(RuleId rule) const {
    return static_cast<std::size_t>(
        std::count_if(result.findings.begin(), result.findings.end(),
                      [&](const Finding& d) { return d.rule == rule; }));
  }
  /// Ids of all findings, for messages of failed tests.
  std::string list() const {
    std::string out;
    for (const Finding& d : result.findings)
      out += std::string(id_text(d.rule)) + " " + d.message + "\n";
    return out;
  }
};

inline Linted linted(Deck&& deck, LoadOptions how = {}) {
  how.geometry = false;
  return Linted(LoadedDeck::from(std::move(deck), how));
}

inline Linted lint_file(const std::string& path, const LintOptions& options = {},
                        const ReadOptions& read = {}) {
  LoadOptions how;
  how.read = read;
  how.geometry = false;
  auto loaded = load(path, how);
  if (!loaded) throw std::runtime_error(loaded.error().message);
  Linted out(std::move(*loaded));
  out.result = run_lint(out.loaded, options);
  return out;
}

inline Linted lint_text(const std::string& text, const LintOptions& options = {}) {
  const SchemaSet& schemas = SchemaSet::built_in();
  auto deck = read_deck_text("deck_0000.rad", text, schemas);
  if (!deck) throw std::runtime_error(deck.error().message);
  Linted out = linted(std::move(*deck));
  out.result = run_lint(out.loaded, options);
  return out;
}

/// Lints an example in the notation of lint/shared/example.hpp.
inline Linted lint_example(std::string_view example, const LintOptions& options = {}) {
  const ExampleDeck deck = example_deck(example, SchemaSet::built_in());
  if (deck.files.empty() && deck.limits.empty()) return lint_text(deck.main, options);
  Folder folder;
  for (const auto& [name, text] : deck.files) folder.write(name, text);
  ReadOptions read;
  for (const auto& [name, value] : deck.limits)
    if (name == "include_depth") read.limits.include_depth = value;
  return lint_file(folder.write("deck_0000.rad", deck.main), options, read);
}

/// What a rule says of an example: a message of the solver (its number), or one of these.
enum Said : int { silent = -1, fires_without_message = 0 };
struct Fact {
  std::string example;
  RuleId rule;
  int said;  ///< number of a message, or Said
};

inline void expect_facts(const std::vector<Fact>& facts) {
  for (const Fact& fact : facts) {
    const Linted run = lint_example(fact.example);
    const Finding* d = run.find(fact.rule);
    const int said = d == nullptr ? silent : d->reference ? d->reference->number : 0;
    EXPECT_EQ(said, fact.said) << id_text(fact.rule) << " of\n" << fact.example << run.list();
  }
}

/// LoadOptions with other schemas.
inline LoadOptions with_schemas(const SchemaSet& schemas) {
  LoadOptions how;
  how.schemas = &schemas;
  return how;
}

/// LoadOptions with this many threads.
inline LoadOptions with_threads(int threads) {
  LoadOptions how;
  how.threads = threads;
  return how;
}

/// Lints a deck with the geometry checks.
inline Linted lint_geometry_of(Deck deck, const GeometryOptions& geometry = {},
                               const LoadOptions& how = {}) {
  Linted out = linted(std::move(deck), how);
  out.result =
      run_lint(out.loaded, {},
               {[&](const LintContext& c, Reporter& r) { return check_geometry(c, r, geometry); }});
  return out;
}

/// Lints an example with the geometry checks.
inline Linted lint_geometry(std::string_view example, const GeometryOptions& geometry = {},
                            const LoadOptions& how = {}) {
  const SchemaSet& schemas = SchemaSet::built_in();
  const ExampleDeck written = example_deck(example, schemas);
  Folder folder;
  for (const auto& [name, text] : written.files) folder.write(name, text);
  auto deck = read_deck(folder.write("deck_0000.rad", written.main), schemas);
  if (!deck) throw std::runtime_error(deck.error().message);
  return lint_geometry_of(std::move(*deck), geometry, how);
}

}  // namespace deck::test
