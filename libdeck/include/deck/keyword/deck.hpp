// Deck: the include tree of a Starter deck cut into blocks, losslessly. A block keeps where its
// lines are; nothing is interpreted before somebody decodes it against its schema.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/schema.hpp"
#include "deck/text/diagnostic.hpp"
#include "deck/text/source.hpp"

namespace deck {

/// Input version used for a deck whose /BEGIN names none that the reference solver knows.
inline constexpr int newest_version = 2026;

/// A run of whole lines of one file.
struct Piece {
  std::uint32_t file = 0;
  std::uint64_t begin = 0, end = 0;
};

/// An id in a header: a number, a parameter reference that was resolved, or absent.
struct HeaderId {
  std::int64_t value = 0;
  Span span;  ///< empty span where absent
  bool present = false;
};

/// One keyword with its lines.
struct Block {
  const Schema* schema = nullptr;  ///< nullptr: unknown keyword
  std::string_view header;         ///< the header line, trimmed; points into the source
  Span header_span;
  std::string_view keyword;      ///< the part of the header that names the keyword
  HeaderId id, unit_id;          ///< without submodel offset
  std::vector<Piece> body;       ///< all lines up to the next header, comments included
  int version = newest_version;  ///< input version that its columns follow
  std::int32_t submodel = -1;    ///< index into Deck::submodels
  bool opaque = false;           ///< encrypted: kept, never interpreted
};

/// One physical line of a block, trailing control characters and blanks removed.
struct Line {
  std::string_view text;
  std::uint32_t file = Span::no_file;
  std::uint64_t offset = 0;
  bool valid() const { return file != Span::no_file; }
  /// Span of the 1-based inclusive columns, clipped to the line.
  Span columns(int first, int last) const;
  Span whole() const { return {file, static_cast<std::uint32_t>(text.size()), offset}; }
};

/// Walks the lines of a block in order.
class LineCursor {
 public:
  LineCursor(const SourceSet& sources, const Block& block) : sources_(&sources), block_(&block) {}
  /// Next data line (comments skipped); invalid Line at the end.
  Line next();
  /// Next physical line, comments included.
  Line next_physical();

 private:
  const SourceSet* sources_;
  const Block* block_;
  std::size_t piece_ = 0;
  std::uint64_t offset_ = 0;
};

/// Factors to kg, m and s.
struct UnitSystem {
  double mass = 1, length = 1, time = 1;
  std::string mass_code, length_code, time_code;
  friend bool operator==(const UnitSystem& a, const UnitSystem& b) {
    return a.mass == b.mass && a.length == b.length && a.time == b.time;
  }
};
/// The factor of a unit code ("Mg", "mm", "0.001"); base is 'g', 'm' or 's'. nullopt: unknown code.
std::optional<double> unit_factor(std::string_view code, char base);
/// value_in_to = value_in_from * factor
double conversion_factor(const UnitSystem& from, const UnitSystem& to, const Dimension& dimension);

struct Submodel {
  std::int64_t id = 0;
  std::string title;
  std::int32_t parent = -1;
  /// Offsets with those of all ancestors added; empty fields already fell back to `definitions`.
  std::int64_t definitions = 0, nodes = 0, elements = 0, parts = 0, materials = 0, properties = 0,
               submodels = 0;
  std::optional<UnitSystem> units;  ///< of its own /BEGIN
  Span span;
  /// Offset for ids of an entity kind ("node", "part", "shell", "surf", ...).
  std::int64_t offset_for(std::string_view kind) const;
};

struct Parameter {
  enum class Type { integer, real, text } type = Type::real;
  double real = 0;
  std::int64_t integer = 0;
  std::string text;
  bool valid = false;
  bool local = false;
  std::uint32_t file = 0;
  Span span;
  std::string expression;  ///< REAL_EXPR, INT_EXPR: as written
};

struct IncludeEdge {
  std::uint32_t file = 0;    ///< the included file
  std::uint32_t parent = 0;  ///< the file holding the directive
  Span directive;
  std::string written;  ///< path as written in the deck
};

/// /BEGIN of the main file.
struct Begin {
  std::string run_name;
  int version_written = 0;  ///< the number in the deck, 0 if blank
  bool version_known = true;
  bool version_unread = false;  ///< 41, 42, 44: cells of eight columns; the deck has no blocks
  UnitSystem input, working;
  bool has_input = false, has_working = false;
  Span span;  ///< header line; invalid: no /BEGIN
  Span version_span;
};

struct ReadOptions {
  Limits limits;
  std::vector<std::string> include_paths;  ///< searched after the including and the main file
  /// Content to take instead of what the file at that path holds (the path as it would be opened).
  /// The file need not exist. Must outlive the reading.
  const std::map<std::string, std::string>* overlay = nullptr;
};

/// What a comment that is meant for `deck lint` begins with, behind its '#' or '$'.
inline constexpr std::string_view lint_marker = "decklint:";

/// Where lint_marker stands in a file.
struct LintMarkers {
  std::uint64_t searched = 0;          ///< up to this byte it was looked for: all, once it was read
  std::vector<std::uint64_t> offsets;  ///< of its first bytes, ascending
};

struct Deck {
  SourceSet sources;
  std::vector<LintMarkers> lint_markers;  ///< by file
  std::vector<IncludeEdge> includes;
  std::vector<Block> blocks;  ///< as they are written, main deck only up to /END
  std::vector<Submodel> submodels;
  std::multimap<std::string, Parameter, std::less<>> parameters;
  std::map<std::int64_t, UnitSystem> units;  ///< /UNIT/id, submodel offsets applied
  Begin begin;
  int version = newest_version;  ///< of the main file
  bool end_seen = false;         ///< /END in the main file
  std::uint64_t total_bytes = 0;
  Diagnostics diagnostics;  ///< what reading had to say (rules DK0xx)

  /// Parameter visible from `file`: local there, local in its parents, global.
  const Parameter* find_parameter(std::string_view name, std::uint32_t file) const;
  /// Unit system the fields of a block are written in. nullptr: unknown unit id.
  const UnitSystem* units_of(const Block& block) const;
  std::int64_t offset_of(const Block& block, std::string_view kind) const;
  /// An id on a card of the block with the offset of its submodel; 0 and below stay.
  std::int64_t shifted_id(const Block& block, std::string_view kind, std::int64_t id) const {
    return id > 0 ? id + offset_of(block, kind) : id;
  }
  /// There are blocks whose header begins so: "/TABLE".
  bool has(std::string_view header) const;
  /// Parent of a file in the include tree (no_file for the main file).
  std::uint32_t parent_of(std::uint32_t file) const;
};

/// Reads a deck and everything it includes. Only a main file that cannot be read is an error; all
/// else is a diagnostic in the result.
Result<Deck> read_deck(const std::string& path, const SchemaSet& schemas,
                       const ReadOptions& options = {});
/// The same for text in memory; includes are searched in the current directory.
Result<Deck> read_deck_text(std::string name, std::string text, const SchemaSet& schemas,
                            const ReadOptions& options = {});

/// True for the rows of the version table of the reference solver.
bool is_known_version(int version);

}  // namespace deck
