// deck batch: one verb over many decks, each in a worker process; a result file per deck and a
// summary. What is finished is remembered, so that a batch that was killed goes on where it
// stopped.

#include <algorithm>

#include "batch/list.hpp"
#include "batch/ranks.hpp"
#include "batch/run.hpp"
#include "batch/summary.hpp"

namespace {

using namespace deck;
using namespace deck::cli;

const std::vector<std::string> verbs_with_documents = {"lint", "params", "gaps", "cycle"};
/// Options that write files of one name, change decks, or are the batch's own.
const std::vector<std::string> not_in_a_batch = {
    "--json", "--csv", "--vtk",   "--html",  "--compare",      "--output",  "--format",
    "--diff", "--fix", "--quiet", "--color", "--unsafe-fixes", "--threads", "--write-baseline"};

/// Error: no such verb, or options that it does not take.
Result<BatchTask> parse_task(const BatchOptions& o, const std::vector<Verb>& all) {
  const auto refuse = [&](const std::string& why) {
    return Error{Error::Code::config, "--verb '" + o.verb + "': " + why};
  };
  BatchTask task;
  const std::vector<std::string> words = split_words(o.verb);
  if (words.empty()) return refuse("name a verb");
  for (const Verb& v : all)
    if (v.name == words.front() &&
        std::find(verbs_with_documents.begin(), verbs_with_documents.end(), words.front()) !=
            verbs_with_documents.end())
      task.verb = v;
  if (task.verb.setup == nullptr) return refuse("expected lint, params, gaps or cycle");
  task.words.assign(words.begin() + 1, words.end());
  CommandLine line("", "");
  const Action action = task.verb.setup(line);  // holds what the options are stored in
  std::vector<std::string> arguments = task.words;
  arguments.insert(arguments.end(), {"--", "deck"});
  if (const auto parsed = line.parse(arguments); !parsed) return refuse(parsed.error().message);
  for (const std::string& name : not_in_a_batch)
    if (line.given(name)) return refuse(name + " is not for a batch");
  if (line.existing("decks").count() != 1) return refuse("decks are named behind the options");
  for (const std::string& dir : o.common.include_paths)
    task.options.insert(task.options.end(), {"--include-path", dir});
  for (const std::string& dir : o.common.schema_dirs)
    task.options.insert(task.options.end(), {"--schemas", dir});
  if (o.common.require_examined) task.options.push_back("--require-examined");
  task.options.insert(task.options.end(), task.words.begin(), task.words.end());
  return task;
}

int run(const BatchOptions& o) {
  const auto usage = [&](const std::string& message) {
    print_error(o.common, message);
    return exit_usage;
  };
  if (const int bad = check_outputs(o.common, {o.common.json}); bad != exit_clean) return bad;
  if (o.merge) {
    if (!o.common.decks.empty() || !o.manifest.empty() || o.shard != "1/1")
      return usage("--merge takes no decks: it puts together the summaries that are in DIR");
    const auto parts = read_shard_summaries(o.directory);
    if (!parts) return usage(parts.error().message);
    const auto merged = merge_summaries(*parts);
    if (!merged) return usage(merged.error().message);
    if (auto written =
            write_result(o.directory + "/" + summary_name({}), summary_json(*merged), true);
        !written)
      return usage(written.error().message);
    return report_batch(o, *merged, 0);
  }
  const auto shard = parse_shard(o.shard);
  if (!shard) return usage(shard.error().message);
  auto task = parse_task(o, verbs());
  if (!task) return usage(task.error().message);
  const auto decks = list_decks(o.common.decks, o.manifest);
  if (!decks) return usage(decks.error().message);
  remember_read(o.manifest);
  if (decks->empty()) return usage("no decks: name some, or a directory, or a --manifest");
  if (const auto schemas = load_schemas(o.common); !schemas) return usage(schemas.error().message);
  Batch batch(o, std::move(*task), *decks, *shard,
              o.no_mpi ? Ranks::alone() : Ranks::from_environment());
  return batch.run();
}

Action setup(CommandLine& line) {
  auto options = std::make_shared<BatchOptions>();
  BatchOptions& o = *options;
  add_common(line, o.common);
  line.existing("decks").required(false).describe(
      "Starter decks, or directories: all *_0000.rad below them");
  line.existing("--json").describe("Write the summary to FILE as well; '-' is standard output");
  line.existing("--threads").describe("Threads of each worker; 0 shares out the processors");
  line.option("-o,--output", o.directory, "Directory of the results; made if missing")
      .required()
      .value("DIR");
  line.option("--manifest", o.manifest,
              "File with one deck per line, # begins a comment; '-' is standard input")
      .value("FILE");
  line.option("--verb", o.verb,
              "What to do with each deck: lint, params, gaps (default) or cycle, with options: "
              "--verb 'lint --geometry'")
      .value("VERB");
  line.option("-j,--jobs", o.jobs, "Decks at the same time; 0 takes all processors")
      .range(0, 4096)
      .value("N");
  line.option("--timeout", o.timeout, "Give a deck up after SECONDS (default 3600); 0: never")
      .number(0, 1e9)
      .value("SECONDS");
  line.option("--shard", o.shard, "Only part i of n: every n-th deck of the list").value("i/n");
  add_require_examined(line, o.common);
  line.flag("--merge", o.merge, "Put the summaries of all shards in DIR together");
  line.flag("--force", o.force, "Do finished decks again");
  line.flag("--no-mpi", o.no_mpi, "Under mpirun: do not share the decks among the ranks");
  return [options] { return run(*options); };
}

const VerbRegistration registration{
    {"batch", 60, "One verb over many decks: a result for each, a summary, resumable",
     "  deck batch -o results models/ --jobs 8\n"
     "  deck batch -o results --manifest decks.txt --verb 'lint --geometry'\n"
     "  deck batch -o results models/ --shard 2/8    part of the decks, for another machine\n"
     "  deck batch -o results --merge                one summary of all shards\n"
     "  mpirun -n 16 deck batch -o results models/\n"
     "\n"
     "DIR/NAME.json is what 'deck VERB NAME.rad --json' writes, DIR/summary.json lists all decks.\n"
     "Decks of the same name get that of their directory before it: left--car_0000.json.\n"
     "Run the same command again to go on after a kill: decks are done again only if a file they\n"
     "read, the options or the program changed, or if they failed.\n",
     setup}};

}  // namespace
