// Reads the include tree in one pass over the bytes of every file. Only lines whose first non-blank
// character is '/' or '#' matter, so the reader searches for these characters and never looks at
// data lines. A header opens a block; the lines up to the next header are its body. The directive
// #include descends into a file; lines before its first keyword belong to no block. Cost: O(bytes),
// two memchr per line with such a character. Steps that need all files are in reader_finish.cpp.
#include "keyword/shared/reader.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "keyword/shared/include_scan.hpp"
#include "text/shared/gzip.hpp"
#include "text/shared/number_scan.hpp"

namespace deck {
namespace {

using detail::header_columns;
using detail::is_blank;
using detail::longest_path;
using detail::make_span;
using detail::starts_with_nocase;
using detail::trim;
using detail::trim_right;
namespace fs = std::filesystem;

constexpr int deepest_include = 250;  // the walk is recursive: limits the stack
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// The text of the file or of its overlay.
Result<std::unique_ptr<Source>> open_source(const std::string& path, const Limits& limits,
                                            const ReadOptions& options) {
  if (options.overlay != nullptr)
    if (const auto it = options.overlay->find(path); it != options.overlay->end())
      return Source::unpack(Source::from_bytes(path, it->second), limits);
  return Source::open_text(path, limits);
}

/// Official solver builds also accept "# RADIOSS" (listing of a public deck).
bool is_banner(std::string_view line) {
  return line.starts_with('#') && trim(line.substr(1)).starts_with("RADIOSS");
}

class Reader {
 public:
  Reader(const SchemaSet& schemas, const ReadOptions& options)
      : schemas_(schemas), options_(options), deck_() {
    deck_.findings = Findings(options.limits.findings_per_rule);
  }

  Result<Deck> read(std::unique_ptr<Source> main) {
    if (auto bad = detail::refuse_empty(*main); !bad) return bad.error();
    if (auto bad = detail::refuse_binary(*main); !bad) return bad.error();
    deck_.total_bytes = main->bytes().size();
    if (main->packed()) unpacked_bytes_ = main->bytes().size();
    main_directory_ = directory_of(main->path());
    deck_.sources.add(std::move(main));
    check_banner();
    stack_.push_back(0);
    scan(0, newest_version);
    detail::note_lint_markers(deck_, 0);
    stack_.pop_back();
    if (!submodel_stack_.empty()) notes_.unclosed_submodel = submodel_stack_.back();
    detail::complete_deck(deck_, notes_, options_);
    if (deck_.begin.version_unread) forget_all();
    return std::move(deck_);
  }

 private:
  /// For an unreadable version only this finding is reported.
  void forget_all() {
    deck_.blocks.clear();
    Findings only(options_.limits.findings_per_rule);
    for (const Finding& d : deck_.findings.all())
      if (d.rule == RuleId::DK050) only.report(d);
    deck_.findings = std::move(only);
  }

  void report(RuleId rule, Span span, std::string message, Overrides overrides = {}) {
    detail::report(deck_, rule, span, std::move(message), std::move(overrides));
  }

  void check_banner() {
    const std::string_view bytes = deck_.sources[0].bytes();
    const bool mark = check_byte_order_mark(0);
    const std::string_view start = bytes.substr(0, 1 << 16);
    const auto end = std::min(start.find('\n'), start.size());
    const std::string_view first = bytes.substr(0, std::min<std::size_t>(end, header_columns));
    if (const auto cr = start.find('\r'); cr < end && end == start.size() && cr + 1 < end)
      report(RuleId::DK057, make_span(0, cr, cr + 1),
             "the lines end with carriage returns without line feeds");
    if (mark && trim(first.substr(3)).starts_with("#RADIOSS STARTER"))
      report(RuleId::DK001, make_span(0, 0, end),
             "the first line is '#RADIOSS STARTER' after a UTF-8 byte order mark (bytes EF BB BF, "
             "which editors do not show)",
             {.solver = "Official builds stop: the line does not begin with the banner.",
              .fix = "remove the mark: save the file as UTF-8 without BOM"});
    else if (!is_banner(trim(first)))
      report(RuleId::DK001, make_span(0, 0, end), "the first line is not '#RADIOSS STARTER'",
             {.fix = "Put '#RADIOSS STARTER' in the first line."});
  }

