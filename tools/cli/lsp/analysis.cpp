// Model, rules and geometry of a deck whose text is in an editor.
#include "lsp/analysis.hpp"

#include <algorithm>

#include "deck/contacts.hpp"
#include "deck/text.hpp"
#include "keyword/shared/recognise.hpp"
#include "lint/shared/baseline.hpp"
#include "lint/shared/geometry.hpp"

namespace deck::lsp {

std::uint32_t Syntax::file_of(const std::string& path) const {
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f)
    if (deck.sources[f].path() == path) return f;
  return Span::no_file;
}

const LineTable& Syntax::lines(std::uint32_t file) const {
  auto& table = tables_[file];
  if (table == nullptr) table = std::make_shared<const LineTable>(deck.sources[file].bytes());
  return *table;
}

const Geometry::Interface* Geometry::find(std::int64_t id, int type) const {
  for (const Interface& i : interfaces)
    if (i.id == id && i.type == type) return &i;
  return nullptr;
}

namespace {

/// Settings of .decklint.toml as in `deck lint`.
Result<LintOptions> lint_options(const LintConfig& config, const std::string& path,
                                 const Limits& limits) {
  LintOptions out;
  out.select = config.select;
  out.ignore = config.ignore;
  out.severity = config.severity;
  out.per_file_ignores = config.per_file_ignores;
  out.findings_per_rule = limits.findings_per_rule;
  if (config.baseline.empty()) return out;
  const auto text = read_config_file(config.baseline, most_baseline_bytes);
  if (!text) return text.error();
  const auto baseline = Baseline::parse(*text, config.baseline, Baseline::Kind::lint);
  if (!baseline) return baseline.error();
  auto accepted = baseline->findings_of(path);
  if (!accepted) return accepted.error();
  out.baseline = std::move(*accepted);
  return out;
}

}  // namespace

LoadOptions load_options(const Settings& settings, const std::map<std::string, std::string>& texts,
                         const SchemaSet& schemas) {
  LoadOptions out;
  out.read.include_paths = settings.include_paths;
  out.read.limits = settings.limits;
  out.read.overlay = &texts;
  out.threads = settings.threads;
  out.geometry = false;
  out.schemas = &schemas;
  return out;
}

std::shared_ptr<const Semantics> analyse(const std::string& path,
                                         const std::map<std::string, std::string>& texts,
                                         std::uint64_t generation, const SchemaSet& schemas,
                                         const Settings& settings, const std::atomic<bool>& stop) {
  auto out = std::make_shared<Semantics>();
  out->generation = generation;
  LoadOptions how = load_options(settings, texts, schemas);
  how.engine_files = true;  // the files of Syntax::deck
  auto loaded = load(path, how);
  out->refusal = loaded ? no_starter_deck(loaded->deck()) : loaded.error().message;
  if (!out->refusal.empty()) return out;
  if (stop) return nullptr;
  loaded->interfaces();
  if (stop) return nullptr;
  const auto config = find_lint_config(path);
  if (!config) out->config_error = config.error().message;
  const auto rules = use_rules(config ? config->rules : std::vector<RulePage>{});
  auto options = lint_options(config ? *config : LintConfig{}, path, settings.limits);
  if (!options) {
    out->config_error = options.error().message;
    options = LintOptions{};
  }
  out->lint = run_lint(*loaded, *options);
  if (stop) return nullptr;
  out->loaded = std::move(*loaded);
  return out;
}

namespace {

/// Data for the lens at an interface and the hover at its default gap.
void note_contacts(const Interfaces& interfaces, const Scene& scene, const SceneView& view,
                   Geometry& out) {
  for (const InterBase* inter : interfaces.ordered) {
    Geometry::Interface row;
    row.id = inter->id;
    row.type = inter->type;
    row.evaluated = first_contact(scene, *inter) != nullptr;
    for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
      if (scene.contacts[c].inter != inter) continue;
      const ContactTotals& totals = view.contacts[c];
      row.nodes += totals.count.nodes;
      row.edges += totals.count.edges;
      row.pairs += totals.count.pairs;
      row.errors += totals.solver_errors;
      row.depth = std::max(row.depth, totals.max_depth);
      row.evaluated = row.evaluated && scene.contacts[c].evaluated;
    }
    if (const Contact* first = first_contact(scene, *inter))
      visit_interface(*inter, [&](const auto& typed) {
        typed.for_each([&](std::string_view name, const auto& field) {
          if (field.origin == Origin::geometry)
            row.values.emplace_back(name, shortest(geometry_value(*first, name)));
        });
      });
    out.interfaces.push_back(std::move(row));
  }
}

}  // namespace

std::shared_ptr<const Geometry> examine(
    const std::string& path, const std::map<std::string, std::string>& texts,
    const SchemaSet& schemas, const Settings& settings,
    const std::function<void(std::size_t, std::size_t)>& progress, const std::atomic<bool>& stop) {
  auto loaded = load(path, load_options(settings, texts, schemas));
  if (!loaded || stop || !no_starter_deck(loaded->deck()).empty()) return nullptr;
  loaded->interfaces();
  if (stop) return nullptr;
  SceneOptions contacts = loaded->scene_options();
  contacts.candidates = false;
  contacts.ties = true;
  contacts.progress = progress;
  loaded->set_scene_options(contacts);
  auto out = std::make_shared<Geometry>();
  const Scene& scene = loaded->scene();
  if (stop) return nullptr;
  note_contacts(loaded->interfaces(), scene, make_view(scene), *out);
  const auto config = find_lint_config(path);
  const auto rules = use_rules(config ? config->rules : std::vector<RulePage>{});
  auto options = lint_options(config ? *config : LintConfig{}, path, settings.limits);
  if (!options) options = LintOptions{};
  Gate gate = config ? config->gate : Gate{};
  gate.on_fresh = gate.on_worse = false;  // no earlier run in the editor
  std::vector<ExtraCheck> extra;
  const bool wanted = !config || config->geometry.value_or(true);
  if (wanted)
    extra.push_back([&](const LintContext& context, Reporter& reporter) {
      return check_geometry(context, reporter, {std::nullopt, &gate, nullptr});
    });
  LintResult result = run_lint(*loaded, *options, extra);
  for (Finding& d : result.findings) {
    const RuleStage stage = rule_of(d.rule).stage;
    if ((stage != RuleStage::extra && stage != RuleStage::gate) || !d.span.valid()) continue;
    const Source& source = loaded->deck().sources[d.span.file];
    d.notes.clear();  // their places are of an earlier text
    const std::string_view line = source.line_at(d.span.offset);
    out->findings.push_back(
        {source.path(), std::string(line), source.position(d.span.offset).line - 1,
         static_cast<std::uint64_t>(line.data() - source.bytes().data()), std::move(d)});
  }
  return out;
}

}  // namespace deck::lsp
