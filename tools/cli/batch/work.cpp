// Work of a worker on a group of decks: runs the verb, writes result and record. If decks are
// written, the record is written first, for a run after a kill.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <new>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "batch/run.hpp"
#include "report/shared/deck_json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

/// Status from the verdict, whatever the exit code accepts; without a verdict "not examined" or
/// not. Empty: decided by the exit code.
std::string status_in(const BatchTask& task, int code, const Json& head) {
  if (code > exit_findings) return {};
  const std::string level =
      head.at("verdict").is_null() ? "" : text_in(head.at("verdict"), "level");
  if (level.empty()) {
    const bool required = std::find(task.options.begin(), task.options.end(),
                                    "--require-examined") != task.options.end();
    return head.value("examined", 1) == 0 && (code == exit_clean || required) ? "not-examined" : "";
  }
  if (level == "not-examined") return level;
  return level == "clean" || level == "remarks" ? "" : "findings";
}

/// Runs the verb as `deck VERB ... DECK...` would, including standard output. `page`: path of the
/// page of the deck; empty: none.
int run_verb(const BatchTask& task, const std::vector<std::string>& decks, const std::string& page,
             Session& session) {
  CommandLine line("", "deck " + std::string(task.verb.name), session);
  const Action action = task.verb.setup(line);
  std::vector<std::string> arguments = task.options;
  if (!page.empty()) arguments.insert(arguments.end(), {"--html", page});
  arguments.push_back("--");
  arguments.insert(arguments.end(), decks.begin(), decks.end());
  if (const auto parsed = line.parse(std::move(arguments)); !parsed)
    throw std::runtime_error(parsed.error().message);
  return action();
}

class GroupWork {
 public:
  GroupWork(const BatchRun& run, const BatchJob& job)
      : o_(run.o), task_(run.task), run_(run), job_(job), record_(job.record) {}
  std::string record(const Captured& output) {
    // The next run notices files changed after this.
    if (record_.contents == 0) record_.contents = contents_now();
    if (job_.overtaken)
      fail(exit_usage,
           "these decks share files; some were already written in place and then edited, or new "
           "decks share the files; --force converts their present texts");
    else
      call(output);
    keep_document();
    enter(frame_.written);
    // Failures are repeated next time, except conversions in place that were made.
    if (worst_code(record_.lines) > exit_findings || (job_.converted && !frame_.written))
      return record_text(record_);
    // Refusals are repeated, too: the reason, such as an unreadable file, may disappear.
    record_.done = frame_.written || !task_.converts();
    // Files of earlier runs still exist.
    if (const auto own = run_.known.find(record_name(job_.result));
        task_.writes && !frame_.written && own != run_.known.end())
      record_.outputs = own->second.outputs;
    if (head_) record_.outputs[job_.result] = content_hash(document_);
    if (const std::string page = page_name(job_.result); head_ && task_.pages)
      record_.outputs[page] = file_hash(o_.in_directory(page));
    if (task_.in_place) record_.contents = contents_now();
    if (auto written = write_record(false); !written) {
      fail(exit_usage, written.error().message);
      enter(frame_.written);
    }
    return record_text(record_);
  }

 private:
  /// Called before decks are written. In-place conversions must not be repeated, so their record
  /// lists the new contents first.
  Result<void> announce(const std::vector<OutputFile>& files) {
    const std::string directory = absolute_path(o_.directory);
    for (const OutputFile& f : files) {
      const std::string name =
          fs::path(absolute_path(f.path)).lexically_relative(directory).string();
      if (!task_.in_place &&
          (name == "index.html" || name == "summary.json" || name == "losses.json"))
        return config_error(f.path + " is a file of the batch itself; give the deck another name");
      record_.outputs[name] = content_hash(f.bytes);
    }
    if (!task_.in_place || !task_.converts() || files.empty()) return {};
    record_.before = record_.contents;
    code_ = exit_clean;
    enter(true);
    code_ = exit_internal;
    return write_record(true);
  }
  /// Runs the verb.
  void call(const Captured& output) {
    Session session = *o_.common.session;
    frame_.root = task_.frame_root;
    frame_.outsiders = task_.outsiders;
    frame_.ours = [this](const std::string& path) {
      return run_.written.contains({absolute_path(path), file_hash(path)});
    };
    frame_.before_writing = [this](const std::vector<OutputFile>& files) {
      return announce(files);
    };
    if (task_.writes) session.frame = &frame_;
    try {
      const std::string page = task_.pages ? o_.in_directory(page_name(job_.result)) : "";
      code_ = run_verb(task_, job_.decks, page, session);
      document_ = output.out();
    } catch (const std::bad_alloc&) {
      broken_ = "out of memory";
    } catch (const std::exception& e) {
      broken_ = e.what();
    }
    err_ = output.err();
  }
  void fail(int code, const std::string& why) {
    code_ = code;
    broken_ = why;
    head_.reset();
  }
  /// Puts the document of the call in place.
  void keep_document() {
    if (code_ != exit_internal) head_ = head_of(document_);
    if (!head_ && !task_.writes && code_ <= exit_findings)
      fail(exit_internal, document_.empty() ? "there is no result" : "the result is not JSON");
    if (head_)  // written at the end
      if (auto written = write_result(o_, job_.result, document_, false); !written)
        fail(exit_usage, written.error().message);
    if (!head_) remove_result(run_, job_);
  }

