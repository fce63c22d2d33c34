// Keywords: schemas of blocks, the blocks of a deck in file order, decoding of the cells of a block
// by its schema, Engine files.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/text.hpp"

namespace deck {

// Schema: the form of a keyword's cards: columns, types, dimensions, legal values, defaults and
// conditions per input version. It is read from schemas/keywords/*.json only.

/// Exponents of mass, length, time and temperature. Half-integers do not occur.
struct Dimension {
  std::int8_t mass = 0, length = 0, time = 0, temperature = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
  bool dimensionless() const { return *this == Dimension{}; }
};

enum class FieldType : std::uint8_t {
  integer,  ///< whole number
  real,     ///< number, converted with its dimension
  text,     ///< raw columns, trailing blanks removed
  flag,     ///< one column, only the digit 1 counts
  id,       ///< integer that refers to another entity (see Field::ref)
};

/// A test on a field of the same block that was read on an earlier card or, for the condition of a
/// cell, on the same line.
struct Condition {
  /// Instead of a field: the number of data lines of the block, its title excluded.
  static constexpr std::string_view data_lines = "(data lines)";

  std::string field;
  std::vector<std::string> words;        ///< of a text cell: its text is one of these, in any case
  std::vector<std::int64_t> in;          ///< the value is one of these (empty: not tested)
  std::vector<std::int64_t> not_in;      ///< and none of these
  std::optional<std::int64_t> min, max;  ///< and within these bounds
  bool holds(std::int64_t value) const;
};

/// The things that can change the default of a field.
enum class DefaultVaries : std::uint8_t {
  no,
  deck,    ///< a card such as /DEFAULT/INTER/TYPE7 comes before the built-in number
  model,   ///< the kind of analysis or the size of the model, and perhaps such a card
  fields,  ///< other fields of the same card
};

/// The scale of one axis of a function or table.
struct Axis {
  /// Real cells of the block whose product with the points counts. 0 or blank is 1 in the units of
  /// the block. Empty: nothing scales the points of this axis.
  std::vector<std::string> scales;
  Dimension dimension;  ///< of the points of an axis without scale
  std::vector<std::pair<std::vector<Condition>, Dimension>> dimension_when;
};

/// One fixed-column cell. Columns are 1-based and inclusive.
struct Field {
  std::string name;         ///< the manual's name, e.g. "Fscalegap"
  int first = 0, last = 0;  ///< columns
  FieldType type = FieldType::integer;
  std::string ref;  ///< for ids: kind of the target ("grnod", "surf", "node", ...)
  /// For ids: the solver stops with this message (0: number not known) where the target does not
  /// exist, has no member, or is not named at all. Without a value that is legal or not known.
  std::optional<int> missing, empty, required;
  int from = 0, until = 9999;        ///< input versions that have this cell
  std::vector<Condition> when;       ///< all must hold; a line all of whose cells fail is none
  std::vector<std::int64_t> values;  ///< legal values (empty: any)
  std::optional<double> min, max;    ///< legal range, inclusive
  bool min_open = false, max_open = false;  ///< the bound itself is not legal
  std::string default_text;  ///< the effective value of 0/blank, in words or a number
  /// The number that 0/blank stands for, where there is one; with default_varies the usual one.
  std::optional<double> default_value;
  DefaultVaries default_varies = DefaultVaries::no;
  Dimension dimension;
  bool dimension_known = true;  ///< false: unit conversion must refuse this field
  /// Dimension that depends on an integer field, first match wins.
  std::vector<std::pair<std::vector<Condition>, Dimension>> dimension_when;
  /// Dimension with which the solver itself brings the cell from the units of its block to working
  /// units, where that is not its physical one.
  std::optional<Dimension> solver_dimension;
  std::vector<Condition> solver_when;  ///< and these hold
  /// For ids of functions and tables: every axis, the ordinate last. Empty: not known.
  std::vector<Axis> axes;
  /// 0 or blank is 1 in the units of the block if one of these cells is not 0.
  std::vector<std::string> unit_for;
  /// The solver multiplies the number by the number in this cell (blank: 1), if `over_when` holds.
  std::string over;
  std::vector<Condition> over_when;
  bool ignored = false;     ///< the reference solver reads it and does nothing with it
  std::string doc;          ///< one line
  std::string from_manual;  ///< where manual and reference solver differ, one line
  /// Its purpose and the solver's behaviour, for `explain`: paragraphs, and lines that begin with
  /// '|' and are shown unchanged (figures, without the '|').
  std::vector<std::string> help;
  std::string help_of;  ///< keyword whose field of the same name has the rest of the help
  /// For ids: the solver passes over the whole block where this one is 0, or where no block of the
  /// kind has a target.
  bool acts_on = false;
  std::vector<std::string> words;  ///< legal texts of a text cell (empty: any)
  /// The solver stops with this message (0: number not known) at a cell that is not legal: a flag
  /// other than 0 and 1, a text that is none of `words`.
  std::optional<int> wrong;
  bool in_version(int version) const { return version >= from && version <= until; }
};

enum class Repeat : std::uint8_t {
  once,
  rows,   ///< this card repeats to the end of the block
  ids,    ///< id list: cells of the last field's width to the end of every line
  group,  ///< this and the following cards marked `group` with the same count repeat together
};

/// One line of a block.
struct CardSchema {
  std::string name;             ///< what the card holds ("ids and flags", "friction")
  int from = 0, until = 9999;   ///< input versions that have this card
  std::vector<Condition> when;  ///< all must hold; empty: always present
  Repeat repeat = Repeat::once;
  /// How often a repeated card or group comes, or how many cells a list has: an integer field or a
  /// number. Empty: to the end of the block.
  std::string count;
  int per_line = 0;       ///< lists with a count: cells of a line
  bool words = false;     ///< lists: as many lines as do not begin with a number
  bool optional = false;  ///< may be missing at the end of the block without a complaint
  std::vector<Field> fields;
  std::string doc;
  bool in_version(int version) const { return version >= from && version <= until; }
  /// The line holds nothing, but a line of the block is taken for it.
  bool blank() const { return fields.empty(); }
};

struct Schema {
  std::string keyword;               ///< canonical, e.g. "/INTER/TYPE7"
  std::vector<std::string> aliases;  ///< e.g. "/PROP/TYPE1" for "/PROP/SHELL"
  std::string kind;       ///< entity kind whose ids it defines ("inter", "surf", ...); may be empty
  bool has_id = true;     ///< header carries an id
  bool has_title = true;  ///< a title line follows the header
  bool has_unit = true;   ///< header may carry a unit id after the id
  bool bulk = false;      ///< read by the fast path straight into arrays
  /// Described in part: lines after the described cards, and columns between the described cells,
  /// are legal and not interpreted.
  bool opaque_tail = false;
  /// With opaque_tail: every line and cell that the solver reads is described after all, for every
  /// version. Cells can be moved; what some of them mean is not interpreted.
  bool full_layout = false;
  int from = 0;  ///< first input version that knows the keyword
  std::string doc;
  std::vector<CardSchema> cards;
  std::string source;  ///< file name the schema came from
  /// Keywords with the same text here share their ids: the solver stops (error 79) where one is
  /// used twice. Empty: ids may repeat, or other tables take care of them.
  std::string unique;
  static constexpr int goes_on = -1;
  /// By demand ("unit", "line", ...), what the solver does with a block that does not meet it.
  std::map<std::string, int, std::less<>> demands;

