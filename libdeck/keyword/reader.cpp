// One pass over the bytes of every file: only header lines and directives are looked at, everything
// else becomes part of the block that is open. A few hundred lines because the walk, its limits and
// its findings belong together.
#include "keyword/reader.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "deck/text/number.hpp"

namespace deck {
namespace {

using detail::columns;
using detail::starts_with_nocase;
using detail::trim;
using detail::trim_right;
namespace fs = std::filesystem;

constexpr int known_versions[] = {2026, 2025, 2024, 2023, 2022, 2021, 2020, 2019, 2018, 2017,
                                  140,  130,  120,  110,  100,  90,   51,   44,   42,   41};

Span make_span(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint64_t longest = 1 << 20;
  return {file, static_cast<std::uint32_t>(std::min(end - begin, longest)), begin};
}

class Reader {
 public:
  Reader(const SchemaSet& schemas, const ReadOptions& options)
      : schemas_(schemas), options_(options), deck_() {
    deck_.diagnostics = Diagnostics(options.limits.diagnostics_per_rule);
  }

  Result<Deck> read(std::unique_ptr<Source> main) {
    if (auto bad = refuse(*main); !bad) return bad.error();
    deck_.total_bytes = main->bytes().size();
    main_directory_ = directory_of(main->path());
    deck_.sources.add(std::move(main));
    check_banner();
    stack_.push_back(0);
    scan(0, newest_version);
    stack_.pop_back();
    finish();
    return std::move(deck_);
  }

 private:
  // ---- findings -----------------------------------------------------------------------------

  void report(std::string_view rule, Severity severity, Span span, std::string message,
              std::string behaviour, std::string help, int number = 0,
              Severity number_severity = Severity::error) {
    if (!deck_.diagnostics.wants(rule)) return;
    Diagnostic d;
    d.rule = rule;
    d.severity = severity;
    d.span = span;
    d.message = std::move(message);
    d.reference_behaviour = std::move(behaviour);
    d.help = std::move(help);
    if (number != 0) d.reference = ReferenceMessage{number, number_severity};
    deck_.diagnostics.add(std::move(d));
  }

  /// Files that are no decks at all.
  static Result<void> refuse(const Source& source) {
    const std::string_view bytes = source.bytes();
    if (trim(bytes.substr(0, 1 << 16)).empty() && trim(bytes).empty())
      return Error{Error::Code::syntax, source.path() + ": is empty (" +
                                            std::to_string(bytes.size()) +
                                            " bytes of nothing but blanks); expected a Starter "
                                            "deck with /BEGIN … /END"};
    const std::string_view head = bytes.substr(0, 4096);
    const auto nul = static_cast<std::size_t>(std::count(head.begin(), head.end(), '\0'));
    if (nul * 10 > head.size())
      return Error{Error::Code::syntax,
                   source.path() + ": is a binary file (" + std::to_string(nul) +
                       " NUL bytes in the first " + std::to_string(head.size()) +
                       "); expected the text of a Starter deck"};
    return {};
  }

  void check_banner() {
    const std::string_view bytes = deck_.sources[0].bytes();
    if (bytes.starts_with("\xef\xbb\xbf"))
      report("DK033", Severity::warning, make_span(0, 0, 3),
             "the file starts with a UTF-8 byte order mark",
             "it takes the three bytes for the start of the first line, so the banner is not found",
             "save the file without byte order mark");
    const auto end = std::min(bytes.find('\n'), bytes.size());
    if (!trim(bytes.substr(0, end)).starts_with("#RADIOSS STARTER"))
      report("DK001", Severity::warning, make_span(0, 0, end),
             "the first line is not '#RADIOSS STARTER'",
             "official builds stop at once; open-reader builds take the line for a comment",
             "put '#RADIOSS STARTER' in the first line", 100201);
  }

  // ---- include tree -------------------------------------------------------------------------

  static fs::path directory_of(const std::string& path) {
    return path == "-" ? fs::path() : fs::path(path).parent_path();
  }

