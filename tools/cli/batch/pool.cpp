// Forks workers, hands out jobs, notices those that die or take too long. A worker and the parent
// have a pair of sockets, for the numbers of jobs and for "done", and files in memory that they
// share.
#include "batch/pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace deck::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Holds back the signals that end a program from outside, as long as it lives: `file` tells them.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction now {};
      sigaction(number, nullptr, &now);
      if (now.sa_handler != SIG_IGN) sigaddset(&set, number);  // nohup
    }
    pthread_sigmask(SIG_BLOCK, &set, &before_);
    file = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() {
    if (file >= 0) close(file);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  /// Number of one that came; 0: none.
  int caught() const {
    signalfd_siginfo info{};
    return read(file, &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
  }

  int file = -1;

 private:
  sigset_t before_{};
};

std::string whole(int fd) {
  std::string text;
  const off_t size = lseek(fd, 0, SEEK_END);
  if (size <= 0) return text;
  text.resize(static_cast<std::size_t>(size));
  std::size_t got = 0;
  while (got < text.size()) {
    const ssize_t n = pread(fd, text.data() + got, text.size() - got, static_cast<off_t>(got));
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  text.resize(got);
  return text;
}

bool write_whole(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// A file in memory that writes always extend.
int memory_file(const char* name) {
  const int fd = memfd_create(name, MFD_CLOEXEC);
  if (fd >= 0) fcntl(fd, F_SETFL, O_APPEND);
  return fd;
}

struct Worker {
  pid_t pid = -1;
  int line = -1;                        ///< to the worker
  int answer = -1, out = -1, err = -1;  ///< files in memory, which the worker fills
  bool busy = false;
  std::size_t job = 0;
  Clock::time_point deadline = {};

  void close_all() const {
    for (const int fd : {line, answer, out, err})
      if (fd >= 0) close(fd);
  }
};

/// The life of a worker. `line` leads to the parent.
[[noreturn]] void serve(int line, const Worker& files, const WorkerPool& pool) {
  if (dup2(files.out, 1) < 0 || dup2(files.err, 2) < 0) _exit(120);
  std::uint64_t job = 0;
  while (recv(line, &job, sizeof job, 0) == sizeof job) {
    for (const int fd : {files.answer, files.out, files.err})
      if (ftruncate(fd, 0) != 0) _exit(120);
    const std::string answer = pool.work(static_cast<std::size_t>(job), {files.out, files.err});
    if (!write_whole(files.answer, answer) || send(line, "", 1, MSG_NOSIGNAL) != 1) _exit(120);
  }
  _exit(0);
}

/// The workers that live; none of them outlives it.
class Workers {
 public:
  explicit Workers(const WorkerPool& pool) : pool_(pool) {}
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() {
    for (Worker& w : workers_) (void)bury(w, "");
  }

  Result<void> start();
  void assign(Worker& worker, std::size_t job) const;
  /// Waits until something happens, a little at most; the reports of what did.
  std::vector<JobReport> wait(int signals);
  std::vector<Worker>& all() { return workers_; }

 private:
  static JobReport bury(Worker& worker, const std::string& why);

  const WorkerPool& pool_;
  std::vector<Worker> workers_;
};

Result<void> Workers::start() {
  int ends[2] = {-1, -1};
  Worker worker;
  worker.answer = memory_file("answer");
  worker.out = memory_file("out");
  worker.err = memory_file("err");
  const bool ready = worker.answer >= 0 && worker.out >= 0 && worker.err >= 0 &&
                     socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) == 0;
  worker.line = ends[0];
  std::fflush(nullptr);  // what is buffered now must not be printed by the worker as well
  const pid_t parent = getpid();
  if (ready) worker.pid = fork();
  if (worker.pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(0);
    close(worker.line);
    for (const Worker& other : workers_) other.close_all();
    serve(ends[1], worker, pool_);  // with signals held: the parent decides when to stop
  }
  const int code = errno;
  if (ends[1] >= 0) close(ends[1]);
  if (worker.pid < 0) {
    worker.close_all();
    return Error{Error::Code::internal,
                 std::string("cannot start a worker: ") + std::strerror(code)};
  }
  workers_.push_back(worker);
  return {};
}

void Workers::assign(Worker& worker, std::size_t job) const {
  const std::uint64_t number = job;
  worker.busy = true;
  worker.job = job;
  worker.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(pool_.timeout));
  // One that cannot be told what to do would be waited for; its end is noticed like any other.
  if (send(worker.line, &number, sizeof number, MSG_NOSIGNAL) != sizeof number)
    kill(worker.pid, SIGKILL);
}

/// Ends a worker, if it has not ended. `why` it is killed; empty: see how it ended.
JobReport Workers::bury(Worker& worker, const std::string& why) {
  JobReport report;
  int status = 0;
  shutdown(worker.line, SHUT_RDWR);
  if (!why.empty() || worker.busy) kill(worker.pid, SIGKILL);  // may be gone already
  waitpid(worker.pid, &status, 0);
  report.job = worker.job;
  report.err = whole(worker.err);
  report.why = why;
  if (why.empty() && WIFSIGNALED(status)) {
    report.why =
        fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  } else if (why.empty()) {
    report.exit_code = WEXITSTATUS(status);
    report.why = fmt::format("ended with exit code {}", report.exit_code);
  }
  worker.close_all();
  worker.pid = -1;
  return report;
}

std::vector<JobReport> Workers::wait(int signals) {
  auto until = Clock::now() + std::chrono::milliseconds(100);
  std::vector<pollfd> fds;
  for (const Worker& w : workers_) {
    fds.push_back({w.line, POLLIN, 0});
    if (w.busy && pool_.timeout > 0) until = std::min(until, w.deadline);
  }
  fds.push_back({signals, POLLIN, 0});
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
  poll(fds.data(), fds.size(), static_cast<int>(std::max<std::int64_t>(0, left + 1)));
  std::vector<JobReport> reports;
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    Worker& w = workers_[i];
    char done = 0;
    if (fds[i].revents != 0 && recv(w.line, &done, 1, 0) == 1) {
      w.busy = false;
      reports.push_back({w.job, true, whole(w.answer), -1, "", ""});
    } else if (fds[i].revents != 0) {
      const bool busy = w.busy;
      JobReport report = bury(w, "");
      if (busy) reports.push_back(std::move(report));
    } else if (w.busy && pool_.timeout > 0 && Clock::now() >= w.deadline) {
      reports.push_back(bury(w, fmt::format("no answer in {} s", pool_.timeout)));
    }
  }
  std::erase_if(workers_, [](const Worker& w) { return w.pid < 0; });
  return reports;
}

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
  Workers pool(*this);
  for (std::size_t next = 0, finished = 0; finished < jobs;) {
    const std::size_t wanted =
        std::min(static_cast<std::size_t>(std::max(1, workers)), jobs - finished);
    while (pool.all().size() < wanted)
      if (auto started = pool.start(); !started) {
        if (pool.all().empty()) return started.error();
        break;  // fewer will do
      }
    for (Worker& w : pool.all())
      if (!w.busy && next < jobs) pool.assign(w, next++);
    const std::vector<JobReport> reports = pool.wait(signals.file);
    if (const int caught = signals.caught(); caught != 0) return caught;
    for (const JobReport& report : reports) {
      ++finished;
      done(report);
    }
    tick();
  }
  return 0;
}

}  // namespace deck::cli