  /// True if the file starts with a byte order mark, which hides its first line.
  bool check_byte_order_mark(std::uint32_t file) {
    if (!deck_.sources[file].bytes().starts_with(byte_order_mark)) return false;
    report(
        RuleId::DK033, make_span(file, 0, byte_order_mark.size()),
        "the file starts with a UTF-8 byte order mark",
        {.solver = file == 0
                       ? "It takes the three bytes as the start of the first line, so it does not "
                         "find the banner."
                       : "It takes the three bytes as the start of the first line: it ignores a "
                         "keyword there and its block."});
    return true;
  }

  // ---- include tree -------------------------------------------------------------------------

  static fs::path directory_of(const std::string& path) {
    return path == "-" ? fs::path() : fs::path(path).parent_path();
  }

  /// Folders searched for a relative path.
  std::vector<std::string> directories(std::uint32_t parent) const {
    std::vector<std::string> all = {directory_of(deck_.sources[parent].path()).string(),
                                    main_directory_.string()};
    all.insert(all.end(), options_.include_paths.begin(), options_.include_paths.end());
    return all;
  }

  void include(std::string written, Span directive, std::uint32_t parent, int version) {
    const bool backslash = written.find('\\') != std::string::npos;
    std::replace(written.begin(), written.end(), '\\', '/');
    if (written.size() > longest_path) {
      report(RuleId::DK004, directive,
             "#include with a file name of " + std::to_string(written.size()) +
                 " characters was not read",
             {.solver = "it stops with an error", .fix = "shorten the path"});
      return;
    }
    if (written.empty()) {
      report(RuleId::DK004, directive, "#include without a file name",
             {.solver = "it stops with an error", .fix = "name the file or remove the line"});
      return;
    }
    const int depth = std::min(options_.limits.include_depth, deepest_include);
    if (static_cast<int>(stack_.size()) > depth) {
      report(RuleId::DK006, directive,
             "includes are nested deeper than " + std::to_string(depth) + " levels; '" + written +
                 "' was not read");
      return;
    }
    if (static_cast<int>(deck_.sources.size()) >= options_.limits.files) {
      report(RuleId::DK006, directive,
             "more than " + std::to_string(options_.limits.files) + " files; '" + written +
                 "' was not read",
             {.fix = "check the deck for an include that multiplies itself"});
      return;
    }
    std::string tried;
    Limits limits = options_.limits;
    // Files can be included many times: above a limit they are mapped instead of read, to save
    // memory.
    if (memory_bytes_ > 8 * limits.map_threshold) limits.map_threshold = 0;
    limits.unpacked_bytes -= std::min(limits.unpacked_bytes, unpacked_bytes_);
    detail::IncludeCandidates places(written, directories(parent));
    while (const std::string* path = places.next()) {
      auto source = open_source(*path, limits, options_);
      if (source)
        if (auto bad = detail::refuse_binary(**source); !bad) source = bad.error();
      if (!source) {
        tried += (tried.empty() ? "" : "; ") + source.error().message;
        continue;
      }
      if ((*source)->packed())
        check_packed(**source, written, directive);
      else if ((*source)->bytes().size() <= limits.map_threshold)
        memory_bytes_ += (*source)->bytes().size();
      if (backslash)
        report(RuleId::DK058, directive, "the path holds '\\'; '" + written + "' was read");
      enter(std::move(*source), std::move(written), directive, parent, version);
      return;
    }
    constexpr int most_hints = 20;  // each hint reads folders
    const std::string hint = ++hints_ > most_hints
                                 ? std::string()
                                 : detail::include_hint(written, backslash, places.all());
    report(RuleId::DK004, directive,
           "included file '" + written + "' cannot be read; tried " + tried,
           {.solver =
                "it stops with an error that does not name the file (\"error 760\" in some builds)",
            .fix = hint.empty()
                       ? "correct the path, or name the folder that holds it with --include-path"
                       : hint});
  }

