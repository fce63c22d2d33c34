// Splits an LS-DYNA file into keywords, cards and cells, fixed or with commas.
#include "edit/lsdyna/read.hpp"

#include <algorithm>
#include <array>

#include "deck/base/limits.hpp"
#include "deck/text/number.hpp"
#include "keyword/reader.hpp"

namespace deck::detail {
namespace {

struct CellLayout {
  std::string_view name, fallback;
};
using CardLayout = std::array<CellLayout, 8>;

constexpr CardLayout mpp1{{{"MPP IGNORE", "0"},
                           {"BCKT", "200"},
                           {"LCBCKT", "0"},
                           {"NS2TRK", "3"},
                           {"INITITR", "2"},
                           {"PARMAX", "1.0005"},
                           {"", ""},
                           {"MPP CPARM8", "0"}}};
constexpr CardLayout mpp2{{{"", ""},
                           {"CHKSEGS", "0"},
                           {"PENSF", "1.0"},
                           {"GRPABLE", "0"},
                           {"", ""},
                           {"", ""},
                           {"", ""},
                           {"", ""}}};
constexpr CardLayout mandatory[3] = {{{{"SSID", ""},
                                       {"MSID", ""},
                                       {"SSTYP", "0"},
                                       {"MSTYP", "0"},
                                       {"SBOXID", "0"},
                                       {"MBOXID", "0"},
                                       {"SPR", "0"},
                                       {"MPR", "0"}}},
                                     {{{"FS", "0"},
                                       {"FD", "0"},
                                       {"DC", "0"},
                                       {"VC", "0"},
                                       {"VDC", "0"},
                                       {"PENCHK", "0"},
                                       {"BT", "0"},
                                       {"DT", "1e20"}}},
                                     {{{"SFS", "1"},
                                       {"SFM", "1"},
                                       {"SST", "0"},
                                       {"MST", "0"},
                                       {"SFST", "1"},
                                       {"SFMT", "1"},
                                       {"FSF", "1"},
                                       {"VSF", "1"}}}};
constexpr CardLayout optional_layouts[] = {
    {{{"SOFT", "0"},
      {"SOFSCL", "0.1"},
      {"LCIDAB", "0"},
      {"MAXPAR", "1.025"},
      {"SBOPT", "2"},
      {"DEPTH", "2"},
      {"BSORT", "0"},
      {"FRCFRQ", "1"}}},
    {{{"PENMAX", "0"},
      {"THKOPT", "0"},
      {"SHLTHK", "0"},
      {"SNLOG", "0"},
      {"ISYM", "0"},
      {"I2D3D", "0"},
      {"SLDTHK", "0"},
      {"SLDSTF", "0"}}},
    {{{"IGAP", "1"},
      {"IGNORE", "0"},
      {"DPRFAC", "0"},
      {"DTSTIF", "0"},
      {"EDGEK", "0"},
      {"", ""},
      {"FLANGL", "0"},
      {"CID_RCF", "0"}}},
    {{{"Q2TRI", "0"},
      {"DTPCHK", "0"},
      {"SFNBR", "0"},
      {"FNLSCL", "0"},
      {"DNLSCL", "0"},
      {"TCSO", "0"},
      {"TIEDID", "0"},
      {"SHLEDG", "0"}}},
    {{{"SHAREC", "0"},
      {"CPARM8", "0"},
      {"IPBACK", "0"},
      {"SRNDE", "0"},
      {"FRICSF", "1"},
      {"ICOR", "0"},
      {"FTORQ", "0"},
      {"REGION", "0"}}},
    {{{"PSTIFF", "0"},
      {"IGNROFF", "0"},
      {"", ""},
      {"FSTOL", "2"},
      {"2DBINR", "0"},
      {"SSFTYP", "0"},
      {"SWTPR", "0"},
      {"TETFAC", "0"}}},
    {{{"", ""}, {"SHLOFF", "0"}, {"", ""}, {"", ""}, {"", ""}, {"", ""}, {"", ""}, {"", ""}}}};

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return out;
}

/// Cuts known options off the end of a keyword.
std::string_view strip_options(std::string_view keyword, std::vector<std::string>& options) {
  // The longer ones first: BEAM_OFFSET ends with OFFSET.
  constexpr std::string_view known[] = {"CONSTRAINED_OFFSET",
                                        "BEAM_OFFSET",
                                        "OFFSET",
                                        "ID",
                                        "TITLE",
                                        "MPP",
                                        "SMOOTH",
                                        "MORTAR",
                                        "INTERIOR"};
  for (bool again = true; again;) {
    again = false;
    for (const std::string_view option : known) {
      if (keyword.size() <= option.size() + 1 || !keyword.ends_with(option) ||
          keyword[keyword.size() - option.size() - 1] != '_')
        continue;
      options.emplace_back(option);
      keyword.remove_suffix(option.size() + 1);
      again = true;
      break;
    }
  }
  return keyword;
}

DynaKind kind_of(std::string_view keyword) {
  constexpr std::pair<std::string_view, DynaKind> kinds[] = {
      {"*CONTACT_AUTOMATIC_SINGLE_SURFACE", DynaKind::single_surface},
      {"*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", DynaKind::surface_to_surface},
      {"*CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", DynaKind::one_way},
      {"*CONTACT_AUTOMATIC_NODES_TO_SURFACE", DynaKind::nodes_to_surface},
      {"*CONTACT_AUTOMATIC_GENERAL", DynaKind::general},
      {"*CONTACT_TIED_NODES_TO_SURFACE", DynaKind::tied_nodes},
      {"*CONTACT_TIED_SURFACE_TO_SURFACE", DynaKind::tied_surface},
      {"*CONTACT_TIED_SHELL_EDGE_TO_SURFACE", DynaKind::tied_edge}};
  for (const auto& [name, kind] : kinds)
    if (name == keyword) return kind;
  return DynaKind::other;
}

struct TextLine {
  std::string_view text;
  std::uint64_t number = 0;
};

/// Cells of a data line: by commas if it has any, else by columns.
std::vector<std::string_view> split(std::string_view line, std::size_t width, std::size_t most) {
  std::vector<std::string_view> cells;
  if (line.find(',') != std::string_view::npos) {
    while (cells.size() < most) {
      const auto comma = std::min(line.find(','), line.size());
      cells.push_back(trim(line.substr(0, comma)));
      if (comma == line.size()) break;
      line.remove_prefix(comma + 1);
    }
    return cells;
  }
  for (std::size_t at = 0; at < line.size() && cells.size() < most; at += width)
    cells.push_back(trim(line.substr(at, width)));
  return cells;
}

/// One file of the include tree, and how far it is read.
struct Frame {
  LsDynaFile file;
  std::size_t parent = 0;  ///< place of the file that includes it; its own: the main file
  std::size_t at = 0;
  std::uint64_t number = 0;
  bool all_long = false;  ///< *KEYWORD LONG=Y
};

class Reader {
 public:
  Reader(const LsDynaFile& file, const LsDynaOptions& options) : main_(file), options_(options) {}