  const Field* find_field(std::string_view name) const;
  /// Message with which the solver stops at a block that does not meet a demand; 0: it stops,
  /// goes_on, nullopt: not known. Cells with a dimension ask for a "unit" that exists.
  std::optional<int> stop(std::string_view demand) const;
  /// True if no line and no column of the block has a meaning that the cards do not tell.
  bool layout_known() const { return !opaque_tail || full_layout; }
};

/// All known schemas and the longest-prefix lookup of header lines.
class SchemaSet {
 public:
  /// The schemas compiled into the library. Never fails in a correct build (tested).
  static const SchemaSet& built_in();
  /// Adds or replaces schemas from one JSON text. Error: where and what is wrong.
  Result<void> add_json(std::string_view name, std::string_view text);
  /// Adds every *.json of a directory, in name order.
  Result<void> add_directory(const std::string& dir);

  /// Schema whose keyword or alias is the longest prefix (by header fields) of `header`
  /// ("/SURF/PART/EXT/12"); nullptr if none.
  const Schema* match(std::string_view header) const;
  const Schema* find(std::string_view keyword) const;  ///< exact keyword or alias
  /// Every schema once, ordered by keyword.
  std::vector<const Schema*> all() const;

 private:
  struct Entry;  ///< one schema; the built-in ones are parsed when they are first asked for
  std::map<std::string, std::shared_ptr<const Entry>, std::less<>> by_name_;
};

// Deck: the include tree of a Starter deck cut into blocks; no text is lost. A block keeps the
// position of its lines; its cells are not read before the block is decoded by its schema.

/// Input version used for a deck whose /BEGIN names none that the reference solver knows.
inline constexpr int newest_version = 2612;

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

/// A comment for `deck lint` begins with this text, behind its '#' or '$'.
inline constexpr std::string_view lint_marker = "decklint:";

/// The places of lint_marker in a file.
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
  Findings findings;  ///< what reading had to say (rules DK0xx)

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
/// else is a finding in the result.
Result<Deck> read_deck(const std::string& path, const SchemaSet& schemas,
                       const ReadOptions& options = {});
/// As read_deck, for text in memory; includes are searched in the current directory.
Result<Deck> read_deck_text(std::string name, std::string text, const SchemaSet& schemas,
                            const ReadOptions& options = {});

/// True for the rows of the version table of the reference solver.
bool is_known_version(int version);

// Decoding: the lines of a block against its schema. Every value keeps its span, so that a
// finding can point at the columns and an edit can change them and nothing else.

/// One decoded cell.
struct Cell {
  const Field* field = nullptr;
  Span span;              ///< its columns on the line, clipped to the line (may be empty)
  std::string_view text;  ///< trimmed
  NumberStatus status = NumberStatus::blank;
  std::int64_t integer = 0;  ///< int, id, flag; what the reference solver reads
  double real = 0;           ///< real cells, in the deck's units
  bool parameter = false;    ///< the value came from a &parameter
  bool blank() const { return status == NumberStatus::blank; }
};

struct DecodedCard {
  const CardSchema* schema = nullptr;
  Line line;  ///< invalid: the line is missing
  /// One per field of this version whose conditions hold; for Repeat::ids one per non-blank id, for
  /// lists with a count one per id.
  std::vector<Cell> cells;
  bool free_format = false;
  int round = 0;  ///< repeated cards and counted lists: which time, or which line, from 1
  bool missing() const { return !line.valid(); }
};

struct DecodedBlock {
  const Block* block = nullptr;
  std::string title;
  Line title_line;
  std::vector<DecodedCard> cards;  ///< in line order; repeated cards appear once per line
  std::vector<Line> extra;         ///< data lines after the last card of the schema
  /// First cell of that name; nullptr if this version or this block does not have it.
  const Cell* find(std::string_view field) const;
  /// Value of an integer/id/flag cell, 0 if absent.
  std::int64_t integer(std::string_view field) const;
  /// Value of a real cell in the deck's units, 0 if absent.
  double real(std::string_view field) const;
  /// Spot for messages about the block as a whole.
  Span span() const { return block->header_span; }
};

/// Reads every cell of `block`. Lines may be fewer or more than the schema's: that is data, and
/// with `findings` also findings (missing and extra lines, text in blank columns, unreadable
/// numbers, tabs, text beyond the last cell).
DecodedBlock decode(const Deck& deck, const Block& block, Findings* findings = nullptr);

/// True if all conditions hold for the cells of a block. Cells of `card` count first, then those of
/// the same round, then those that do not repeat.
bool holds(const std::vector<Condition>& when, const DecodedBlock& block,
           const DecodedCard* card = nullptr);
/// Dimension of a field in a given block (resolves Field::dimension_when), `card` being its line.
Dimension dimension_of(const Field& field, const DecodedBlock& block,
                       const DecodedCard* card = nullptr);
/// Value of a real cell in working units; `card`: its line, where that decides on the dimension.
double working_value(const Deck& deck, const DecodedBlock& block, const Cell& cell,
                     const DecodedCard* card = nullptr);
/// The working value of the first cell of that name; 0 if there is none.
double working_value(const Deck& deck, const DecodedBlock& block, std::string_view field);

/// Cells of one line. Free format if the line holds a comma (titles never are). Conditions of cells
/// can look at this line only: where they test another field they count as true.
DecodedCard decode_line(const Deck& deck, const Block& block, const CardSchema& card,
                        const Line& line, Findings* findings);

// Engine files: the instructions for a run, in car_0001.rad, car_0002.rad and so on beside the
// Starter deck (car_0000.rad). They have keyword lines, and lines in free format below them.

/// One keyword of an Engine file with its lines.
struct EngineBlock {
  std::string_view keyword;  ///< "/RUN/car/1": the line without trailing blanks
  Span header;
  std::vector<Span> lines;  ///< data lines: neither blank nor comments
  /// Part n of the keyword, counted from 0: part(0) of "/RUN/car/1" is "RUN". Empty: there is none.
  std::string_view part(std::size_t n) const;
};

struct EngineFile {
  std::uint32_t file = 0;  ///< in the deck's sources
  int number = 0;          ///< of its name: 1 for car_0001.rad
  std::vector<EngineBlock> blocks;
  std::vector<Span> includes;  ///< lines that would include a file
};

struct EngineFiles {
  std::string run;                ///< "car"; empty: the deck has no name of that form
  std::vector<EngineFile> files;  ///< by number
  struct Unread {
    std::string path, why;
  };
  std::vector<Unread> unread;  ///< there, but not to be read
};

/// Reads the Engine files that stand beside the main file of the deck, NAME_0000.rad (of a packed
/// deck also packed ones): number 1 and on, up to the first that is not there. They are added to
/// the deck's sources, so that spans of findings lie in them, and belong to no block. A file above
/// Limits::map_threshold is no Engine file: it is named in `unread`.
EngineFiles read_engine_files(Deck& deck, const Limits& limits = {});

/// The Starter deck of an Engine file by its name: "car_0000.rad" of "car_0002.rad"; empty: this is
/// no such name.
std::string starter_of_engine_file(std::string_view path);

/// The words of a line, parted by blanks and commas.
std::vector<Span> engine_cells(const SourceSet& sources, Span line);

}  // namespace deck
