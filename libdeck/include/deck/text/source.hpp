// Source: the bytes of one file, read whole and never modified, with line and column on demand.
// Files up to Limits::map_threshold are read into memory; larger ones are mapped, and pages that
// were converted already can be given back so that a deck need not fit into memory twice.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text/result.hpp"

namespace deck {

/// Bounds on what a hostile or broken deck may cost: an argument everywhere, with safe defaults.
struct Limits {
  std::uint64_t total_bytes = std::uint64_t{64} << 30;    ///< all files of the include tree
  std::uint64_t map_threshold = std::uint64_t{32} << 20;  ///< larger files are mapped, not read
  std::uint64_t stdin_bytes = std::uint64_t{4} << 30;     ///< standard input has no size to check
  std::uint64_t unpacked_bytes = std::uint64_t{4} << 30;  ///< text of packed files, kept in memory
  std::uint64_t unpacked_ratio = 100;  ///< more text than this times the file (and 64 MiB): no deck
  int include_depth = 100;             ///< the reference solver stops at about 10
  int files = 10000;
  std::size_t blocks = 20'000'000;
  int diagnostics_per_rule = 1000;  ///< further ones are counted, not kept
  int expression_steps = 10000;     ///< parameter expressions
  std::uint64_t selection_bytes = std::uint64_t{4}
                                  << 30;              ///< members of all groups, surfaces, sets
  std::uint64_t pair_bytes = std::uint64_t{2} << 30;  ///< the list of pairs of one contact
};

/// A stretch of bytes of one file. Line and column are computed when a person wants to see them.
struct Span {
  static constexpr std::uint32_t no_file = 0xffffffffu;
  std::uint32_t file = no_file;  ///< index into SourceSet
  std::uint32_t length = 0;
  std::uint64_t offset = 0;
  bool valid() const { return file != no_file; }
  friend bool operator==(const Span&, const Span&) = default;
};

/// 1-based position as an editor shows it. Columns count bytes: a tab is one column.
struct Position {
  std::uint64_t line = 0, column = 0;
};

class Source {
 public:
  /// Opens a regular file; "-" reads standard input. Errors: missing, directory, FIFO, device,
  /// unreadable, over the limit — with the system's reason.
  static Result<std::unique_ptr<Source>> open(const std::string& path, const Limits& limits);
  /// The same with the text of a file that is packed with gzip, see unpack().
  static Result<std::unique_ptr<Source>> open_text(const std::string& path, const Limits& limits);
  static std::unique_ptr<Source> from_bytes(std::string name, std::string bytes);
  /// The same file; where it is packed with gzip, with the text that was packed as its bytes.
  /// Errors: damaged, cut off, over the limit.
  static Result<std::unique_ptr<Source>> unpack(std::unique_ptr<Source> source,
                                                const Limits& limits);
  ~Source();
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  const std::string& path() const { return path_; }  ///< as it was asked for
  std::string_view bytes() const { return bytes_; }
  /// What is on disk: other bytes than bytes() if the file is packed.
  std::string_view on_disk() const { return packed_ ? packed_bytes_ : bytes_; }
  bool packed() const { return packed_; }
  std::uint64_t device() const { return device_; }
  std::uint64_t inode() const { return inode_; }

  /// Line and column of a byte offset (offset == size is allowed). Thread safe.
  Position position(std::uint64_t offset) const;
  /// The whole line holding `offset`, without its line end.
  std::string_view line_at(std::uint64_t offset) const;
  /// Gives the pages of [begin, end) back to the system if the file is mapped; the bytes stay
  /// readable (they are fetched again when touched).
  void release(std::uint64_t begin, std::uint64_t end) const;

 private:
  Source() = default;
  std::string path_;
  std::string storage_, unpacked_;
  std::string_view bytes_, packed_bytes_;
  bool packed_ = false;
  void* map_ = nullptr;
  std::size_t map_size_ = 0;
  std::uint64_t device_ = 0, inode_ = 0;
  mutable std::mutex mutex_;
  mutable std::vector<std::uint64_t>
      checkpoints_;  // lines before every 64 KiB boundary seen so far
};

/// All files of a deck. Index 0 is the main file.
class SourceSet {
 public:
  std::uint32_t add(std::unique_ptr<Source> source);
  const Source& operator[](std::uint32_t file) const { return *sources_[file]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(sources_.size()); }
  std::string_view text(const Span& span) const;
  Position position(const Span& span) const;
  /// "file:line:column"
  std::string where(const Span& span) const;

 private:
  std::vector<std::unique_ptr<Source>> sources_;
};

}  // namespace deck
