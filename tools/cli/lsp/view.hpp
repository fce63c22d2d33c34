// Data for answering a request: the document, its deck, analysis results.
#pragma once
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "lsp/analysis.hpp"
#include "lsp/rpc.hpp"
#include "lsp/workspace.hpp"

namespace deck::lsp {

/// Capabilities of the client.
struct Client {
  Encoding encoding = Encoding::utf16;
  bool markdown = true;           ///< of hover and completion
  bool snippets = false;          ///< in completion
  bool document_changes = false;  ///< WorkspaceEdit.documentChanges
  bool progress = false;          ///< window/workDoneProgress
  bool refresh_lenses = false, refresh_hints = false;
  bool hierarchical_symbols = false;
  std::string show_report = "deck.openGapReport";  ///< command of the lens
};

/// A position of the protocol.
TextPlace place_of(const Json& position);

/// A document of a deck at a moment.
class View {
 public:
  View(const Workspace& space, const Client& client_of, const OpenDeck& deck_of,
       std::string path_of);

  const Workspace& workspace;
  const Client& client;
  const OpenDeck& open;
  std::string path;
  std::shared_ptr<const Syntax> syntax;
  const Deck& deck;
  std::uint32_t file = 0;  ///< of the document in the deck

  const SchemaSet& schemas() const { return workspace.schemas(); }
  /// Results for this or an earlier text; nullptr: not yet known.
  const Semantics* semantics() const;
  /// The interface of a block in the last analysis, by type and id. nullptr: none.
  const InterBase* interface_of(const Block& block) const;

  std::string_view text() const { return deck.sources[file].bytes(); }
  std::uint64_t offset(const Json& position) const;
  PlacedLine line_at(std::uint64_t offset) const;

  // ---- to the protocol
  Json position(std::uint32_t of_file, std::uint64_t offset) const;
  Json range(std::uint32_t of_file, std::uint64_t begin, std::uint64_t end) const;
  Json range(const Span& span) const {
    return range(span.file, span.offset, span.offset + span.length);
  }
  Json location(const Span& span) const;
  std::string uri(std::uint32_t of_file) const;
  /// Edits as a WorkspaceEdit; a file included twice is edited once.
  Json workspace_edit(const std::vector<TextEdit>& edits) const;
  Json text_edit(const TextEdit& edit) const;

  /// End of a block, without trailing comments.
  std::uint64_t block_end(const Block& block) const;
};

/// Reason for the user why a request cannot be answered.
struct Refusal {
  std::string message;
};

/// The answer, or a Refusal.
using Answer = Json;

// ---- features: one function per method; `params` are those of the request.
Answer hover(const View& view, const Json& params);
Answer inlay_hints(const View& view, const Json& params);
Answer completion(const View& view, const Json& params);
Answer document_symbols(const View& view, const Json& params);
Answer folding_ranges(const View& view, const Json& params);
Answer definition(const View& view, const Json& params);
Answer references(const View& view, const Json& params);
Answer document_highlight(const View& view, const Json& params);
Answer code_actions(const View& view, const Json& params);
Answer code_lenses(const View& view, const Json& params);
/// deck/card: see tools/docs/editors.md.
Answer card_at(const View& view, const Json& params);
/// Edits of the command "deck.setField".
Json set_field_edit(const View& view, const Json& argument);
/// Edits of "deck.fixAll": all fixes of the document; "unsafe" ones if requested.
Json fix_all_edit(const View& view, const Json& argument);

// ---- shared by features Texts about a cell: name, columns, type, unit, range, value, origin,
// help.
struct CellText {
  std::string head;   ///< "Gapmin · columns 41-60 · real · mm"
  std::string value;  ///< "0.55, derived from the mesh"; empty: unknown
  std::string doc;    ///< one line
  std::string rest;   ///< legal values, default, manual
  std::string help;
};
CellText describe(const View& view, const Block& block, const DecodedCard& card, const Cell& cell);
/// Unit of a dimension: "mm/s"; empty: none.
std::string unit_text(const Dimension& dimension, const UnitSystem* units);
/// Meaning of a value in the one-line text of a field: "1000 constant Gapmin"; empty: none.
std::string meaning_of_value(const Field& field, std::int64_t value);
/// Title of a block; empty: none.
std::string title_of(const Deck& deck, const Block& block);
/// The id at a place, used or defined.
struct NamedId {
  std::string kind;
  std::int64_t id = 0;
  Span span;
  bool definition = false;
};
std::optional<NamedId> id_at(const View& view, std::uint64_t offset);
/// Place of the definition of an id; invalid: none.
Span definition_of(const View& view, std::string_view kind, std::int64_t id);
Json markup(const View& view, const std::string& markdown);

}  // namespace deck::lsp
