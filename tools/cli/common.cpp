// Options shared by verbs, and loading of decks.
#include "common.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/shared/parallel.hpp"
#include "base/shared/paths.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "deck/contacts.hpp"
#include "deck/lint.hpp"
#include "deck/model.hpp"
#include "deck/rule_id.hpp"
#include "deck/text.hpp"
#include "keyword/shared/recognise.hpp"
#include "library.hpp"
#include "lint/shared/config.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {

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
  // The registration order is arbitrary (link order).
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

std::size_t terminal_width(int fd) {
  winsize size{};
  return isatty(fd) == 1 && ioctl(fd, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::size_t text_width() {
  if (const std::size_t width = terminal_width(1); width > 0) return width;
  const char* columns = std::getenv("COLUMNS");
  const IntegerCell n = read_integer(columns == nullptr ? "" : columns);
  return n.status == NumberStatus::ok && n.value > 0 ? static_cast<std::size_t>(n.value) : 0;
}

void add_common_without_decks(CommandLine& line, CommonOptions& options) {
  options.session = &line.session();
  line.option("--json FILE", options.json, "Write JSON to FILE; '-' is standard output");
  line.flag("-q,--quiet", options.quiet, "Print nothing but errors");
  line.option("--color WHEN", options.color,
              "Colours: auto, always or never (NO_COLOR is respected)")
      .one_of({"auto", "always", "never"});
  line.option("--schemas DIR", options.schema_dirs, "Add the keyword schemas (*.json) of DIR")
      .one_each();
}

void add_common(CommandLine& line, CommonOptions& options, bool with_json) {
  line.option("DECK", options.decks, "Starter decks (*_0000.rad); '-' is standard input")
      .value("")
      .required();
  add_common_without_decks(line, options);
  if (!with_json) line.remove("--json");
  line.option("--threads N", options.threads, "Threads; 0: all processors").range(0, 1024);
  line.bytes(
      "--max-memory SIZE",
      [&options](std::uint64_t bytes) {
        options.limits.pair_bytes = options.limits.selection_bytes = bytes;
      },
      "Memory for two things, for each of them: the pairs of one contact (without the option "
      "2GB) and the members of all groups (4GB); what needs more is not evaluated, with a "
      "finding");
  line.option("--include-path DIR", options.include_paths,
              "Also search included files in DIR (repeatable)")
      .one_each();
}

std::vector<std::string> handed_on(const CommonOptions& options) {
  std::vector<std::string> words;
  for (const std::string& dir : options.include_paths)
    words.insert(words.end(), {"--include-path", dir});
  for (const std::string& dir : options.schema_dirs) words.insert(words.end(), {"--schemas", dir});
  if (options.limits.pair_bytes != Limits{}.pair_bytes)
    words.insert(words.end(), {"--max-memory", std::to_string(options.limits.pair_bytes)});
  return words;
}

void allow_directories(CommandLine& line) {
  line.existing("DECK").describe(
      "Starter decks, or directories: all *_0000.rad below them; '-' is standard input");
}

int open_directories(CommonOptions& options) {
  auto decks = decks_in_directories(options.decks);
  if (!decks) return failed(options, decks.error(), exit_input);
  options.decks = std::move(*decks);
  return exit_clean;
}

void add_require_examined(CommandLine& line, CommonOptions& options) {
  line.flag("--require-examined", options.require_examined,
            "Exit 1 if the deck has no interface of an examined type (" +
                examined_types(Examined::contacts_and_ties) + ")");
}

void add_verbose(CommandLine& line, CommonOptions& options, const std::string& what) {
  line.flag("-v,--verbose", options.verbose, what);
}

void add_accuracy(CommandLine& line, std::string& value) {
  line.option("--accuracy", value,
              "Which arithmetic decides that a pair is in contact: fast (plain double), reference "
              "(the solver's), robust (double, exact where in doubt), exact (rationals)")
      .one_of({"fast", "reference", "robust", "exact"})
      .show_default();
}

Accuracy accuracy_of(const std::string& value) {
  for (const Accuracy a : {Accuracy::fast, Accuracy::reference, Accuracy::exact})
    if (value == to_string(a)) return a;
  return Accuracy::robust;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const auto colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown processor";
}

// ---- loading --------------------------------------------------------------------------------

Result<LoadedSchemas> load_schemas(const CommonOptions& options) {
  if (options.schema_dirs.empty()) return LoadedSchemas();
  SchemaSet set = SchemaSet::built_in();
  for (const std::string& dir : options.schema_dirs) {
    if (auto added = set.add_directory(dir); !added) return added.error();
    for (const std::filesystem::path& file : entries_of(dir))
      if (file.extension() == ".json") options.session->remember_read(file.string());
  }
  return LoadedSchemas(std::move(set));
}

void add_rules(CommandLine& line, CommonOptions& options) {
  line.option("--rules DIR", options.rules,
              "Also the rules of your own whose pages (X101.md) are in DIR; goes before 'rules' of "
              ".decklint.toml");
}

Result<std::vector<RulePage>> team_rules(const CommonOptions& options, bool of_directory) {
  if (options.rules.empty()) {
    const auto config = of_directory ? find_lint_config("-") : LintConfig{};
    return config ? config->rules : std::vector<RulePage>{};
  }
  auto pages = read_rules(options.rules);
  if (pages)
    for (const RulePage& page : *pages) options.session->remember_read(page.path);
  return pages;
}

const Scene& resolve_geometry(const LoadedDeck& loaded, const CommonOptions& options) {
  Progress progress(!options.quiet);
  if (waits_for_geometry(loaded.interfaces())) progress.step("deriving gaps from the geometry");
  return loaded.mesh_values([&](std::size_t done, std::size_t all) { progress.update(done, all); });
}

namespace {

/// Read-only verbs print a note about an interrupted write of this deck.
void warn_of_interrupted(const std::string& main, const CommonOptions& options) {
  const auto note = options.rewrites || options.quiet ? std::nullopt : unfinished_note(main);
  if (!note) return;
  print_messages(fmt::format(
      "deck: note: writing {} was interrupted ({}): some of its files may be old and some new; "
      "the next convert --in-place, fix --in-place or lint --fix of it finishes this\n",
      terminal_text(main), terminal_text(*note)));
}

/// A mapped file that changes during reading is inconsistent. Smaller files are read at once and
/// compared before they are replaced.
Result<void> check_mapped(const Deck& deck, const Limits& limits, const timespec& since) {
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f) {
    const Source& source = deck.sources[f];
    struct stat status {};
    if (source.inode() == 0 || source.on_disk().size() <= limits.map_threshold) continue;
    if (stat(source.path().c_str(), &status) != 0) continue;
    const auto moment = [](const timespec& t) { return std::pair{t.tv_sec, t.tv_nsec}; };
    if (moment(status.st_mtim) >= moment(since))
      return config_error(source.path() +
                          " was changed while it was read; nothing was written. "
                          "Run the command again");
  }
  return {};
}

/// Reads the deck and checks it before rewriting.
Result<Deck> read_for_rewriting(const std::string& path, const SchemaSet& schemas,
                                const CommonOptions& options, const ReadOptions& read) {
  timespec since{};
  clock_gettime(CLOCK_REALTIME_COARSE, &since);
  auto deck = read_deck(path, schemas, read);
  if (!deck || read.overlay != nullptr) return deck;
  warn_of_interrupted(path, options);
  if (options.rewrites)
    if (auto same = check_mapped(*deck, read.limits, since); !same) return same.error();
  return deck;
}

}  // namespace

void note_found(const std::string& given, const std::string& path, const CommonOptions& options) {
  if (path != given && !options.quiet) print_note(given + " is not there; reading " + path);
}

std::vector<Crossing> crossings_and_findings(LoadedDeck& loaded, int threads) {
  const Scene& scene = loaded.scene();
  std::vector<Crossing> crossings;
  // Crossings only read the scene; findings write interfaces, selections, tables of the mesh.
  parallel_items(threads, 2, [&](std::size_t task) {
    if (task == 0) crossings = find_crossings(scene, threads);
    if (task == 1) report_solver_errors(loaded), loaded.findings();
  });
  return crossings;
}

LoadOptions load_options(const CommonOptions& options, const SchemaSet& schemas,
                         const Overlay* overlay) {
  LoadOptions out;
  out.read.include_paths = options.include_paths;
  out.read.overlay = overlay;
  out.read.limits = options.limits;
  out.threads = options.thread_count();
  out.geometry = false;
  out.engine_files = options.engine_files;
  out.schemas = &schemas;
  return out;
}

Result<LoadedDeck> load(const std::string& given, const SchemaSet& schemas,
                        const CommonOptions& options, Stage stage, const Overlay* overlay) {
  const std::string path = overlay == nullptr ? find_deck(given) : given;
  note_found(given, path, options);
  Progress progress(!options.quiet);
  progress.step("reading " + path);
  const LoadOptions how = load_options(options, schemas, overlay);
  auto deck = read_for_rewriting(path, schemas, options, how.read);
  if (!deck) {
    Error error = deck.error();
    if (std::error_code ec; path != "-" && !std::filesystem::exists(path, ec))
      if (const std::string close = similar_file(path); !close.empty())
        error.message += "; did you mean '" + close + "'?";
    return error;
  }
  LoadedDeck loaded = LoadedDeck::from(std::move(*deck), how);
  options.session->remember_read(loaded.deck().sources);
  if (const std::string other = no_starter_deck(loaded.deck()); !other.empty())
    return Error{Error::Code::syntax, path + ": " + other};
  if (std::string old = unread_version(loaded.deck()); !old.empty() && !options.unread_too)
    return Error{Error::Code::syntax, std::move(old)};
  if (stage < Stage::model) return loaded;
  progress.step("building the model of " + path);
  loaded.interfaces();
  return loaded;
}

int for_each_deck(const CommonOptions& options, const std::function<int(LoadedDeck&)>& body) {
  const auto schemas = load_schemas(options);
  if (!schemas) return failed(options, schemas.error());
  if (const int refused = check_outputs(options, {options.json}); refused != exit_clean)
    return refused;
  int worst = exit_clean;
  const auto one = [&](const std::string& path) {
    auto loaded = load(path, *schemas, options);
    if (!loaded) return failed(options, loaded.error(), reading_code(loaded.error()));
    const int code = std::max(body(*loaded), examined_code(*loaded, options));
    return loaded->incomplete() ? std::max<int>(code, exit_input) : code;
  };
  for (const std::string& path : options.decks)
    worst = std::max(worst, options.session->about(path, [&] { return one(path); }));
  return worst;
}

int examined_code(const LoadedDeck& loaded, const CommonOptions& options) {
  if (!options.require_examined) return exit_clean;
  const bool nothing =
      coverage_of(loaded.deck(), loaded.interfaces(), Examined::contacts_and_ties).nothing();
  return nothing ? exit_findings : exit_clean;
}

namespace {

/// "1, 2, 3 and 4 more"; if `wanted` may be a hidden one, the closest.
std::string list_of(const std::vector<std::int64_t>& ids, std::int64_t wanted) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, ids.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", ids[i]);
  if (ids.size() <= most) return text;
  std::vector<std::string> words;
  for (const std::int64_t id : ids) words.push_back(std::to_string(id));
  const std::string close = closest_word(std::to_string(wanted), words);
  return text + fmt::format(" and {} more", ids.size() - most) +
         (close.empty() ? close : "; did you mean " + close + "?");
}

}  // namespace