  /// Candidate places of an include, in the order they are tried, without repetition.
  std::vector<std::string> candidates(const std::string& written, std::uint32_t parent) const {
    std::vector<std::string> all;
    const auto consider = [&](const fs::path& p) {
      std::string text = p.lexically_normal().string();
      if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(std::move(text));
    };
    const fs::path path(written);
    if (path.is_absolute()) {
      consider(path);
      return all;
    }
    consider(directory_of(deck_.sources[parent].path()) / path);
    consider(main_directory_ / path);
    for (const std::string& extra : options_.include_paths) consider(fs::path(extra) / path);
    return all;
  }

  void include(std::string written, Span directive, std::uint32_t parent, int version) {
    std::replace(written.begin(), written.end(), '\\', '/');
    if (written.empty()) {
      report("DK004", Severity::error, directive, "#include without a file name",
             "it stops with an error", "name the file or remove the line", 100002);
      return;
    }
    if (static_cast<int>(stack_.size()) > options_.limits.include_depth) {
      report("DK006", Severity::error, directive,
             "includes are nested deeper than " + std::to_string(options_.limits.include_depth) +
                 " levels; '" + written + "' was not read",
             "it stops at about 10 levels", "flatten the include tree");
      return;
    }
    if (static_cast<int>(deck_.sources.size()) >= options_.limits.files) {
      report("DK006", Severity::error, directive,
             "more than " + std::to_string(options_.limits.files) + " files; '" + written +
                 "' was not read",
             "", "check the deck for an include that multiplies itself");
      return;
    }
    std::string tried;
    for (const std::string& path : candidates(written, parent)) {
      auto source = Source::open(path, options_.limits);
      if (!source) {
        tried += (tried.empty() ? "" : "; ") + source.error().message;
        continue;
      }
      enter(std::move(*source), std::move(written), directive, parent, version);
      return;
    }
    report("DK004", Severity::error, directive,
           "included file '" + written + "' cannot be read; tried " + tried,
           "it stops with an error that does not name the file (\"error 760\" in some builds)",
           "correct the path, or name the folder that holds it with --include-path", 100002);
  }

  void enter(std::unique_ptr<Source> source, std::string written, Span directive,
             std::uint32_t parent, int version) {
    for (const std::uint32_t open : stack_) {
      const Source& s = deck_.sources[open];
      if (s.inode() != source->inode() || s.device() != source->device() || s.inode() == 0)
        continue;
      report("DK005", Severity::error, directive,
             "include cycle: '" + written + "' is being read already (" + s.path() + ")",
             "it recurses until it fails", "remove the directive");
      return;
    }
    deck_.total_bytes += source->bytes().size();
    if (deck_.total_bytes > options_.limits.total_bytes) {
      report("DK006", Severity::error, directive,
             "all files together are larger than the limit of " +
                 std::to_string(options_.limits.total_bytes) + " bytes",
             "", "check the deck for an include that multiplies itself");
      return;
    }
    const std::uint32_t file = deck_.sources.add(std::move(source));
    deck_.includes.push_back({file, parent, directive, std::move(written)});
    stack_.push_back(file);
    scan(file, version);
    stack_.pop_back();
  }

  /// Path of an include directive; continuation by a trailing " +", "..." or "&", or by a next line
  /// that starts with "+". `pos` moves behind the directive.
  static std::string include_path(std::string_view bytes, std::uint64_t& pos) {
    std::string path;
    bool more = true;
    for (bool first = true; more && pos < bytes.size(); first = false) {
      const auto nl = std::min(bytes.find('\n', pos), bytes.size());
      std::string_view line = trim_right(bytes.substr(pos, nl - pos));
      if (first) line.remove_prefix(8);
      if (!first && line.starts_with('+')) line.remove_prefix(1);
      pos = std::min(nl + 1, bytes.size());
      more = false;
      for (const std::string_view mark : {" +", "...", "&"}) {
        if (line.ends_with(mark)) {
          line.remove_suffix(mark.size());
          more = true;
          break;
        }
      }
      path += trim(line);
      if (pos < bytes.size() && bytes[pos] == '+') more = true;
    }
    std::erase(path, '\'');
    return std::string(trim(path));
  }

