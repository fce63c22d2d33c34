// JSON-RPC over a pair of file descriptors: the frames of the Language Server Protocol.
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

  /// The content of the next message; nullopt: the other side has closed, or sends no frames.
  std::optional<std::string> read();
  /// Sends a message; one at a time, from any thread. False: the client no longer reads.
  bool write(const Json& message);

 private:
  /// The next message of what has arrived; nullopt: it is not whole yet, or no frame (closed_).
  std::optional<std::string> arrived();
  bool fill();
  int in_, out_;
  std::string buffer_;
  std::size_t begin_ = 0;  ///< of what was not taken yet
  bool closed_ = false;
  std::mutex writing_;
};

}  // namespace deck::lsp
