// What a worker does with a group of decks: one call of the verb, its result and its record. Where
// decks are written the record is there first and says what will be: a run after a kill goes by it.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <new>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "batch/run.hpp"
#include "report/shared/losses.hpp"
#include "text/shared/gzip.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

/// What the verdict says, whatever the exit code lets pass; without one whether anything was
/// examined.
std::string_view status_in(const BatchTask& task, int code,
                           const std::optional<DocumentFacts>& facts) {
  if (!facts || code > exit_findings) return status_of(code);
  if (facts->level.empty()) {
    const bool required = std::find(task.options.begin(), task.options.end(),
                                    "--require-examined") != task.options.end();
    return facts->examined.value_or(1) == 0 && (code == exit_clean || required) ? "not-examined"
                                                                                : status_of(code);
  }
  if (facts->level == "not-examined") return facts->level;
  const bool clean = facts->level == "clean" || facts->level == "remarks";
  return clean ? status_of(code) : status_of(exit_findings);
}

/// "counts" of a deck that was to be written.
std::string counts_of(const BatchFrame::Deck& deck) {
  return json_line([&](JsonWriter& json) {
    json.begin_object(true).field("changed_files", deck.changed);
    constexpr const char* names[] = {"kept", "approximated", "dropped", "undecided"};
    for (std::size_t k = 0; k < 4; ++k) json.field(names[k], deck.losses[k]);
    json.end_object();
  });
}

/// The lists of a loss report, without what says whose it is.
std::string loss_lists(const std::vector<LossEntry>& losses) {
  return json_line([&](JsonWriter& json) {
    json.begin_object(true);
    write_loss_lists(json, losses);
    json.end_object();
  });
}

}  // namespace

std::string first_line(std::string_view text) {
  constexpr std::string_view prefix = "deck: error: ";
  if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
  return std::string(text.substr(0, text.find('\n')));
}

/// Runs the verb as `deck VERB ... DECK...` would; its output goes where standard output goes.
static int run_verb(const BatchTask& task, const std::vector<std::string>& decks,
                    Session& session) {
  CommandLine line("", "deck " + std::string(task.verb.name), session);
  const Action action = task.verb.setup(line);
  std::vector<std::string> arguments = task.options;
  arguments.push_back("--");
  arguments.insert(arguments.end(), decks.begin(), decks.end());
  if (const auto parsed = line.parse(std::move(arguments)); !parsed)
    throw std::runtime_error(parsed.error().message);
  return action();
}

Result<void> Batch::write_record(const Job& job, const Record& record, bool sync) const {
  return write_result(*o_.common.session, record_path(o_.directory, job.result),
                      record_text(record), sync);
}

/// Before decks are written: looks at what will be, and writes a record that says so.
Result<void> Batch::announce(const Job& job, const std::set<std::string>& read,
                             const std::vector<OutputFile>& files, BatchFrame& frame,
                             Record& record) const {
  // A file that could not be read when the decks were grouped may belong to others as well.
  std::set<std::string> seen;
  for (const std::string& file : job.group.files) seen.insert(absolute_path(file));
  for (const std::string& path : read)
    if (!seen.contains(absolute_path(path)) && !seen.contains(without_gz(absolute_path(path))))
      return Error{Error::Code::config,
                   path + ", a file of " + job.decks.front() +
                       ", did not exist when the decks were grouped; run the same command again"};
  std::vector<WrittenFile> outputs;
  for (const OutputFile& f : files) {
    outputs.push_back({below_directory(f.path), content_hash(f.bytes)});
    const std::string& name = outputs.back().path;
    if (!task_.in_place &&
        (name == "index.html" || name == "summary.json" || name == "losses.json"))
      return Error{Error::Code::config,
                   f.path + " is a file of the batch itself; give the deck another name"};
  }
  set_outputs(record, job, std::move(outputs));
  if (task_.in_place && task_.converts() && !files.empty()) record.before = job.group.contents;
  enter_written(record, job, frame, {exit_clean, "", "", ""}, true);
  return write_record(job, record, task_.in_place);
}

/// Files of earlier runs that are none of these any more are remembered until they are removed.
void Batch::set_outputs(Record& record, const Job& job, std::vector<WrittenFile> outputs) const {
  record.outputs = std::move(outputs);
  record.former.clear();
  std::set<std::string> current;
  for (const WrittenFile& f : record.outputs) current.insert(f.path);
  for (const Record* known : job.known)
    for (const auto* files : {&known->outputs, &known->former})
      for (const WrittenFile& f : *files)
        if (!current.contains(f.path)) record.former.push_back(f);
}

/// Runs the verb.
Batch::Outcome Batch::call(const Job& job, const Captured& output, BatchFrame& frame,
                           Record& record) const {
  Session session = *o_.common.session;
  std::set<std::string> read;
  if (task_.writes) {
    session.on_load = [&](const Deck& loaded) {
      for (std::uint32_t f = 0; f < loaded.sources.size(); ++f)
        if (!task_.from_json) read.insert(loaded.sources[f].path());
    };
    frame.root = task_.frame_root;
    frame.outsiders = task_.outsiders;
    frame.ours = [this](const std::string& path) {
      return written_.contains({absolute_path(path), file_hash(path)});
    };
    frame.before_writing = [&](const std::vector<OutputFile>& files) {
      return announce(job, read, files, frame, record);
    };
    session.frame = &frame;
  }
  Outcome out;
  try {
    out.code = run_verb(task_, job.decks, session);
    out.document = output.out();
  } catch (const std::bad_alloc&) {
    out.broken = "out of memory";
  } catch (const std::exception& e) {
    out.broken = e.what();
  }
  out.err = output.err();
  return out;
}

