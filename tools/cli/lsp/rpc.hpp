// JSON-RPC over two file descriptors with frames of the Language Server Protocol.
#pragma once
#include <nlohmann/json.hpp>

#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace deck::lsp {

using Json = nlohmann::json;

enum ErrorCode : int {
  parse_error = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  invalid_params = -32602,
  internal_error = -32603,
  server_not_initialized = -32002,
  request_failed = -32803,
  request_cancelled = -32800,
};

class Connection {
 public:
  Connection(int in, int out) : in_(in), out_(out) {}
  /// The next message; nullopt: closed, or invalid frame.
  std::optional<std::string> read();
  /// Sends a message, from any thread. False: the client does not read any more.
  bool write(const Json& message);

 private:
  /// The next complete message in the buffer; nullopt: incomplete or invalid (closed_).
  std::optional<std::string> arrived();
  bool fill();
  int in_, out_;
  std::string buffer_;
  std::size_t begin_ = 0;  ///< start of the unread bytes
  bool closed_ = false;
  std::mutex writing_;
};

}  // namespace deck::lsp
