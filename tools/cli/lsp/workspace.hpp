// Open documents and their decks.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "keyword/shared/include_scan.hpp"
#include "lsp/analysis.hpp"
#include "lsp/rpc.hpp"

namespace deck::lsp {

/// Position of the cursor, if the client sends it.
struct Cursor {
  std::string path;
  TextPlace place;
};

/// A deck with an open file.
struct OpenDeck {
  std::string path;  ///< of the main file
  std::shared_ptr<const Syntax> syntax;
  std::shared_ptr<const Semantics> semantics;  ///< of this or an earlier text
  std::shared_ptr<const Geometry> geometry;    ///< of the last saved text
  bool fragment = false;                  ///< true: a file that no deck includes; without findings
  std::map<std::string, Json> published;  ///< findings sent to the client, by file
  std::optional<Cursor> cursor;           ///< in a file of the deck
};

/// Texts and decks; used by one thread.
class Workspace {
 public:
  void configure(const SchemaSet& schemas, Settings settings) {
    schemas_ = &schemas;
    settings_ = std::move(settings);
  }
  const SchemaSet& schemas() const { return *schemas_; }
  const Settings& settings() const { return settings_; }
  /// Folders searched for decks that include a file.
  void set_folders(std::vector<std::string> folders) { folders_ = std::move(folders); }

  // ---- documents
  Document& open(const std::string& path, std::string uri, std::int64_t version, std::string text);
  void close(const std::string& path);
  Document* find(const std::string& path);
  const std::map<std::string, Document>& documents() const { return documents_; }
  std::string& text(const std::string& path) { return texts_.at(path); }
  const std::map<std::string, std::string>& texts() const { return texts_; }
  /// The client's name of a file, open or not.
  std::string uri(const std::string& path) const;
  /// Unknown files changed: all decks must be read again.
  void changed() { everything_ = ++generation_; }
  /// One file changed: decks without it stay valid.
  void changed(const std::string& path) { touched_[path] = ++generation_; }

  // ---- decks The deck of a document with its current text; nullptr: unreadable.
  OpenDeck* deck_of(const std::string& path);
  std::map<std::string, OpenDeck>& decks() { return decks_; }
  /// Reads a deck again if its text changed.
  const std::shared_ptr<const Syntax>& refresh(OpenDeck& deck);
  /// True if no file of the deck changed since it was read.
  bool current(const OpenDeck& deck) const;
  /// Removes and returns decks without open files.
  std::vector<OpenDeck> forget_closed();

 private:
  std::string root_of(const std::string& path, bool& fragment);
  /// A deck around a file that no deck includes, so that it has a /BEGIN.
  std::string frame_of(const std::string& path);
  bool reaches(const std::string& root, const std::string& path);
  /// A file was opened or closed.
  void shown_or_hidden(const std::string& path);
  std::vector<std::string> candidates(const std::string& path) const;

  const SchemaSet* schemas_ = nullptr;
  Settings settings_;
  std::vector<std::string> folders_;
  std::map<std::string, Document> documents_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, OpenDeck> decks_;     ///< by main file
  std::map<std::string, std::string> roots_;  ///< document -> main file
  std::uint64_t generation_ = 1, everything_ = 1;
  std::map<std::string, std::uint64_t> touched_;  ///< generation of the last change of a file
};

}  // namespace deck::lsp
