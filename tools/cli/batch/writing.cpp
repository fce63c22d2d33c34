// Groups of decks that share files: written by one call of the verb, all or none. Before anything
// is written, the journal says what will be; after a kill the next run finishes or cleans up by it.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <new>
#include <thread>

#include "base/shared/paths.hpp"
#include "batch/json.hpp"
#include "batch/run.hpp"
#include "deck/keyword/engine_file.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"
#include "report/shared/losses.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

/// "counts" of a deck in the summary.
std::string counts_of(const BatchFrame::Deck& deck) {
  std::string text;
  JsonWriter json(text);
  json.begin_object(true).field("changed_files", deck.changed);
  constexpr const char* names[] = {"kept", "approximated", "dropped", "undecided"};
  for (std::size_t k = 0; k < 4; ++k) json.field(names[k], deck.losses[k]);
  json.end_object();
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

/// The lists of a loss report, without what says whose it is.
std::string loss_lists(const std::vector<LossEntry>& losses) {
  std::string text;
  JsonWriter json(text);
  json.begin_object(true);
  write_loss_lists(json, losses);
  json.end_object();
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

/// What a worker learns while a group is written.
struct Notes {
  std::map<std::string, std::vector<FileState>> read;  ///< by deck
  std::map<std::string, FileState> written;            ///< by normal path
};

/// Files as they lie there now; times that cannot be relied on are left out.
std::vector<FileState> settled(const Notes& notes, const std::vector<FileState>& read) {
  std::vector<FileState> out;
  for (const FileState& f : read) {
    const auto found = notes.written.find(absolute_path(f.path));
    out.push_back(found == notes.written.end() ? f : found->second);
    out.back().path = f.path;
  }
  return out;
}

}  // namespace

std::string Batch::write_group(std::size_t group, Captured& output) const {
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t since = file_clock_now();
  const std::vector<std::size_t>& members = groups_[group];
  std::vector<std::string> paths;
  for (const std::size_t i : members) paths.push_back(decks_[i].path);
  std::vector<Record> records(members.size());
  Notes notes;
  for (std::size_t k = 0; k < members.size(); ++k) {
    records[k].deck = paths[k];
    records[k].key = key_;
    if (task_.from_json)
      if (auto state = file_state(paths[k])) notes.read[paths[k]].push_back(*state);
  }
  Session session = *o_.common.session;
  session.on_load = [&](const Deck& loaded) {
    if (task_.from_json) return;
    auto& files = notes.read[loaded.sources[0].path()];
    if (!files.empty()) return;  // read again with other texts
    for (std::uint32_t f = 0; f < loaded.sources.size(); ++f)
      files.push_back(file_state(loaded.sources[f].path(), loaded.sources[f].bytes(), since));
  };
  const auto complete = [&] {
    for (std::size_t k = 0; k < members.size(); ++k) {
      const auto& read = notes.read[paths[k]];
      records[k].files = task_.in_place ? settled(notes, read) : read;
      records[k].outputs.clear();
      if (k == 0 && !task_.in_place)
        for (const auto& [path, state] : notes.written) records[k].outputs.push_back(state);
    }
  };
  BatchFrame frame;
  frame.root = task_.frame_root;
  frame.outsiders = task_.outsiders;
  frame.ours = [this](const std::string& path) { return is_ours(path); };
  frame.before_writing = [&](const std::vector<OutputFile>& files) -> Result<void> {
    // A file that could not be read when the decks were grouped may belong to others as well.
    for (const std::string& path : paths) {
      const auto seen = task_.seen.find(path);
      if (seen == task_.seen.end()) continue;
      for (const FileState& f : notes.read[path])
        if (!seen->second.contains(absolute_path(f.path)) &&
            absolute_path(starter_of_engine_file(f.path)) != absolute_path(path))
          return Error{
              Error::Code::config,
              f.path + ", a file of " + path +
                  ", did not exist when the decks were grouped; run the same command again"};
    }
    const std::string directory(parent_path(absolute_path(o_.directory + "/index.html")));
    for (const OutputFile& f : files) {
      const std::string place = absolute_path(f.path);
      const std::string_view name = std::string_view(place).substr(place.rfind('/') + 1);
      if (!task_.in_place && parent_path(place) == directory &&
          (name == "index.html" || name == "summary.json" || name == "losses.json"))
        return Error{Error::Code::config,
                     f.path + " is a file of the batch itself; give the deck another name"};
      notes.written[place] = {f.path, f.bytes.size(), 0, content_hash(f.bytes)};
    }
    complete();
    // In place this is the record, should the writer be killed as soon as it has written.
    std::string text;
    for (std::size_t k = 0; k < records.size(); ++k) {
      Record& r = records[k];
      const BatchFrame::Deck& deck = frame.decks[paths[k]];
      r.written = true;
      r.code = deck.code;
      r.entry =
          summary_entry(paths[k], status_of(r.code), deck.target, r.code, "", "", counts_of(deck));
      if (k == 0 && task_.verb.name == "convert") r.losses = loss_lists(frame.losses);
      r.announced = true;
      text += record_line(r);
      r.announced = false;
    }
    return note(text, task_.in_place);
  };
  int code = exit_internal;
  std::string broken;
  const bool overtaken = std::any_of(members.begin(), members.end(),
                                     [&](std::size_t i) { return overtaken_.contains(i); });
  if (overtaken) {
    code = exit_usage;
    broken =
        "these decks share files; some were already written in place and then edited, or new decks "
        "share the files; --force converts their present texts";
  } else {
    session.frame = &frame;
    try {
      code = run_verb(task_, paths, session);
    } catch (const std::bad_alloc&) {
      broken = "out of memory";
    } catch (const std::exception& e) {
      broken = e.what();
    }
  }
  // What is in place is looked at once more: its times tell the next run that it is as it was.
  if (frame.written)
    for (auto& [path, state] : notes.written)
      if (auto now = file_state(state.path)) {
        const std::string name = state.path;
        state = *now;
        state.path = name;
      }
  if (!frame.written) notes.written.clear();
  complete();
  std::string document, result;
  if (task_.with_documents && broken.empty()) document = output.out();
  std::optional<DocumentFacts> facts;
  if (!document.empty()) facts = document_facts(document);
  if (facts) {
    result = decks_[members.front()].result;
    if (auto done = write_result(*o_.common.session, in_directory(result), document, false);
        !done) {
      broken = done.error().message;
      code = exit_usage;
      result.clear();
    }
  }
  const bool refused = !frame.written && (code > exit_findings ||
                                          (code != exit_clean && task_.verb.name == "convert"));
  std::string first_failed;
  for (const std::string& path : paths)
    if (frame.decks[path].code != exit_clean && first_failed.empty()) first_failed = path;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (std::size_t k = 0; k < members.size(); ++k) {
    Record& r = records[k];
    const BatchFrame::Deck& deck = frame.decks[paths[k]];
    r.written = frame.written;
    std::string error = broken.empty() ? deck.error : broken;
    std::string status;
    r.code = deck.code;
    if (refused && deck.code == exit_clean && broken.empty()) {
      r.code = code;
      if (first_failed.empty()) {
        error = frame.error.empty() ? first_line(output.err()) : frame.error;
      } else {
        status = "skipped";
        error = "not written: " + first_failed + ", which shares files with it, was not";
      }
    } else if (!broken.empty()) {
      r.code = std::max<int>(code, exit_usage);
    }
    if (status.empty()) status = status_of(r.code);
    if (r.code == exit_clean) error.clear();
    if (facts) {
      r.result = result;
      r.bytes = document.size();
      r.hash = content_hash(document);
    }
    r.seconds = seconds / static_cast<double>(members.size());
    const std::string& target = facts ? result : deck.target;
    r.entry = summary_entry(paths[k], status, refused ? "" : target, r.code, error,
                            facts ? facts->verdict : "", counts_of(deck));
    if (k == 0 && task_.verb.name == "convert" && !frame.written)
      r.losses = loss_lists(frame.losses);  // else they were announced
  }
  std::string message;
  for (const Record& r : records) message += record_line(r);
  return message;
}

// ---- after a kill ----------------------------------------------------------------------------

namespace {

/// Waits a little for a process that was killed together with its parent.
bool is_gone(int pid) {
  constexpr auto step = std::chrono::milliseconds(10);
  for (int waited = 0; waited < 200; ++waited) {
    if (pid <= 0 || pid == getpid() || kill(pid, 0) != 0) return true;
    std::this_thread::sleep_for(step);
  }
  return false;
}

/// True if a process holds the lock of a label.
bool is_at_work(const std::string& lock) {
  const int fd = open(lock.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (fd < 0) return false;
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  const bool held = fcntl(fd, F_GETLK, &whole) == 0 && whole.l_type != F_UNLCK;
  close(fd);
  return held;
}

}  // namespace

void Batch::settle(const std::vector<Record>& records) const {
  std::vector<std::string> files;
  std::map<std::string, std::set<std::string>> names;  // by directory
  for (const Record& r : records)
    for (const auto* states : {&r.outputs, task_.in_place ? &r.files : nullptr})
      for (std::size_t i = 0; states != nullptr && i < states->size(); ++i) {
        files.push_back((*states)[i].path);
        const fs::path place(files.back());
        names[place.has_parent_path() ? place.parent_path().string() : "."].insert(
            place.filename().string());
      }
  if (task_.in_place)
    for (const std::string& file : files) (void)finish_interrupted_write(file, files);
  // What the writer had beside its targets, unless it is still at work.
  for (const auto& [directory, targets] : names) {
    std::error_code ec;
    for (auto it = fs::directory_iterator(directory, ec); !ec && it != fs::directory_iterator();
         it.increment(ec)) {
      const std::string name = it->path().filename().string();
      if (name.size() < 6 || name[0] != '.' || !name.ends_with(".tmp")) continue;
      const auto dot = name.rfind('.', name.size() - 5);
      const std::string target = name.substr(1, dot == 0 ? 0 : dot - 1);
      if (!targets.contains(target) || !is_temporary_of(name, target)) continue;
      if (!is_gone(std::atoi(name.c_str() + dot + 1))) continue;
      unlink(it->path().c_str());
    }
    for (const std::string& target : targets)
      unlink((fs::path(directory) / ("." + target + ".unfinished")).c_str());
  }
}

std::vector<Record> Batch::announced_by(const std::vector<std::size_t>& group) const {
  const auto source = Source::open(in_directory(".batch/" + label() + ".jsonl"), Limits{});
  if (!source) return {};
  std::vector<Record> out = parse_records((*source)->bytes());
  std::erase_if(out, [&](const Record& r) {
    return !r.announced || std::none_of(group.begin(), group.end(), [&](std::size_t i) {
      return as_utf8(decks_[i].path) == r.deck;
    });
  });
  return out;
}

namespace {

/// Our own journal is written anew; of that of a shard that was killed this is done.
void forget_announced(Session& session, const std::string& journal) {
  const auto source = Source::open(journal, Limits{});
  if (!source) return;
  std::string text;
  for (const Record& r : parse_records((*source)->bytes()))
    if (!r.announced) text += record_line(r);
  (void)write_result(session, journal, text, true);  // else it is settled once more next time
}

}  // namespace

void Batch::settle_announced() {
  for (const Record& r : known_)
    for (const FileState& f : r.outputs) written_.emplace(absolute_path(f.path), f.hash);
  Freshness freshness;
  for (auto& [owner, records] : announced_) {
    // Closing a file that this process has locked would give the lock up: its own is not asked for.
    if (records.empty() ||
        (owner != label() && is_at_work(in_directory(".batch/" + owner + ".lock"))))
      continue;
    settle(records);
    for (Record& r : records) {
      for (const FileState& f : r.outputs) written_.emplace(absolute_path(f.path), f.hash);
      // In place, a conversion that came to its end must not be done twice, and one that did not
      // was none. Fixes find nothing to do.
      bool done = !task_.in_place;
      if (task_.in_place && !task_.with_documents && !o_.force && r.key == key_)
        for (std::size_t i = 0; i < decks_.size(); ++i)
          if (as_utf8(decks_[i].path) == r.deck && records_[i].code < 0 &&
              std::all_of(r.files.begin(), r.files.end(),
                          [&](const FileState& f) { return freshness.unchanged(f); })) {
            r.announced = false;
            records_[i] = r;
            overtaken_.erase(i);
            done = true;
          }
      if (done) known_.push_back(std::move(r));
    }
    if (owner != label())
      forget_announced(*o_.common.session, in_directory(".batch/" + owner + ".jsonl"));
  }
}

bool Batch::is_ours(const std::string& path) const {
  const auto state = file_state(path);
  return state && written_.contains({absolute_path(path), state->hash});
}

void Batch::remove_leftovers() const {
  std::set<std::string> listed, results, outputs;
  for (const BatchDeck& d : all_) listed.insert(as_utf8(d.path));
  // A group of decks has one result; which groups there are may have been another time's guess.
  for (const Record& r : records_) {
    results.insert(r.result);
    for (const FileState& f : r.outputs) outputs.insert(absolute_path(f.path));
  }
  std::set<std::string> ours;
  for (const BatchDeck& d : decks_) ours.insert(as_utf8(d.path));
  for (const Record& r : known_)  // of other shards
    if (listed.contains(r.deck) && !ours.contains(r.deck)) {
      results.insert(r.result);
      for (const FileState& f : r.outputs) outputs.insert(absolute_path(f.path));
    }
  Freshness freshness;
  const std::string root = absolute_path(o_.directory) + "/";
  for (const Record& r : known_) {
    if (!r.result.empty() && !results.contains(r.result) && r.result.find('/') == std::string::npos)
      if (const auto now = file_state(in_directory(r.result)); now && now->hash == r.hash)
        unlink(in_directory(r.result).c_str());
    for (const FileState& f : r.outputs) {
      const std::string path = absolute_path(f.path);
      if (outputs.contains(path) || !path.starts_with(root) || !freshness.unchanged(f)) continue;
      unlink(path.c_str());
      std::error_code ec;  // directories that are empty now
      for (fs::path dir = fs::path(path).parent_path();
           dir.string().size() > root.size() && fs::remove(dir, ec); dir = dir.parent_path()) {
      }
    }
  }
}

}  // namespace deck::cli
