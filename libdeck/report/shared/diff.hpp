// Text, Markdown and JSON of `deck diff`.
#pragma once
#include <cstddef>
#include <string>

#include "inspect/shared/diff.hpp"

namespace deck {

struct DiffTextOptions {
  bool color = false;
  std::size_t rows = 20;  ///< of moved nodes, of ids and of penetrations; 0: all
  std::size_t width = 0;  ///< columns of a line; 0: any
};

/// "Equal in meaning ..." or how much of what differs.
std::string diff_verdict(const DeckDiff& diff);
std::string diff_text(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                      const DiffTextOptions& options = {});
/// For a review comment: tables of GitHub and GitLab flavour.
std::string diff_markdown(const DiffSide& a, const DiffSide& b, const DeckDiff& diff,
                          const DiffTextOptions& options = {});
/// The document of `deck diff --json` (schemas/output/diff.schema.json).
std::string diff_json(const DiffSide& a, const DiffSide& b, const DeckDiff& diff);

}  // namespace deck
