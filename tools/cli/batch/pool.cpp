// Forks workers, assigns jobs, and detects workers that die or take too long. Output of a worker
// goes to shared files in memory; it wakes the parent by a signal.
#include "batch/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <list>
#include <optional>

namespace deck::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Blocks termination signals and SIGCHLD during its lifetime. Workers inherit that: the parent
/// decides when to stop.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&set_);
    sigaddset(&set_, SIGCHLD);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction now {};
      sigaction(number, nullptr, &now);
      if (now.sa_handler != SIG_IGN) sigaddset(&set_, number);  // nohup
    }
    pthread_sigmask(SIG_BLOCK, &set_, &before_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  /// Waits a tenth of a second or for a signal. Returns a termination signal, or 0.
  int wait() const {
    const timespec tenth{0, 100'000'000};
    const int number = sigtimedwait(&set_, nullptr, &tenth);
    return number <= 0 || number == SIGCHLD ? 0 : number;
  }

 private:
  sigset_t set_{}, before_{};
};

/// A file in memory; writes append.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : file(memfd_create(name, MFD_CLOEXEC)) {
    if (file >= 0) fcntl(file, F_SETFL, O_APPEND);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() {
    if (file >= 0) close(file);
  }
  const int file;
};

std::string whole(int fd) {
  std::string text(static_cast<std::size_t>(std::max<off_t>(0, lseek(fd, 0, SEEK_END))), '\0');
  std::size_t got = 0;
  for (ssize_t n = 1; got < text.size() && n > 0;
       got += static_cast<std::size_t>(std::max<ssize_t>(n, 0)))
    n = pread(fd, text.data() + got, text.size() - got, static_cast<off_t>(got));
  text.resize(got);
  return text;
}

/// A process that runs jobs one after another. It ends with this object.
class Worker {
 public:
  explicit Worker(const WorkerPool& pool) : pool_(pool) {
    if (answer_.file < 0 || out_.file < 0 || err_.file < 0 ||
        socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, line_) != 0)
      return;
    std::fflush(nullptr);  // prevents the worker from printing buffered output again
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0) serve(parent);
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    if (pid_ > 0) kill(pid_, SIGKILL);
    if (pid_ > 0) waitpid(pid_, nullptr, 0);
    for (const int end : line_)
      if (end >= 0) close(end);
  }
  bool alive() const { return pid_ > 0; }
  bool busy() const { return job_.has_value(); }
  void assign(std::size_t job) {
    const std::uint64_t number = job;
    job_ = job;
    start_ = Clock::now();
    // Kills a worker that cannot be reached; its end is detected as usual.
    if (send(line_[0], &number, sizeof number, MSG_NOSIGNAL) != sizeof number) kill(pid_, SIGKILL);
  }
  /// Report of its last job; nullopt: still running, or none.
  std::optional<JobReport> report() {
    JobReport report{job_.value_or(0), {}, -1, {}, {}};
    char done = 0;
    int status = 0;
    if (recv(line_[0], &done, 1, MSG_DONTWAIT) == 1) {
      report.answer = whole(answer_.file);
    } else {
      const bool late = busy() && pool_.timeout > 0 &&
                        Clock::now() - start_ > std::chrono::duration<double>(pool_.timeout);
      if (late) kill(pid_, SIGKILL);
      if (waitpid(pid_, &status, late ? 0 : WNOHANG) != pid_) return std::nullopt;
      pid_ = -1;
      report.err = whole(err_.file);
      if (late) {
        report.why = fmt::format("no answer in {} s", pool_.timeout);
      } else if (WIFSIGNALED(status)) {
        report.why =
            fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
      } else {
        report.exit_code = WEXITSTATUS(status);
        report.why = fmt::format("ended with exit code {}", report.exit_code);
      }
    }
    const bool had_one = busy();
    job_.reset();
    return had_one ? std::optional(std::move(report)) : std::nullopt;
  }

 private:
  [[noreturn]] void serve(pid_t parent) const {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent || dup2(out_.file, 1) < 0 || dup2(err_.file, 2) < 0) _exit(120);
    std::uint64_t job = 0;
    while (recv(line_[1], &job, sizeof job, 0) == sizeof job) {
      for (const int file : {answer_.file, out_.file, err_.file})
        if (ftruncate(file, 0) != 0) _exit(120);
      const std::string answer = pool_.work(static_cast<std::size_t>(job), {out_.file, err_.file});
      for (std::string_view left = answer; !left.empty();) {
        const ssize_t n = write(answer_.file, left.data(), left.size());
        if (n <= 0) _exit(120);
        left.remove_prefix(static_cast<std::size_t>(n));
      }
      if (send(line_[1], "", 1, MSG_NOSIGNAL) != 1) _exit(120);
      kill(parent, SIGCHLD);
    }
    _exit(0);
  }
  const WorkerPool& pool_;
  const MemoryFile answer_{"answer"}, out_{"out"}, err_{"err"};
  int line_[2] = {-1, -1};  ///< ends of the parent and of the worker
  pid_t pid_ = -1;
  std::optional<std::size_t> job_;
  Clock::time_point start_ = {};
};

}  // namespace

std::string Captured::out() const {
  std::fflush(stdout);
  return whole(out_file);
}
std::string Captured::err() const {
  std::fflush(stderr);
  return whole(err_file);
}

Result<int> WorkerPool::run(std::size_t jobs, const std::function<void(const JobReport&)>& done,
                            const std::function<void()>& tick) const {
  const HeldSignals signals;
  std::list<Worker> pool;
  for (std::size_t next = 0, finished = 0; finished < jobs;) {
    while (pool.size() < std::min<std::size_t>(std::max(1, workers), jobs - finished)) {
      if (pool.emplace_back(*this).alive()) continue;
      const int code = errno;
      pool.pop_back();
      if (pool.empty())
        return Error{Error::Code::internal,
                     std::string("cannot start a worker: ") + std::strerror(code)};
      break;  // continues with fewer
    }
    for (Worker& worker : pool)
      if (!worker.busy() && next < jobs) worker.assign(next++);
    if (const int ends = signals.wait(); ends != 0) return ends;
    for (Worker& worker : pool)
      if (const auto report = worker.report()) {
        ++finished;
        done(*report);
      }
    pool.remove_if([](const Worker& worker) { return !worker.alive(); });
    tick();
  }
  return 0;
}

}  // namespace deck::cli