  /// The line of a deck. `refused`: the group was not written, because of `first_failed`.
  Json line_of(const std::string& path, bool refused, const std::string& first_failed) {
    const BatchHooks::Deck& deck = frame_.decks[path];
    int code = task_.writes ? deck.code : code_;
    std::string error = task_.writes ? deck.error : first_line(err_), status;
    if (!broken_.empty()) {
      code = std::max<int>(code_, exit_usage);
      error = broken_;
    } else if (refused && code == exit_clean) {
      code = code_;
      error = frame_.error.empty() ? first_line(err_) : frame_.error;
      if (!first_failed.empty()) {
        status = "skipped";
        error = "not written: " + first_failed + ", which shares files with it, was not";
      }
    }
    if (code == exit_clean || (!task_.writes && code == exit_findings)) error.clear();
    if (refused && code == exit_findings && status.empty()) status = "failed";  // not written
    if (!task_.writes && head_) status = status_in(task_, code, *head_);
    Json line = deck_line(path, code, error, status);
    if (const std::string& target = head_ ? job_.result : deck.target; !refused && !target.empty())
      line["result"] = as_utf8(target);
    for (const char* member : {"verdict", "gate", "counts"})
      if (head_) line[member] = head_->at(member);
    if (task_.writes)
      line["counts"] = {{"changed_files", deck.changed},
                        {"kept", refused ? 0 : deck.losses[0]},
                        {"approximated", deck.losses[1]},
                        {"dropped", deck.losses[2]},
                        {"undecided", deck.losses[3]}};
    return line;
  }

  /// Adds the lines of the decks. `written`: the decks are or will be written.
  void enter(bool written) {
    const bool refused = task_.writes && !written &&
                         (code_ > exit_findings || (code_ != exit_clean && task_.converts()));
    std::string first_failed;
    for (const std::string& path : job_.decks)
      if (frame_.decks[path].code != exit_clean && first_failed.empty()) first_failed = path;
    record_.lines.clear();
    for (const std::string& path : job_.decks)
      record_.lines.push_back(line_of(path, refused, first_failed));
    if (!task_.converts()) return;
    record_.losses = Json::parse(losses_json(frame_.losses));
    if (refused) record_.losses["kept"] = Json::array();  // these decks were not written
  }
  Result<void> write_record(bool sync) const {
    return write_result(o_, record_name(job_.result), record_text(record_), sync);
  }
  std::uint64_t contents_now() const {
    IncludeScan scan(o_.common.include_paths);
    return files_of_decks(job_.decks, scan).contents;
  }
  const BatchOptions& o_;
  const BatchTask& task_;
  const BatchRun& run_;
  const BatchJob& job_;
  Record record_;
  BatchHooks frame_;
  // Exit code of the call.
  int code_ = exit_internal;
  std::string broken_;  ///< reason why there is no result
  std::string document_, err_;
  std::optional<Json> head_;  ///< of the document
};

}  // namespace

std::string first_line(std::string_view text) {
  constexpr std::string_view prefix = "deck: error: ";
  if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
  return std::string(text.substr(0, text.find('\n')));
}

std::string work_on(const BatchRun& run, const BatchJob& job, const Captured& output) {
  return GroupWork(run, job).record(output);
}

}  // namespace deck::cli
