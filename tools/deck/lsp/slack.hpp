// Room for edits: the analysed text of an open file has comment lines between its blocks that give
// way as a block grows or shrinks, so that an edit moves nothing outside its own block, and what
// was found out about the rest stays true, places included.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/deck.hpp"
#include "deck/text/diagnostic.hpp"

namespace deck::lsp {

/// Comment lines of `size` bytes (0, or 2 and more), in front of the byte at `offset` of the text
/// in the editor.
struct Slack {
  std::uint64_t offset = 0, size = 0;
};

/// The slacks of the files of a deck, by path.
class SlackTable {
 public:
  /// One behind each block of the open files.
  static SlackTable of(const Deck& deck, const std::vector<std::uint32_t>& open_files);

  bool empty() const { return by_path_.empty(); }
  const std::vector<Slack>* find(const std::string& path) const;
  std::vector<Slack>* find(const std::string& path);
  /// The text with the slacks in it.
  std::string padded(const std::string& path, std::string_view text) const;
  /// Offset in the padded text of a place of the real one that lies in the block which ends with
  /// the slack at `end`.
  std::uint64_t padded_offset(const std::string& path, std::uint64_t offset,
                              std::uint64_t end) const;
  /// Places of the padded deck in the real one.
  Span real(const SourceSet& sources, Span span) const;
  void make_real(const SourceSet& sources, Diagnostic& d) const;

 private:
  std::map<std::string, std::vector<Slack>> by_path_;
};

/// Comment lines of that many bytes.
std::string slack_text(std::uint64_t size);

}  // namespace deck::lsp