  // ---- lines --------------------------------------------------------------------------------

  /// Adds the lines [begin, end) to the open block.
  void append_lines(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
    if (begin >= end || open_block_ < 0) return;
    auto& body = deck_.blocks[static_cast<std::size_t>(open_block_)].body;
    if (!body.empty() && body.back().file == file && body.back().end == begin)
      body.back().end = end;
    else
      body.push_back({file, begin, end});
  }

  void scan(std::uint32_t file, int version) {
    const std::string_view bytes = deck_.sources[file].bytes();
    const std::uint64_t size = bytes.size();
    const bool is_main = file == 0;
    std::uint64_t pos = 0, run = 0;
    while (pos < size) {
      const char* const start = bytes.data() + pos;
      const void* const found = std::memchr(start, '\n', size - pos);
      const std::uint64_t end =
          found ? static_cast<std::uint64_t>(static_cast<const char*>(found) - bytes.data()) : size;
      const std::uint64_t next = std::min(end + 1, size);
      const char* c = start;
      const char* const stop = bytes.data() + end;
      while (c != stop && (*c == ' ' || *c == '\t')) ++c;
      if (c == stop || (*c != '/' && *start != '#')) {
        pos = next;
        continue;
      }
      if (*start == '#') {
        const std::string_view line(start, end - pos);
        if (starts_with_nocase(line, "#include") && line.size() > 8 &&
            (line[8] == ' ' || line[8] == '\t' || line[8] == '\'')) {
          append_lines(file, run, pos);
          const std::uint64_t directive = pos;
          std::string path = include_path(bytes, pos);
          include(std::move(path), make_span(file, directive, end), file,
                  in_submodel_without_begin() ? deck_.version : version);
          run = pos;
          continue;
        }
        if (!is_main && starts_with_nocase(line, "#enddata")) {
          append_lines(file, run, pos);
          return;
        }
        pos = next;
        continue;
      }
      append_lines(file, run, pos);
      const std::string_view header =
          trim_right({c, static_cast<std::size_t>(stop - c)});
      run = next;
      if (header == "/END") {
        open_block_ = -1;
        if (is_main) {
          deck_.end_seen = true;
          check_tail(next);
        }
        return;
      }
      open(file, header, static_cast<std::uint64_t>(c - bytes.data()), next, version);
      pos = next;
    }
    append_lines(file, run, size);
  }

  bool in_submodel_without_begin() const {
    return !submodel_stack_.empty() &&
           !deck_.submodels[static_cast<std::size_t>(submodel_stack_.back())].units;
  }

  void check_tail(std::uint64_t from) {
    std::string_view rest = deck_.sources[0].bytes().substr(from);
    std::uint64_t at = from;
    while (!rest.empty()) {
      const auto nl = std::min(rest.find('\n'), rest.size());
      const std::string_view line = trim(rest.substr(0, nl));
      if (!line.empty() && line[0] != '#' && line[0] != '$') {
        report("DK011", Severity::warning, make_span(0, at, at + nl),
               "text after /END in the main file",
               "it stops reading at /END: nothing below exists for it",
               "move the lines above /END or delete them");
        return;
      }
      at += nl + 1;
      rest.remove_prefix(std::min(nl + 1, rest.size()));
    }
  }

  // ---- headers ------------------------------------------------------------------------------

