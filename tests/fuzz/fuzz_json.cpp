// --from json: any document is read or refused; what was read becomes a deck, its JSON, and the
// same files again.
#include "edit/shared/from_json.hpp"
#include "report/shared/deck_json.hpp"
#include "support.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace deck;
  using fuzz::require;
  if (size > 65536) return 0;
  const auto files = deck_from_json(fuzz::text_of(data, size), SchemaSet::built_in());
  if (!files) {
    require(!files.error().message.empty(), "a refusal says why");
    return 0;
  }
  require(!files->empty(), "a document has a main file");
  fuzz::Files contents;
  for (const DeckFile& f : *files) {
    require(!f.path.empty() && f.path[0] != '/' && f.path.find('\0') == std::string::npos &&
                ("/" + f.path + "/").find("/../") == std::string::npos,
            "a file stays in its directory", f.path);
    contents[f.path] = f.text;
  }
  const auto whole = fuzz::read_files(contents, (*files)[0].path);
  if (!whole) return 0;
  const auto json =
      deck_to_json({(*files)[0].path, &whole->deck, &whole->model, &whole->interfaces});
  if (!json) return 0;
  const auto again = deck_from_json(*json, SchemaSet::built_in());
  require(again.ok(), "what --to json writes, --from json reads",
          again.ok() ? "" : again.error().message);
  require((*again)[0].text == (*files)[0].text, "the main file comes back");
  return 0;
}