  /// In a packed deck, packed includes are normal.
  void check_packed(const Source& source, const std::string& written, Span directive) {
    unpacked_bytes_ += source.bytes().size();
    if (deck_.sources[0].packed() || has_gz_name(deck_.sources[0].path())) return;
    const bool other_name = has_gz_name(source.path()) && !has_gz_name(written);
    report(
        RuleId::DK378, directive,
        other_name ? "'" + written + "' is not there; '" + source.path() +
                         "', packed with gzip, was read instead"
                   : "the included file '" + written + "' is packed with gzip; it was unpacked",
        {.solver = other_name ? "Not known. It would not find the file."
                              : "Not known. It would take the packed bytes as lines of the deck.",
         .fix = "unpack the file before a run (gunzip " + source.path() + ")" +
                (other_name ? "" : " and name it without .gz")});
  }

  void enter(std::unique_ptr<Source> source, std::string written, Span directive,
             std::uint32_t parent, int version) {
    for (const std::uint32_t open : stack_) {
      const Source& s = deck_.sources[open];
      const bool same_file =
          s.inode() != 0 && s.inode() == source->inode() && s.device() == source->device();
      if (!same_file && !(s.inode() == 0 && s.path() == source->path())) continue;
      report(RuleId::DK005, directive,
             "include cycle: '" + written + "' is being read already (" + s.path() + ")");
      return;
    }
    deck_.total_bytes += source->bytes().size();
    if (deck_.total_bytes > options_.limits.total_bytes) {
      report(RuleId::DK006, directive,
             "all files together are larger than the limit of " +
                 std::to_string(options_.limits.total_bytes) + " bytes",
             {.fix = "check the deck for an include that multiplies itself"});
      return;
    }
    const std::uint32_t file = deck_.sources.add(std::move(source));
    deck_.includes.push_back({file, parent, directive, std::move(written)});
    stack_.push_back(file);
    scan(file, version);
    detail::note_lint_markers(deck_, file);
    stack_.pop_back();
  }

  // ---- lines --------------------------------------------------------------------------------

  /// Adds the lines [begin, end) to the open block.
  void append_lines(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
    if (begin >= end) return;
    if (open_block_ < 0) {
      report_stray(file, begin, end);
      return;
    }
    auto& body = deck_.blocks[static_cast<std::size_t>(open_block_)].body;
    if (!body.empty() && body.back().file == file && body.back().end == begin)
      body.back().end = end;
    else
      body.push_back({file, begin, end});
  }

  /// First line of [begin, end) that is neither blank nor a comment; empty span if there is none.
  Span first_text(std::uint32_t file, std::uint64_t begin, std::uint64_t end) const {
    const std::string_view bytes = deck_.sources[file].bytes().substr(0, end);
    for (std::uint64_t at = begin; at < end;) {
      const std::uint64_t nl = std::min<std::uint64_t>(bytes.find('\n', at), end);
      const std::string_view line = bytes.substr(at, nl - at);
      const bool comment = line.starts_with('#') || line.starts_with('$');
      if (!comment && !std::all_of(line.begin(), line.end(), is_blank))
        return make_span(file, at, nl);
      at = nl + 1;
    }
    return {};
  }

  void report_stray(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
    const Span text = first_text(file, begin, end);
    if (!text.valid() || (begin == 0 && file == 0 && text.offset == 0 &&
                          deck_.sources[0].bytes().starts_with(byte_order_mark)))
      return;
    report(RuleId::DK055, text, "this text belongs to no keyword and is ignored");
  }

