// Keywords: schemas, the blocks of a deck in file order, decoding of their cells, Engine files.
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

// Schema: the layout of a keyword's cards per input version: columns, types, dimensions, legal
// values, defaults, conditions. Schemas come from schemas/keywords/*.json.

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
  flag,     ///< one column; set if it has the digit 1
  id,       ///< integer that refers to another entity (see Field::ref)
};

/// A test on another field of the block: one of an earlier card or, for conditions of cells, one of
/// the same line.
struct Condition {
  /// Instead of a field: the number of data lines of the block, its title excluded.
  static constexpr std::string_view data_lines = "(data lines)";

  std::string field;
  std::vector<std::string> words;    ///< for a text cell: it has one of these texts, in any case
  std::vector<std::int64_t> in;      ///< the value is one of these (empty: no test)
  std::vector<std::int64_t> not_in;  ///< and not one of these
  std::optional<std::int64_t> min, max;  ///< and within these limits, inclusive
  bool accepts(std::int64_t value) const;
};

/// The quantities that can change the default of a field.
enum class DefaultVaries : std::uint8_t {
  no,
  deck,    ///< a card such as /DEFAULT/INTER/TYPE7 comes before the built-in number
  model,   ///< the kind of analysis or the size of the model, and maybe a /DEFAULT card
  fields,  ///< other fields of the same card
};

/// The scale of one axis of a function or table.
struct Axis {
  /// Real cells that scale the points (by their product). 0 or blank is 1 in the units of the
  /// block. Empty: no scale.
  std::vector<std::string> scales;
  Dimension dimension;  ///< of the points of an axis without a scale
  std::vector<std::pair<std::vector<Condition>, Dimension>> dimension_when;
};

/// One fixed-column cell. Columns are 1-based and inclusive.
struct Field {
  std::string name;         ///< the manual's name, e.g. "Fscalegap"
  int first = 0, last = 0;  ///< columns
  FieldType type = FieldType::integer;
  std::string ref;  ///< for ids: kind of the target ("grnod", "surf", "node", ...)
  /// For ids: the solver message (0: number unknown) at which the solver stops if the target does
  /// not exist, is empty, or if the id is blank. nullopt: legal or unknown.
  std::optional<int> missing, empty, required;
  int from = 0, until = 9999;        ///< input versions that have this cell
  std::vector<Condition> when;       ///< all must hold; a line without active cells is absent
  std::vector<std::int64_t> values;  ///< legal values (empty: any)
  std::optional<double> min, max;    ///< legal range, inclusive
  bool min_open = false, max_open = false;  ///< the limit itself is not legal
  std::string default_text;  ///< the effective value of 0 or blank, in words or as a number
  /// The number that 0 or blank means, if it is one; with default_varies the usual one.
  std::optional<double> default_value;
  DefaultVaries default_varies = DefaultVaries::no;
  Dimension dimension;
  bool dimension_known = true;  ///< false: unit conversion must refuse this field
  /// Dimensions that depend on other fields; the first match applies.
  std::vector<std::pair<std::vector<Condition>, Dimension>> dimension_when;
  /// Dimension that the solver uses to convert the cell to working units, if it is not the physical
  /// one.
  std::optional<Dimension> solver_dimension;
  std::vector<Condition> solver_when;  ///< conditions for solver_dimension
  /// For ids of functions and tables: all axes, the ordinate last. Empty: unknown.
  std::vector<Axis> axes;
  /// 0 or blank is 1 in the units of the block if one of these cells is not 0.
  std::vector<std::string> unit_for;
  /// The solver multiplies the value by this cell (blank: 1) if `over_when` holds.
  std::string over;
  std::vector<Condition> over_when;
  bool ignored = false;     ///< the solver reads it and ignores it
  std::string doc;          ///< one line
  std::string from_manual;  ///< difference between manual and solver, one line
  /// Purpose and solver behaviour for `explain`: paragraphs, and figure lines that begin with '|'
  /// and are shown unchanged without it.
  std::vector<std::string> help;
  std::string help_of;  ///< keyword whose field of this name has the rest of the help
  /// For ids: the solver ignores the block if this id is 0 or none of these ids has a target.
  bool acts_on = false;
  std::vector<std::string> words;  ///< legal texts of a text cell (empty: any)
  /// The solver message (0: number unknown) at which the solver stops if the cell is not legal: a
  /// flag that is not 0 or 1, a text that is not in `words`.
  std::optional<int> wrong;
  bool in_version(int version) const { return version >= from && version <= until; }
};

