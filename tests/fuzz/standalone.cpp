// A fuzz target without libFuzzer, for builds without clang. `TARGET FILE...` runs the inputs once;
// `TARGET -SECONDS SEED DIR CRASH [MOST]` mutates the inputs of a directory blindly for so long:
// what the mutator knows of decks has to do without coverage. Seconds are processor time; an input
// has MOST bytes at most, and stands in the file CRASH while it is at work, behind its length and
// the number of those before it (8 bytes each). One that takes 25 s ends the program.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed);
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* a, std::size_t a_size,
                                                 const std::uint8_t* b, std::size_t b_size,
                                                 std::uint8_t* out, std::size_t most,
                                                 unsigned seed);

namespace {

std::minstd_rand random_number;

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void run(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

/// Processor time so far, of all threads.
double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string mutated(const std::string& a, const std::string& b, std::size_t most) {
  std::string out = a;
  out.resize(most);
  auto* data = reinterpret_cast<std::uint8_t*>(out.data());
  std::size_t size = std::min(a.size(), most);
  if (random_number() % 8 == 0)
    size = LLVMFuzzerCustomCrossOver(reinterpret_cast<const std::uint8_t*>(a.data()), a.size(),
                                     reinterpret_cast<const std::uint8_t*>(b.data()), b.size(),
                                     data, most, static_cast<unsigned>(random_number()));
  for (unsigned n = 1 + static_cast<unsigned>(random_number()) % 3; n > 0; --n)
    size = LLVMFuzzerCustomMutator(data, size, most, static_cast<unsigned>(random_number()));
  out.resize(size);
  return out;
}

}  // namespace

/// libFuzzer's own mutations, in short: bytes changed, taken out, put in.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most) {
  for (int n = 0; n < 3; ++n) {
    const std::size_t at = size == 0 ? 0 : random_number() % size;
    const auto byte = static_cast<std::uint8_t>(random_number());
    switch (random_number() % 3) {
      case 0:
        if (size > 0) data[at] = byte;
        break;
      case 1:
        if (size == 0) break;
        std::memmove(data + at, data + at + 1, --size - at);
        break;
      default:
        if (size >= most) break;
        std::memmove(data + at + 1, data + at, size++ - at);
        data[at] = byte;
    }
  }
  return size;
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  if (argv[1][0] != '-') {
    for (int i = 1; i < argc; ++i) run(read(argv[i]));
    return 0;
  }
  if (argc != 5 && argc != 6) return 2;
  const double end = processor_seconds() + std::atoi(argv[1] + 1);
  const std::size_t most = argc == 6 ? static_cast<std::size_t>(std::atoi(argv[5])) : 12288;
  random_number.seed(static_cast<unsigned>(std::atoi(argv[2])));
  std::vector<std::string> pool;
  for (const auto& entry : std::filesystem::directory_iterator(argv[3]))
    pool.push_back(read(entry.path()));
  std::sort(pool.begin(), pool.end());
  const int fd = ::open(argv[4], O_RDWR | O_CREAT | O_TRUNC, 0600);
  if (pool.empty() || fd < 0 || ::ftruncate(fd, static_cast<off_t>(most + 16)) != 0) return 2;
  auto* shared =
      static_cast<char*>(::mmap(nullptr, most + 16, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0));
  std::uint64_t executions = 0;
  for (; processor_seconds() < end; ++executions) {
    const itimerval patience{{}, {25, 0}};
    ::setitimer(ITIMER_PROF, &patience, nullptr);
    const std::string& from = pool[random_number() % pool.size()];
    const std::string input = mutated(from, pool[random_number() % pool.size()], most);
    const std::uint64_t size = input.size();
    std::memcpy(shared, &size, 8);
    std::memcpy(shared + 8, &executions, 8);
    std::memcpy(shared + 16, input.data(), input.size());
    run(input);
  }
  std::printf("%llu\n", static_cast<unsigned long long>(executions));
  return 0;
}
