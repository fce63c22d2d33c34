// Expands the decks of a call, finds other decks that include their files, and writes.
#include "changes.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/shared/paths.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "library.hpp"

namespace deck::cli {
namespace {
namespace fs = std::filesystem;
}

void add_write_options(CommandLine& line, WriteFlags& choice) {
  line.option("-o,--output DIR", choice.directory,
              "Directory to write to; made if missing. The include tree keeps its relative names");
  line.flag("--overwrite", choice.overwrite,
            "With -o: replace decks and includes in DIR that differ (earlier results of the same "
            "files, if unchanged since, are replaced without it)");
  line.flag("--in-place", choice.in_place, "Change the files of the deck");
  line.flag("--backup{.orig}", choice.backup_suffix,
            "With --in-place: keep the old file under its name plus .orig (--backup=SUFFIX); a "
            "backup is never replaced, the next one is .orig.2");
  line.flag("--diff", choice.diff,
            "Write nothing; print the changes as a unified diff that git apply takes");
  add_root_option(line, choice);
}

void add_root_option(CommandLine& line, WriteFlags& choice) {
  line.group("Decks that share files, when they are changed")
      .option("--root DIR", choice.root,
              "Where to look for other decks that include the same files (default: the git work "
              "tree, else the deepest folder that holds the deck and its includes)");
}

std::string usage_error(const WriteFlags& choice) {
  const bool changes = choice.in_place || choice.diff;
  if (choice.in_place && (choice.diff || !choice.directory.empty()))
    return "--in-place goes with neither -o nor --diff";
  if (choice.overwrite && choice.directory.empty()) return "--overwrite goes with -o";
  if (!choice.backup_suffix.empty() && !choice.in_place) return "--backup goes with --in-place";
  if (!choice.root.empty() && !changes) return "--root goes with --in-place or --diff";
  std::error_code ec;
  if (!choice.root.empty() && !fs::is_directory(choice.root, ec))
    return "--root " + choice.root + ": there is no such directory";
  return {};
}

namespace {

/// Completes an interrupted write of one of the decks, if there is a note beside `main`. Returns
/// the number of changed files.
Result<std::size_t> complete_interrupted(const std::string& main,
                                         const std::vector<std::string>& decks,
                                         const CommonOptions& common) {
  if (!unfinished_note(main)) return std::size_t{0};
  std::vector<std::string> tree;
  IncludeScan scan(common.include_paths);
  for (const std::string& deck : decks) {
    for (const IncludeScan::File& f : scan.files(deck)) tree.push_back(f.path);
    for (std::string& engine : engine_files_beside(deck)) tree.push_back(std::move(engine));
  }
  const auto done = complete_interrupted_write(main, tree);
  if (!done)
    return Error{done.error().code,
                 "a rewriting of " + main +
                     " was interrupted and cannot be finished: " + done.error().message +
                     "; nothing was written. Give all decks of that call again, or remove the "
                     "note if it is not wanted"};
  if (*done > 0 && !common.quiet)
    print_messages(fmt::format("deck: note: the interrupted writing of {} was finished: {}\n",
                               terminal_text(main), count(*done, "file", "files")));
  return done;
}

}  // namespace

Result<std::map<FileIdentity, std::string>> recover_and_find_dependents(
    const std::vector<std::string>& decks, const std::string& root, const CommonOptions& common) {
  while (true) {
    auto shared = find_shared_files(decks, root, common.include_paths);
    if (!shared) return shared.error();
    std::size_t changed = 0;
    for (const std::string& deck : decks) {
      const auto done = common.rewrites ? complete_interrupted(deck, decks, common) : 0;
      if (!done) return done.error();
      changed += *done;
    }
    if (changed > 0) continue;  // other contents now
    if (const std::string where = shared->where(); !where.empty() && !common.quiet)
      print_note(where);
    return std::move(shared->others);
  }
}

Result<std::vector<std::string>> Changes::decks(const std::vector<std::string>& given) {
  for (const std::string& path : given) note_found(path, find_deck(path), common_);
  auto all = expand_decks(given, choice_.directory);
  if (!all) return all;
  if (all->empty()) return no_deck_in(given.empty() ? "." : given.front());
  if (const BatchHooks* frame = common_.session->frame) {
    root_ = frame->root;
    outsiders_ = frame->outsiders;
  } else if (!choice_.directory.empty() && names_directory(given)) {
    std::vector<std::string> files = *all;
    IncludeScan scan(common_.include_paths);
    for (const std::string& deck : *all)
      for (const IncludeScan::File& f : scan.files(deck)) files.push_back(f.path);
    root_ = common_root(given, files);
  } else if (choice_.in_place) {
    auto outsiders = recover_and_find_dependents(*all, choice_.root, common_);
    if (!outsiders) return outsiders.error();
    outsiders_ = std::move(*outsiders);
  }
  set_ = EditSet(root_);
  return all;
}

Result<std::size_t> Changes::add(const LoadedDeck& loaded, const std::string& name) {
  auto deck = set_.add(loaded.deck(), name);
  if (deck) names_.push_back(name);
  return deck;
}

void Changes::propose(std::size_t deck, const Deck& now, const ChangedFiles& changed) {
  set_.propose(deck, now, changed);
  if (BatchHooks* frame = common_.session->frame)
    frame->decks[names_[deck]].changed = changed.size();
}

void Changes::list_files(const std::vector<OutputFile>& files) const {
  if (common_.quiet) return;
  for (const OutputFile& f : files) print_lines(terminal_text(f.path) + "\n");
}

/// Reads every deck with the planned contents: it must consist of the decided texts in order.
Result<void> Changes::read_back(const EditSet::Plan& plan) const {
  Overlay overlay;
  for (const OutputFile& f : plan.files) {
    overlay.insert_or_assign(normal_path(f.path), std::string(f.bytes));
    overlay.insert_or_assign(f.path, std::string(f.bytes));  // a main file is opened by its name
  }
  for (const auto& [path, planned] : set_.other_paths())
    if (const auto it = overlay.find(planned); it != overlay.end())
      overlay.insert_or_assign(path, it->second);
  ReadOptions read;
  read.include_paths = common_.include_paths;
  read.overlay = &overlay;
  for (std::size_t d = 0; d < names_.size(); ++d) {
    const auto deck = read_deck(plan.mains[d], SchemaSet::built_in(), read);
    if (!deck) return deck.error();
    if (const std::string why = set_.read_back_difference(d, *deck); !why.empty())
      return Error{Error::Code::internal, plan.mains[d] +
                                              ": read back, it is not what was converted: " + why +
                                              "; nothing was written"};
  }
  return {};
}

/// The planned contents by path.
Result<EditSet::Plan> Changes::plan() {
  if (choice_.in_place)
    for (const auto& [file, deck] : outsiders_) set_.add_outsider(file, deck);
  auto plan = choice_.in_place ? set_.in_place() : set_.tree(choice_.directory);
  if (plan && choice_.read_back)
    if (auto same = read_back(*plan); !same) return same.error();
  if (plan && common_.session->frame != nullptr)  // a batch has its own record
    for (OutputFile& f : plan->files) f.origin.clear();
  return plan;
}

OutputRules Changes::rules(bool deck_tree) const {
  OutputRules rules;
  rules.deck_tree = deck_tree;
  rules.overwrite = deck_tree && choice_.overwrite;
  if (const BatchHooks* frame = common_.session->frame) rules.ours = frame->ours;
  return rules;
}

Result<void> Changes::check() {
  if (!choice_.in_place && choice_.directory.empty()) {
    const auto patch = diff();
    return patch ? Result<void>() : Result<void>(patch.error());
  }
  const auto planned = plan();
  if (!planned) return planned.error();
  if (choice_.in_place) return {};
  return common_.session->check_outputs(planned->files, rules(true));
}

Result<void> Changes::write(bool list) {
  const auto planned = plan();
  if (!planned) return planned.error();
  BatchHooks* frame = common_.session->frame;
  const std::string below = normal_path(choice_.directory);
  for (std::size_t d = 0; frame != nullptr && !choice_.in_place && d < names_.size(); ++d)
    frame->decks[names_[d]].target = fs::path(planned->mains[d]).lexically_relative(below).string();
  WriteOptions options{choice_.backup_suffix};
  if (choice_.in_place && !planned->mains.empty()) options.note_beside = planned->mains.front();
  if (auto done = put(planned->files, options, rules(true)); !done) return done;
  if (!planned->files.empty()) common_.session->remember_written();
  for (const std::string& path : planned->outside)
    print_note(path + " is included by its absolute path and was not copied");
  if (list) list_files(planned->files);
  return {};
}

Result<void> Changes::write_documents(const std::vector<OutputFile>& files, bool list) {
  auto done = put(files, {}, rules(false));
  if (done && list) list_files(files);
  return done;
}

/// Writes all files or none.
Result<void> Changes::put(const std::vector<OutputFile>& files, WriteOptions options,
                          const OutputRules& rules) {
  BatchHooks* frame = common_.session->frame;
  if (auto claimed = common_.session->check_claimed(); !claimed) return claimed;
  if (!choice_.in_place) {
    options.make_directories = true;
    options.below = choice_.directory;
    options.sync = frame == nullptr;
    if (auto allowed = common_.session->check_outputs(files, rules); !allowed) return allowed;
  }
  if (frame != nullptr && frame->before_writing)
    if (auto announced = frame->before_writing(files); !announced) return announced;
  if (auto done = write_files_atomic(files, options); !done) return done;
  if (frame != nullptr) frame->written = true;
  return {};
}

}  // namespace deck::cli