  void open(std::uint32_t file, std::string_view header, std::uint64_t offset, std::uint64_t next,
            int& version) {
    Block block;
    block.header = header;
    block.header_span = make_span(file, offset, offset + header.size());
    block.version = version;
    if (!submodel_stack_.empty()) block.submodel = submodel_stack_.back();
    if (header == "/BEGIN" || header.starts_with("/BEGIN/")) {
      read_begin(file, block.header_span, next, version);
      block.version = version;
    } else if (header.starts_with("//SUBMODEL")) {
      Submodel sub;
      sub.parent = submodel_stack_.empty() ? -1 : submodel_stack_.back();
      sub.span = block.header_span;
      deck_.submodels.push_back(std::move(sub));
      submodel_stack_.push_back(static_cast<std::int32_t>(deck_.submodels.size()) - 1);
      submodel_blocks_.push_back(deck_.blocks.size());
    } else if (header.starts_with("//ENDSUB")) {
      if (submodel_stack_.empty())
        report("DK035", Severity::error, block.header_span, "//ENDSUB without //SUBMODEL",
               "the line is an unknown keyword for it", "remove the line");
      else
        submodel_stack_.pop_back();
    }
    if (begin_count_ == 0 && !header.starts_with("/PARAMETER")) before_begin_.push_back(
        deck_.blocks.size());
    detail::parse_header(schemas_, block);
    deck_.blocks.push_back(std::move(block));
    open_block_ = static_cast<std::int64_t>(deck_.blocks.size()) - 1;
  }

  /// /BEGIN is needed before anything else can be read: its four lines are read on the spot.
  void read_begin(std::uint32_t file, Span header, std::uint64_t pos, int& version) {
    const std::string_view bytes = deck_.sources[file].bytes();
    Line lines[4];
    for (int have = 0; have < 4 && pos < bytes.size();) {
      const auto nl = std::min(bytes.find('\n', pos), bytes.size());
      const std::string_view text = trim_right(bytes.substr(pos, nl - pos));
      const bool comment = text.starts_with('#') || text.starts_with('$');
      if (!comment && trim(text).starts_with('/')) break;
      if (!comment) lines[have++] = {text.substr(0, 100), file, pos};
      pos = nl + 1;
    }
    ++begin_count_;
    Begin begin;
    begin.span = header;
    begin.run_name = std::string(trim(lines[0].text));
    const std::string_view cell = columns(lines[1].text, 1, 10);
    begin.version_span = lines[1].valid() ? lines[1].columns(1, 10) : header;
    const IntegerCell number = read_integer(cell);
    begin.version_written = static_cast<int>(std::clamp<std::int64_t>(number.value, 0, 99999));
    begin.version_known = is_known_version(begin.version_written);
    version = begin.version_known ? begin.version_written : newest_version;
    read_units(lines[2], begin.input, begin.has_input);
    read_units(lines[3], begin.working, begin.has_working);
    if (file == 0 || begin_count_ == 1) {
      deck_.begin = std::move(begin);
      deck_.version = version;
      if (!deck_.begin.version_known)
        report("DK003", Severity::error, deck_.begin.version_span,
               "input version " + std::string(trim(cell).empty() ? "(blank)" : trim(cell)) +
                   " is unknown; the columns of version " + std::to_string(newest_version) +
                   " are assumed",
               "open-reader builds take the newest layout, official builds may refuse the deck",
               "write the version the deck was made for (90 … 2026) in columns 1-10", 100202);
      settle_units();
    } else if (!submodel_stack_.empty() && begin.has_input) {
      deck_.submodels[static_cast<std::size_t>(submodel_stack_.back())].units = begin.input;
    }
  }

  void read_units(const Line& line, UnitSystem& units, bool& present) {
    const std::string_view cells[3] = {trim(columns(line.text, 1, 20)),
                                       trim(columns(line.text, 21, 40)),
                                       trim(columns(line.text, 41, 60))};
    present = !cells[0].empty() || !cells[1].empty() || !cells[2].empty();
    if (!present) return;
    units.mass_code = cells[0];
    units.length_code = cells[1];
    units.time_code = cells[2];
    double* const factors[3] = {&units.mass, &units.length, &units.time};
    constexpr char bases[3] = {'g', 'm', 's'};
    constexpr const char* names[3] = {"mass", "length", "time"};
    for (int i = 0; i < 3; ++i) {
      if (const auto factor = unit_factor(cells[i], bases[i])) {
        *factors[i] = *factor;
        continue;
      }
      report("DK015", Severity::error, line.columns(20 * i + 1, 20 * i + 20),
             std::string("'") + std::string(cells[i]) + "' is not a " + names[i] +
                 " unit; expected a prefix and '" + bases[i] + "', or a positive number",
             "it stops with an error", "write for example Mg, mm, s or kg, mm, ms", 573);
    }
  }

