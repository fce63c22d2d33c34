// Forks workers, hands out jobs, notices those that die or take too long.
#include "batch/pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>

namespace deck::cli {
namespace {

using Clock = std::chrono::steady_clock;

volatile sig_atomic_t caught = 0;
void on_signal(int number) { caught = number; }

/// Catches the signals that end a program from outside, as long as it lives.
class SignalGuard {
 public:
  SignalGuard() {
    caught = 0;
    struct sigaction action {};
    action.sa_handler = on_signal;
    for (std::size_t i = 0; i < std::size(numbers); ++i)
      sigaction(numbers[i], &action, &before_[i]);
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;  // a worker that is gone shows as the end of its pipe
    sigaction(SIGPIPE, &ignore, &pipe_before_);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;
  ~SignalGuard() {
    for (std::size_t i = 0; i < std::size(numbers); ++i)
      sigaction(numbers[i], &before_[i], nullptr);
    sigaction(SIGPIPE, &pipe_before_, nullptr);
  }

 private:
  static constexpr int numbers[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction before_[3]{}, pipe_before_{};
};

/// One deck after the other asks for the same memory again: what is free stays where it is instead
/// of being joined, given back to the system and fetched anew for each.
void keep_memory() {
#ifdef __GLIBC__
  constexpr int most = 64 << 20;
  mallopt(M_MXFAST, 0);
  mallopt(M_MMAP_THRESHOLD, most / 2);
  mallopt(M_TRIM_THRESHOLD, most);
#endif
}

bool read_exactly(int fd, void* to, std::size_t size) {
  auto* at = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t n = read(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool write_exactly(int fd, const void* from, std::size_t size) {
  const auto* at = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t n = write(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

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

/// A file in memory that writes always extend.
int memory_file(const char* name) {
  const int fd = memfd_create(name, MFD_CLOEXEC);
  if (fd >= 0) fcntl(fd, F_SETFL, O_APPEND);
  return fd;
}

struct Worker {
  pid_t pid = -1;
  int jobs = -1, results = -1, err = -1;
  bool busy = false;
  std::size_t job = 0;
  Clock::time_point deadline;
  std::string received;

  void close_all() {
    for (int* fd : {&jobs, &results, &err}) {
      if (*fd >= 0) close(*fd);
      *fd = -1;
    }
  }
};

/// The life of a worker: numbers come in, length and message go out.
[[noreturn]] void serve(int jobs, int results, int err, const WorkerPool::Work& work) {
  const int out = memory_file("out");
  if (out < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) _exit(120);
  Captured captured(out, err);
  std::uint64_t job = 0;
  while (read_exactly(jobs, &job, sizeof job)) {
    captured.reset();
    const std::string message = work(static_cast<std::size_t>(job), captured);
    const std::uint64_t size = message.size();
    if (!write_exactly(results, &size, sizeof size) ||
        !write_exactly(results, message.data(), message.size()))
      break;
  }
  _exit(0);
}

class Run {
 public:
  Run(double timeout, const WorkerPool::Work& work) : timeout_(timeout), work_(work) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  ~Run() {
    for (Worker& w : workers_) {
      if (w.busy) kill(w.pid, SIGKILL);
      w.close_all();
    }
    for (const Worker& w : workers_)
      if (w.pid > 0) waitpid(w.pid, nullptr, 0);
  }

  Result<void> start();
  void assign(Worker& worker, std::size_t job);
  /// Waits for something to happen; the reports of what did.
  std::vector<JobReport> wait(std::chrono::milliseconds longest);

  std::vector<Worker>& workers() { return workers_; }

 private:
  void receive(Worker& worker, std::vector<JobReport>& reports);
  JobReport bury(Worker& worker, const std::string& why);

  double timeout_;
  const WorkerPool::Work& work_;
  std::vector<Worker> workers_;
};

Result<void> Run::start() {
  int jobs[2], results[2];
  const auto failed = [](const char* what) {
    return Error{Error::Code::internal,
                 std::string("cannot start a worker: ") + what + ": " + std::strerror(errno)};
  };
  if (pipe2(jobs, O_CLOEXEC) != 0) return failed("pipe");
  if (pipe2(results, O_CLOEXEC) != 0) {
    close(jobs[0]);
    close(jobs[1]);
    return failed("pipe");
  }
  Worker worker;
  worker.jobs = jobs[1];
  worker.results = results[0];
  worker.err = memory_file("err");
  std::fflush(nullptr);  // what is buffered now must not be printed by the worker as well
  const pid_t parent = getpid();
  worker.pid = worker.err < 0 ? -1 : fork();
  if (worker.pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(0);
    // The parent decides when to stop; an interrupt from the terminal reaches all of us.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) signal(number, SIG_IGN);
    close(jobs[1]);
    close(results[0]);
    for (Worker& other : workers_) other.close_all();
    keep_memory();
    serve(jobs[0], results[1], worker.err, work_);
  }
  const int code = errno;
  close(jobs[0]);
  close(results[1]);
  if (worker.pid < 0) {
    worker.close_all();
    errno = code;
    return failed("fork");
  }
  fcntl(worker.results, F_SETFL, O_NONBLOCK);
  workers_.push_back(std::move(worker));
  return {};
}

void Run::assign(Worker& worker, std::size_t job) {
  const std::uint64_t number = job;
  worker.busy = true;
  worker.job = job;
  worker.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(timeout_));
  // A worker that cannot be told what to do would be waited for; its end is noticed like any other.
  if (!write_exactly(worker.jobs, &number, sizeof number)) kill(worker.pid, SIGKILL);
}

JobReport Run::bury(Worker& worker, const std::string& why) {
  int status = 0;
  waitpid(worker.pid, &status, 0);
  JobReport report;
  report.job = worker.job;
  report.err = whole(worker.err);
  report.why = why;
  if (why.empty() && WIFSIGNALED(status))
    report.why =
        fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  else if (why.empty()) {
    report.exit_code = WEXITSTATUS(status);
    report.why = fmt::format("ended with exit code {}", report.exit_code);
  }
  worker.close_all();
  worker.pid = -1;
  worker.busy = false;
  return report;
}

void Run::receive(Worker& worker, std::vector<JobReport>& reports) {
  char buffer[65536];
  bool end = false;
  for (;;) {
    const ssize_t n = read(worker.results, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      end = n == 0 || errno != EAGAIN;
      break;
    }
    worker.received.append(buffer, static_cast<std::size_t>(n));
  }
  std::uint64_t size = 0;
  if (worker.received.size() >= sizeof size) {
    std::memcpy(&size, worker.received.data(), sizeof size);
    if (worker.received.size() >= sizeof size + size) {
      JobReport report;
      report.job = worker.job;
      report.answered = true;
      report.message = worker.received.substr(sizeof size, size);
      worker.received.clear();  // one job at a time: nothing can follow
      worker.busy = false;
      reports.push_back(std::move(report));
      return;
    }
  }
  if (end) {
    const bool busy = worker.busy;
    kill(worker.pid, SIGKILL);  // nearly always gone already
    JobReport report = bury(worker, "");
    if (busy) reports.push_back(std::move(report));
  }
}

std::vector<JobReport> Run::wait(std::chrono::milliseconds longest) {
  std::vector<pollfd> fds;
  std::vector<std::size_t> who;
  auto until = Clock::now() + longest;
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    if (workers_[i].pid < 0) continue;
    fds.push_back({workers_[i].results, POLLIN, 0});
    who.push_back(i);
    if (workers_[i].busy && timeout_ > 0) until = std::min(until, workers_[i].deadline);
  }
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
  std::vector<JobReport> reports;
  if (poll(fds.data(), fds.size(), static_cast<int>(std::max<std::int64_t>(0, left + 1))) > 0)
    for (std::size_t i = 0; i < fds.size(); ++i)
      if (fds[i].revents != 0) receive(workers_[who[i]], reports);
  if (timeout_ > 0)
    for (Worker& w : workers_)
      if (w.busy && Clock::now() >= w.deadline) {
        kill(w.pid, SIGKILL);
        reports.push_back(bury(w, fmt::format("no answer in {} s", timeout_)));
      }
  std::erase_if(workers_, [](const Worker& w) { return w.pid < 0; });
  return reports;
}

}  // namespace

void Captured::reset() {
  for (const int fd : {out_, err_})
    if (ftruncate(fd, 0) != 0) _exit(120);
}
std::string Captured::out() const {
  std::fflush(stdout);
  return whole(out_);
}
std::string Captured::err() const {
  std::fflush(stderr);
  return whole(err_);
}

Result<int> WorkerPool::run(const std::vector<std::size_t>& jobs,
                            const std::function<bool(JobReport)>& done,
                            const std::function<void()>& tick) {
  const SignalGuard guard;
  Run run(timeout_, work_);
  std::size_t next = 0, finished = 0;
  while (finished < jobs.size()) {
    if (caught != 0) return static_cast<int>(caught);
    const std::size_t wanted =
        std::min(static_cast<std::size_t>(std::max(1, workers_)), jobs.size() - finished);
    while (run.workers().size() < wanted)
      if (auto started = run.start(); !started) {
        if (run.workers().empty()) return started.error();
        break;  // fewer will do
      }
    for (Worker& w : run.workers())
      if (!w.busy && next < jobs.size()) run.assign(w, jobs[next++]);
    for (JobReport& report : run.wait(std::chrono::milliseconds(100))) {
      ++finished;
      if (caught != 0) return static_cast<int>(caught);
      if (!done(std::move(report))) return 0;
    }
    tick();
  }
  return 0;
}

}  // namespace deck::cli
