// The verb `deck lsp`: dispatch of messages by state.
#include "lsp/server.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "common.hpp"
#include "report/shared/json.hpp"
#include "text/shared/read_json.hpp"

namespace deck::lsp {
namespace {

/// params.a.b.c, or null.
const Json& at(const Json& json, std::initializer_list<const char*> keys) {
  static const Json none;
  const Json* here = &json;
  for (const char* key : keys) {
    if (!here->is_object()) return none;
    const auto it = here->find(key);
    if (it == here->end()) return none;
    here = &*it;
  }
  return *here;
}
bool is_true(const Json& json, std::initializer_list<const char*> keys) {
  const Json& v = at(json, keys);
  return v.is_boolean() && v.get<bool>();
}
bool lists(const Json& array, const char* word) {
  return array.is_array() && std::find(array.begin(), array.end(), word) != array.end();
}

using Feature = Answer (*)(const View&, const Json&);

/// Requests about a document.
Feature feature(const std::string& method) {
  static const std::map<std::string, Feature, std::less<>> all = {
      {"textDocument/hover", hover},
      {"textDocument/inlayHint", inlay_hints},
      {"textDocument/completion", completion},
      {"textDocument/documentSymbol", document_symbols},
      {"textDocument/foldingRange", folding_ranges},
      {"textDocument/definition", definition},
      {"textDocument/references", references},
      {"textDocument/documentHighlight", document_highlight},
      {"textDocument/codeAction", code_actions},
      {"textDocument/codeLens", code_lenses},
      {"deck/card", card_at},
  };
  const auto it = all.find(method);
  return it == all.end() ? nullptr : it->second;
}

Json capabilities(const Client& client) {
  return {
      {"positionEncoding", client.encoding == Encoding::utf8 ? "utf-8" : "utf-16"},
      {"textDocumentSync",
       {{"openClose", true}, {"change", 2}, {"save", {{"includeText", false}}}}},
      {"hoverProvider", true},
      {"inlayHintProvider", true},
      {"completionProvider", {{"triggerCharacters", {"/", " "}}, {"resolveProvider", false}}},
      {"definitionProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"documentSymbolProvider", true},
      {"codeActionProvider", {{"codeActionKinds", {"quickfix", "source.fixAll", "refactor"}}}},
      {"codeLensProvider", {{"resolveProvider", false}}},
      {"foldingRangeProvider", true},
      {"executeCommandProvider",
       {{"commands", {"deck.setField", "deck.fixAll", "deck.openGapReport", "deck.explain"}},
        {"workDoneProgress", false}}},
      {"workspace", {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}},
  };
}

}  // namespace

Server::Server(Connection& connection, const SchemaSet& schemas, Settings settings)
    : connection_(connection),
      analyst_(std::make_unique<Worker>()),
      geometer_(std::make_unique<Worker>()) {
  workspace_.configure(schemas, std::move(settings));
}

Server::~Server() {
  for (auto& [path, stop] : analysing_) *stop = true;
  for (auto& [path, progress] : examining_) progress->stop = true;
  for (auto& [id, progress] : reports_) progress->stop = true;
  analyst_.reset();
  geometer_.reset();
  std::error_code ignored;
  if (!report_folder_.empty()) std::filesystem::remove_all(report_folder_, ignored);
}

int Server::run() {
  std::thread reader([this] { read_messages(); });
  while (!done_) {
    const auto task = queue_.pop(next_due());
    if (task) (*task)();
    start_due();
  }
  reader.join();
  return shutdown_ ? 0 : 1;
}

/// Runs in its own thread, so that requests can be cancelled during others.
void Server::read_messages() {
  while (const auto content = connection_.read())
    if (!enqueue(*content)) return;
  queue_.push([this] { done_ = true; });
}

/// Adds a message to the queue; false: the last one.
bool Server::enqueue(const std::string& content) {
  Json message = read_json<Json>(content);
  const Json& method = at(message, {"method"});
  if (method == "$/cancelRequest") {
    const std::string id = at(message, {"params", "id"}).dump();
    const std::lock_guard lock(cancelling_);
    cancelled_.insert(id);
    if (const auto it = reports_.find(id); it != reports_.end()) it->second->stop = true;
    return true;
  }
  const bool last = method == "exit";
  queue_.push([this, m = std::move(message)] {
    if (m.is_discarded())
      fail(nullptr, parse_error, "the message is no JSON");
    else
      dispatch(m);
  });
  return !last;
}

bool Server::cancelled(const Json& id) {
  const std::lock_guard lock(cancelling_);
  return cancelled_.erase(id.dump()) > 0;
}

void Server::respond(const Json& id, Json result) {
  connection_.write({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
}
void Server::fail(const Json& id, int code, const std::string& message) {
  connection_.write(
      {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", utf8(message)}}}});
}
void Server::notify(const char* method, Json params) {
  connection_.write({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
}
void Server::request(const char* method, Json params) {
  Json message = {
      {"jsonrpc", "2.0"}, {"id", "deck-" + std::to_string(next_id_++)}, {"method", method}};
  if (!params.is_null()) message["params"] = std::move(params);
  connection_.write(message);
}

void Server::dispatch(const Json& message) {
  const Json& method = at(message, {"method"});
  const bool has_id = message.is_object() && message.contains("id");
  const Json id = has_id ? message["id"] : Json();
  if (!method.is_string()) {
    // Answers to our own requests need no reaction.
    if (!message.is_object() || !has_id ||
        !(message.contains("result") || message.contains("error")))
      fail(id, invalid_request, "the message has no method");
    return;
  }
  const std::string name = method.get<std::string>();
  const Json& params = at(message, {"params"});
  if (!has_id) {
    try {
      notified(name, params);
    } catch (const std::exception& e) {
      notify("window/logMessage", {{"type", 1}, {"message", utf8(name + ": " + e.what())}});
    }
    return;
  }
  if (cancelled(id)) return fail(id, request_cancelled, "cancelled");
  if (!initialized_ && name != "initialize")
    return fail(id, server_not_initialized, "the first request has to be initialize");
  if (initialized_ && name == "initialize")
    return fail(id, invalid_request, "the server was initialized before");
  if (shutdown_) return fail(id, invalid_request, "the server was shut down");
  try {
    bool later = false;
    Json result = answer(name, params, id, later);
    if (later) return;
    if (cancelled(id)) return fail(id, request_cancelled, "cancelled");
    respond(id, std::move(result));
  } catch (const Refusal& e) {
    fail(id, request_failed, e.message);
  } catch (const Json::exception& e) {
    fail(id, invalid_params, e.what());
  } catch (const std::exception& e) {
    fail(id, internal_error, e.what());
  }
}

Json Server::answer(const std::string& method, const Json& params, const Json& id, bool& later) {
  if (method == "initialize") return initialize(params);
  if (method == "shutdown") {
    shutdown_ = true;
    return nullptr;
  }
  if (method == "workspace/executeCommand") {
    later = true;
    execute_command(id, params);
    return nullptr;
  }
  if (method == "deck/explain") return explain(params);
  if (method == "deck/gapReport") {
    later = true;
    gap_report(id, params);
    return nullptr;
  }
  const Feature of = feature(method);
  if (of == nullptr) {
    later = true;
    fail(id, method_not_found, "there is no method '" + method + "'");
    return nullptr;
  }
  const auto view = view_of(params);
  if (!view) return nullptr;
  return of(*view, params);
}

/// The document of the parameters; nullopt: not open, or no deck.
std::optional<View> Server::view_of(const Json& params) {
  const std::string path = path_of_uri(at(params, {"textDocument", "uri"}).get<std::string>());
  const OpenDeck* deck = workspace_.deck_of(path);
  if (deck == nullptr) return std::nullopt;
  return View(workspace_, client_, *deck, path);
}

void Server::notified(const std::string& method, const Json& params) {
  if (method == "exit") {
    done_ = true;
    return;
  }
  if (!initialized_ || shutdown_) return;
  if (method == "textDocument/didOpen") return did_open(params);
  if (method == "textDocument/didChange") return did_change(params);
  if (method == "textDocument/didClose") return did_close(params);
  if (method == "textDocument/didSave") return did_save(params);
  if (method == "workspace/didChangeWatchedFiles") return files_changed(params);
  if (method == "deck/cursor") return cursor_moved(params);
  if (method == "window/workDoneProgress/cancel")
    if (const auto it = progresses_.find(at(params, {"token"}).get<std::string>());
        it != progresses_.end())
      it->second->stop = true;
}

Json Server::initialize(const Json& params) {
  const Json& c = at(params, {"capabilities"});
  client_.encoding =
      lists(at(c, {"general", "positionEncodings"}), "utf-8") ? Encoding::utf8 : Encoding::utf16;
  const Json& preferred = at(c, {"general", "positionEncodings"});
  if (preferred.is_array() && !preferred.empty() && preferred[0] == "utf-16")
    client_.encoding = Encoding::utf16;
  const Json& format = at(c, {"textDocument", "hover", "contentFormat"});
  client_.markdown = !format.is_array() || lists(format, "markdown");
  client_.snippets = is_true(c, {"textDocument", "completion", "completionItem", "snippetSupport"});
  client_.document_changes = is_true(c, {"workspace", "workspaceEdit", "documentChanges"});
  client_.progress = is_true(c, {"window", "workDoneProgress"});
  client_.refresh_lenses = is_true(c, {"workspace", "codeLens", "refreshSupport"});
  client_.refresh_hints = is_true(c, {"workspace", "inlayHint", "refreshSupport"});
  client_.hierarchical_symbols =
      is_true(c, {"textDocument", "documentSymbol", "hierarchicalDocumentSymbolSupport"});
  const Json& options = at(params, {"initializationOptions"});
  const auto number = [&](const char* key, int fallback) {
    const Json& v = at(options, {key});
    return v.is_number_integer() ? std::clamp(v.get<int>(), 0, 600'000) : fallback;
  };
  delay_ms_ = number("delay", delay_ms_);
  if (const Json& v = at(options, {"geometryOnSave"}); v.is_boolean())
    geometry_on_save_ = v.get<bool>();
  if (const Json& v = at(options, {"showReportCommand"}); v.is_string())
    client_.show_report = v.get<std::string>();
  Settings settings = workspace_.settings();
  if (const Json& v = at(options, {"includePaths"}); v.is_array())
    for (const Json& p : v)
      if (p.is_string()) settings.include_paths.push_back(p.get<std::string>());
  workspace_.configure(workspace_.schemas(), std::move(settings));
  std::vector<std::string> folders;
  if (const Json& list = at(params, {"workspaceFolders"}); list.is_array())
    for (const Json& f : list) folders.push_back(path_of_uri(f.at("uri").get<std::string>()));
  else if (const Json& root = at(params, {"rootUri"}); root.is_string())
    folders.push_back(path_of_uri(root.get<std::string>()));
  workspace_.set_folders(std::move(folders));
  initialized_ = true;
  return {{"capabilities", capabilities(client_)},
          {"serverInfo", {{"name", "deck"}, {"version", std::string(library_version())}}}};
}

}  // namespace deck::lsp

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
  std::signal(SIGPIPE, SIG_IGN);  // write() reports a client that is gone
  lsp::Connection connection(0, 1);
  lsp::Server server(connection, *schemas, std::move(settings));
  return server.run() == 0 ? exit_clean : exit_findings;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<Options>();
  add_common(line, options->common);
  for (const char* no : {"DECK", "--json", "--quiet", "--color"}) line.remove(no);
  line.flag("--stdio", options->stdio, "Use standard input and output (the only way)");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"lsp", 85, "Language server: findings, hover, completion and more in an editor",
     R"(  deck lsp                       as an editor starts it (see tools/docs/editors.md)
  deck lsp --include-path lib)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_lsp