  void settle_units() {
    Begin& b = deck_.begin;
    if (!b.has_input && b.has_working) b.input = b.working;
    if (b.has_input && !b.has_working) b.working = b.input;
  }

  // ---- after the last line ------------------------------------------------------------------

  void finish() {
    if (begin_count_ == 0) {
      report("DK002", Severity::error, make_span(0, 0, 0),
             "no /BEGIN: version and units are unknown; version " +
                 std::to_string(newest_version) + " is assumed",
             "it ignores everything before /BEGIN, that is the whole deck",
             "start the deck with /BEGIN, run name, version and units");
    } else {
      drop_before_begin();
    }
    if (!deck_.end_seen)
      report("DK010", Severity::warning, make_span(0, deck_.total_bytes ? main_size() : 0,
                                                   main_size()),
             "the main file has no /END", "it reads to the end of the file",
             "close the deck with /END", 100215);
    detail::read_parameters(deck_, options_.limits);
    resolve_header_parameters();
    fill_submodels();
    fill_units();
    mark_opaque();
  }

  std::uint64_t main_size() const { return deck_.sources[0].bytes().size(); }

  void drop_before_begin() {
    std::vector<Block> kept;
    std::size_t k = 0;
    for (std::size_t i = 0; i < deck_.blocks.size(); ++i) {
      const bool early = k < before_begin_.size() && before_begin_[k] == i;
      if (early) ++k;
      if (!early || deck_.blocks[i].header.starts_with("/BEGIN")) {
        for (std::size_t& s : submodel_blocks_)
          if (s == i) s = kept.size();
        kept.push_back(std::move(deck_.blocks[i]));
      } else {
        report("DK002", Severity::warning, deck_.blocks[i].header_span,
               std::string(deck_.blocks[i].header) + " stands before /BEGIN",
               "it ignores everything before /BEGIN except /PARAMETER",
               "move the block behind /BEGIN");
      }
    }
    deck_.blocks = std::move(kept);
  }

  void resolve_header_parameters() {
    for (Block& b : deck_.blocks) {
      for (HeaderId* id : {&b.id, &b.unit_id}) {
        const std::string_view text = deck_.sources.text(id->span);
        if (!text.starts_with('&')) continue;
        const Parameter* p = deck_.find_parameter(text.substr(1), id->span.file);
        if (p != nullptr && p->valid) {
          id->value = p->type == Parameter::Type::integer ? p->integer
                                                          : static_cast<std::int64_t>(p->real);
        } else {
          report("DK018", Severity::error, id->span,
                 "parameter '" + std::string(text) + "' is not defined here",
                 "it reads 0", "define it with /PARAMETER before its first use", 100105);
        }
      }
    }
  }

  void fill_submodels() {
    for (std::size_t i = 0; i < deck_.submodels.size(); ++i) {
      Submodel& s = deck_.submodels[i];
      if (i >= submodel_blocks_.size()) break;
      const Block& block = deck_.blocks[submodel_blocks_[i]];
      s.id = block.id.value;
      LineCursor cursor(deck_.sources, block);
      s.title = std::string(cursor.next().text);
      const Line line = cursor.next();
      std::int64_t* const cells[7] = {&s.definitions, &s.nodes,      &s.elements, &s.parts,
                                      &s.materials,   &s.properties, &s.submodels};
      for (int c = 0; c < 7; ++c)
        *cells[c] = read_integer(columns(line.text, 10 * c + 1, 10 * c + 10)).value;
      for (int c = 1; c < 7; ++c)
        if (*cells[c] == 0) *cells[c] = s.definitions;
      if (s.parent < 0) continue;
      const Submodel& p = deck_.submodels[static_cast<std::size_t>(s.parent)];
      const std::int64_t above[7] = {p.definitions, p.nodes,      p.elements, p.parts,
                                     p.materials,   p.properties, p.submodels};
      for (int c = 0; c < 7; ++c) *cells[c] += above[c];
      if (!s.units && p.units) s.units = p.units;
    }
    if (!submodel_stack_.empty())
      report("DK035", Severity::error,
             deck_.submodels[static_cast<std::size_t>(submodel_stack_.back())].span,
             "//SUBMODEL is not closed by //ENDSUB", "everything below belongs to the submodel",
             "close it with //ENDSUB");
  }