  /// Position of the next line in [pos, size) that is a header or starts with '#'; `size`: none.
  /// Bulk data has neither '/' nor '#', so most lines are skipped. Notes lint comments.
  std::uint64_t next_candidate(std::uint32_t file, std::uint64_t pos) {
    const std::string_view bytes = deck_.sources[file].bytes();
    const char* const data = bytes.data();
    const std::uint64_t size = bytes.size();
    constexpr std::uint64_t window = 32 * 1024;
    while (pos < size) {
      detail::note_lint_markers(deck_, file, pos);
      const std::uint64_t length = std::min(window, size - pos);
      const void* const slash = std::memchr(data + pos, '/', length);
      const std::uint64_t until =
          slash == nullptr
              ? length
              : static_cast<std::uint64_t>(static_cast<const char*>(slash) - data) - pos;
      const void* const hash = until == 0 ? nullptr : std::memchr(data + pos, '#', until);
      if (slash == nullptr && hash == nullptr) {
        pos += length;
        continue;
      }
      const std::uint64_t hit =
          hash != nullptr ? static_cast<std::uint64_t>(static_cast<const char*>(hash) - data)
                          : pos + until;
      // Only its first non-blank character makes a line special.
      std::uint64_t first = hit;
      while (first > 0 && (data[first - 1] == ' ' || data[first - 1] == '\t')) --first;
      const bool line_start = first == 0 || data[first - 1] == '\n';
      if (line_start && (data[hit] == '/' || first == hit)) return first;
      const void* const nl = std::memchr(data + hit, '\n', size - hit);
      if (nl == nullptr) return size;
      pos = static_cast<std::uint64_t>(static_cast<const char*>(nl) - data) + 1;
    }
    detail::note_lint_markers(deck_, file, size);
    return size;
  }

  void scan(std::uint32_t file, int version) {
    const std::string_view bytes = deck_.sources[file].bytes();
    const std::uint64_t size = bytes.size();
    const bool is_main = file == 0;
    if (!is_main) check_byte_order_mark(file);
    // Lines of an include before its first keyword belong to no block.
    const std::size_t outer_blocks = deck_.blocks.size();
    const auto keep_lines = [&](std::uint64_t begin, std::uint64_t end) {
      if (is_main || deck_.blocks.size() > outer_blocks)
        append_lines(file, begin, end);
      else
        report_headless(file, begin, end);
    };
    std::uint64_t run = 0;
    for (std::uint64_t pos = 0; (pos = next_candidate(file, pos)) < size;) {
      const std::uint64_t end = std::min<std::uint64_t>(bytes.find('\n', pos), size);
      const std::uint64_t next = std::min(end + 1, size);
      if (bytes[pos] == '#') {
        const std::string_view line = bytes.substr(pos, end - pos);
        if (detail::is_include(line)) {
          keep_lines(run, pos);
          const std::uint64_t directive = pos;
          std::string path = detail::include_path(bytes, pos);
          include(std::move(path), make_span(file, directive, end), file,
                  in_submodel_without_begin() ? deck_.version : version);
          run = pos;
          continue;
        }
        if (!is_main && starts_with_nocase(line, "#enddata")) {
          keep_lines(run, pos);
          return;
        }
        pos = next;
        continue;
      }
      keep_lines(run, pos);
      run = next;
      const auto slash = bytes.find('/', pos);
      const std::string_view line =
          trim_right(bytes.substr(slash, std::min<std::uint64_t>(end - slash, header_columns)));
      const std::string_view header = detail::without_note(line);
      detail::check_header_line(deck_, {file, pos, slash, end}, header);
      pos = next;
      if (line == "/END") {  // with text after it, it is another keyword
        open_block_ = -1;
        if (is_main) deck_.end_seen = true;
        check_tail(file, next);
        return;
      }
      if (!open(file, header, slash, next, version)) return;
    }
    keep_lines(run, size);
  }

