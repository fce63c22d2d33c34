#include "common.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include "deck/report/json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;

// ---- verbs ----------------------------------------------------------------------------------

namespace {
std::vector<Verb>& registry() {
  static std::vector<Verb> all;
  return all;
}
}  // namespace

VerbRegistration::VerbRegistration(const Verb& verb) { registry().push_back(verb); }

std::vector<Verb> verbs() {
  std::vector<Verb> all = registry();
  // Registration follows link order, which means nothing.
  std::sort(all.begin(), all.end(), [](const Verb& a, const Verb& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.name < b.name;
  });
  return all;
}

// ---- options --------------------------------------------------------------------------------

int CommonOptions::thread_count() const {
  if (threads > 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

bool CommonOptions::color_on(int fd) const {
  if (color == "always") return true;
  if (color == "never") return false;
  const char* no_color = std::getenv("NO_COLOR");
  if (no_color != nullptr && *no_color != '\0') return false;
  const char* term = std::getenv("TERM");
  return isatty(fd) == 1 && (term == nullptr || std::strcmp(term, "dumb") != 0);
}

void add_common_without_decks(CLI::App& app, CommonOptions& options) {
  app.add_option("--json", options.json, "Write JSON to FILE; '-' is standard output")
      ->type_name("FILE");
  app.add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
  app.add_option("--color", options.color, "Colours: auto, always or never (NO_COLOR is honoured)")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->type_name("WHEN");
  app.add_option("--schemas", options.schema_dirs, "Add the keyword schemas (*.json) of DIR")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

void add_common(CLI::App& app, CommonOptions& options, bool with_json) {
  app.add_option("decks", options.decks, "Starter decks (*_0000.rad); '-' is standard input")
      ->required()
      ->type_name("DECK");
  add_common_without_decks(app, options);
  if (!with_json) app.remove_option(app.get_option("--json"));
  app.add_option("--threads", options.threads, "Threads; 0 takes all processors")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  app.add_option("--include-path", options.include_paths,
                 "Search included files in DIR as well (repeatable)")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

// ---- loading --------------------------------------------------------------------------------

Result<SchemaSet> load_schemas(const CommonOptions& options) {
  SchemaSet set = SchemaSet::built_in();
  for (const std::string& dir : options.schema_dirs)
    if (auto added = set.add_directory(dir); !added) return added.error();
  return set;
}

bool Loaded::incomplete() const {
  const auto& counts = deck.diagnostics.counts();
  // Included files that are missing, form a cycle or exceed the limits.
  return counts.contains("DK004") || counts.contains("DK005") || counts.contains("DK006");
}

namespace {
std::function<void(const Deck&)>& load_observer() {
  static std::function<void(const Deck&)> observer;
  return observer;
}
}  // namespace

namespace {
/// A deck of several files that was being rewritten when the program was killed is read as it was
/// to become, never half of it. True if files changed.
Result<bool> finish_rewriting(const std::vector<std::string>& paths, const CommonOptions& options) {
  std::size_t files = 0;
  for (const std::string& path : paths) {
    const auto finished = finish_interrupted_write(path);
    if (!finished) return finished.error();
    files += *finished;
  }
  if (files > 0 && !options.quiet)
    fmt::print(stderr, "deck: note: an interrupted rewriting of {} was finished: {} file{}\n",
               paths.front(), files, files == 1 ? "" : "s");
  return files > 0;
}
}  // namespace

void observe_loading(std::function<void(const Deck&)> observer) {
  load_observer() = std::move(observer);
}

Result<std::unique_ptr<Loaded>> load(const std::string& path, const SchemaSet& schemas,
                                     const CommonOptions& options, Stage stage,
                                     const Overlay* overlay) {
  Progress progress(!options.quiet);
  progress.step("reading " + path);
  ReadOptions read;
  read.include_paths = options.include_paths;
  read.overlay = overlay;
  if (overlay == nullptr)
    if (auto finished = finish_rewriting({path}, options); !finished) return finished.error();
  auto deck = read_deck(path, schemas, read);
  if (!deck) return deck.error();
  if (overlay == nullptr) {
    std::vector<std::string> includes;
    for (std::uint32_t f = 1; f < deck->sources.size(); ++f)
      includes.push_back(deck->sources[f].path());
    const auto finished = finish_rewriting(includes, options);
    if (!finished) return finished.error();
    if (*finished) deck = read_deck(path, schemas, read);
    if (!deck) return deck.error();
  }
  auto loaded = std::make_unique<Loaded>();
  loaded->path = path;
  loaded->deck = std::move(*deck);
  if (load_observer()) load_observer()(loaded->deck);
  if (stage == Stage::blocks) return loaded;
  progress.step("building the model of " + path);
  ModelOptions build;
  build.threads = options.thread_count();
  build.limits = read.limits;
  loaded->model = build_model(loaded->deck, schemas, loaded->diagnostics, build);
  if (stage == Stage::model) return loaded;
  loaded->interfaces = read_interfaces(loaded->deck, loaded->model, loaded->diagnostics);
  return loaded;
}

int for_each_deck(const CommonOptions& options, Stage stage,
                  const std::function<int(Loaded&)>& body) {
  const auto schemas = load_schemas(options);
  if (!schemas) {
    print_error(options, schemas.error().message);
    return exit_usage;
  }
  int worst = exit_clean;
  for (const std::string& path : options.decks) {
    auto loaded = load(path, *schemas, options, stage);
    if (!loaded) {
      print_error(options, loaded.error().message);
      worst = std::max<int>(worst, exit_input);
      continue;
    }
    worst = std::max(worst, body(**loaded));
    if ((*loaded)->incomplete()) worst = std::max<int>(worst, exit_input);
  }
  return worst;
}

// ---- printing -------------------------------------------------------------------------------

namespace {

const char* name_of(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::info:
      break;
  }
  return "info";
}

const char* color_of(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "\x1b[1;31m";
    case Severity::warning:
      return "\x1b[1;33m";
    case Severity::info:
      break;
  }
  return "\x1b[1;36m";
}

}  // namespace

void print_error(const CommonOptions& options, std::string_view message) {
  const bool color = options.color_on(2);
  fmt::print(stderr, "deck: {}error:{} {}\n", color ? "\x1b[1;31m" : "", color ? "\x1b[0m" : "",
             message);
}

std::uint64_t print_findings(const Loaded& loaded, const CommonOptions& options, bool errors_only,
                             std::size_t limit) {
  const bool color = options.color_on(2);
  std::uint64_t errors = 0, shown = 0, hidden = 0;
  for (const Diagnostics* list : {&loaded.deck.diagnostics, &loaded.diagnostics}) {
    for (const Diagnostic& d : list->all()) {
      if (d.severity == Severity::error) ++errors;
      if (errors_only && d.severity != Severity::error) continue;
      if (shown == limit) {
        ++hidden;
        continue;
      }
      ++shown;
      const std::string where = d.span.valid() ? loaded.deck.sources.where(d.span) : loaded.path;
      fmt::print(stderr, "{}: {}{}:{} {} [{}]\n", where, color ? color_of(d.severity) : "",
                 name_of(d.severity), color ? "\x1b[0m" : "", d.message, d.rule);
    }
  }
  if (hidden > 0)
    fmt::print(stderr, "{}: {} more like these; 'deck lint {}' shows them all\n", loaded.path,
               hidden, loaded.path);
  return errors;
}

// ---- output ---------------------------------------------------------------------------------

namespace {

std::string reason(const std::string& what, const std::string& path) {
  return what + " " + path + ": " + std::strerror(errno);
}

}  // namespace

void print_text(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

Result<void> write_output(const std::string& path, std::string_view bytes) {
  if (path != "-") return write_file_atomic(path, bytes);
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
      std::fflush(stdout) != 0)
    return Error{Error::Code::io, reason("cannot write", "standard output")};
  return {};
}

int JsonOutput::finish(int code) const {
  if (!wanted() || documents_.empty()) return code;
  std::string text;
  if (options_.decks.size() <= 1) {
    text = documents_.front();
  } else {
    JsonWriter json(text);
    json.begin_object();
    write_json_head(json, schema_id_, schema_version_);
    json.key("decks").begin_array();
    for (const std::string& d : documents_) {
      const std::string_view document(d);
      json.raw(document.substr(0, document.find_last_not_of('\n') + 1));
    }
    json.end_array().end_object();
  }
  if (auto written = write_output(options_.json, text); !written) {
    print_error(options_, written.error().message);
    return std::max<int>(code, exit_usage);
  }
  return code;
}

}  // namespace deck::cli
