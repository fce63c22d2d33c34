// deck batch: runs one verb on many decks, each in a worker process; writes one result file per
// deck and a summary. Records of finished decks let a killed batch continue.

#include <algorithm>
#include <filesystem>

#include "batch/record.hpp"
#include "batch/run.hpp"
#include "changes.hpp"
#include "library.hpp"
#include "verbs/gap_page.hpp"

namespace deck::cli::verb_batch {
namespace {

bool is_verb_of_a_batch(std::string_view word) {
  constexpr std::string_view all[] = {"lint", "params", "gaps", "cycle", "convert", "fix"};
  return std::find(std::begin(all), std::end(all), word) != std::end(all);
}
/// Options that write one file, or that the batch has itself.
const std::vector<std::string> not_in_a_batch = {
    "--json", "--csv",   "--vtk",   "--html",    "--compare",        "--output", "--format",
    "--diff", "--quiet", "--color", "--threads", "--write-baseline", "--report"};

/// Value of an option in the words of a verb; empty: absent.
std::string value_among(const std::vector<std::string>& words, const std::string& option) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == option && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with(option + "=")) return words[i].substr(option.size() + 1);
  }
  return {};
}

/// Reads the options of a verb that writes decks.
void parse_writing(BatchTask& task, const CommandLine& line) {
  if (task.converts()) task.to_json = value_among(task.words, "--to") == "json";
  task.writes = task.converts() || task.verb.name == "fix" || line.has_option("--fix") ||
                line.has_option("--unsafe-fixes");
  if (!task.writes) return;
  task.in_place = task.verb.name == "lint" || line.has_option("--in-place");
  task.root = value_among(task.words, "--root");
}

/// Error: unknown verb, or options that it does not have.
Result<BatchTask> parse_task(const BatchOptions& o) {
  const auto refuse = [&](const std::string& why) {
    return config_error("--verb '" + o.verb + "': " + why);
  };
  BatchTask task;
  const std::vector<std::string> words = split_words(o.verb);
  if (words.empty()) return refuse("name a verb");
  for (const Verb& v : verbs())
    if (v.name == words.front() && is_verb_of_a_batch(v.name)) task.verb = v;
  if (task.verb.setup == nullptr)
    return refuse("expected lint, params, gaps, cycle, convert or fix");
  task.words.assign(words.begin() + 1, words.end());
  CommandLine line("", std::string(task.verb.name), *o.common.session);
  const Action action = task.verb.setup(line);  // owns the storage of the options
  std::vector<std::string> arguments = task.words;
  task.pages = std::erase(arguments, "--html") > 0;  // each deck has one of its own name
  if (task.pages && task.verb.name != "gaps" && task.verb.name != "cycle")
    return refuse("--html is for gaps and cycle");
  if (const std::string why = task.pages ? no_viewer("page") : ""; !why.empty()) return refuse(why);
  task.options = arguments;
  arguments.insert(arguments.end(), {"--", "deck"});
  if (const auto parsed = line.parse(arguments); !parsed) return refuse(parsed.error().message);
  for (const std::string& name : not_in_a_batch)
    if (line.has_option(name)) return refuse(name + " is not for a batch");
  if (line.existing("DECK").count() != 1) return refuse("decks are named after the options");
  parse_writing(task, line);
  const std::vector<std::string> common = handed_on(o.common);
  task.options.insert(task.options.begin(), common.begin(), common.end());
  if (o.common.require_examined && task.verb.name != "convert")
    task.options.push_back("--require-examined");
  return task;
}

/// In place: files that decks outside of the list include must not change.
Result<void> prepare_in_place(const BatchOptions& o, BatchTask& task, const BatchList& list) {
  CommonOptions common = o.common;
  common.rewrites = true;
  std::vector<std::string> paths;
  for (const BatchDeck& d : list.decks) paths.push_back(d.path);
  auto outsiders = recover_and_find_dependents(paths, task.root, common);
  if (!outsiders) return outsiders.error();
  task.outsiders = std::move(*outsiders);
  return {};
}

/// Groups of decks to be done together, and their output. Error: in place, an unreadable file that
/// other decks may share.
Result<std::vector<BatchJob>> plan_jobs(const BatchOptions& o, BatchTask& task,
                                        const BatchList& list) {
  IncludeScan scan(o.common.include_paths);
  std::vector<std::vector<IncludeScan::File>> trees(list.decks.size());
  for (std::size_t d = 0; d < trees.size() && task.writes; ++d) {
    const std::string& deck = list.decks[d].path;
    if (!task.to_json) trees[d] = scan.files(deck);  // a document has all files of its deck
    for (const IncludeScan::File& f : trees[d])
      if (task.in_place && f.contents == 0)
        return config_error("cannot read " + f.path + ", a file of " + deck +
                            ": whether other decks share it is not known; nothing was written");
  }
  std::vector<BatchJob> jobs;
  std::vector<std::string> files;
  for (std::vector<std::size_t>& group : sharing_groups(trees)) {
    BatchJob& job = jobs.emplace_back();
    for (const std::size_t i : group) job.decks.push_back(list.decks[i].path);
    job.result = list.decks[group.front()].result;
    job.positions = std::move(group);
    if (!task.writes) continue;
    DeckFiles found = files_of_decks(job.decks, scan);
    files.insert(files.end(), found.paths.begin(), found.paths.end());
    job.record.contents = found.contents;
    job.files = std::move(found.paths);
  }
  if (task.writes) task.frame_root = common_root(o.common.decks, files);
  return jobs;
}