  DynaFile run() {
    collect_parameters();
    begin();
    std::string keyword;
    for (TextLine line = next_keyword(keyword); line.number != 0; line = next_keyword(keyword)) {
      DynaSetKeyword set;
      if (keyword == "*CONTROL_CONTACT")
        note("*CONTROL_CONTACT was not read: its defaults for blank cells are not carried");
      else if (keyword.starts_with("*CONTACT_"))
        contact(std::move(keyword), line);
      else if (read_set_keyword(keyword, set))
        read_set(set);
      else if (keyword == "*PART")
        read_parts();
      else if (keyword.starts_with("*PART_"))
        out_.sets.all_parts_known = false;
    }
    return std::move(out_);
  }

 private:
  void note(std::string text) {
    if (std::find(out_.notes.begin(), out_.notes.end(), text) == out_.notes.end())
      out_.notes.push_back(std::move(text));
  }

  void not_followed(std::string text) {
    out_.sets.all_parts_known = false;
    note(std::move(text));
  }

  // ---- lines of the include tree --------------------------------------------------------------

  void begin() {
    frames_.assign(1, {main_});
    includes_ = 0;
  }

  /// Next line of the file at work that is no comment; number 0 at its end.
  TextLine next() {
    Frame& f = frames_.back();
    while (f.at < f.file.text.size()) {
      const auto nl = std::min(f.file.text.find('\n', f.at), f.file.text.size());
      const std::string_view line = trim_right(f.file.text.substr(f.at, nl - f.at));
      f.at = nl + 1;
      ++f.number;
      if (!line.starts_with('$')) return {line, f.number};
    }
    return {};
  }
  /// Next data line of the open keyword; number 0 where the next keyword begins, or the file ends.
  TextLine next_data() {
    const Frame before = frames_.back();
    const TextLine line = next();
    if (line.number == 0 || !line.text.starts_with('*')) return line;
    frames_.back() = before;
    return {};
  }
  /// Next keyword of the tree, in capitals without its format mark; number 0 at the end.
  TextLine next_keyword(std::string& keyword) {
    while (!frames_.empty()) {
      const TextLine line = next();
      if (line.number == 0) {
        frames_.pop_back();
        continue;
      }
      if (!line.text.starts_with('*')) continue;
      keyword = keyword_of(line.text);
      if (keyword == "*END")
        frames_.pop_back();
      else if (keyword == "*KEYWORD")
        frames_.back().all_long = upper(line.text).find("LONG=Y") != std::string::npos;
      else if (keyword == "*INCLUDE")
        include();
      else if (keyword.starts_with("*INCLUDE"))
        not_followed(keyword + " is not followed: convert its files one by one");
      else
        return line;
    }
    return {};
  }

