// The language server as a process that waits for its editor.
#include <csignal>

#include "lsp/server.hpp"

namespace deck::lsp {

int serve(const SchemaSet& schemas, Settings settings) {
  // A client that is gone shows in what write() says.
  std::signal(SIGPIPE, SIG_IGN);
  Connection connection(0, 1);
  Server server(connection, schemas, std::move(settings));
  return server.run();
}

}  // namespace deck::lsp
