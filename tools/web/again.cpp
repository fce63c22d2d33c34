// `deck lint --no-geometry` of a deck that a page edits again and again, in a program that stays
// loaded. The page calls it by name; the files lie in the folder that it runs in.
#include <emscripten/emscripten.h>

#include <atomic>
#include <cstdio>
#include <exception>
#include <string>

#include "common.hpp"
#include "lsp/analysis.hpp"
#include "report/shared/diagnostics.hpp"

namespace {

using namespace deck;

/// The document of `deck lint PATH --no-geometry --json -`; empty: the command itself has to say
/// why not.
std::string lint_again(const std::string& path) {
  static const auto schemas = cli::load_schemas({});
  if (!schemas) return {};
  const std::atomic<bool> stop = false;
  const auto found = lsp::analyse(path, {}, 0, *schemas, {}, stop);
  if (!found->refusal.empty() || !found->config_error.empty()) return {};
  const LoadedDeck& loaded = *found->loaded;
  return lint_json({{path, &loaded.deck(), &found->lint, "", &loaded.interfaces()}});
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