enum class Repeat : std::uint8_t {
  once,
  rows,   ///< this card repeats to the end of the block
  ids,    ///< list of ids: cells of the last field's width to the end of each line
  group,  ///< this card and the next ones marked `group` with the same count repeat together
};

/// One line of a block.
struct CardSchema {
  std::string name;             ///< subject of the card ("ids and flags", "friction")
  int from = 0, until = 9999;   ///< input versions that have this card
  std::vector<Condition> when;  ///< all must hold; empty: always present
  Repeat repeat = Repeat::once;
  /// Number of repetitions of a card or group, or of cells of a list: an integer field or a number.
  /// Empty: up to the end of the block.
  std::string count;
  int per_line = 0;       ///< cells per line of a list with a count
  bool words = false;     ///< lists: all lines up to the first that begins with a number
  bool optional = false;  ///< may be missing at the end of the block
  std::vector<Field> fields;
  std::string doc;
  bool in_version(int version) const { return version >= from && version <= until; }
  /// True if the line is a placeholder without fields.
  bool blank() const { return fields.empty(); }
};

struct Schema {
  std::string keyword;               ///< canonical, e.g. "/INTER/TYPE7"
  std::vector<std::string> aliases;  ///< e.g. "/PROP/TYPE1" for "/PROP/SHELL"
  std::string kind;       ///< kind of entity that it defines ("inter", "surf", ...); may be empty
  bool has_id = true;     ///< header carries an id
  bool has_title = true;  ///< a title line follows the header
  bool has_unit = true;   ///< header may carry a unit id after the id
  bool bulk = false;      ///< read by the fast reader directly into arrays
  /// Described in part: further lines, and columns between the cells, are legal and not
  /// interpreted.
  bool opaque_tail = false;
  /// With opaque_tail: the cards have every line and cell that the solver reads, in all versions.
  /// Cells can be moved; the meaning of some is unknown.
  bool full_layout = false;
  int from = 0;  ///< first input version with this keyword
  std::string doc;
  std::vector<CardSchema> cards;
  std::string source;  ///< file name the schema came from
  /// Keywords with the same text here share their ids: the solver stops (error 79) at an id used
  /// twice. Empty: ids may repeat, or another table checks them.
  std::string unique;
  static constexpr int goes_on = -1;
  /// By demand ("unit", "line", ...): solver message if a block does not meet it.
  std::map<std::string, int, std::less<>> demands;

  const Field* find_field(std::string_view name) const;
  /// The solver message for an unmet demand; 0: number unknown; goes_on: no stop; nullopt: unknown.
  /// The demand "unit" is that the unit id exists, if a cell has a dimension.
  std::optional<int> stop(std::string_view demand) const;
  /// True if all lines and columns of the block are described.
  bool layout_known() const { return !opaque_tail || full_layout; }
};

/// All known schemas and the longest-prefix lookup of header lines.
class SchemaSet {
 public:
  /// The schemas compiled into the library. Never fails in a correct build (tested).
  static const SchemaSet& built_in();
  /// Adds or replaces schemas from a JSON text. Error: place and reason.
  Result<void> add_json(std::string_view name, std::string_view text);
  /// Adds all *.json files of a directory, in the order of their names.
  Result<void> add_directory(const std::string& dir);

  /// Schema whose keyword or alias is the longest prefix (by header fields) of `header`
  /// ("/SURF/PART/EXT/12"); nullptr if none.
  const Schema* match(std::string_view header) const;
  const Schema* find(std::string_view keyword) const;  ///< exact keyword or alias
  /// Every schema once, ordered by keyword.
  std::vector<const Schema*> all() const;

 private:
  struct LazySchema;  ///< one schema; built-in ones are parsed at their first use
  std::map<std::string, std::shared_ptr<const LazySchema>, std::less<>> by_name_;
};

// Deck: the include tree of a Starter deck, cut into blocks without loss of text. A block has the
// position of its lines; decode() reads its cells.

/// Input version assumed if /BEGIN has no version that the solver knows.
inline constexpr int newest_version = 2612;

/// Consecutive whole lines of one file.
struct FilePiece {
  std::uint32_t file = 0;
  std::uint64_t begin = 0, end = 0;
};

/// An id in a header: a number or a resolved parameter.
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
  std::vector<FilePiece> body;   ///< all lines up to the next header, comments included
  int version = newest_version;  ///< input version that its columns follow
  std::int32_t submodel = -1;    ///< index into Deck::submodels
  bool opaque = false;           ///< encrypted: never interpreted
};

