// What the fuzz targets share: a property that must hold, and decks read from text in memory with
// all that is made of them. Nothing here visits the file system.
#pragma once
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "deck/edit.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"

namespace deck::fuzz {

/// Ends the process where a property does not hold: libFuzzer keeps the input that did it.
inline void require(bool good, const char* what, std::string_view detail = {}) {
  if (good) return;
  std::fprintf(stderr, "property does not hold: %s\n%s\n", what,
               std::string(detail.substr(0, 4000)).c_str());
  std::abort();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A number that depends on every byte of the input, to choose among variants of a target.
inline std::uint64_t hash_of(std::string_view text) {
  std::uint64_t h = 1469598103934665603u;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return h ^ (h >> 29);
}

/// The text without directives that would lead to a file: "#include" becomes a comment.
inline std::string without_includes(std::string text) {
  for (std::size_t at = 0; (at = text.find('#', at)) != std::string::npos; ++at)
    if (at + 1 < text.size() && (text[at + 1] | 0x20) == 'i') text[at + 1] = '-';
  return text;
}

using Files = std::map<std::string, std::string>;

/// A deck with its texts. Never moved: the parts point to one another.
struct Whole {
  Files files;
  LoadedDeck loaded;
  const Deck& deck = loaded.deck();
  const Model& model = loaded.model();
  const Interfaces& interfaces = loaded.interfaces();
  Findings findings = loaded.findings(Stage::interfaces);

  const LoadedDeck& context() const { return loaded; }
  std::string_view bytes(std::uint32_t file = 0) const { return deck.sources[file].bytes(); }
};

inline ReadOptions read_options(const Files& files) {
  ReadOptions options;
  options.limits.files = 8;
  options.limits.include_depth = 6;
  options.overlay = &files;
  return options;
}

/// Reads the file `main` of `files`; nullptr: not a deck.
inline std::unique_ptr<Whole> read_files(Files files, const std::string& main, int threads = 1) {
  LoadOptions options;
  options.read = read_options(files);
  options.threads = threads;
  options.geometry = false;
  auto loaded = load(main, options);
  if (!loaded) return nullptr;
  return std::unique_ptr<Whole>(new Whole{std::move(files), std::move(*loaded)});
}

inline constexpr const char* main_name = "fuzz_0000.rad";

/// Reads one text, without includes; nullptr: not a deck.
inline std::unique_ptr<Whole> read_text(std::string text, int threads = 1) {
  return read_files({{main_name, without_includes(std::move(text))}}, main_name, threads);
}

/// Every span of the findings lies in its file.
inline void check_spans(const Deck& deck, const Findings& findings) {
  for (const Finding& d : findings.all()) {
    if (!d.span.valid()) continue;
    require(d.span.file < deck.sources.size(), "a finding lies in a file of the deck", d.message);
    require(d.span.offset + d.span.length <= deck.sources[d.span.file].bytes().size(),
            "a finding lies in its file", d.message);
    deck.sources.where(d.span);
  }
}

inline std::string shown(std::int64_t v) { return std::to_string(v); }
inline std::string shown(const std::string& v) { return v; }
/// All bits, so that the last one counts.
inline std::string shown(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", v);
  return text;
}

template <class Inter>
void add_values(std::string& out, const std::vector<Inter>& all, bool only_used) {
  for (const Inter& inter : all) {
    out += "/INTER/TYPE" + std::to_string(inter.type) + "/" + std::to_string(inter.id) + ":";
    inter.for_each([&](std::string_view name, const auto& field) {
      if (only_used && (inter.type == 10 ? name == "Inacti" : name == "Iedge")) return;
      // 1000 is what old manuals write for 0.
      if constexpr (std::is_integral_v<std::decay_t<decltype(field.value)>>) {
        out += " " + std::string(name) + "=" +
               shown(only_used && field.value == 1000 ? 0 : field.value);
      } else {
        out += " " + std::string(name) + "=" + shown(field.value);
      }
    });
    out += "\n";
  }
}

/// The effective values of all interfaces, one line each, to compare decks by; `only_used`: without
/// Inacti of a tied contact and Iedge, which are printed and never used.
inline std::string effective_values(const Interfaces& interfaces, bool only_used = false) {
  std::string out;
  add_values(out, interfaces.type7, only_used);
  add_values(out, interfaces.type10, only_used);
  add_values(out, interfaces.type11, only_used);
  add_values(out, interfaces.type19, only_used);
  return out;
}

}  // namespace deck::fuzz
