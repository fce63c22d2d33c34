// Open documents, and the decks that they belong to.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "keyword/shared/include_scan.hpp"
#include "lsp/analysis.hpp"
#include "lsp/rpc.hpp"

namespace deck::lsp {

/// Where the cursor is, as far as the client says.
struct Cursor {
  std::string path;
  Place place;
};

/// A deck of which some file is open.
struct OpenDeck {
  std::string path;  ///< of the main file
  std::shared_ptr<const Syntax> syntax;
  std::shared_ptr<const Semantics> semantics;  ///< of this or an earlier text
  std::shared_ptr<const Geometry> geometry;    ///< of the text last saved
  bool fragment = false;  ///< no deck includes the file: it stands for itself, without findings
  std::map<std::string, Json> published;  ///< its findings at the client, by file
  std::optional<Cursor> cursor;           ///< in a file of the deck
};

/// Texts and decks. For one thread.
class Workspace {
 public:
  void configure(const SchemaSet& schemas, Settings settings) {
    schemas_ = &schemas;
    settings_ = std::move(settings);
  }
  const SchemaSet& schemas() const { return *schemas_; }
  const Settings& settings() const { return settings_; }
  /// Folders that are searched for decks which include a file.
  void set_folders(std::vector<std::string> folders) { folders_ = std::move(folders); }

  // ---- documents
  Document& open(const std::string& path, std::string uri, std::int64_t version, std::string text);
  void close(const std::string& path);
  Document* find(const std::string& path);
  const std::map<std::string, Document>& documents() const { return documents_; }
  std::string& text(const std::string& path) { return texts_.at(path); }
  const std::map<std::string, std::string>& texts() const { return texts_; }
  /// The client's name of a file, whether it is open or not.
  std::string uri(const std::string& path) const;
  /// Unknown files changed: everything that was read is old.
  void changed() { everything_ = ++generation_; }
  /// The text of one file changed: decks without it stay as they are.
  void changed(const std::string& path) { touched_[path] = ++generation_; }

  // ---- decks
  /// The deck of a document, of the text as it is now; nullptr: it cannot be read at all.
  OpenDeck* deck_of(const std::string& path);
  std::map<std::string, OpenDeck>& decks() { return decks_; }
  /// Reads a deck again if its text has changed.
  const std::shared_ptr<const Syntax>& refresh(OpenDeck& deck);
  /// True where the deck was read and none of its files has changed since.
  bool current(const OpenDeck& deck) const;
  /// Forgets decks of which no file is open; they are given back.
  std::vector<OpenDeck> forget_closed();

 private:
  std::string root_of(const std::string& path, bool& fragment);
  /// A deck around a file that none includes: its lines follow no /BEGIN of their own.
  std::string frame_of(const std::string& path);
  bool reaches(const std::string& root, const std::string& path);
  /// A file begins or ceases to be open.
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
  std::map<std::string, std::uint64_t> touched_;  ///< generation in which a file changed last
};

}  // namespace deck::lsp