/// One physical line of a block, trailing control characters and blanks removed.
struct Line {
  std::string_view text;
  std::uint32_t file = Span::no_file;
  std::uint64_t offset = 0;
  bool valid() const { return file != Span::no_file; }
  /// Span of columns `first` to `last` (1-based, inclusive), clipped to the line.
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
/// The factor of a unit code ("Mg", "mm", "0.001") for base 'g', 'm' or 's'. nullopt: unknown code.
std::optional<double> unit_factor(std::string_view code, char base);
/// value_in_to = value_in_from * factor
double conversion_factor(const UnitSystem& from, const UnitSystem& to, const Dimension& dimension);

struct Submodel {
  std::int64_t id = 0;
  std::string title;
  std::int32_t parent = -1;
  /// Offsets, including those of all ancestors; empty fields have the value of `definitions`.
  std::int64_t definitions = 0, nodes = 0, elements = 0, parts = 0, materials = 0, properties = 0,
               submodels = 0;
  std::optional<UnitSystem> units;  ///< units of its own /BEGIN
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
  std::uint32_t parent = 0;  ///< the file with the directive
  Span directive;
  std::string written;  ///< path as written in the deck
};

/// The /BEGIN block of the main file.
struct Begin {
  std::string run_name;
  int version_written = 0;  ///< the number in the deck, 0 if blank
  bool version_known = true;
  bool version_unread = false;  ///< 41, 42, 44 (cells of eight columns): no blocks are read
  UnitSystem input, working;
  bool has_input = false, has_working = false;
  Span span;  ///< header line; invalid: no /BEGIN
  Span version_span;
};

struct ReadOptions {
  Limits limits;
  std::vector<std::string> include_paths;  ///< searched after the including and the main file
  /// Texts to use instead of files, by path as the reader would open them. The files need not
  /// exist. Must outlive the reading.
  const std::map<std::string, std::string>* overlay = nullptr;
};

/// Start of a comment for `deck lint`, after its '#' or '$'.
inline constexpr std::string_view lint_marker = "decklint:";

/// Positions of lint_marker in a file.
struct LintMarkers {
  std::uint64_t searched = 0;          ///< bytes searched so far; the whole file after reading
  std::vector<std::uint64_t> offsets;  ///< of the markers, ascending
};

struct Deck {
  SourceSet sources;
  std::vector<LintMarkers> lint_markers;  ///< by file
  std::vector<IncludeEdge> includes;
  std::vector<Block> blocks;  ///< in file order; those of the main file up to /END
  std::vector<Submodel> submodels;
  std::multimap<std::string, Parameter, std::less<>> parameters;
  std::map<std::int64_t, UnitSystem> units;  ///< /UNIT/id, submodel offsets applied
  Begin begin;
  int version = newest_version;  ///< of the main file
  bool end_seen = false;         ///< /END in the main file
  std::uint64_t total_bytes = 0;
  Findings findings;  ///< findings of the reader (rules DK0xx)

