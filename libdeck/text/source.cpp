// Maps files into memory, unpacks them, and finds lines and columns.
#include "deck/text.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <system_error>

#include "text/shared/gzip.hpp"

namespace deck {
namespace {

constexpr std::uint64_t checkpoint_step = 4 * 1024;
constexpr std::uint64_t given_back_at_once = 8 << 20;

/// Line ends in the `checkpoint_step` bytes at `first`: many small counters, so that the compiler
/// vectorizes the loop.
std::uint64_t line_ends(const char* first) {
  constexpr std::size_t wide = 32;
  static_assert(checkpoint_step % wide == 0 && checkpoint_step / wide < 256);
  std::array<unsigned char, wide> count{};
  for (std::size_t i = 0; i < checkpoint_step; i += wide)
    for (std::size_t k = 0; k < wide; ++k) count[k] += first[i + k] == '\n' ? 1 : 0;
  return std::accumulate(count.begin(), count.end(), std::uint64_t{0});
}

Error io_error(const std::string& path, const std::string& why) {
  return {Error::Code::io, path + ": " + why};
}

Error limit_error(const std::string& path, std::uint64_t size, std::uint64_t limit) {
  return {Error::Code::limit, path + ": " + std::to_string(size) +
                                  " bytes are more than the limit of " + std::to_string(limit)};
}

/// Start of the line with this offset.
std::size_t line_begin(std::string_view bytes, std::uint64_t offset) {
  const void* end = offset == 0 ? nullptr : ::memrchr(bytes.data(), '\n', offset);
  if (end == nullptr) return 0;
  return static_cast<std::size_t>(static_cast<const char*>(end) - bytes.data()) + 1;
}

std::string system_reason(int code) { return std::generic_category().message(code); }

/// File descriptor that closes itself.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

Result<void> read_all(int fd, const std::string& path, std::uint64_t limit, std::string& out) {
  char buffer[1 << 16];
  for (;;) {
    const ssize_t n = ::read(fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return io_error(path, system_reason(errno));
    if (n == 0) return {};
    out.append(buffer, static_cast<std::size_t>(n));
    if (out.size() > limit) return limit_error(path, out.size(), limit);
  }
}

}  // namespace

Result<std::unique_ptr<Source>> Source::open(const std::string& path, const Limits& limits) {
  std::unique_ptr<Source> source(new Source);
  source->path_ = path;
  if (path == "-") {
    if (auto r = read_all(0, "standard input", limits.stdin_bytes, source->storage_); !r)
      return r.error();
    source->bytes_ = source->storage_;
    return source;
  }
  // O_NONBLOCK: opening a FIFO must not wait for a writer that never comes.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.fd < 0) return io_error(path, system_reason(errno));
  struct stat info {};
  if (::fstat(file.fd, &info) != 0) return io_error(path, system_reason(errno));
  if (S_ISDIR(info.st_mode)) return io_error(path, "is a directory, not a file");
  if (!S_ISREG(info.st_mode))
    return io_error(path, "is not a regular file (FIFO, socket or device)");
  source->device_ = info.st_dev;
  source->inode_ = info.st_ino;
  const auto bytes = static_cast<std::uint64_t>(info.st_size);
  const auto limit = std::min<std::uint64_t>(limits.total_bytes, SIZE_MAX / 2);
  if (bytes > limit) return limit_error(path, bytes, limit);
  const auto size = static_cast<std::size_t>(bytes);
  if (char first = 0; size == 0)  // files in /proc have size 0 and contents
    if (const ssize_t n = ::read(file.fd, &first, 1); n != 0)
      return io_error(path, n < 0 ? system_reason(errno)
                                  : "is not a regular file (the system makes it as it is read)");
  if (size <= limits.map_threshold) {
    source->storage_.reserve(size);
    if (auto r = read_all(file.fd, path, limit, source->storage_); !r) return r.error();
    source->bytes_ = source->storage_;
    return source;
  }
  void* map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.fd, 0);
  if (map == MAP_FAILED) return io_error(path, system_reason(errno));
  ::madvise(map, size, MADV_SEQUENTIAL);
  source->map_ = map;
  source->map_size_ = size;
  source->bytes_ = {static_cast<const char*>(map), size};
  return source;
}

Result<std::unique_ptr<Source>> Source::open_text(const std::string& path, const Limits& limits) {
  auto source = open(path, limits);
  return source ? unpack(std::move(*source), limits) : std::move(source);
}

std::unique_ptr<Source> Source::from_bytes(std::string name, std::string bytes) {
  std::unique_ptr<Source> source(new Source);
  source->path_ = std::move(name);
  source->storage_ = std::move(bytes);
  source->bytes_ = source->storage_;
  return source;
}

Result<std::unique_ptr<Source>> Source::unpack(std::unique_ptr<Source> source,
                                               const Limits& limits) {
  if (!is_gzip(source->bytes_)) return source;
  constexpr std::uint64_t always = std::uint64_t{64} << 20;
  const std::uint64_t size = source->bytes_.size();
  const std::uint64_t by_ratio = std::max(always, size < limits.total_bytes / limits.unpacked_ratio
                                                      ? size * limits.unpacked_ratio
                                                      : limits.total_bytes);
  auto text =
      gunzip(source->bytes_, std::min({limits.total_bytes, limits.unpacked_bytes, by_ratio}));
  if (!text) return Error{text.error().code, source->path_ + ": " + text.error().message};
  source->packed_ = true;
  source->packed_bytes_ = source->bytes_;
  source->unpacked_ = std::move(*text);
  source->bytes_ = source->unpacked_;
  return source;
}

Source::~Source() {
  if (map_ != nullptr) ::munmap(map_, map_size_);
}

Position Source::position(std::uint64_t offset) const {
  offset = std::min<std::uint64_t>(offset, bytes_.size());
  const std::uint64_t slot = offset / checkpoint_step;
  std::uint64_t lines = 0;
  {
    const std::lock_guard lock(mutex_);
    if (checkpoints_.empty()) checkpoints_.push_back(0);
    while (checkpoints_.size() <= slot) {
      const std::uint64_t from = (checkpoints_.size() - 1) * checkpoint_step;
      checkpoints_.push_back(checkpoints_.back() + line_ends(bytes_.data() + from));
      const std::uint64_t to = from + checkpoint_step;
      release(from, to);
    }
    lines = checkpoints_[slot];
  }
  const auto* data = bytes_.data();
  lines +=
      static_cast<std::uint64_t>(std::count(data + slot * checkpoint_step, data + offset, '\n'));
  return {lines + 1, offset - line_begin(bytes_, offset) + 1};
}

std::string_view Source::line_at(std::uint64_t offset) const {
  offset = std::min<std::uint64_t>(offset, bytes_.size());
  const std::size_t begin = line_begin(bytes_, offset);
  std::size_t end = std::min(bytes_.find('\n', offset), bytes_.size());
  if (end > begin && bytes_[end - 1] == '\r') --end;
  return bytes_.substr(begin, end - begin);
}

void Source::release(std::uint64_t begin, std::uint64_t end) const {
  if (map_ == nullptr || packed_) return;
  // In large stretches: few calls to the system.
  begin = begin / given_back_at_once * given_back_at_once;
  end = std::min<std::uint64_t>(end, map_size_) / given_back_at_once * given_back_at_once;
  if (end > begin) ::madvise(static_cast<char*>(map_) + begin, end - begin, MADV_DONTNEED);
}

std::uint32_t SourceSet::add(std::unique_ptr<Source> source) {
  sources_.push_back(std::move(source));
  return size() - 1;
}

std::string_view SourceSet::text(const Span& span) const {
  if (!span.valid()) return {};
  const std::string_view bytes = (*this)[span.file].bytes();
  return span.offset < bytes.size() ? bytes.substr(span.offset, span.length) : std::string_view();
}

Position SourceSet::position(const Span& span) const {
  return span.valid() ? (*this)[span.file].position(span.offset) : Position{};
}

std::string SourceSet::where(const Span& span) const {
  if (!span.valid()) return "(no place)";
  const Position p = position(span);
  return (*this)[span.file].path() + ":" + std::to_string(p.line) + ":" + std::to_string(p.column);
}

}  // namespace deck