/// Puts the document of a call in place.
void Batch::keep_document(const Job& job, Outcome& o) const {
  const auto fail = [&](int code, const std::string& why) {
    o.code = code;
    o.broken = why;
    o.facts.reset();
  };
  if (!o.document.empty() && o.code != exit_internal) {
    o.facts = document_facts(o.document);
    if (!o.facts) {
      if (!task_.writes) fail(exit_internal, "the result is not JSON");
    } else if (auto written = write_result(*o_.common.session, in_directory(job.result), o.document,
                                           false);  // flushed together at the end
               !written) {
      fail(exit_usage, written.error().message);
    }
  } else if (!task_.writes && o.code <= exit_findings) {
    fail(exit_internal, "there is no result");
  }
  // A result of earlier would be taken for this one.
  if (!o.facts && (!task_.writes || task_.with_documents)) unlink(in_directory(job.result).c_str());
}

/// The entry of a deck that was only read.
SummaryEntry Batch::entry_read(const Job& job, const Outcome& o) const {
  const std::string error = !o.broken.empty()        ? o.broken
                            : o.code > exit_findings ? first_line(o.err)
                                                     : "";
  EntryFacts facts{job.decks.front(), status_in(task_, o.code, o.facts), "", o.code, error, "", ""};
  if (o.facts) {
    facts.result = job.result;
    facts.verdict = o.facts->verdict;
    facts.counts = o.facts->counts;
    facts.gate = o.facts->gate;
  }
  return summary_entry(facts);
}

/// The entries of decks that were to be written together.
void Batch::enter_written(Record& record, const Job& job, BatchFrame& frame, const Outcome& o,
                          bool written) const {
  const bool refused =
      !written && (o.code > exit_findings || (o.code != exit_clean && task_.converts()));
  std::string first_failed;
  for (const std::string& path : job.decks)
    if (frame.decks[path].code != exit_clean && first_failed.empty()) first_failed = path;
  record.entries.clear();
  for (const std::string& path : job.decks) {
    const BatchFrame::Deck& deck = frame.decks[path];
    int code = deck.code;
    std::string error = o.broken.empty() ? deck.error : o.broken, status;
    if (!o.broken.empty()) {
      code = std::max<int>(o.code, exit_usage);
    } else if (refused && code == exit_clean) {
      code = o.code;
      if (first_failed.empty()) {
        error = frame.error.empty() ? first_line(o.err) : frame.error;
      } else {
        status = "skipped";
        error = "not written: " + first_failed + ", which shares files with it, was not";
      }
    }
    if (status.empty()) status = status_of(code);
    if (code == exit_clean) error.clear();
    const std::string& target = o.facts ? job.result : deck.target;
    const std::string counts = counts_of(deck);
    record.entries.push_back(summary_entry({path, status, refused ? "" : target, code, error,
                                            o.facts ? o.facts->verdict : "", counts}));
  }
  if (task_.converts()) record.losses = loss_lists(frame.losses);
}

std::string Batch::work_on(const Job& job, const Captured& output) const {
  const auto start = std::chrono::steady_clock::now();
  Record record;
  record.verb = task_.verb.name;
  for (const std::string& deck : job.decks) record.decks.push_back(as_utf8(deck));
  record.settings = job.settings;
  const auto contents_now = [&] {
    IncludeScan scan(o_.common.include_paths);
    return files_of_decks(job.decks, scan).contents;
  };
  // A file that is changed after this is found changed by the next run.
  record.contents = job.group.contents != 0 ? job.group.contents : contents_now();
  BatchFrame frame;
  Outcome o;
  if (job.overtaken) {
    o.code = exit_usage;
    o.broken =
        "these decks share files; some were already written in place and then edited, or new decks "
        "share the files; --force converts their present texts";
  } else {
    o = call(job, output, frame, record);
  }
  keep_document(job, o);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  record.seconds = took.count() / static_cast<double>(job.decks.size());
  const auto enter = [&] {
    if (task_.writes)
      enter_written(record, job, frame, o, frame.written);
    else
      record.entries = {entry_read(job, o)};
    int worst = exit_clean;
    for (const SummaryEntry& e : record.entries) worst = std::max(worst, e.code);
    return worst;
  };
  const bool converted_before = std::any_of(job.known.begin(), job.known.end(),
                                            [](const Record* r) { return r->before != 0; });
  // What failed is tried again next time; what is converted in place by now must stay known.
  if (enter() > exit_findings || (converted_before && !frame.written)) return record_text(record);
  // Refused, perhaps for a reason that is gone next time: a file that could not be read just now.
  record.done = frame.written || !task_.converts();
  std::vector<WrittenFile> outputs =
      frame.written ? std::move(record.outputs) : std::vector<WrittenFile>();
  if (o.facts) outputs.push_back({job.result, content_hash(o.document)});
  set_outputs(record, job, std::move(outputs));
  if (task_.in_place) record.contents = contents_now();
  if (auto written = write_record(job, record, false); !written) {
    o.code = exit_usage;
    o.broken = written.error().message;
    enter();
  }
  return record_text(record);
}

}  // namespace deck::cli
