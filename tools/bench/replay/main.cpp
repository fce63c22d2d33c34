// replay: the contact kernel on recorded pair states, compared with the recorded forces.
//   replay DECK STATES --interface ID [--model reference|robust] [--json FILE] [--csv FILE]
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "base/shared/shown_text.hpp"
#include "deck/cycle.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/model.hpp"
#include "replay/replay.hpp"
#include "report/shared/json.hpp"

namespace deck {
namespace {

/// Input of a replay.
struct ReplayInput {
  std::string_view path;    ///< of the deck, as given
  std::string_view states;  ///< of the states
  const Deck* deck = nullptr;
  const InterBase* inter = nullptr;
  cycle::Model model = cycle::Model::reference;
};

void write_vector(JsonWriter& j, const std::vector<double>& v) {
  j.begin_array(true);
  for (const double x : v) j.value(x);
  j.end_array();
}

const char* name_of(cycle::Model model) {
  return model == cycle::Model::reference ? "reference" : "robust";
}

std::string vector_text(const std::vector<double>& v) {
  std::string text;
  for (const double x : v) text += fmt::format("{}{:.10g}", text.empty() ? "" : " ", x);
  return text;
}

std::string replay_json(const ReplayInput& input, const cycle::ReplayReport& r) {
  std::string out;
  JsonWriter j(out);
  j.begin_object();
  write_json_head(j, "deck/replay", 1);
  write_json_deck(j, input.path, *input.deck, nullptr, nullptr);
  j.field("states", input.states).field("interface", input.inter->id);
  j.field("type", input.inter->type).field("kind", r.kind).field("model", name_of(input.model));
  j.field("records", r.records).field("compared", r.compared);
  j.key("relative_error").begin_object(true);
  j.field("median", r.median).field("p99", r.p99).field("max", r.max).end_object();
  j.key("zero_rows").begin_object(true).field("count", r.zero_rows);
  j.field("max_over_k0_gap", r.zero_max_over_k0_gap).end_object();
  j.field("acting", r.acting);
  j.key("columns").begin_array();
  for (const cycle::ReplayColumn& c : r.columns) {
    j.begin_object(true).field("name", c.name).field("rows", c.rows).field("acting", c.acting);
    j.field("median", c.median).field("p99", c.p99).field("max", c.max);
    j.field("zero_max", c.zero_max).end_object();
  }
  j.end_array();
  j.key("worst").begin_array();
  for (const cycle::ReplayWorst& w : r.worst) {
    j.begin_object(true).field("row", w.row).field("relative_error", w.relative_error);
    j.key("reference");
    write_vector(j, w.reference);
    j.key("computed");
    write_vector(j, w.computed);
    j.end_object();
  }
  j.end_array().end_object();
  return out;
}

std::string replay_text(const ReplayInput& input, const cycle::ReplayReport& r) {
  std::string out = fmt::format("{}: {} states ({}) of interface {}, {} compared, model {}\n",
                                terminal_text(input.states), r.records, r.kind, input.inter->id,
                                r.compared, name_of(input.model));
  out += fmt::format("  relative error of the {}: median {:.1e}, 99 % {:.1e}, worst {:.1e}\n",
                     r.kind.starts_with("heat") ? "heat" : "pair force", r.median, r.p99, r.max);
  if (r.zero_rows > 0)
    out += fmt::format("  {} states without {}: at most {:.1e} of {}\n", r.zero_rows,
                       r.kind.starts_with("heat") ? "heat" : "force", r.zero_max_over_k0_gap,
                       r.kind.starts_with("heat") ? "the largest heat" : "K0 gap");
  if (10 * r.acting < 3 * r.records)
    out += fmt::format("  only {} of {} states record any action: this proves little\n", r.acting,
                       r.records);
  for (const cycle::ReplayColumn& c : r.columns)
    out += fmt::format("  {:<12} median {:.1e}, worst {:.1e}, where zero {:.1e}\n", c.name,
                       c.median, c.max, c.zero_max);
  std::size_t shown = 0;
  for (const cycle::ReplayWorst& w : r.worst) {
    if (shown++ == 3) break;
    out += fmt::format("  row {}: recorded ({}), computed ({}), relative {:.1e}\n", w.row,
                       vector_text(w.reference), vector_text(w.computed), w.relative_error);
  }
  return out;
}

struct Options {
  std::string deck, states, csv, json, model = "reference";
  std::vector<std::string> include_paths;
  std::int64_t interface_id = 0;
  bool quiet = false;
};

/// Exit code 3 for unreadable input, as in `deck`.
int unreadable(const std::string& message) {
  fmt::print(stderr, "replay: error: {}\n", terminal_text(message));
  return 3;
}
int wrong_usage(const std::string& message) {
  fmt::print(stderr, "replay: error: {}\n", terminal_text(message));
  return 2;
}

/// False: it could not be written.
bool write(const std::string& path, const std::string& text) {
  if (path == "-") return std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  std::ofstream out(path, std::ios::binary);
  out << text;
  return static_cast<bool>(out.flush());
}

/// The contact of the recorded states: edges for edge states of a TYPE19, else the first.
const Contact* contact_of(const Scene& scene, bool edges) {
  for (const Contact& c : scene.contacts)
    if (!c.dropped && (c.kind == ContactKind::edge_edge) == edges) return &c;
  return nullptr;
}

int run(const Options& o) {
  const auto source = Source::open_text(o.states, Limits{});
  if (!source) return unreadable(source.error().message);
  const std::string_view csv = (*source)->bytes();
  LoadOptions how;
  how.read.include_paths = o.include_paths;
  how.geometry = false;
  auto loaded = load(o.deck, how);
  if (!loaded) return unreadable(loaded.error().message);
  const auto& all = loaded->interfaces().ordered;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const InterBase* i) { return i->id == o.interface_id; });
  if (found == all.end())
    return wrong_usage(fmt::format("{} has no interface {}", o.deck, o.interface_id));
  SceneOptions scene_options = loaded->scene_options();
  scene_options.only = {o.interface_id};
  scene_options.penetrations = scene_options.candidates = scene_options.nodal_stiffness = false;
  loaded->set_scene_options(scene_options);
  const Scene& scene = loaded->scene();
  const std::string_view header = csv.substr(0, csv.find('\n'));
  const bool edges = header.find("hs1") != std::string_view::npos;  // also in edge heat states
  const Contact* contact = contact_of(scene, edges);
  if (contact == nullptr)
    return wrong_usage(o.states + ": the states do not fit the type of interface " +
                       std::to_string(o.interface_id));
  cycle::ReplayOptions options;
  options.interface_id = static_cast<int>(o.interface_id);
  options.model = o.model == "robust" ? cycle::Model::robust : cycle::Model::reference;
  options.scene = &scene;
  options.csv = !o.csv.empty();
  const auto report = cycle::replay(cycle::make_card(scene, *contact), csv, options);
  if (!report.error.empty()) return unreadable(o.states + ": " + report.error);
  if (report.records == 0)
    return unreadable(o.states + ": no state belongs to interface " +
                      std::to_string(o.interface_id));
  const ReplayInput input{loaded->path(), o.states, &loaded->deck(), *found, options.model};
  if (options.csv && !write(o.csv, report.csv)) return wrong_usage(o.csv + " cannot be written");
  if (!o.json.empty() && !write(o.json, replay_json(input, report)))
    return wrong_usage(o.json + " cannot be written");
  if (!o.quiet && o.csv != "-" && o.json != "-") fmt::print("{}", replay_text(input, report));
  return 0;
}

}  // namespace
}  // namespace deck

int main(int argc, char** argv) {
  deck::Options o;
  CLI::App app("The contact kernel on recorded pair states, compared with the recorded forces.",
               "replay");
  app.add_option("deck", o.deck, "Starter deck (*_0000.rad)")->required()->option_text("DECK");
  app.add_option("states", o.states, "Recorded states: CSV, also compressed (.gz)")
      ->required()
      ->option_text("STATES");
  app.add_option("--interface", o.interface_id, "Interface whose states are replayed")->required();
  app.add_option("--model", o.model, "reference or robust")
      ->check(CLI::IsMember({"reference", "robust"}));
  app.add_option("--json", o.json, "Write JSON to FILE; '-' is standard output");
  app.add_option("--csv", o.csv,
                 "Every result column of STATES as computed here, one line per state, preceded by "
                 "the number of its data line");
  app.add_option("--include-path", o.include_paths, "Also search included files in DIR")
      ->allow_extra_args(false);
  app.add_flag("-q,--quiet", o.quiet, "Print nothing but errors");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  return deck::run(o);
}
