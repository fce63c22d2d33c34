// Writes what a repository needs for a gate: settings, the documents to compare with, a workflow.
#include "verbs/gate/init.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "base/shared/paths.hpp"
#include "deck/report/gaps.hpp"
#include "library.hpp"
#include "lint/shared/config.hpp"
#include "report/shared/json.hpp"
#include "verbs/gate/history.hpp"
#include "verbs/lint/lint_run.hpp"

namespace deck::cli {
namespace writing_gate {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view config_name = ".decklint.toml", lint_name = "lint-baseline.json",
                           gaps_name = "gaps-baseline.json";

std::string config_text() {
  std::string out =
      "# The gate of the decks below this directory: 'deck gate' stops at what is not in the two\n"
      "# baselines. 'deck lint --init' elsewhere shows every key that may stand here.\n"
      "# Accepted findings; written by 'deck lint --write-baseline':\n"
      "baseline = \"" +
      std::string(lint_name) +
      "\"\n\n[gate]\n"
      "# Accepted penetrations, written by 'deck gaps --write-baseline': new and deeper ones "
      "stop.\n"
      "baseline = \"" +
      std::string(gaps_name) + "\"\n";
  for (const ConfigKey& k : config_keys())
    if (k.table == "gate" && k.key.starts_with("max-"))
      out += fmt::format("# {}\n# {} = {}\n", k.meaning, k.key, k.example);
  return out;
}

std::string package() { return "./tools/libdeck_" + std::string(library_version()) + "_amd64.deb"; }

/// `decks`: as words of a shell, each after a blank.
std::string github_text(const std::string& decks) {
  return "# Written by 'deck gate --init'. " + package() +
         " has to be in the repository, or be fetched here.\n"
         "name: deck gate\n"
         "on: [pull_request]\n"
         "jobs:\n"
         "  gate:\n"
         "    runs-on: ubuntu-latest\n"
         "    container: debian:12\n"
         "    permissions: { contents: read, security-events: write }\n"
         "    steps:\n"
         "      - run: apt-get update && apt-get install -y ca-certificates git\n"
         "      - uses: actions/checkout@v4\n"
         "        with: { fetch-depth: 0 }\n"
         "      - run: git config --global --add safe.directory \"$GITHUB_WORKSPACE\"\n"
         "      - run: apt-get install -y " +
         package() +
         "\n"
         "      - run: >-\n"
         "          deck gate" +
         decks +
         " --since \"origin/$GITHUB_BASE_REF\"\n"
         "          --format github -o sarif=deck.sarif\n"
         "      - uses: github/codeql-action/upload-sarif@v3\n"
         "        if: always()\n"
         "        with: { sarif_file: deck.sarif }\n";
}

std::string gitlab_text(const std::string& decks) {
  return "# Written by 'deck gate --init'. In .gitlab-ci.yml: include: [{ local: "
         ".gitlab/deck-gate.yml }]\n"
         "# " +
         package() +
         " has to be in the repository, or be fetched here.\n"
         "deck-gate:\n"
         "  image: debian:12\n"
         "  variables: { GIT_DEPTH: \"0\" }\n"
         "  rules: [{ if: '$CI_PIPELINE_SOURCE == \"merge_request_event\"' }]\n"
         "  script:\n"
         "    - apt-get update && apt-get install -y git " +
         package() +
         "\n"
         "    - git config --global --add safe.directory \"$CI_PROJECT_DIR\"\n"
         "    - >-\n"
         "      deck gate" +
         decks +
         " --since \"$CI_MERGE_REQUEST_DIFF_BASE_SHA\"\n"
         "      -o gitlab=deck.json -o junit=deck.xml\n"
         "  artifacts: { when: always, reports: { codequality: deck.json, junit: deck.xml } }\n";
}

/// What the repository looks like: its own files, else its remotes.
std::string forge_of(const std::string& root) {
  std::error_code ec;
  if (fs::exists(fs::path(root) / ".gitlab-ci.yml", ec) ||
      fs::exists(fs::path(root) / ".gitlab", ec))
    return "gitlab";
  if (fs::exists(fs::path(root) / ".github", ec)) return "github";
  const auto config = read_config_file((fs::path(root) / ".git" / "config").string(), 1 << 20);
  return config && config->find("gitlab") != config->npos ? "gitlab" : "github";
}

/// The decks with what is accepted of them.
struct Today {
  struct One {
    std::string path;
    LoadedDeck loaded;
    LintResult result;
  };
  std::vector<std::unique_ptr<One>> decks;
  std::string gaps;
  std::size_t penetrating = 0;
};

/// Reads and lints all decks. Returns exit_clean, or what is wrong, said.
int look(const CommonOptions& common, const SchemaSet& schemas, const std::string& gaps_path,
         Today& out) {
  JsonOutput gaps(common, "deck/gaps", gaps_version);
  for (const std::string& path : common.decks) {
    auto loaded = load(path, schemas, common);
    if (!loaded || loaded->incomplete()) {
      if (loaded) print_findings(*loaded, common);
      print_error(common, (loaded ? path + ": an include is missing" : loaded.error().message) +
                              "; nothing was written");
      return exit_input;
    }
    auto one = std::make_unique<Today::One>(Today::One{path, std::move(*loaded), {}});
    std::string document;
    one->result = lint_loaded(
        one->loaded, {}, Geometry::all, {}, [&](const Scene& scene, const SceneView& view) {
          document =
              gaps_json(name_in_baseline(path, gaps_path), one->loaded.deck(), scene, view, false);
          out.penetrating += view.deepest_per_node.size();
        });
    if (document.empty()) {  // without interfaces nothing is looked at
      const Scene& scene = one->loaded.scene();
      document = gaps_json(name_in_baseline(path, gaps_path), one->loaded.deck(), scene,
                           make_view(scene), false);
      one->loaded.drop_scene();
    }
    gaps.add(std::move(document));
    out.decks.push_back(std::move(one));
  }
  out.gaps = gaps.text();
  return exit_clean;
}

/// A file to be written, with its text.
struct NewFile {
  std::string path, text;
};

std::vector<NewFile> files_of(const Today& today, const fs::path& root, const std::string& forge,
                              const std::string& decks) {
  std::vector<BaselinedDeck> baselined;
  for (const auto& one : today.decks)
    baselined.push_back({one->path, &one->loaded.deck(), &one->result});
  const std::string lint = (root / lint_name).string();
  const bool github = forge == "github";
  return {{(root / config_name).string(), config_text()},
          {lint, write_baseline(baselined, lint)},
          {(root / gaps_name).string(), today.gaps},
          {(root / (github ? ".github/workflows/deck-gate.yml" : ".gitlab/deck-gate.yml")).string(),
           github ? github_text(decks) : gitlab_text(decks)}};
}

/// The arguments as they are called from the top of the work tree.
std::string decks_in_tree(const std::vector<std::string>& given, const std::string& root) {
  std::string out;
  for (const std::string& path : given) {
    const std::string inside =
        fs::path(absolute_path(path)).lexically_relative(root).generic_string();
    if (inside != ".") out += " " + shell_word(inside);
  }
  return out;
}

void tell(const Today& today, const std::vector<NewFile>& files, const fs::path& root,
          const std::string& decks) {
  std::string out;
  for (const NewFile& f : files)
    out +=
        "wrote " + terminal_text(fs::path(f.path).lexically_relative(root).generic_string()) + "\n";
  std::uint64_t errors = 0;
  for (const auto& one : today.decks) errors += one->result.errors;
  out += fmt::format(
      "Accepted as it is today: {} of lint, {} in {}. Commit these files; 'deck gate{}' runs the "
      "gate. The workflow needs {}.\n",
      count(errors, "error", "errors"),
      count(today.penetrating, "penetrating node or edge", "penetrating nodes and edges"),
      count(today.decks.size(), "deck", "decks"), terminal_text(decks),
      package() + (files.back().path.ends_with("workflows/deck-gate.yml")
                       ? ""
                       : ", and .gitlab-ci.yml has to include .gitlab/deck-gate.yml"));
  print_lines(out);
}

}  // namespace
}  // namespace writing_gate