Result<void> check_interfaces(const LoadedDeck& loaded, const std::vector<std::int64_t>& ids,
                              std::string_view option, Examined which) {
  std::vector<std::int64_t> known;
  const bool ties = which == Examined::contacts_and_ties;
  for (const InterBase* i : ties ? loaded.interfaces().all : loaded.interfaces().ordered)
    known.push_back(i->id);
  std::sort(known.begin(), known.end());
  for (const std::int64_t id : ids) {
    if (std::binary_search(known.begin(), known.end(), id)) continue;
    std::string text = fmt::format("{} {}: {} has no interface {} of {}", option, id, loaded.path(),
                                   id, examined_types(which));
    for (const NotExamined& n : coverage_of(loaded.deck(), loaded.interfaces(), which).not_examined)
      if (std::find(n.ids.begin(), n.ids.end(), id) != n.ids.end())
        text += fmt::format("; {}/{} is of a type that is not examined", n.keyword, id);
    text += known.empty() ? "; it has none at all" : "; it has " + list_of(known, id);
    return config_error(text);
  }
  return {};
}

Result<void> check_parts(const LoadedDeck& loaded, const std::vector<std::int64_t>& ids,
                         std::string_view option) {
  for (const std::int64_t id : ids) {
    if (loaded.model().part_of_id.contains(id)) continue;
    std::vector<std::int64_t> known;
    for (const Part& p : loaded.model().parts) known.push_back(p.id);
    std::sort(known.begin(), known.end());
    return config_error(
        fmt::format("{} {}: {} has no part {}; {}", option, id, loaded.path(), id,
                    known.empty() ? "it has none at all" : "it has " + list_of(known, id)));
  }
  return {};
}

