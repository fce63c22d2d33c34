// Frames of messages: "Content-Length: N", an empty line, N bytes.
#include "lsp/rpc.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>

namespace deck::lsp {
namespace {

constexpr std::size_t most_header = 8192;
constexpr std::size_t most_kept = 65536;  // bytes already consumed
constexpr std::size_t most_content = std::size_t{2} << 30;

/// N of "Content-Length: N" in a header; nullopt: absent.
std::optional<std::size_t> content_length(std::string_view header) {
  constexpr std::string_view name = "content-length:";
  while (!header.empty()) {
    const auto end = std::min(header.find('\n'), header.size());
    std::string_view line = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    std::string lower(line.substr(0, name.size()));
    for (char& c : lower)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    if (lower != name) continue;
    line.remove_prefix(name.size());
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    std::size_t n = 0;
    const auto [p, error] = std::from_chars(line.data(), line.data() + line.size(), n);
    if (error != std::errc() || n > most_content) return std::nullopt;
    return n;
  }
  return std::nullopt;
}

/// Start of the message after the empty line of a header; npos: incomplete. Some clients use LF
/// only.
std::size_t end_of_header(std::string_view text) {
  for (auto at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
    const std::string_view rest = text.substr(at + 1, 2);
    if (rest.starts_with('\n')) return at + 2;
    if (rest == "\r\n") return at + 3;
  }
  return text.npos;
}

}  // namespace

bool Connection::fill() {
  char chunk[65536];
  ssize_t n = 0;
  do {
    n = ::read(in_, chunk, sizeof chunk);
  } while (n < 0 && errno == EINTR);
  if (n <= 0) return false;
  buffer_.append(chunk, static_cast<std::size_t>(n));
  return true;
}

std::optional<std::string> Connection::read() {
  for (;;) {
    if (auto content = arrived()) return content;
    if (closed_ || !fill()) return std::nullopt;
  }
}

std::optional<std::string> Connection::arrived() {
  const std::string_view rest = std::string_view(buffer_).substr(begin_);
  const std::size_t size = end_of_header(rest.substr(0, most_header));
  if (size == rest.npos && rest.size() < most_header) return std::nullopt;
  const auto length = size == rest.npos ? std::nullopt : content_length(rest.substr(0, size));
  if (!length) {
    write({{"jsonrpc", "2.0"},
           {"id", nullptr},
           {"error", {{"code", -32700}, {"message", "a header without Content-Length"}}}});
    closed_ = true;
    return std::nullopt;
  }
  if (rest.size() - size < *length) return std::nullopt;
  std::string content(rest.substr(size, *length));
  begin_ += size + *length;
  // Moves the buffer rarely, not once per message.
  if (begin_ == buffer_.size() || begin_ > most_kept) {
    buffer_.erase(0, begin_);
    begin_ = 0;
  }
  return content;
}

bool Connection::write(const Json& message) {
  // Replaces invalid UTF-8, so that the answer can be sent.
  const std::string content = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string frame =
      "Content-Length: " + std::to_string(content.size()) + "\r\n\r\n" + content;
  const std::lock_guard lock(writing_);
  std::size_t done = 0;
  while (done < frame.size()) {
    const ssize_t n = ::write(out_, frame.data() + done, frame.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace deck::lsp
