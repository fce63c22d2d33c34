// Include trees in memory: the input is the main file and, behind lines "=== NAME", further files.
// Reading is repeatable; a deck becomes JSON; flattening keeps every block and the effective
// values. The input decides which of these is looked at beside what was read: each costs several
// times as much as reading.
#include <nlohmann/json.hpp>

#include "deck/edit.hpp"
#include "report/shared/deck_json.hpp"
#include "support.hpp"

namespace {

using namespace deck;
using fuzz::require;

fuzz::Files files_of(std::string_view input) {
  fuzz::Files files;
  std::string name = fuzz::main_name;
  while (true) {
    const auto mark = input.substr(0, 4) == "=== " ? 0 : input.find("\n=== ");
    files[name] = std::string(input.substr(0, mark == 0            ? 0
                                              : mark == input.npos ? mark
                                                                   : mark + 1));
    if (mark == input.npos) return files;
    input.remove_prefix(mark == 0 ? 4 : mark + 5);
    const auto end = std::min(input.find('\n'), input.size());
    name = std::string(input.substr(0, end));
    input.remove_prefix(std::min(end + 1, input.size()));
  }
}

void check(const Deck& deck) {
  fuzz::check_spans(deck, deck.findings);
  for (const Block& b : deck.blocks)
    for (const FilePiece& p : b.body)
      require(p.begin < p.end && p.end <= deck.sources[p.file].bytes().size(),
              "a block lies in its file");
  for (const IncludeEdge& e : deck.includes)
    require(e.file < deck.sources.size() && e.parent < deck.sources.size(), "an include exists");
}

void to_json(const fuzz::Whole& whole) {
  const auto json = deck_to_json({fuzz::main_name, &whole.deck, &whole.model, &whole.interfaces});
  if (!json) return;  // two files in one place
  require(nlohmann::json::accept(*json), "what --to json writes is JSON");
}

void flattened(const fuzz::Whole& whole) {
  const Rewrite flat = flatten(whole.context());
  if (!flat.refusals.empty() || !flat.new_text) return;
  const auto again = fuzz::read_files({{fuzz::main_name, *flat.new_text}}, fuzz::main_name);
  require(again != nullptr, "a flattened deck is a deck");
  require(again->deck.includes.empty(), "a flattened deck includes nothing");
  require(fuzz::effective_values(again->interfaces) == fuzz::effective_values(whole.interfaces),
          "flattening keeps effective values");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 16384) return 0;
  const std::string text = fuzz::text_of(data, size);
  const fuzz::Files files = files_of(text);
  // Names that would lead to the disk: only those that are given here are read.
  for (const auto& [name, content] : files)
    if (name.empty() || name.find('\0') != std::string::npos) return 0;
  const auto whole = fuzz::read_files(files, fuzz::main_name);
  if (!whole) return 0;
  check(whole->deck);
  const std::uint64_t h = fuzz::hash_of(text) % 8;
  if (h == 0) to_json(*whole);
  if (h == 1 || h == 2) flattened(*whole);
  if (h == 3) {
    const auto again = fuzz::read_files(files, fuzz::main_name);
    require(again && again->deck.blocks.size() == whole->deck.blocks.size() &&
                again->deck.findings.counts() == whole->deck.findings.counts(),
            "reading again gives the same");
  }
  return 0;
}