// ---- printing -------------------------------------------------------------------------------

namespace {

const char* color_of(Severity severity) {
  return severity == Severity::error     ? "\x1b[1;31m"
         : severity == Severity::warning ? "\x1b[1;33m"
                                         : "\x1b[1;36m";
}

}  // namespace

void print_error(const CommonOptions& options, std::string_view message) {
  const bool color = options.color_on(2);
  print_messages(fmt::format("deck: {}error:{} {}\n", color ? "\x1b[1;31m" : "",
                             color ? "\x1b[0m" : "", terminal_text(message)));
  if (BatchHooks* frame = options.session->frame) frame->note_error(message);
}

int failed(const CommonOptions& options, std::string_view message, int code) {
  print_error(options, message);
  return code;
}

int failed(const CommonOptions& options, const Error& error, int code) {
  return failed(options, std::string_view(error.message), code);
}

int reading_code(const Error& error) {
  return error.code == Error::Code::config     ? exit_usage
         : error.code == Error::Code::internal ? exit_internal
                                               : exit_input;
}

std::uint64_t print_findings(const LoadedDeck& loaded, const CommonOptions& options,
                             bool errors_only, std::size_t limit) {
  const bool color = options.color_on(2);
  std::uint64_t errors = 0, shown = 0;
  const Findings found = loaded.findings(loaded.reached());
  for (const Finding& d : found.all()) {
    if (d.severity == Severity::error) ++errors;
    // Findings that explain "not evaluated" or a wrong verdict are always printed.
    const bool vital = d.severity == Severity::error || d.rule == RuleId::DK004 ||
                       d.rule == RuleId::DK334 || d.rule == RuleId::DK336 ||
                       d.rule == RuleId::DK380;
    if (errors_only && !vital) continue;
    if (shown++ >= limit) continue;
    const std::string where = d.span.valid() ? loaded.deck().sources.where(d.span) : loaded.path();
    print_messages(fmt::format("{}: {}{}:{} {} [{}]\n", terminal_text(where),
                               color ? color_of(d.severity) : "", to_string(d.severity),
                               color ? "\x1b[0m" : "", terminal_text(d.message), finding_name(d)));
  }
  if (shown > limit)
    print_messages(fmt::format("{0}: {1} more like these; 'deck lint {0}' shows them all\n",
                               terminal_text(loaded.path()), shown - limit));
  return errors;
}

