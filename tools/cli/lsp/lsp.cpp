// deck lsp: the language server for editors, on standard input and output.
#include <unistd.h>

#include <csignal>

#include "common.hpp"
#include "lsp/server.hpp"

namespace deck::cli::verb_lsp {
namespace {

struct Options {
  CommonOptions common;
  bool stdio = false;
};

int run(const Options& o) {
  const auto schemas = load_schemas(o.common);
  if (!schemas) return failed(o.common, schemas.error().message);
  if (isatty(0) == 1)
    return failed(
        o.common,
        "deck lsp is started by an editor and speaks the Language Server Protocol; do not "
        "type here");
  lsp::Settings settings;
  settings.include_paths = o.common.include_paths;
  settings.limits = o.common.limits;
  settings.threads = o.common.threads > 0 ? o.common.threads : 1;
  std::signal(SIGPIPE, SIG_IGN);  // a client that is gone shows in what write() says
  lsp::Connection connection(0, 1);
  lsp::Server server(connection, *schemas, std::move(settings));
  return server.run() == 0 ? exit_clean : exit_findings;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  for (const char* no : {"decks", "--json", "--quiet", "--color"}) line.remove(no);
  line.flag("--stdio", options->stdio, "Use standard input and output (the only way)");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"lsp", 85, "Language server: findings, hover, completion and more in an editor",
     "  deck lsp                       as an editor starts it (see tools/docs/editors.md)\n"
     "  deck lsp --include-path lib\n",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_lsp