/// --merge: combines the summaries of all shards.
int merge(const BatchOptions& o) {
  auto merged = merge_shards(o.directory);
  if (!o.common.decks.empty() || !o.manifest.empty() || o.shard != "1/1")
    merged = config_error("--merge takes no decks: it merges the summaries in DIR");
  if (!merged) return failed(o.common, merged.error());
  remove_strays(o.directory);
  return write_overview(o, {}, *merged, 0);
}

/// The requested run. Error (io): nothing to read.
Result<BatchRun> plan(const BatchOptions& o) {
  const auto shard = parse_shard(o.shard);
  if (!shard) return shard.error();
  auto task = parse_task(o);
  if (!task) return task.error();
  // Other verbs are the first word after the program.
  const std::string first = o.common.decks.empty() ? "" : o.common.decks.front();
  std::error_code ec;
  if (is_verb_of_a_batch(first) && !std::filesystem::exists(first, ec))
    return config_error("'" + first + "' is read as the name of a deck, which does not exist; " +
                        "name the verb with --verb " + first);
  IncludeScan scan(o.common.include_paths);
  auto list = list_decks(o.common.decks, o.manifest, o.directory, scan);
  if (!list) return list.error();
  o.common.session->remember_read(o.manifest);
  if (list->decks.empty() && !first.empty()) return no_deck_in(first);
  if (list->decks.empty())
    return config_error("no decks: name some, or a directory, or a --manifest");
  for (const std::string& note : list->notes)
    if (!o.common.quiet) print_note(note);
  if (const auto schemas = load_schemas(o.common); !schemas)
    return config_error(schemas.error().message);
  if (task->in_place)
    if (auto prepared = prepare_in_place(o, *task, *list); !prepared)
      return config_error(prepared.error().message);
  std::vector<BatchJob> jobs;
  auto all = plan_jobs(o, *task, *list);
  if (!all) return all.error();
  for (std::size_t g = 0; g < all->size(); ++g)
    if (shard->has(g)) jobs.push_back(std::move((*all)[g]));
  return BatchRun{o, std::move(*task), std::move(*list), *shard, std::move(jobs)};
}

int run(const BatchOptions& o) {
  if (const int bad = check_outputs(o.common, {o.common.json}); bad != exit_clean) return bad;
  if (o.merge) return merge(o);
  auto run = plan(o);
  if (run) return run_batch(std::move(*run));
  print_error(o.common, run.error().message);
  return run.error().code == Error::Code::io ? exit_input : exit_usage;
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<BatchOptions>();
  BatchOptions& o = *options;
  add_common(line, o.common);
  line.existing("DECK").required(false).describe(
      "Starter decks, directories (all *_0000.rad below them) or patterns ('models/*/a*.rad')");
  line.existing("--json").describe("Write the summary to FILE too; '-' is standard output");
  line.existing("--threads")
      .describe("Threads of each worker; 0 divides the processors among them");
  line.option("-o,--output DIR", o.directory, "Directory of the results; made if missing")
      .required();
  line.option("--manifest FILE", o.manifest,
              "File with one deck per line, # begins a comment; '-' is standard input");
  line.option(
      "--verb VERB", o.verb,
      "What to do with each deck: lint, params, gaps (default), cycle, convert or fix, with "
      "options: --verb 'lint --geometry', --verb 'convert --units kg,m,s'");
  line.option("-j,--jobs N", o.jobs, "Decks at the same time; 0 takes all processors")
      .range(0, 4096);
  line.option(
          "--timeout SECONDS", o.timeout,
          "Stop a deck (or decks that are written together) after SECONDS (default 3600); 0: never")
      .number(0, 1e9);
  line.option("--shard i/n", o.shard,
              "Only part i of n: every n-th deck of the list; decks that are written together stay "
              "together");
  add_require_examined(line, o.common);
  line.flag("--merge", o.merge, "Merge the summaries of all shards in DIR");
  line.flag("--force", o.force, "Do finished decks again");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"batch", 60, "One verb over many decks: a result for each, a summary, resumable",
     R"(  deck batch -o results models/ --jobs 8
  deck batch -o results --manifest decks.txt --verb 'lint --geometry'
  deck batch -o metric models/ --verb 'convert --units kg,m,s'
  deck batch -o results models/ --verb 'lint --fix'
  deck batch -o results models/ --shard 2/8    part of the decks, for another machine
  deck batch -o results --merge                one summary of all shards

DIR/NAME.json is what 'deck VERB NAME.rad --json' writes, DIR/summary.json lists all decks, and
DIR/index.html shows them, worst first. With --verb 'gaps --html' or 'cycle --html' it links to
the page of each deck, DIR/NAME.html.
convert and fix write the decks below DIR, with their paths relative to the directory that
holds all of them (or in place, with --in-place among the options of the verb). Decks that
share files are written together or not at all; every result is verified (--no-verify).
After an interruption run the same command again: it does what failed or changed since.)",
     setup}};

}  // namespace
}  // namespace deck::cli::verb_batch
