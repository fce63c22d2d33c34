// Looks at one deck again and again: what an edit did not touch is not looked at once more.
#pragma once
#include <atomic>
#include <map>
#include <memory>
#include <string>

#include "lsp/analysis.hpp"

namespace deck::lsp {

/// For one thread at a time. The findings are those that a fresh look at the same text has.
class Analyst {
 public:
  /// nullptr: stopped.
  std::shared_ptr<const Semantics> look(const std::shared_ptr<const Syntax>& now,
                                        const SchemaSet& schemas, const Settings& settings,
                                        const std::atomic<bool>& stop);

 private:
  /// What an edit did, as far as it can be followed.
  struct Edit {
    bool none = false;      ///< the text is the same
    std::size_t block = 0;  ///< the only one that is different
  };
  std::optional<Edit> follow(const Syntax& now);
  void start_anew(const Syntax& now);
  std::shared_ptr<const Deck> read(const Syntax& now, const SchemaSet& schemas,
                                   const Settings& settings) const;
  /// Puts model and members into `out`, old ones where they are still true.
  void build(Semantics& out, const std::optional<Edit>& edit, const SchemaSet& schemas,
             const Settings& settings);

  std::shared_ptr<const Syntax> real_;  ///< of the last look
  std::shared_ptr<const Semantics> last_;
  SlackTable slacks_;
  std::map<std::string, std::string> padded_;  ///< texts that are analysed, by path
};

}  // namespace deck::lsp
