// Text and JSON of `deck show`: one entity with its card, figures and references.
#pragma once
#include <cstddef>
#include <string>

#include "inspect/shared/show.hpp"
#include "report/shared/params_report.hpp"

namespace deck {

struct ShowTextOptions {
  bool color = false;
  bool all = false;       ///< every line and every user, however many
  std::size_t width = 0;  ///< columns of a line; 0: any
};

/// `params` has the same deck and, if the geometry was evaluated, the default gaps.
std::string show_text(const ParamsInput& params, const EntityView& view,
                      const ShowTextOptions& options = {});
/// The document of `deck show --json` (schemas/output/show.schema.json).
std::string show_json(const ParamsInput& params, const EntityView& view);

}  // namespace deck
