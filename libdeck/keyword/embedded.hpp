// The keyword schemas compiled into the library (generated from schemas/keywords at build).
#pragma once
#include <string_view>
#include <vector>

namespace deck::detail {
struct EmbeddedSchema {
  const char* name;       // file name, e.g. "inter_type7.json"
  std::string_view text;  // its JSON text
};
const std::vector<EmbeddedSchema>& embedded_schemas();
}  // namespace deck::detail
