// The viewer of the HTML report as compiled in: what the generated source includes.
#pragma once
#include <string_view>

namespace deck::detail {

/// The viewer as compiled in (generated at build): script and style sheet; empty script: none,
/// and `missing` says why.
struct ViewerBundle {
  std::string_view script, style, missing;
};
const ViewerBundle& viewer_bundle();

}  // namespace deck::detail
