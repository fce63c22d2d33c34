// Gets files of a deck at a revision, changed lines and commits from git.
#include "verbs/git_deck.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>

#include "base/shared/paths.hpp"
#include "deck/report.hpp"
#include "keyword/shared/include_scan.hpp"
#include "library.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace asking_git {
namespace {

struct Answer {
  std::string out;
  int code = 0;
};

/// Git is called only here, with options that prevent running commands of the repository and
/// fetching. without_filters() disables filters, which only run when the work tree is compared.
constexpr const char* harmless[] = {"--no-optional-locks",      "-c", "core.fsmonitor=false", "-c",
                                    "core.hooksPath=/dev/null", "-c", "protocol.allow=never"};

/// Runs git with `input`; returns standard output, hides standard error.
Result<Answer> run_git(const std::vector<std::string>& words, const std::string& input = {}) {
  std::string call = "printf %s " + shell_word(input) + " | git";
  for (const char* word : harmless) call += " " + shell_word(word);
  for (const std::string& word : words) call += " " + shell_word(word);
  FILE* const pipe = popen((call + " 2>/dev/null").c_str(), "re");
  constexpr int not_found = 127;  // the shell's code
  Answer answer;
  char buffer[65536];
  while (pipe != nullptr) {
    const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe);
    if (n == 0) break;
    answer.out.append(buffer, n);
  }
  const int status = pipe == nullptr ? -1 : pclose(pipe);
  answer.code = status < 0 ? not_found : WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  if (answer.code == not_found) return config_error("git cannot be run");
  return answer;
}

/// Files of a revision by path in the work tree.
class Revision {
 public:
  Revision(std::string root, std::string name) : root_(std::move(root)), name_(std::move(name)) {}
  Result<void> check() const {
    // A name starting with a dash would be an option.
    if (name_.empty() || name_.starts_with('-'))
      return config_error("'" + name_ + "' is no git revision");
    const auto known =
        run_git({"-C", root_, "rev-parse", "--verify", "--quiet", name_ + "^{commit}"});
    if (!known) return known.error();
    if (known->code != 0) return config_error("git knows no revision '" + name_ + "' in " + root_);
    return {};
  }
  /// nullopt: not in git. Follows links within the tree.
  Result<std::optional<std::string>> file(const std::string& path) const {
    if (path.find('\n') != path.npos) return std::optional<std::string>();
    auto answer = run_git({"-C", root_, "cat-file", "--batch", "--follow-symlinks"},
                          name_ + ":" + path + "\n");
    if (!answer) return answer.error();
    // "<name> blob <size>", then the bytes; other words if it is not a file.
    const std::size_t head = answer->out.find('\n');
    const std::size_t name = answer->out.find_first_not_of("0123456789abcdef");
    if (answer->code != 0 || head == answer->out.npos ||
        answer->out.compare(name, 6, " blob ") != 0)
      return std::optional<std::string>();
    std::string bytes = answer->out.substr(head + 1);
    if (!bytes.empty()) bytes.pop_back();
    return std::optional(std::move(bytes));
  }
  std::string shown(const std::string& path) const {
    return std::string(git_prefix) + name_ + "/" + path;
  }

 private:
  std::string root_, name_;
};

/// Adds included files: beside the file, else beside the main file, as the reader does.
Result<void> add_includes(const Revision& revision, const std::string& of, const std::string& main,
                          GitDeck& out, std::vector<std::string>& waiting) {
  for (const std::string& name : included_names(out.files.at(revision.shown(of)))) {
    if (name.starts_with('/')) continue;  // read from disk
    for (const std::string_view folder : {parent_path(of), parent_path(main)}) {
      std::string path = normal_path(folder.empty() ? name : std::string(folder) + "/" + name);
      if (path.starts_with("..")) continue;
      if (out.files.contains(revision.shown(path))) break;
      auto text = revision.file(path);
      if (!text) return text.error();
      if (!*text) continue;
      out.files.emplace(revision.shown(path), std::move(**text));
      waiting.push_back(std::move(path));
      break;
    }
  }
  return {};
}

/// Splits an answer at zero bytes.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    out.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

/// The git command with all configured filters disabled.
Result<std::vector<std::string>> without_filters(const std::string& root,
                                                 const std::vector<std::string>& words) {
  const auto keys =
      run_git({"-C", root, "config", "-z", "--name-only", "--get-regexp", "^filter[.]"});
  if (!keys) return keys.error();
  std::vector<std::string> out;
  for (const std::string& key : words_of(keys->out)) {
    if (key.find('=') != key.npos)
      return config_error("git has a filter whose name holds '=' (" + key +
                          "), which cannot be switched off; rename it");
    out.insert(out.end(), {"-c", key + (key.ends_with(".required") ? "=false" : "=")});
  }
  out.insert(out.end(), words.begin(), words.end());
  return out;
}

/// Merge base of a revision and the current commit; the revision itself if there is none.
Result<std::string> fork_point(const std::string& root, const std::string& revision) {
  const auto answer = run_git({"-C", root, "merge-base", revision, "HEAD"});
  if (!answer) return answer.error();
  const std::string name = answer->out.substr(0, answer->out.find('\n'));
  return answer->code == 0 && !name.empty() ? name : revision;
}

