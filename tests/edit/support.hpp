// Decks in memory with all that conversions read, their results, and their values as text.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "deck/edit.hpp"
#include "deck/model.hpp"
#include "edit/shared/conversion.hpp"
#include "keyword/reading.hpp"
#include "lint/shared/example.hpp"
#include "where.hpp"

namespace deck::edit_test {

/// A deck read from disk or from texts by path. Not movable: the parts point to one another.
struct Whole {
  using Files = std::map<std::string, std::string>;

  explicit Whole(const std::string& path, Files texts = {})
      : files(std::move(texts)), loaded(open(path)) {
    findings = loaded.found_by(Stage::model);
    findings.merge(Findings(loaded.found_by(Stage::interfaces)));
  }
  Whole(const Whole&) = delete;
  Whole& operator=(const Whole&) = delete;

  static std::unique_ptr<Whole> read(const std::string& path, Files files = {}) {
    return std::make_unique<Whole>(path, std::move(files));
  }
  static std::unique_ptr<Whole> text(const std::string& main,
                                     const std::string& name = "memory_0000.rad") {
    return read(name, {{name, main}});
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
  Findings findings;  ///< of model and interfaces

 private:
  LoadedDeck open(const std::string& path) const {
    LoadOptions options;
    options.read.overlay = &files;
    options.geometry = false;
    auto read = load(path, options);
    EXPECT_TRUE(read.ok()) << (read ? "" : read.error().message);
    return read ? std::move(*read) : LoadedDeck::from(Deck());
  }
};

/// The first figure of values, contacts, forces, masses and steps that a conversion changed, by the
/// library's own verification, which verify_test.cpp holds to each of them; empty: none.
inline std::string changed_figure(const Whole& before, const Whole& after, std::string_view step,
                                  const std::vector<LossEntry>& losses = {}) {
  return first_difference(before.context(), after.context(), relation_of(step, losses))
      .value_or("");
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

inline std::string as_text(std::int64_t v) { return std::to_string(v); }
inline std::string as_text(double v) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", v);
  return buffer;
}
inline std::string as_text(const std::string& v) { return v; }

/// "/INTER/TYPE7/3 Istf" -> effective value, with the origin where it is asked for; of these
/// interfaces, or of all of them.
inline std::map<std::string, std::string> effective_values(
    const Whole& o, bool origins = false, const std::set<std::int64_t>& only = {}) {
  std::map<std::string, std::string> out;
  for (const InterBase* i : o.interfaces.all) {
    if (!only.empty() && !only.contains(i->id)) continue;
    const std::string head =
        "/INTER/TYPE" + std::to_string(i->type) + "/" + std::to_string(i->id) + " ";
    out[head] = i->title;
    for_each_field(*i, [&](std::string_view name, const auto& e) {
      out[head + std::string(name)] =
          as_text(e.value) + (origins ? std::string(" ") + to_string(e.origin) : "");
    });
  }
  return out;
}

}  // namespace deck::edit_test

namespace deck::test {

using edit_test::changed_figure;
using edit_test::effective_values;
using edit_test::Whole;

inline std::unique_ptr<Whole> open_text(const std::string& text,
                                        const std::string& name = "main_0000.rad") {
  return Whole::text(text, name);
}

/// The values that differ, one line each; empty if there are none.
inline std::string difference(const std::map<std::string, std::string>& a,
                              const std::map<std::string, std::string>& b) {
  std::string out;
  for (const auto& [name, value] : a) {
    const auto it = b.find(name);
    if (it == b.end()) out += name + ": " + value + " -> missing\n";
    if (it != b.end() && it->second != value)
      out += name + ": " + value + " -> " + it->second + "\n";
  }
  for (const auto& [name, value] : b)
    if (a.count(name) == 0) out += name + ": new " + value + "\n";
  return out;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& l : lines) out += l + "\n";
  return out;
}

inline std::vector<LossEntry> losses_of(const Rewrite& r, Loss kind) {
  std::vector<LossEntry> out;
  for (const LossEntry& l : r.losses)
    if (l.loss == kind) out.push_back(l);
  return out;
}

inline std::vector<std::string> sample_decks() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "samples"))
    if (entry.path().string().ends_with("_0000.rad")) out.push_back(entry.path().string());
  std::sort(out.begin(), out.end());
  EXPECT_GE(out.size(), 10u);
  return out;
}

/// A main file of one version around some cards.
inline std::string deck_of_version(int version, const std::string& cards) {
  return testing_support::deck_of(cards, std::to_string(version));
}

inline std::string card(const std::string& keyword, int id, int version,
                        const std::vector<std::pair<std::string, std::string>>& values) {
  const Schema* schema = SchemaSet::built_in().find(keyword);
  EXPECT_NE(schema, nullptr) << keyword;
  if (schema == nullptr) return {};
  const std::string header =
      schema->has_id ? keyword + "/" + std::to_string(id) : std::string(keyword);
  return render_card(*schema, header, version, values);
}

}  // namespace deck::test
