// What decoding of a line and decoding of a block share: the findings of one call, and what the
// cells of a line can know about other lines. Private to the keyword stage.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword/decode.hpp"
#include "deck/text/rule.hpp"

namespace deck::detail {

/// Findings of one decode call, about one block.
class Findings {
 public:
  Findings(Diagnostics* sink, const Block& block) : sink_(sink), block_(block) {}
  bool on() const { return sink_ != nullptr; }
  /// Counts one finding; true if its message is wanted. Then keep() it.
  bool wants(RuleId rule) { return sink_ != nullptr && sink_->wants(rule); }

  Diagnostic* report(RuleId rule, Span span, std::string message, Case particular = {}) {
    return wants(rule) ? keep(rule, span, std::move(message), std::move(particular)) : nullptr;
  }

  Diagnostic* keep(RuleId rule, Span span, std::string message, Case particular = {}) {
    Diagnostic d = finding_of(rule, span, std::move(message), std::move(particular));
    d.keyword = std::string(block_.keyword);
    d.id = block_.id.value;
    return &sink_->add(std::move(d));
  }

 private:
  Diagnostics* sink_;
  const Block& block_;
};

/// How the conditions of the cells of a line find the cells of other lines, and how long a list is.
struct LineContext {
  const std::function<std::int64_t(std::string_view)>* value = nullptr;
  int cells = 0;  ///< of a list, on this line; 0: not known
};

/// Cells of a line in free format, with their places.
using FreeCells = std::vector<std::pair<std::string_view, Span>>;
/// Commas and blanks separate, two commas make an empty cell.
FreeCells split_free(const Line& line);
/// True if a comma puts the line into free format. Lines of a single text cell never are.
bool is_free(const Line& line);

DecodedCard decode_in_context(const Deck& deck, const Block& block, const CardSchema& card,
                              const Line& line, Diagnostics* diagnostics,
                              const LineContext& context);

/// Reports a /DEFAULT/INTER that was written without its lines without content (DK511). True: it
/// was, and what else could be said of its lines would be a consequence.
bool report_missing_blank_lines(const Deck& deck, const Block& block, Diagnostics& diagnostics);

}  // namespace deck::detail
