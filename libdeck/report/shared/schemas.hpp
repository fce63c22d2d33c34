// JSON schemas of the documents that the verbs write with --json.
#pragma once
#include <string>
#include <vector>

#include "report/record.hpp"

namespace deck {

struct DocumentOfVerb {
  const char* verb;
  DocumentSchema (*schema)();
};
const std::vector<DocumentOfVerb>& documents_of_verbs();
/// What the schemas of documents refer to as common.schema.json.
std::string common_schema();

DocumentSchema accuracy_schema();
DocumentSchema cycle_schema();
DocumentSchema diff_schema();
DocumentSchema explain_schema();
DocumentSchema fix_schema();
DocumentSchema gaps_schema();
DocumentSchema gate_schema();
DocumentSchema lint_schema();
DocumentSchema losses_schema();
DocumentSchema page_schema();  ///< of the data in a page, see html/page_data.cpp
DocumentSchema params_schema();
DocumentSchema parts_schema();
DocumentSchema rules_schema();
DocumentSchema show_schema();

}  // namespace deck