  void fill_units() {
    for (const Block& b : deck_.blocks) {
      if (b.header.starts_with("/UNIT/LENGTH") || b.header.starts_with("/UNIT/MASS") ||
          b.header.starts_with("/UNIT/TIME")) {
        const auto slash = b.header.rfind('/');
        const char kind = b.header[6];
        const std::string_view code = b.header.substr(slash + 1);
        const char base = kind == 'L' ? 'm' : kind == 'M' ? 'g' : 's';
        if (const auto f = unit_factor(code, base)) {
          UnitSystem& u = deck_.begin.input;
          (kind == 'L' ? u.length : kind == 'M' ? u.mass : u.time) = *f;
          (kind == 'L' ? u.length_code : kind == 'M' ? u.mass_code : u.time_code) = code;
          deck_.begin.has_input = true;
        }
        continue;
      }
      if (!b.header.starts_with("/UNIT/")) continue;
      LineCursor cursor(deck_.sources, b);
      cursor.next();
      UnitSystem units;
      bool present = false;
      if (const Line line = cursor.next(); line.valid()) read_unit_line(line, units, present);
      deck_.units[b.id.value + deck_.offset_of(b, "unit")] = units;
    }
    settle_units();
    if (begin_count_ > 0 && !deck_.begin.has_input && !deck_.begin.has_working)
      report("DK016", Severity::error, deck_.begin.span,
             "/BEGIN names neither input nor working units",
             "it stops with an error", "add the unit lines, for example 'kg mm ms' twice", 574);
    else if (begin_count_ > 0 && !(deck_.begin.input == deck_.begin.working))
      report("DK017", Severity::info, deck_.begin.span,
             "input units differ from working units: every value is converted",
             "it converts and warns", "nothing to do if this is meant", 754, Severity::warning);
  }

  /// As read_units, but a blank or 0 cell means factor 1.
  void read_unit_line(const Line& line, UnitSystem& units, bool& present) {
    Line copy = line;
    read_units(copy, units, present);
  }

  void mark_opaque() {
    for (Block& b : deck_.blocks) {
      if (!b.header.starts_with("/MAT") && !b.header.starts_with("/PROP") &&
          !b.header.starts_with("/FAIL") && !b.header.starts_with("/FUNCT"))
        continue;
      LineCursor cursor(deck_.sources, b);
      cursor.next();
      const Line line = cursor.next();
      // Cipher text: a full line without a single blank that is not a number either.
      if (line.text.size() < 60 || line.text.find(' ') != std::string_view::npos) continue;
      b.opaque = line.text.find_first_not_of("0123456789.,+-eEdD") != std::string_view::npos;
    }
  }

  const SchemaSet& schemas_;
  const ReadOptions& options_;
  Deck deck_;
  fs::path main_directory_;
  std::vector<std::uint32_t> stack_;  // files being read, outermost first
  std::vector<std::int32_t> submodel_stack_;
  std::vector<std::size_t> submodel_blocks_;
  std::vector<std::size_t> before_begin_;
  std::int64_t open_block_ = -1;
  int begin_count_ = 0;
};

}  // namespace

bool is_known_version(int version) {
  return std::find(std::begin(known_versions), std::end(known_versions), version) !=
         std::end(known_versions);
}

Result<Deck> read_deck(const std::string& path, const SchemaSet& schemas,
                       const ReadOptions& options) {
  auto source = Source::open(path, options.limits);
  if (!source) return source.error();
  return Reader(schemas, options).read(std::move(*source));
}

Result<Deck> read_deck_text(std::string name, std::string text, const SchemaSet& schemas,
                            const ReadOptions& options) {
  return Reader(schemas, options).read(Source::from_bytes(std::move(name), std::move(text)));
}

}  // namespace deck
