// Asks git for the files of a deck at a revision.
#include "verbs/git_deck.hpp"

#include <fcntl.h>
#include <unistd.h>
#ifndef __EMSCRIPTEN__
#include <spawn.h>
#include <sys/wait.h>
#endif

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "deck/base/paths.hpp"
#include "deck/edit/include_scan.hpp"
#include "deck/report/gaps.hpp"
#include "deck/report/json.hpp"
#include "writing/library.hpp"

extern char** environ;

namespace deck::cli {
namespace asking_git {
namespace {

struct Answer {
  std::string out;
  int code = 0;
};

#ifdef __EMSCRIPTEN__
Result<Answer> run_git(const std::vector<std::string>&) {
  return Error{Error::Code::config, "git cannot be run here"};
}
#else
/// Standard output of a git command; what it says on standard error is not shown.
Result<Answer> run_git(const std::vector<std::string>& words) {
  const auto failed = [](int number) {
    return Error{Error::Code::config, std::string("git cannot be run: ") + std::strerror(number)};
  };
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return failed(errno);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  std::string program = "git";
  std::vector<std::string> texts = words;
  std::vector<char*> arguments = {program.data()};
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  pid_t pid = 0;
  const int wrong =
      posix_spawnp(&pid, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (wrong != 0) {
    close(ends[0]);
    return failed(wrong);
  }
  Answer answer;
  char buffer[65536];
  for (;;) {
    const ssize_t n = read(ends[0], buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    answer.out.append(buffer, static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return answer;
}
#endif

/// The files of a revision, by their paths from the top of the work tree.
class Revision {
 public:
  Revision(std::string root, std::string name) : root_(std::move(root)), name_(std::move(name)) {}

  Result<void> check() const {
    // A name that begins with a dash would be an option of git.
    if (name_.empty() || name_.starts_with('-'))
      return Error{Error::Code::config, "'" + name_ + "' is no git revision"};
    const auto known =
        run_git({"-C", root_, "rev-parse", "--verify", "--quiet", name_ + "^{commit}"});
    if (!known) return known.error();
    if (known->code != 0)
      return Error{Error::Code::config, "git knows no revision '" + name_ + "' in " + root_};
    return {};
  }

  /// nullopt: git does not have it.
  Result<std::optional<std::string>> file(const std::string& path) const {
    auto answer = run_git({"-C", root_, "cat-file", "blob", name_ + ":" + path});
    if (!answer) return answer.error();
    if (answer->code != 0) return std::optional<std::string>();
    return std::optional(std::move(answer->out));
  }

  std::string shown(const std::string& path) const {
    return std::string(git_prefix) + name_ + "/" + path;
  }

 private:
  std::string root_, name_;
};

/// Adds what a file includes: beside it, else beside the main file, as the reader looks for it.
Result<void> add_includes(const Revision& revision, const std::string& of, const std::string& main,
                          GitDeck& out, std::vector<std::string>& waiting) {
  for (const std::string& name : included_names(out.files.at(revision.shown(of)))) {
    if (name.starts_with('/')) continue;  // read from the disk
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

}  // namespace
}  // namespace asking_git

Result<GitDeck> git_deck(const std::string& name, const std::string& given) {
  namespace fs = std::filesystem;
  const std::string deck = find_deck(given);
  const std::string root = library_root(deck);
  if (std::error_code ec; given == "-" || !fs::exists(fs::path(root) / ".git", ec))
    return Error{Error::Code::config, given + " is in no git work tree"};
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
  SceneOptions wanted = loaded->scene_options();
  wanted.candidates = false;
  wanted.ties = true;
  loaded->set_scene_options(wanted);
  const Scene& scene = loaded->scene();
  return gaps_json(loaded->path(), loaded->deck(), scene, make_view(scene), false);
}

}  // namespace deck::cli