  /// True for a line of numbers, which may be a card.
  static bool is_data(std::string_view line) {
    bool any = false;
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r,", at)) != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t\r,", at), line.size());
      const NumberStatus status = read_real(line.substr(at, end - at)).status;
      if (status != NumberStatus::ok && status != NumberStatus::implicit_exponent) return false;
      any = true;
      at = end;
    }
    return any;
  }

  /// Reports lines of an include before its first keyword.
  void report_headless(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
    const Span text = first_text(file, begin, end);
    if (!text.valid()) return;
    const std::string_view bytes = deck_.sources[file].bytes();
    std::uint64_t lines = 0;
    bool data = false;
    for (Span at = text; at.valid(); at = first_text(file, at.offset + at.length, end), ++lines)
      data = data || is_data(bytes.substr(at.offset, at.length));
    const bool keyword_behind_mark = text.offset == 0 && bytes.starts_with(byte_order_mark) &&
                                     trim(bytes.substr(byte_order_mark.size(), 1)).starts_with('/');
    std::string message =
        count(lines, "line of this included file precedes its first keyword and is ignored",
              "lines of this included file precede its first keyword and are ignored");
    if (open_block_ >= 0 && !keyword_behind_mark)
      message += (lines == 1 ? ": it does not continue " : ": they do not continue ") +
                 std::string(deck_.blocks[static_cast<std::size_t>(open_block_)].header) +
                 " of the including file";
    if (keyword_behind_mark) message += ": a byte order mark hides the keyword of the first line";
    if (!data && !keyword_behind_mark) {
      report(RuleId::DK051, text, std::move(message),
             {.severity = Severity::info,
              .fix = "Nothing to do if the lines are remarks; better make them comments."});
      return;
    }
    report(RuleId::DK051, text, std::move(message),
           {.fix = keyword_behind_mark
                       ? "save the file without byte order mark"
                       : "repeat the keyword line (and title) at the top of the included file"});
  }

  bool in_submodel_without_begin() const {
    return !submodel_stack_.empty() && begun_.count(submodel_stack_.back()) == 0;
  }

  void check_tail(std::uint32_t file, std::uint64_t from) {
    const Span text = first_text(file, from, deck_.sources[file].bytes().size());
    if (!text.valid()) return;
    report(
        RuleId::DK011, text,
        file == 0 ? "text after /END in the main file is ignored"
                  : "text after /END in an included file is ignored",
        {.solver = file == 0 ? "It stops reading at /END." : "It ignores the rest of this file."});
  }

  // ---- headers ------------------------------------------------------------------------------

  /// Opens a block. False: the limit on blocks is reached and reading stops.
  bool open(std::uint32_t file, std::string_view header, std::uint64_t offset, std::uint64_t next,
            int& version) {
    if (deck_.blocks.size() >= options_.limits.blocks) {
      if (open_block_ >= 0)
        report(RuleId::DK006, make_span(file, offset, offset + header.size()),
               "more than " + std::to_string(options_.limits.blocks) +
                   " keywords; the rest is not read",
               {.fix = "check the deck for an include that multiplies itself"});
      open_block_ = -1;
      return false;
    }
    Block block;
    block.header = header;
    block.header_span = make_span(file, offset, offset + header.size());
    block.version = version;
    if (!submodel_stack_.empty()) block.submodel = submodel_stack_.back();
    if (header == "/BEGIN" || header.starts_with("/BEGIN/")) {
      read_begin(block.header_span, next, version);
      block.version = version;
    } else if (header.starts_with("//SUBMODEL")) {
      open_submodel(block.header_span, version);
    } else if (header.starts_with("//ENDSUB")) {
      close_submodel(block.header_span, version);
    }
    if (notes_.begin_count == 0 && !header.starts_with("/PARAMETER"))
      notes_.before_begin.push_back(deck_.blocks.size());
    detail::parse_header(schemas_, block);
    if (header.starts_with("/INCLUDE")) refuse_include(block, next);
    deck_.blocks.push_back(std::move(block));
    open_block_ = static_cast<std::int64_t>(deck_.blocks.size()) - 1;
    return true;
  }

  /// Reports a keyword that includes a file: of another solver, or a misspelt directive.
  void refuse_include(Block& block, std::uint64_t next) {
    block.schema = schemas_.find("/INCLUDE_LS-DYNA");
    const auto file = block.header_span.file;
    const Span below = first_text(file, next, deck_.sources[file].bytes().size());
    const bool foreign = block.header.starts_with("/INCLUDE_");
    std::string name(trim(block.header.substr(std::string_view("/INCLUDE").size())));
    std::erase_if(name, [](char c) { return c == '"' || c == '\''; });
    if (name.empty()) name = deck_.sources.text(below);
    report(RuleId::DK004, foreign && below.valid() ? below : block.header_span,
           foreign ? "the file of " + std::string(block.header) +
                         " is not read: it is of another solver"
                   : "/INCLUDE is no keyword: the file is not read",
           {.severity = Severity::warning,
            .message = 0,
            .solver = foreign ? "It reads the file, and is silent where there is none"
                              : "It ignores the line",
            .fix = foreign ? "convert it to a Radioss deck, and include that"
                           : "write #include " + name});
  }

  void open_submodel(Span header, int version) {
    Submodel sub;
    sub.parent = submodel_stack_.empty() ? -1 : submodel_stack_.back();
    sub.span = header;
    deck_.submodels.push_back(std::move(sub));
    submodel_stack_.push_back(static_cast<std::int32_t>(deck_.submodels.size()) - 1);
    notes_.submodel_blocks.push_back(deck_.blocks.size());
    outer_versions_.push_back(version);
  }

  void close_submodel(Span header, int& version) {
    if (submodel_stack_.empty()) {
      report(RuleId::DK035, header, "//ENDSUB without //SUBMODEL",
             {.solver = "the line is an unknown keyword for it", .fix = "remove the line"});
      return;
    }
    // A /BEGIN inside of the submodel sets the version of its lines only.
    version = outer_versions_.back();
    submodel_stack_.pop_back();
    outer_versions_.pop_back();
  }

  /// Reads the four lines of /BEGIN at once: all other blocks depend on them.
  void read_begin(Span header, std::uint64_t pos, int& version) {
    ++notes_.begin_count;
    Begin begin = detail::read_begin(deck_, header, pos);
    version = begin.version_known ? begin.version_written : newest_version;
    const bool unread = begin.version_unread || deck_.begin.version_unread;
    if (notes_.begin_count == 1) {
      deck_.begin = std::move(begin);
      deck_.version = version;
    } else if (!submodel_stack_.empty()) {
      begun_.insert(submodel_stack_.back());
      // A single unit system is used for both.
      if (begin.has_input || begin.has_working)
        deck_.submodels[static_cast<std::size_t>(submodel_stack_.back())].units =
            begin.has_input ? begin.input : begin.working;
    } else if (header.file == 0) {
      report(RuleId::DK043, header, "a second /BEGIN in the main file");
    } else {
      const Begin& main = deck_.begin;
      const UnitSystem& counts = main.has_input ? main.input : main.working;
      const UnitSystem& here = begin.has_input ? begin.input : begin.working;
      if ((begin.has_input || begin.has_working) && !(here == counts))
        report(RuleId::DK043, header,
               "the units of /BEGIN in an included file (" + here.mass_code + " " +
                   here.length_code + " " + here.time_code + ") differ from those of the deck (" +
                   counts.mass_code + " " + counts.length_code + " " + counts.time_code +
                   "), which are used for its values",
               {.solver = "it uses the units of such a /BEGIN only inside a submodel",
                .fix = "put the #include between //SUBMODEL and //ENDSUB, give the blocks of the "
                       "file a /UNIT, or convert it"});
    }
    deck_.begin.version_unread = unread;
  }

  const SchemaSet& schemas_;
  const ReadOptions& options_;
  Deck deck_;
  fs::path main_directory_;
  std::vector<std::uint32_t> stack_;  // files being read, outermost first
  std::vector<std::int32_t> submodel_stack_;
  std::set<std::int32_t> begun_;     // submodels with a /BEGIN of their own
  std::vector<int> outer_versions_;  // versions outside of the open submodels
  detail::ReaderNotes notes_;
  int hints_ = 0;                     // number of wrong paths searched for hints
  std::uint64_t memory_bytes_ = 0;    // of included files that are not mapped
  std::uint64_t unpacked_bytes_ = 0;  // text of packed files
  std::int64_t open_block_ = -1;
};

}  // namespace

Result<Deck> read_deck(const std::string& path, const SchemaSet& schemas,
                       const ReadOptions& options) {
  auto source = open_source(path, options.limits, options);
  if (!source) return source.error();
  return Reader(schemas, options).read(std::move(*source));
}

Result<Deck> read_deck_text(std::string name, std::string text, const SchemaSet& schemas,
                            const ReadOptions& options) {
  return Reader(schemas, options).read(Source::from_bytes(std::move(name), std::move(text)));
}

}  // namespace deck