  /// Parameter visible from `file`: a local one of the file, of its parents, or a global one.
  const Parameter* find_parameter(std::string_view name, std::uint32_t file) const;
  /// Unit system of the fields of a block. nullptr: unknown unit id.
  const UnitSystem* units_of(const Block& block) const;
  std::int64_t offset_of(const Block& block, std::string_view kind) const;
  /// An id on a card of the block plus the submodel offset; 0 and negative ids are unchanged.
  std::int64_t shifted_id(const Block& block, std::string_view kind, std::int64_t id) const {
    return id > 0 ? id + offset_of(block, kind) : id;
  }
  /// True if some header begins with this text, for example "/TABLE".
  bool has(std::string_view header) const;
  /// Parent of a file in the include tree (no_file for the main file).
  std::uint32_t parent_of(std::uint32_t file) const;
};

/// Reads a deck and all its includes. Error: the main file cannot be read. All other problems are
/// findings of the result.
Result<Deck> read_deck(const std::string& path, const SchemaSet& schemas,
                       const ReadOptions& options = {});
/// read_deck for text in memory; includes are searched in the current directory.
Result<Deck> read_deck_text(std::string name, std::string text, const SchemaSet& schemas,
                            const ReadOptions& options = {});

/// True for versions that the solver knows.
bool is_known_version(int version);

// Decoding: reads the cells of a block by its schema. Each value has its span, so that findings can
// point at the columns and edits can change only them.

/// One decoded cell.
struct Cell {
  const Field* field = nullptr;
  Span span;              ///< its columns on the line, clipped to the line (may be empty)
  std::string_view text;  ///< trimmed
  NumberStatus status = NumberStatus::blank;
  std::int64_t integer = 0;  ///< int, id, flag: as the solver reads it
  double real = 0;           ///< real cells, in the deck's units
  bool parameter = false;    ///< the value came from a &parameter
  bool blank() const { return status == NumberStatus::blank; }
};

struct DecodedCard {
  const CardSchema* schema = nullptr;
  Line line;  ///< invalid: the line is missing
  /// One per field of this version whose conditions hold; Repeat::ids: one per non-blank id; lists
  /// with a count: one per id.
  std::vector<Cell> cells;
  bool free_format = false;
  int round = 0;  ///< repeated cards and counted lists: number of the repetition or line, from 1
  bool missing() const { return !line.valid(); }
};

struct DecodedBlock {
  const Block* block = nullptr;
  std::string title;
  Line title_line;
  std::vector<DecodedCard> cards;  ///< in line order; repeated cards appear once per line
  std::vector<Line> extra;         ///< data lines after the last card of the schema
  /// First cell of that name. nullptr: not in this version or block.
  const Cell* find(std::string_view field) const;
  /// Value of an int, id or flag cell, 0 if absent.
  std::int64_t integer(std::string_view field) const;
  /// Value of a real cell in the deck's units, 0 if absent.
  double real(std::string_view field) const;
  /// Place for messages about the whole block.
  Span span() const { return block->header_span; }
};

/// Reads all cells of `block`. Missing and extra lines are legal in the result. With `findings`,
/// reports them, text in blank columns, unreadable numbers, tabs, and text after the last cell.
DecodedBlock decode(const Deck& deck, const Block& block, Findings* findings = nullptr);

/// True if the cells of a block meet all conditions. Cells of `card` are searched first, then those
/// of the same repetition, then those that do not repeat.
bool is_met(const std::vector<Condition>& when, const DecodedBlock& block,
            const DecodedCard* card = nullptr);
/// Dimension of a field in a block (evaluates Field::dimension_when); `card` is its line.
Dimension dimension_of(const Field& field, const DecodedBlock& block,
                       const DecodedCard* card = nullptr);
/// Value of a real cell in working units; `card` is its line if the dimension depends on it.
double working_value(const Deck& deck, const DecodedBlock& block, const Cell& cell,
                     const DecodedCard* card = nullptr);
/// Working value of the first cell of that name; 0 if there is none.
double working_value(const Deck& deck, const DecodedBlock& block, std::string_view field);

/// Reads the cells of one line; free format if it has a comma. Conditions on fields of other lines
/// count as true.
DecodedCard decode_line(const Deck& deck, const Block& block, const CardSchema& card,
                        const Line& line, Findings* findings);

// Engine files: instructions for a run in car_0001.rad, car_0002.rad ... beside the Starter deck
// car_0000.rad. They have keyword lines, each followed by lines in free format.

/// One keyword of an Engine file with its lines.
struct EngineBlock {
  std::string_view keyword;  ///< "/RUN/car/1": the line without trailing blanks
  Span header;
  std::vector<Span> lines;  ///< data lines: neither blank nor comments
  /// Part n of the keyword, from 0: part(0) of "/RUN/car/1" is "RUN". Empty: no such part.
  std::string_view part(std::size_t n) const;
};

struct EngineFile {
  std::uint32_t file = 0;  ///< in the deck's sources
  int number = 0;          ///< number in its name: 1 for car_0001.rad
  std::vector<EngineBlock> blocks;
  std::vector<Span> includes;  ///< include directives, which are not followed
};

struct EngineFiles {
  std::string run;                ///< "car"; empty: the deck is not named NAME_0000.rad
  std::vector<EngineFile> files;  ///< by number
  struct Unread {
    std::string path, why;
  };
  std::vector<Unread> unread;  ///< files that exist but cannot be read
};

/// Reads the Engine files beside the main file NAME_0000.rad: number 1, 2, ... up to the first
/// missing one; packed ones only if the deck is packed. Adds them to the sources of the deck, but
/// not to its blocks. Files above Limits::map_threshold are listed in `unread`.
EngineFiles read_engine_files(Deck& deck, const Limits& limits = {});

/// Name of the Starter deck of an Engine file: "car_0000.rad" for "car_0002.rad". Empty: not a name
/// of an Engine file.
std::string starter_of_engine_file(std::string_view path);

/// The words of a line, separated by blanks and commas.
std::vector<Span> engine_cells(const SourceSet& sources, Span line);

}  // namespace deck