// ---- output ---------------------------------------------------------------------------------

void print_text(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_lines(std::string_view text) { print_text(folded(text, text_width())); }

void print_messages(std::string_view text) {
  const std::string lines = folded(text, terminal_width(2));
  std::fwrite(lines.data(), 1, lines.size(), stderr);
}

void print_contents(std::string_view text) {
  if (isatty(1) == 1)
    print_text(terminal_lines(text));
  else
    print_text(text);
}

void print_note(std::string_view note) {
  print_messages(fmt::format("deck: note: {}\n", terminal_text(note)));
}

void JsonOutput::add(const MakeText& make) {
  if (options_.decks.size() > 1) return add(make({}));
  if (auto written = options_.session->write_output(options_.json, make); !written) {
    print_error(options_, written.error().message);
    failed_ = true;
  }
}

std::string JsonOutput::text() const {
  if (options_.decks.size() <= 1) return documents_.empty() ? std::string() : documents_.front();
  std::string list;
  JsonWriter json(list);
  json.begin_object();
  write_json_head(json, schema_id_, schema_version_);
  json.key("decks").begin_array();
  for (const std::string& d : documents_) {
    const std::string_view document(d);
    json.raw(document.substr(0, document.find_last_not_of('\n') + 1));
  }
  json.end_array().end_object();
  return list;
}

int JsonOutput::write(int code) const {
  if (failed_) return std::max<int>(code, exit_usage);
  if (!wanted() || documents_.empty()) return code;
  if (auto written = options_.session->write_output(options_.json, text()); !written) {
    print_error(options_, written.error().message);
    return std::max<int>(code, exit_usage);
  }
  return code;
}

// ---- progress ------------------------------------------------------------------------------

using std::chrono::steady_clock;
constexpr std::chrono::milliseconds patience{300}, refresh{100};

Progress::Progress(bool enabled)
    : enabled_(enabled && isatty(2) == 1), start_(steady_clock::now()), last_(start_) {}

Progress::~Progress() { clear(); }

void Progress::step(std::string_view what) {
  if (!enabled_) return;
  what_ = terminal_text(what);
  if (steady_clock::now() - start_ > patience) draw(-1);
}

void Progress::update(std::uint64_t done, std::uint64_t total, std::string_view what) {
  if (!enabled_) return;
  if (!what.empty()) what_ = terminal_text(what);
  const auto now = steady_clock::now();
  if (now - start_ < patience || now - last_ < refresh) return;
  last_ = now;
  draw(total == 0 ? -1 : static_cast<double>(done) / static_cast<double>(total));
}

void Progress::draw(double share) {
  constexpr int width = 30;
  // A wrapped line could not be overwritten.
  constexpr std::size_t bar = width + 10;
  const std::size_t columns = std::max<std::size_t>(terminal_width(2), bar + 10);
  std::string line = "\r\x1b[K" + cut_to(what_, columns - bar);
  if (share >= 0) {
    const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
    line += fmt::format(" [{}{}] {:3.0f} %", std::string(static_cast<std::size_t>(full), '#'),
                        std::string(static_cast<std::size_t>(width - full), '.'),
                        100 * std::clamp(share, 0.0, 1.0));
  } else {
    line += " ...";
  }
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace deck::cli
