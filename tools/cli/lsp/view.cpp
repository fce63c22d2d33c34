// Positions, ranges and edits in the form of the protocol.
#include "lsp/view.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace deck::lsp {

View::View(const Workspace& space, const Client& client_of, const OpenDeck& deck_of,
           std::string path_of)
    : workspace(space),
      client(client_of),
      open(deck_of),
      path(std::move(path_of)),
      syntax(deck_of.syntax),
      deck(syntax->deck),
      file(syntax->file_of(path)) {}

const Semantics* View::semantics() const {
  const Semantics* s = open.semantics.get();
  return s != nullptr && s->refusal.empty() ? s : nullptr;
}

const InterBase* View::interface_of(const Block& block) const {
  const Semantics* s = semantics();
  if (s == nullptr || block.schema == nullptr || block.schema->kind != "inter") return nullptr;
  const std::int64_t id = id_of(deck, block);
  for (const InterBase* inter : s->loaded->interfaces().all)
    if (inter->id == id && inter->block != nullptr && inter->block->schema == block.schema)
      return inter;
  return nullptr;
}

TextPlace place_of(const Json& position) {
  return {position.at("line").get<std::uint64_t>(), position.at("character").get<std::uint64_t>()};
}

std::uint64_t View::offset(const Json& position) const {
  return syntax->lines(file).offset(text(), place_of(position), client.encoding);
}

PlacedLine View::line_at(std::uint64_t offset) const {
  return deck::line_at(deck, syntax->index, file, offset);
}

Json View::position(std::uint32_t of_file, std::uint64_t offset) const {
  const TextPlace p =
      syntax->lines(of_file).place(deck.sources[of_file].bytes(), offset, client.encoding);
  return {{"line", p.line}, {"character", p.character}};
}

Json View::range(std::uint32_t of_file, std::uint64_t begin, std::uint64_t end) const {
  return {{"start", position(of_file, begin)}, {"end", position(of_file, end)}};
}

Json View::location(const Span& span) const {
  return {{"uri", uri(span.file)}, {"range", range(span)}};
}

std::string View::uri(std::uint32_t of_file) const {
  return workspace.uri(deck.sources[of_file].path());
}

Json View::text_edit(const TextEdit& edit) const {
  return {{"range", range(edit.span)}, {"newText", utf8(edit.text)}};
}

Json View::workspace_edit(const std::vector<TextEdit>& edits) const {
  std::map<std::string, Json> by_path;
  std::map<std::string, std::set<std::tuple<std::uint64_t, std::uint32_t, std::string>>> seen;
  for (const TextEdit& e : edits) {
    const std::string& path_of = deck.sources[e.span.file].path();
    if (!seen[path_of].emplace(e.span.offset, e.span.length, e.text).second) continue;
    by_path.try_emplace(path_of, Json::array()).first->second.push_back(text_edit(e));
  }
  if (!client.document_changes) {
    Json changes = Json::object();
    for (auto& [p, list] : by_path) changes[workspace.uri(p)] = std::move(list);
    return {{"changes", std::move(changes)}};
  }
  Json changes = Json::array();
  for (auto& [p, list] : by_path) {
    const auto& documents = workspace.documents();
    const auto d = documents.find(p);
    changes.push_back({{"textDocument",
                        {{"uri", workspace.uri(p)},
                         {"version", d == documents.end() ? Json() : Json(d->second.version)}}},
                       {"edits", std::move(list)}});
  }
  return {{"documentChanges", std::move(changes)}};
}

std::uint64_t View::block_end(const Block& block) const {
  std::uint64_t end = block.header_span.offset + block.header_span.length;
  LineCursor cursor(deck.sources, block);
  // Searches long blocks from their end.
  for (const deck::FilePiece& p : block.body)
    if (p.file == block.header_span.file) end = std::max(end, p.end);
  const std::string_view bytes = deck.sources[block.header_span.file].bytes();
  while (end > block.header_span.offset) {
    std::uint64_t stop = end;
    while (stop > 0 && (bytes[stop - 1] == '\n' || bytes[stop - 1] == '\r')) --stop;
    const auto before = stop == 0 ? bytes.npos : bytes.rfind('\n', stop - 1);
    const std::uint64_t begin = before == bytes.npos ? 0 : before + 1;
    const std::string_view line = bytes.substr(begin, stop - begin);
    const bool idle = line.find_first_not_of(" \t\r") == line.npos || line.starts_with('#') ||
                      line.starts_with('$');
    if (!idle || begin <= block.header_span.offset) return std::max(stop, block.header_span.offset);
    end = begin;
  }
  return end;
}

Json markup(const View& view, const std::string& markdown) {
  return {{"kind", view.client.markdown ? "markdown" : "plaintext"}, {"value", utf8(markdown)}};
}

}  // namespace deck::lsp