  /// File names, one on a line; " +" at the end of a line continues the name.
  void include() {
    std::vector<std::pair<std::string, std::uint64_t>> names;
    bool open = false;
    for (TextLine line = next_data(); line.number != 0; line = next_data()) {
      std::string_view text = trim(line.text);
      const bool more = text.ends_with(" +");
      if (more) text.remove_suffix(2);
      if (open)
        names.back().first += std::string(text);
      else if (!text.empty())
        names.emplace_back(std::string(text), line.number);
      open = more && !names.empty();
    }
    // What was pushed last is read first.
    const std::size_t parent = frames_.size() - 1;
    for (auto name = names.rbegin(); name != names.rend(); ++name) open_file(*name, parent);
  }
  void open_file(const std::pair<std::string, std::uint64_t>& name, std::size_t parent) {
    if (!options_.include)
      return not_followed("*INCLUDE is not followed: convert the included files one by one");
    const Frame from = frames_[parent];
    const auto miss = [&](std::string why) {
      out_.sets.all_parts_known = false;
      if (complete_) return;  // said when parameters were collected
      out_.missing.push_back(
          {std::string(from.file.path), name.second, name.first.substr(0, 200), std::move(why)});
    };
    const auto file = options_.include(name.first, from.file.path);
    if (!file) return miss(file.error().message);
    int depth = 1;
    bool again = false;
    for (std::size_t at = parent;; at = frames_[at].parent, ++depth) {
      again = again || frames_[at].file.path == file->path;
      if (frames_[at].parent == at) break;
    }
    constexpr Limits limits{};
    if (again) return miss("it includes itself");
    if (depth > limits.include_depth || ++includes_ > limits.files)
      return miss("too many files include one another");
    frames_.push_back({*file, parent, 0, 0, from.all_long});
  }

  /// The keyword in capitals without the format mark; sets the width of its cells.
  std::string keyword_of(std::string_view line) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    std::string keyword = upper(line.substr(0, end));
    std::string_view rest = trim(line.substr(end));
    width_ = frames_.back().all_long ? 20 : 10;
    if (keyword.ends_with('+') || rest.starts_with('+')) width_ = 20;
    if (keyword.ends_with('-') || rest.starts_with('-')) width_ = 10;
    while (keyword.ends_with('+') || keyword.ends_with('-')) keyword.pop_back();
    return keyword;
  }

