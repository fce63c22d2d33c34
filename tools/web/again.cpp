// `deck lint --no-geometry` of a deck that a page edits again and again: what an edit did not touch
// is not looked at once more. The page calls it by name; the files lie in the folder that it runs
// in.
#include <emscripten/emscripten.h>

#include <atomic>
#include <cstdio>
#include <exception>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "common.hpp"
#include "deck/keyword/recognise.hpp"
#include "deck/report/diagnostics.hpp"
#include "lsp/analyst.hpp"

namespace {

using namespace deck;

/// The document of `deck lint PATH --no-geometry --json -`; empty: the command itself has to say
/// why not.
std::string lint_again(const std::string& path) {
  static const auto schemas = cli::load_schemas({});
  static lsp::Analyst analyst;
  static std::uint64_t looks = 0;
  if (!schemas) return {};
  lsp::Settings settings;
  ReadOptions read;
  read.limits = settings.limits;
  auto deck = read_deck(path, *schemas, read);
  if (!deck || !no_starter_deck(*deck).empty()) return {};
  EngineFiles engine = read_engine_files(*deck, settings.limits);
  std::set<std::string> edited;
  for (std::uint32_t f = 0; f < deck->sources.size(); ++f) edited.insert(deck->sources[f].path());
  const auto now = std::make_shared<const lsp::Syntax>(std::move(*deck), std::move(engine),
                                                       std::move(edited), ++looks);
  const std::atomic<bool> stop = false;
  const auto found = analyst.look(now, *schemas, settings, stop);
  if (found == nullptr || !found->refusal.empty() || !found->config_error.empty()) return {};
  return lint_json({{path, &now->deck, &found->lint, "", &found->interfaces, found->deck.get()}});
}

}  // namespace

/// Prints the document; 0: there is none.
extern "C" EMSCRIPTEN_KEEPALIVE int deck_lint_again(const char* path) {
  try {
    const std::string text = lint_again(path);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return std::fflush(stdout) == 0 && !text.empty() ? 1 : 0;
  } catch (const std::exception&) {
    return 0;
  }
}
