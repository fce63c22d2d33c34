// The language server where nothing may wait: node reads standard input, hands over what arrives
// and calls again when the server has more to do (node.mjs).
#include <emscripten/emscripten.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string_view>

#include "lsp/server.hpp"

namespace deck::lsp {
namespace {

/// What lives from the call of `deck lsp` until the editor ends it.
struct Serving {
  Serving(const SchemaSet& given, Settings settings)
      : schemas(given), server(connection, schemas, std::move(settings)) {}
  SchemaSet schemas;
  Connection connection{0, 1};
  Server server;
};
std::unique_ptr<Serving> serving;

}  // namespace

int serve(const SchemaSet& schemas, Settings settings) {
  serving = std::make_unique<Serving>(schemas, std::move(settings));
  return 0;
}

}  // namespace deck::lsp

/// Bytes of standard input.
extern "C" EMSCRIPTEN_KEEPALIVE void deck_receive(const char* bytes, int size) {
  deck::lsp::serving->connection.receive({bytes, static_cast<std::size_t>(size)});
}

/// The end of standard input.
extern "C" EMSCRIPTEN_KEEPALIVE void deck_close() { deck::lsp::serving->connection.close(); }

/// Milliseconds until the next call if nothing arrives before; -1: no such call is needed; -2 -
/// CODE: the server has ended with this exit code; -4: there is none.
extern "C" EMSCRIPTEN_KEEPALIVE int deck_step() {
  using namespace std::chrono;
  if (!deck::lsp::serving) return -4;
  auto& server = deck::lsp::serving->server;
  const auto next = server.step();
  if (server.done()) {
    const int code = server.exit_code();
    deck::lsp::serving.reset();
    return -2 - code;
  }
  if (!next) return -1;
  const auto wait = duration_cast<milliseconds>(*next - deck::lsp::Server::Clock::now());
  return static_cast<int>(std::max<milliseconds::rep>(0, wait.count() + 1));
}