  // ---- values ---------------------------------------------------------------------------------

  /// *PARAMETER: name and value in turn; the first letter of the name is its type.
  void collect_parameters() {
    begin();
    std::string keyword;
    for (TextLine line = next_keyword(keyword); line.number != 0; line = next_keyword(keyword)) {
      if (keyword != "*PARAMETER" && keyword != "*PARAMETER_GLOBAL" &&
          keyword != "*PARAMETER_LOCAL")
        continue;
      for (TextLine data = next_data(); data.number != 0; data = next_data()) {
        const auto cells = split(data.text, width_, 8);
        for (std::size_t i = 0; i + 1 < cells.size(); i += 2) {
          std::string_view name = cells[i];
          if (name.empty()) continue;
          name.remove_prefix(1);
          parameters_.emplace(upper(trim(name)), cells[i + 1]);
        }
      }
    }
    complete_ = true;
  }

  /// Text of a cell with its parameter replaced; nullopt: there is no such parameter.
  std::optional<std::string> value_of(std::string_view text) const {
    std::string_view name = text;
    const bool minus = name.starts_with("-&");
    if (minus) name.remove_prefix(1);
    if (!name.starts_with('&')) return std::string(text.substr(0, 100));
    const auto it = parameters_.find(upper(name.substr(1)));
    if (it == parameters_.end()) return std::nullopt;
    const bool negative = it->second.starts_with('-');
    std::string out(it->second.substr(minus && negative ? 1 : 0));
    if (minus && !negative) out.insert(0, 1, '-');
    return out;
  }

  /// Ids of a line; blank cells and 0 are none. What is no id goes to `unread`.
  std::vector<std::int64_t> ids_of(std::string_view line, std::size_t most, std::string& unread) {
    std::vector<std::int64_t> out;
    for (const std::string_view text : split(line, width_, most)) {
      const auto value = value_of(text);
      const IntegerCell id = read_integer(value ? *value : std::string("?"));
      if (id.status == NumberStatus::ok && id.value >= 0 && id.value <= 2147483647)
        out.push_back(id.value);
      else if (id.status == NumberStatus::blank)
        out.push_back(0);
      else if (unread.empty())
        unread = "'" + std::string(text.substr(0, 20)) + "' in it is no id";
    }
    return out;
  }

  // ---- sets and parts -------------------------------------------------------------------------

  void read_set(const DynaSetKeyword& keyword) {
    using Form = DynaSetKeyword::Form;
    DynaSet set;
    TextLine line = next_data();
    if (keyword.title && line.number != 0) {
      set.title = std::string(trim(line.text).substr(0, 100));
      line = next_data();
    }
    if (line.number == 0) return;
    const auto first = ids_of(line.text, 1, set.unread);
    const std::int64_t id = first.empty() ? 0 : first[0];
    if (keyword.form == Form::other) set.unread = "this form of *SET is not read";
    for (line = next_data(); line.number != 0 && keyword.form != Form::other; line = next_data()) {
      const std::size_t most = keyword.form == Form::column     ? 1
                               : keyword.form == Form::segments ? 4
                                                                : 8;
      std::vector<std::int64_t> ids = ids_of(line.text, most, set.unread);
      if (keyword.form == Form::segments) {
        ids.resize(4);
        if (ids[0] != 0) set.segments.push_back({ids[0], ids[1], ids[2], ids[3]});
      } else if (keyword.form == Form::generate) {
        for (std::size_t i = 0; i + 1 < ids.size(); i += 2)
          if (ids[i] != 0) set.ranges.emplace_back(ids[i], ids[i + 1]);
      } else {
        std::erase(ids, 0);
        auto& to = keyword.form == Form::add ? set.sets : set.ids;
        to.insert(to.end(), ids.begin(), ids.end());
      }
    }
    if (id > 0) out_.sets.add(keyword.kind, id, std::move(set), keyword.collect);
  }

