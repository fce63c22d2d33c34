// Opening, editing, saving and closing documents, and commands that change them.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "deck/contacts.hpp"
#include "deck/model.hpp"
#include "deck/report.hpp"
#include "edit/shared/write.hpp"
#include "keyword/shared/recognise.hpp"
#include "lint/shared/topics.hpp"
#include "lsp/server.hpp"
#include "verbs/gap_page.hpp"

namespace deck::lsp {
namespace {

std::string path_in(const Json& params) {
  return path_of_uri(params.at("textDocument").at("uri").get<std::string>());
}

}  // namespace

void Server::did_open(const Json& params) {
  const Json& d = params.at("textDocument");
  const std::string path = path_in(params);
  if (path.empty()) return;
  workspace_.open(path, d.at("uri"), d.value("version", std::int64_t{0}),
                  d.at("text").get<std::string>());
  schedule(path, true);
  if (OpenDeck* deck = workspace_.deck_of(path);
      geometry_on_save_ && deck != nullptr && deck->geometry == nullptr)
    start_geometry(*deck);
}

void Server::did_change(const Json& params) {
  const Json& d = params.at("textDocument");
  const std::string path = path_in(params);
  Document* document = workspace_.find(path);
  if (document == nullptr) return;
  std::string& text = workspace_.text(path);
  for (const Json& change : params.at("contentChanges")) {
    const std::string by = change.at("text").get<std::string>();
    const auto range = change.find("range");
    if (range == change.end()) {
      text = by;
      document->lines = std::make_shared<const LineTable>(text);
      continue;
    }
    const auto place = [&](const Json& position) {
      return document->lines->offset(text, place_of(position), client_.encoding);
    };
    const std::uint64_t begin = place(range->at("start")), end = place(range->at("end"));
    replace(text, *document, begin, std::max(begin, end), by);
  }
  document->version = d.value("version", document->version + 1);
  workspace_.changed(path);
  schedule(path);
}

void Server::did_close(const Json& params) {
  const std::string path = path_in(params);
  if (workspace_.find(path) == nullptr) return;
  workspace_.close(path);
  for (const OpenDeck& gone : workspace_.forget_closed()) {
    due_.erase(gone.path);
    if (const auto it = analysing_.find(gone.path); it != analysing_.end()) *it->second = true;
    if (const auto it = examining_.find(gone.path); it != examining_.end()) it->second->stop = true;
    for (const auto& [file, list] : gone.published)
      notify("textDocument/publishDiagnostics",
             {{"uri", workspace_.uri(file)}, {"diagnostics", Json::array()}});
  }
  for (auto& [root, deck] : workspace_.decks()) due_[root] = Clock::now();
}

void Server::did_save(const Json& params) {
  const std::string path = path_in(params);
  OpenDeck* deck = workspace_.deck_of(path);
  if (deck == nullptr) return;
  // Engine files are used as on disk, so the last reading is outdated.
  if (deck->syntax->deck.sources[deck->syntax->file_of(path)].bytes() != workspace_.text(path))
    workspace_.changed(path);
  schedule(path, true);
  if (geometry_on_save_) start_geometry(*deck);
}

/// Changed files that are not open, if the client watches them.
void Server::files_changed(const Json&) {
  workspace_.changed();
  for (auto& [root, deck] : workspace_.decks()) due_[root] = Clock::now();
}

void Server::execute_command(const Json& id, const Json& params) {
  const std::string command = params.at("command").get<std::string>();
  const auto list = params.find("arguments");
  if (list == params.end() || !list->is_array() || list->empty() || !list->front().is_object())
    return fail(id, invalid_params, command + " needs an object as its argument");
  const Json& argument = list->front();
  if (command == "deck.explain") return respond(id, explain(argument));
  if (command == "deck.openGapReport") return open_gap_report(id, argument);
  using Edit = Json (*)(const View&, const Json&);
  const Edit edit_of = command == "deck.setField" ? set_field_edit
                       : command == "deck.fixAll" ? fix_all_edit
                                                  : nullptr;
  if (edit_of == nullptr) return fail(id, invalid_params, "there is no command '" + command + "'");
  const auto view = view_of(argument);
  if (!view) return fail(id, request_failed, "the document is not open, or no deck");
  const Json edit = edit_of(*view, argument);
  request("workspace/applyEdit", {{"label", command}, {"edit", edit}});
  respond(id, nullptr);
}

namespace {

/// The page of `deck gaps --html`.
Result<std::string> write_report(const std::string& path,
                                 const std::map<std::string, std::string>& texts,
                                 const SchemaSet& schemas, const Settings& settings,
                                 const std::vector<std::int64_t>& only,
                                 const std::atomic<bool>& stop) {
  auto loaded = load(path, load_options(settings, texts, schemas));
  if (!loaded) return loaded.error();
  if (std::string other = no_starter_deck(loaded->deck()); !other.empty())
    return cli::config_error(std::move(other));
  loaded->interfaces();
  if (stop) return cli::config_error("cancelled");
  SceneOptions options = loaded->scene_options();
  options.only = only;
  options.ties = true;
  loaded->set_scene_options(options);
  loaded->scene();
  if (stop) return cli::config_error("cancelled");
  HtmlInput input;
  input.path = path;
  return cli::gap_page(*loaded, input, &stop);
}

}  // namespace

void Server::form_report(const Json& id, const View& view, std::vector<std::int64_t> only,
                         std::function<void(std::string html)> then) {
  auto progress = begin_progress("Gap report");
  {
    const std::lock_guard lock(cancelling_);
    reports_[id.dump()] = progress;
  }
  geometer_->push([this, id, progress, only = std::move(only), then = std::move(then),
                   path = view.open.path, texts = workspace_.texts(),
                   &schemas = workspace_.schemas(), settings = workspace_.settings()] {
    auto page = write_report(path, texts, schemas, settings, only, progress->stop);
    queue_.push([this, id, progress, then, page = std::move(page)]() mutable {
      end_progress(progress);
      {
        const std::lock_guard lock(cancelling_);
        reports_.erase(id.dump());
        cancelled_.erase(id.dump());
      }
      if (progress->stop) return fail(id, request_cancelled, "cancelled");
      if (!page) return fail(id, request_failed, page.error().message);
      then(std::move(*page));
    });
  });
}

namespace {

std::vector<std::int64_t> wanted_interfaces(const Json& params) {
  const auto it = params.find("interface");
  if (it == params.end() || !it->is_number_integer()) return {};
  return {it->get<std::int64_t>()};
}

}  // namespace

/// {"textDocument", "interface"?: id, "file"?: path to write} -> {"html"} or {"file"}
void Server::gap_report(const Json& id, const Json& params) {
  const auto view = view_of(params);
  if (!view) return fail(id, request_failed, "the document is not open, or no deck");
  const std::string file = params.value("file", std::string());
  if (!file.empty() && !file.ends_with(".html"))
    return fail(id, invalid_params, "'file' has to end with .html");
  form_report(id, *view, wanted_interfaces(params), [this, id, file](std::string html) {
    if (file.empty()) return respond(id, {{"html", std::move(html)}});
    if (auto written = write_files_atomic({{file, html}}); !written)
      return fail(id, request_failed, written.error().message);
    respond(id, {{"file", file}});
  });
}

/// Command "deck.openGapReport", for clients without their own window.
void Server::open_gap_report(const Json& id, const Json& argument) {
  const auto view = view_of(argument);
  if (!view) return fail(id, request_failed, "the document is not open, or no deck");
  if (report_folder_.empty()) {
    const char* const temporary = std::getenv("TMPDIR");
    std::string folder = std::string(temporary == nullptr ? "/tmp" : temporary) + "/deck-XXXXXX";
    if (mkdtemp(folder.data()) == nullptr)
      return fail(id, request_failed, folder + " cannot be made");
    report_folder_ = folder;
  }
  const std::string file =
      report_folder_ + "/" + std::filesystem::path(view->open.path).stem().string() + ".html";
  form_report(id, *view, wanted_interfaces(argument), [this, id, file](std::string html) {
    if (auto written = write_files_atomic({{file, html}}); !written)
      return fail(id, request_failed, written.error().message);
    request("window/showDocument", {{"uri", uri_of_path(file)}, {"external", true}});
    respond(id, {{"file", file}});
  });
}

/// {"topic"} -> {"text"}: the page of `deck explain`.
Json Server::explain(const Json& params) const {
  const std::string topic = params.at("topic").get<std::string>();
  const auto& open = workspace_.documents();
  const auto config = find_lint_config(open.empty() ? "-" : open.begin()->first);
  const auto rules = use_rules(config ? config->rules : std::vector<RulePage>{});
  std::string page = explain_topic(topic, workspace_.schemas());
  if (page.empty()) throw Refusal{"nothing is known about '" + topic + "'"};
  return {{"text", utf8(page)}};
}

/// {"textDocument", "position"}: position of the cursor.
void Server::cursor_moved(const Json& params) {
  const std::string path = path_in(params);
  OpenDeck* deck = workspace_.deck_of(path);
  if (deck == nullptr) return;
  deck->cursor = Cursor{path, place_of(params.at("position"))};
  if (client_.refresh_hints) request("workspace/inlayHint/refresh", nullptr);
}

}  // namespace deck::lsp
