// Splits an LS-DYNA file into keywords, cards and cells, fixed or with commas.
#include "edit/lsdyna/read.hpp"

#include <algorithm>
#include <array>

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
constexpr CardLayout optional_cards[] = {
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

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  DynaFile run() {
    collect_parameters();
    for (TextLine line = next(); line.number != 0; line = next()) {
      if (!line.text.starts_with('*')) continue;
      std::string keyword = keyword_of(line.text);
      if (keyword == "*END") break;
      if (keyword == "*KEYWORD") {
        const std::string all = upper(line.text);
        all_long_ = all.find("LONG=Y") != std::string::npos;
      } else if (keyword.starts_with("*INCLUDE")) {
        note("*INCLUDE is not followed: convert the included files one by one");
      } else if (keyword == "*CONTROL_CONTACT") {
        note("*CONTROL_CONTACT was not read: its defaults for blank cells are not carried");
      } else if (keyword.starts_with("*CONTACT_")) {
        contact(std::move(keyword), line);
      }
    }
    return std::move(out_);
  }

 private:
  void note(const char* text) {
    if (std::find(out_.notes.begin(), out_.notes.end(), text) == out_.notes.end())
      out_.notes.emplace_back(text);
  }

  /// Next line that is no comment; number 0 at the end.
  TextLine next() {
    while (at_ < text_.size()) {
      const auto nl = std::min(text_.find('\n', at_), text_.size());
      const std::string_view line = trim_right(text_.substr(at_, nl - at_));
      at_ = nl + 1;
      ++number_;
      if (!line.starts_with('$')) return {line, number_};
    }
    return {};
  }
  /// Next data line of the open keyword; number 0 where the next keyword begins.
  TextLine next_data() {
    const std::size_t at = at_;
    const std::uint64_t number = number_;
    const TextLine line = next();
    if (line.number == 0 || !line.text.starts_with('*')) return line;
    at_ = at;
    number_ = number;
    return {};
  }

  /// The keyword in capitals without the format mark; sets the width of its cells.
  std::string keyword_of(std::string_view line) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    std::string keyword = upper(line.substr(0, end));
    std::string_view rest = trim(line.substr(end));
    width_ = all_long_ ? 20 : 10;
    if (keyword.ends_with('+') || rest.starts_with('+')) width_ = 20;
    if (keyword.ends_with('-') || rest.starts_with('-')) width_ = 10;
    while (keyword.ends_with('+') || keyword.ends_with('-')) keyword.pop_back();
    return keyword;
  }

  /// *PARAMETER: name and value in turn; the first letter of the name is its type.
  void collect_parameters() {
    bool open = false;
    for (TextLine line = next(); line.number != 0; line = next()) {
      if (line.text.starts_with('*')) {
        const std::string keyword = keyword_of(line.text);
        open = keyword == "*PARAMETER" || keyword == "*PARAMETER_GLOBAL" ||
               keyword == "*PARAMETER_LOCAL";
        if (keyword == "*END") break;
        continue;
      }
      if (!open) continue;
      const auto cells = split(line.text, width_, 8);
      for (std::size_t i = 0; i + 1 < cells.size(); i += 2) {
        std::string_view name = cells[i];
        if (name.empty()) continue;
        name.remove_prefix(1);
        parameters_.emplace(upper(trim(name)), cells[i + 1]);
      }
    }
    at_ = 0;
    number_ = 0;
  }

  void add_cell(DynaContact& c, const CellLayout& layout, std::string_view text,
                std::uint64_t line) {
    if (layout.name.empty() && (text.empty() || text == "&")) return;
    DynaCell cell;
    cell.name = layout.name.empty() ? std::string_view("(unused columns)") : layout.name;
    cell.fallback = layout.fallback;
    cell.line = line;
    cell.written = std::string(text.substr(0, 100));
    std::string_view name = text;
    const bool minus = name.starts_with("-&");
    if (minus) name.remove_prefix(1);
    if (name.starts_with('&')) {
      const auto it = parameters_.find(upper(name.substr(1)));
      cell.unknown_parameter = it == parameters_.end();
      if (!cell.unknown_parameter) {
        const bool negative = it->second.starts_with('-');
        cell.text = std::string(it->second.substr(minus && negative ? 1 : 0));
        if (minus && !negative) cell.text.insert(0, 1, '-');
      }
    } else {
      cell.text = cell.written;
    }
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
    for (const CardLayout& layout : optional_cards) {
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

  std::string_view text_;
  std::size_t at_ = 0, width_ = 10;
  std::uint64_t number_ = 0;
  bool all_long_ = false;
  std::map<std::string, std::string_view, std::less<>> parameters_;
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

DynaFile read_dyna(std::string_view text) { return Reader(text).run(); }

}  // namespace deck::detail