  /// Heading and card in turn.
  void read_parts() {
    std::string unread;
    for (TextLine title = next_data(); title.number != 0; title = next_data()) {
      const TextLine card = next_data();
      if (card.number == 0) return;
      const auto ids = ids_of(card.text, 1, unread);
      if (!ids.empty() && ids[0] > 0) out_.sets.parts.insert(ids[0]);
    }
  }

  // ---- contacts -------------------------------------------------------------------------------

  void add_cell(DynaContact& c, const CellLayout& layout, std::string_view text,
                std::uint64_t line) {
    if (layout.name.empty() && (text.empty() || text == "&")) return;
    DynaCell cell;
    cell.name = layout.name.empty() ? std::string_view("(unused columns)") : layout.name;
    cell.fallback = layout.fallback;
    cell.line = line;
    cell.written = std::string(text.substr(0, 100));
    const auto value = value_of(text);
    cell.unknown_parameter = !value;
    if (value) cell.text = *value;
    c.cells.push_back(std::move(cell));
  }

  void card(DynaContact& c, const CardLayout& layout, const TextLine& line) {
    const auto cells = split(line.text, width_, 8);
    for (std::size_t i = 0; i < layout.size(); ++i)
      add_cell(c, layout[i], i < cells.size() ? cells[i] : std::string_view(), line.number);
  }

  void id_card(DynaContact& c, const TextLine& line) {
    const auto comma = line.text.find(',');
    const bool free = comma != std::string_view::npos &&
                      read_integer(line.text.substr(0, comma)).status == NumberStatus::ok;
    const std::size_t cut = free ? comma : std::min(width_, line.text.size());
    add_cell(c, {"CID", ""}, trim(line.text.substr(0, cut)), line.number);
    c.heading =
        std::string(trim(line.text.substr(std::min(cut + (free ? 1 : 0), line.text.size()))));
  }

  void contact(std::string keyword, const TextLine& header) {
    DynaContact c;
    c.keyword = std::move(keyword);
    c.file = std::string(frames_.back().file.path);
    c.line = header.number;
    const std::string stripped(strip_options(c.keyword, c.options));
    c.kind = kind_of(stripped);
    if (c.kind == DynaKind::other) {
      out_.contacts.push_back(std::move(c));
      return;
    }
    TextLine line = next_data();
    if ((c.has("ID") || c.has("TITLE")) && line.number != 0) {
      id_card(c, line);
      line = next_data();
    }
    if (c.has("MPP") && line.number != 0) {
      card(c, mpp1, line);
      line = next_data();
      if (const auto cells = split(line.text, width_, 1);
          line.number != 0 && !cells.empty() && cells[0] == "&") {
        card(c, mpp2, line);
        line = next_data();
      }
    }
    for (const CardLayout& layout : mandatory) {
      if (line.number == 0) break;
      card(c, layout, line);
      ++c.mandatory;
      line = next_data();
    }
    for (const CardLayout& layout : optional_layouts) {
      if (line.number == 0) break;
      card(c, layout, line);
      line = next_data();
    }
    for (; line.number != 0; line = next_data()) {
      if (line.text.empty()) continue;
      if (c.extra.empty()) c.extra_line = line.number;
      if (c.extra.size() < 10) c.extra.emplace_back(line.text.substr(0, 100));
    }
    out_.contacts.push_back(std::move(c));
  }

  LsDynaFile main_;
  const LsDynaOptions& options_;
  std::vector<Frame> frames_;  ///< the include tree: the file at work last
  int includes_ = 0;
  std::size_t width_ = 10;
  std::map<std::string, std::string_view, std::less<>> parameters_;
  bool complete_ = false;  ///< parameters are collected
  DynaFile out_;
};

}  // namespace

bool DynaContact::has(std::string_view option) const {
  return std::find(options.begin(), options.end(), option) != options.end();
}

const DynaCell* DynaContact::find(std::string_view name) const {
  for (const DynaCell& cell : cells)
    if (cell.name == name) return &cell;
  return nullptr;
}

DynaFile read_dyna(const LsDynaFile& file, const LsDynaOptions& options) {
  return Reader(file, options).run();
}

}  // namespace deck::detail
