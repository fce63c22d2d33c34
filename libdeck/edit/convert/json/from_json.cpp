// Reads a deck's JSON: the text is parsed as a whole, every file is written from its lines, and
// what came out is read back and held against everything else that the document says.
#include "edit/shared/from_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/shared/paths.hpp"
#include "edit/convert/json/check.hpp"
#include "edit/convert/json/file_writer.hpp"
#include "keyword/shared/deck_json_cells.hpp"

namespace deck {
namespace {

using namespace detail;

std::vector<DeckFile> read_document(const Json& root, const SchemaSet& schemas,
                                    const FromJsonOptions& options,
                                    std::vector<LossEntry>& losses) {
  const Path top;
  if (root.is_object() && root.contains("decks"))
    fail(top, "a document of several decks; give one of them");
  const Path schema{&top, "schema"};
  const Json& head = member(root, "schema", top);
  if (string_of(member(head, "id", schema), {&schema, "id"}) != deck_json_id)
    fail({&schema, "id"}, fmt::format("expected \"{}\"", deck_json_id));
  if (integer_of(member(head, "version", schema), {&schema, "version"}) != deck_json_version)
    fail({&schema, "version"}, fmt::format("expected {}", deck_json_version));
  only(root, {"schema", "tool", "deck", "deck_sum", "files"}, top);
  only(head, {"id", "version"}, schema);
  if (const Json* tool = optional_member(root, "tool", top))
    only(*tool, {"name", "version"}, {&top, "tool"});
  const Path files{&top, "files"};
  const Json& list = array_of(member(root, "files", top), files);
  std::vector<DeckFile> out;
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Path path{&files, {}, i};
    if (is_external(list[i], path)) continue;
    out.push_back(write_file(list[i], path, schemas, options, losses));
    if (!names.insert(normal_path(out.back().path)).second)
      fail({&path, "path"}, "a second file of that name");
  }
  if (out.empty()) fail(files, "no file with content");
  check_document(root, out, schemas, options.round);
  return out;
}

/// Line and column of a byte, 1-based.
std::string place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte == 0 ? 0 : byte - 1);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const auto nl = before.rfind('\n');
  const std::size_t column = nl == std::string_view::npos ? before.size() : before.size() - nl - 1;
  return fmt::format("line {}, column {}", lines + 1, column + 1);
}

std::string told(const Json& root, const Wrong& wrong) {
  const std::string place = place_in_deck(root, wrong.path);
  return fmt::format("/{}: {}{}{}", fmt::join(wrong.path, "/"), place, place.empty() ? "" : ": ",
                     wrong.what);
}

}  // namespace

Result<std::vector<DeckFile>> deck_from_json(std::string_view json, const SchemaSet& schemas,
                                             const FromJsonOptions& options,
                                             std::vector<LossEntry>* losses) {
  Json root;
  try {
    root = Json::parse(json);
    std::vector<LossEntry> found;
    auto files = read_document(root, schemas, options, found);
    if (losses != nullptr) losses->insert(losses->end(), found.begin(), found.end());
    return files;
  } catch (const nlohmann::json::parse_error& e) {
    return Error{Error::Code::syntax,
                 fmt::format("{}: no JSON: {}", place_of(json, e.byte), e.what())};
  } catch (const Wrong& wrong) {
    return Error{Error::Code::syntax, told(root, wrong)};
  } catch (const nlohmann::json::exception& e) {
    return Error{Error::Code::syntax, e.what()};
  }
}

}  // namespace deck
