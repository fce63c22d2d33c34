// Files of the source tree that are compiled into the library (generated at build).
#pragma once
#include <string_view>
#include <vector>

namespace deck::detail {

struct EmbeddedFile {
  const char* name;  ///< without folder, e.g. "inter_type7.json"
  std::string_view text;
};

/// A keyword of schemas/keywords/*.json.
struct EmbeddedSchema {
  const char* file;   ///< without folder
  const char* names;  ///< the keyword and its aliases, one per line
  const char* text;   ///< its JSON object, checked by the build
};

const std::vector<EmbeddedSchema>& embedded_schemas();
const std::vector<EmbeddedFile>& embedded_rules();      // schemas/rules/*.md
const std::vector<EmbeddedFile>& embedded_messages();   // schemas/messages/*.json
const std::vector<EmbeddedFile>& embedded_config();     // schemas/config/*.json
const std::vector<EmbeddedFile>& embedded_examples();   // schemas/examples/*.rad
const std::vector<EmbeddedFile>& embedded_pages();      // schemas/pages/*
const std::vector<EmbeddedFile>& embedded_workflows();  // schemas/workflows/*.yml

}  // namespace deck::detail