int init_gate(const CommonOptions& given, const GateInit& init) {
  using namespace writing_gate;
  const auto fail = [&](const std::string& message, int code = exit_usage) {
    print_error(given, message);
    return code;
  };
  CommonOptions common = given;
  const auto decks = decks_in_directories(given.decks);
  if (!decks) return fail(decks.error().message, exit_input);
  common.decks = *decks;
  const std::string root = library_root(common.decks.front());
  std::error_code ec;
  if (!fs::exists(fs::path(root) / ".git", ec))
    return fail(common.decks.front() + " is in no git work tree; --init writes into one");
  for (const std::string& path : common.decks)
    if (library_root(path) != root) return fail(path + " is in another git work tree than " + root);
  const std::string forge = init.forge.empty() ? forge_of(root) : init.forge;
  const std::string words = decks_in_tree(given.decks, root);
  // Before the decks are looked at, which takes time.
  if (!init.overwrite)
    for (const NewFile& f : files_of({}, root, forge, words))
      if (fs::symlink_status(f.path, ec).type() != fs::file_type::not_found)
        return fail(f.path +
                    " is there already; nothing was written (--overwrite replaces it, with all "
                    "that --init writes)");
  for (const std::string_view name : {lint_name, gaps_name})
    if (auto kept = keeps_other_decks((fs::path(root) / name).string(), common.decks); !kept)
      return fail(kept.error().message);
  const auto schemas = load_schemas(common);
  if (!schemas) return fail(schemas.error().message);
  Today today;
  const std::string gaps_path = (fs::path(root) / gaps_name).string();
  if (const int code = look(common, *schemas, gaps_path, today); code != exit_clean) return code;
  const std::vector<NewFile> files = files_of(today, root, forge, words);
  std::vector<OutputFile> written_files;
  for (const NewFile& f : files) written_files.push_back({f.path, f.text});
  OutputRules rules;
  rules.overwrite = init.overwrite;
  if (auto written = common.session->write_outputs(written_files, rules); !written)
    return fail(written.error().message);
  if (common.quiet) return exit_clean;
  tell(today, files, root, words);
  std::size_t young = 0;
  for (const auto& one : today.decks) {
    if (init.commits == 0) break;
    const auto past = gate_history(one->loaded, init.commits, common);
    if (!past) return fail(past.error().message);
    if (past->empty())
      ++young;
    else
      print_lines("\n" + *past);
  }
  if (young > 0)
    print_lines(fmt::format("\n{} fewer than two commits: nothing to look back at yet.\n",
                            count(young, "deck has", "decks have")));
  return exit_clean;
}

}  // namespace deck::cli