Error no_work_tree(const std::string& deck) {
  return {Error::Code::config, deck + " is in no git work tree"};
}

bool in_work_tree(const std::string& root) {
  namespace fs = std::filesystem;
  std::error_code ec;
  return fs::exists(fs::path(root) / ".git", ec);
}

}  // namespace
}  // namespace asking_git

std::vector<std::string> files_in_tree(const LoadedDeck& loaded, const std::string& root) {
  namespace fs = std::filesystem;
  std::set<std::string> files;
  const SourceSet& sources = loaded.deck().sources;
  for (std::uint32_t i = 0; i < sources.size(); ++i) {
    const fs::path inside = fs::path(absolute_path(sources[i].path())).lexically_relative(root);
    if (!inside.empty() && *inside.begin() != "..") files.insert(inside.generic_string());
  }
  return {files.begin(), files.end()};
}

Result<ChangedLines> changed_lines(const std::string& name, const LoadedDeck& loaded) {
  using namespace asking_git;
  const std::string root = library_root(loaded.path());
  if (loaded.path() == "-" || !in_work_tree(root)) return no_work_tree(loaded.path());
  if (auto known = Revision(root, name).check(); !known) return known.error();
  const auto base = fork_point(root, name);
  if (!base) return base.error();
  // No git setting changes this output.
  const auto diff = without_filters(root, {"-C", root, "diff", "--no-color", "--no-ext-diff",
                                           "--no-textconv", "--no-renames", "--ignore-submodules"});
  if (!diff) return diff.error();
  std::vector<std::string> words = *diff;
  words.insert(words.end(), {"--name-only", "-z", "--no-relative", *base});
  const auto names = run_git(words);
  if (!names) return names.error();
  const std::vector<std::string> touched = words_of(names->out);
  ChangedLines out;
  for (const std::string& file : files_in_tree(loaded, root)) {
    if (std::find(touched.begin(), touched.end(), file) == touched.end()) continue;
    words = *diff;
    words.insert(words.end(), {"--unified=0", *base, "--", ":(top,literal)" + file});
    const auto patch = run_git(words);
    if (!patch) return patch.error();
    out.add_hunks(root + "/" + file, patch->out);
  }
  return out;
}

Result<std::vector<Commit>> commits_of(const std::string& root,
                                       const std::vector<std::string>& files, std::size_t most) {
  using namespace asking_git;
  if (!in_work_tree(root)) return no_work_tree(root);
  std::vector<std::string> words = {"-C",
                                    root,
                                    "log",
                                    "-z",
                                    "--first-parent",
                                    "--no-color",
                                    "--no-show-signature",
                                    "--date=format:%Y-%m-%d",
                                    "--format=%h%n%ad%n%s"};
  words.insert(words.end(), {"--max-count=" + std::to_string(most), "--"});
  for (const std::string& file : files) words.push_back(":(top,literal)" + file);
  const auto answer = run_git(words);
  if (!answer) return answer.error();
  std::vector<Commit> out;
  if (answer->code != 0) return out;  // no commit yet
  for (const std::string& entry : words_of(answer->out)) {
    const std::size_t first = entry.find('\n'), second = entry.find('\n', first + 1);
    if (second == entry.npos) continue;
    out.push_back({entry.substr(0, first), entry.substr(first + 1, second - first - 1),
                   entry.substr(second + 1)});
  }
  return out;
}

Result<GitDeck> git_deck(const std::string& name, const std::string& given) {
  namespace fs = std::filesystem;
  const std::string deck = find_deck(given);
  const std::string root = library_root(deck);
  if (given == "-" || !asking_git::in_work_tree(root)) return asking_git::no_work_tree(given);
  const asking_git::Revision revision(root, name);
  if (auto known = revision.check(); !known) return known.error();
  const std::string main = fs::path(absolute_path(deck)).lexically_relative(root).generic_string();
  auto text = revision.file(main);
  if (!text) return text.error();
  if (!*text) return Error{Error::Code::io, "git has no " + main + " at revision '" + name + "'"};
  GitDeck out;
  out.path = revision.shown(main);
  out.files.emplace(out.path, std::move(**text));
  std::vector<std::string> waiting = {main};
  while (!waiting.empty()) {
    const std::string next = std::move(waiting.back());
    waiting.pop_back();
    if (auto added = asking_git::add_includes(revision, next, main, out, waiting); !added)
      return added.error();
  }
  return out;
}

Result<std::string> gaps_at_revision(const std::string& revision, const std::string& deck,
                                     const CommonOptions& options) {
  const auto old = git_deck(revision, deck);
  if (!old) return old.error();
  const auto schemas = load_schemas(options);
  if (!schemas) return schemas.error();
  auto loaded = load(old->path, *schemas, options, Stage::interfaces, &old->files);
  if (!loaded) return loaded.error();
  if (loaded->incomplete())
    return Error{Error::Code::io,
                 old->path +
                     ": a file that it includes is not in git, or lies outside of the work "
                     "tree; nothing can be compared with it"};
  SceneOptions wanted = loaded->scene_options();
  wanted.candidates = false;
  wanted.ties = true;
  loaded->set_scene_options(wanted);
  const Scene& scene = loaded->scene();
  return gaps_json(loaded->path(), loaded->deck(), scene, make_view(scene), false);
}

}  // namespace deck::cli
