// Decides for every LS-DYNA contact what interface it becomes and which value goes where.
#include "deck/edit/lsdyna.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "deck/text/number.hpp"
#include "edit/lsdyna/cards.hpp"
#include "edit/lsdyna/names.hpp"
#include "edit/lsdyna/read.hpp"
#include "edit/lsdyna/sides.hpp"
#include "keyword/reader.hpp"

namespace deck {
namespace {

using detail::CardValues;
using detail::DynaCell;
using detail::DynaContact;
using detail::DynaKind;

std::string shown(double value) {
  const auto text = format_real(value, 24);
  return text ? text->text : std::string("?");
}

/// Ids that the files of a call share.
struct Ids {
  std::set<std::int64_t> given, written;  ///< of contacts
  std::int64_t free = 1;                  ///< for the next contact without an id
  detail::DynaHelpers::Taken blocks;      ///< of groups, surfaces, lines and sets
  std::int64_t helper = 90000001;         ///< for the next group, surface, line or set
};

class Converter {
 public:
  Converter(std::string_view path, const SchemaSet& schemas, const LsDynaOptions& options, Ids& ids,
            detail::DynaFile& file)
      : path_(path),
        schemas_(schemas),
        options_(options),
        ids_(ids),
        file_(file),
        helpers_(ids.helper, ids.blocks),
        sides_(options.version, file.sets, helpers_) {}

  Rewrite run() {
    for (const detail::DynaMissing& m : file_.missing) missing(m);
    for (const DynaContact& c : file_.contacts) contact(c);
    check_sets();
    out_.notes = file_.notes;
    if (!sides_.outside().empty())
      out_.notes.push_back(
          "sets that are not in these files are named by their ids: they must be sets, surfaces or "
          "groups of the same ids in the Radioss deck");
    if (helpers_.next_id() > ids_.helper)
      out_.notes.push_back("ids " + std::to_string(ids_.helper) + " to " +
                           std::to_string(helpers_.next_id() - 1) +
                           " are used for surfaces, groups, lines and sets made here");
    ids_.helper = helpers_.next_id();
    if (count_ == 0)
      out_.refusals.push_back(path_ + ":1:1: no *CONTACT keyword that can be converted");
    out_.new_text = "# contact interfaces of " + detail::title_of(path_) +
                    ", columns of input version " + std::to_string(options_.version) + "\n" +
                    helpers_.text() + text_;
    if (!out_.refusals.empty()) out_.new_text.reset();
    return std::move(out_);
  }

 private:
  // ---- the loss report ------------------------------------------------------------------------

  void add(Loss loss, std::string field, std::string old_text, std::string new_text,
           std::string note, std::uint64_t line = 0) {
    LossEntry e;
    e.loss = loss;
    e.file = contact_->file;
    e.line = line != 0 ? line : contact_->line;
    e.keyword = contact_->keyword;
    e.id = id_;
    e.field = std::move(field);
    e.old_text = std::move(old_text);
    e.new_text = std::move(new_text);
    e.note = std::move(note);
    out_.losses.push_back(std::move(e));
  }
  void missing(const detail::DynaMissing& m) {
    LossEntry e;
    e.loss = Loss::undecided;
    e.file = m.file;
    e.line = m.line;
    e.keyword = "*INCLUDE";
    e.old_text = m.name;
    e.note = m.why;
    out_.losses.push_back(std::move(e));
  }
  /// About one cell; blank ones are not reported, and the first word about a cell is the last.
  void cell(Loss loss, std::string_view name, const std::string& new_text,
            const std::string& note) {
    if (!used_.insert(std::string(name)).second) return;
    const DynaCell* c = contact_->find(name);
    if (c == nullptr || c->written.empty()) return;
    add(loss, std::string(name), c->written, new_text, note, c->line);
  }

  /// Value of a cell; nullopt: blank, absent or unreadable (then reported, and used up).
  std::optional<double> real(std::string_view name) {
    const DynaCell* c = contact_->find(name);
    if (c == nullptr || c->written.empty()) return std::nullopt;
    if (c->unknown_parameter) {
      cell(Loss::undecided, name, "", "the parameter is not defined in this file");
      return std::nullopt;
    }
    const RealCell value = read_real(c->text);
    if (value.status == NumberStatus::ok || value.status == NumberStatus::implicit_exponent)
      return value.value;
    cell(Loss::undecided, name, "", "the cell cannot be read as a number");
    return std::nullopt;
  }
  std::int64_t integer(std::string_view name) {
    const auto value = real(name);
    constexpr double most = 2147483647;
    if (!value) return 0;
    if (std::fabs(*value) > most || std::floor(*value) != *value) {
      cell(Loss::undecided, name, "", "the cell cannot be read as an id or flag");
      return 0;
    }
    return static_cast<std::int64_t>(*value);
  }
  double positive_or(std::string_view name, double fallback) {
    const double value = real(name).value_or(0);
    return value > 0 ? value : fallback;
  }

  /// Writes a value that stands for a cell and says what became of it.
  void write(std::string_view field, double value, Loss loss, std::string_view name,
             const std::string& note = {}) {
    bool exact = true;
    if (!values_->set(field, value, &exact)) {
      cell(Loss::dropped, name, "",
           "the card has no " + std::string(field) + " in version " +
               std::to_string(options_.version));
      return;
    }
    cell(exact ? loss : std::max(loss, Loss::approximated), name,
         std::string(field) + " = " + *values_->find(field), note);
  }
  void flag(std::string_view field, std::int64_t value) { values_->set(field, value); }

  // ---- sets and parts -------------------------------------------------------------------------

  using Side = detail::DynaSide;

  Side side(const char* id, const char* type, bool single) {
    return {integer(id), integer(type), single};
  }

  /// The id of a side; what a person has to look at is reported.
  std::int64_t made(const detail::DynaSides::Made& side, const char* name) {
    if (!side.doubt.empty())
      cell(Loss::undecided, name, side.id == 0 ? "" : std::to_string(side.id), side.doubt);
    return side.id;
  }

  void report_side(const Side& s, const char* id, const char* type, std::int64_t target) {
    if (target != 0)
      cell(Loss::kept, id, std::to_string(target), std::string(detail::set_name(s.type)));
    if (target != 0) cell(Loss::kept, type, "", std::string(detail::set_name(s.type)));
  }

  void sides(const DynaContact& c) {
    const bool single = detail::is_single(c.kind);
    const Side a = side("SSID", "SSTYP", single), b = side("MSID", "MSTYP", false);
    std::int64_t secondary = 0, main = 0;
    if (target_ == 11) {
      secondary = made(sides_.line(a), "SSID");
      main = single ? secondary : made(sides_.line(b), "MSID");
      flag("line_IDs", secondary);
      flag("line_IDm", main);
    } else if (target_ == 19) {
      secondary = made(sides_.surface(a), "SSID");
      main = single ? secondary : made(sides_.surface(b), "MSID");
      flag("surf_IDs", secondary);
      flag("surf_IDm", main);
    } else if (single) {
      main = made(sides_.surface(a), "SSID");
      secondary = main;
      // Without a node group TYPE7 takes the nodes of its own surface; TYPE10 needs the group.
      flag("grnd_IDs", target_ == 10 ? sides_.group_of(main) : 0);
      flag("surf_IDm", main);
    } else {
      secondary = made(sides_.nodes(a), "SSID");
      main = made(sides_.surface(b), "MSID");
      flag("grnd_IDs", secondary);
      flag("surf_IDm", main);
    }
    report_side(a, "SSID", "SSTYP", secondary);
    if (single)
      for (const char* name : {"MSID", "MSTYP"})
        cell(Loss::kept, name, "", "a single surface has no second side");
    else
      report_side(b, "MSID", "MSTYP", main);
    for (const char* name : {"SBOXID", "MBOXID"})
      if (integer(name) != 0)
        cell(Loss::undecided, name, "",
             "the side is not cut by the box; name a surface in the box");
  }

  /// A set id that stands for sets of two types can be one Radioss set only.
  void check_sets() {
    std::map<std::int64_t, std::set<std::int64_t>> types;
    for (const auto& [id, type] : sides_.outside()) types[id].insert(type);
    for (const auto& [id, list] : types) {
      if (list.size() < 2) continue;
      std::string names;
      for (const std::int64_t t : list)
        names += (names.empty() ? "" : " and ") + std::string(detail::set_name(t));
      LossEntry e;
      e.loss = Loss::undecided;
      e.file = path_;
      e.line = 1;
      e.keyword = "*SET";
      e.id = id;
      e.note = names + " have the same id; one of them needs another id in the Radioss deck";
      out_.losses.push_back(std::move(e));
    }
  }

  // ---- one contact ----------------------------------------------------------------------------

  int choose_target(const DynaContact& c) {
    const std::int64_t soft = integer("SOFT");
    int target = options_.target;
    if (target == 0 && (soft == -7 || soft == -11 || soft == -19)) {
      cell(Loss::kept, "SOFT", "/INTER/TYPE" + std::to_string(-soft), "names the interface type");
      return static_cast<int>(-soft);
    }
    if (target == 0)
      target = detail::is_tied(c.kind)                                                 ? 10
               : c.kind == DynaKind::surface_to_surface || c.kind == DynaKind::general ? 19
                                                                                       : 7;
    const bool from_nodes = integer("SSTYP") == 4 && !detail::is_single(c.kind);
    if (from_nodes && (target == 11 || target == 19)) {
      add(Loss::approximated, "keyword", c.keyword, "/INTER/TYPE7",
          "a node set has no surface and no edges, so the interface is of type 7");
      target = 7;
    }
    return target;
  }

  void explain_target(const DynaContact& c) {
    const std::string now = "/INTER/TYPE" + std::to_string(target_);
    add(Loss::approximated, "keyword", c.keyword, now,
        std::string(detail::target_note(c.kind, target_)));
    for (const std::string& option : c.options) {
      if (option == "ID" || option == "TITLE" || option == "MPP") continue;
      const bool offset = option.ends_with("OFFSET");
      add(offset && target_ == 10 ? Loss::approximated : Loss::dropped, "option", option, "",
          offset ? "nodes are tied where they are" : "no such formulation");
    }
  }

  void friction(const DynaContact& c) {
    if (detail::is_tied(c.kind) || target_ == 10) {
      for (const char* name : {"FS", "FD", "DC", "FSF"})
        if (real(name)) cell(Loss::dropped, name, "", "a tied interface has no friction");
      return;
    }
    const double scale = positive_or("FSF", 1);
    const double fs = real("FS").value_or(0), fd = real("FD").value_or(0);
    const double dc = real("DC").value_or(0);
    if (fs < 0 || fs == 2) {
      cell(Loss::undecided, "FS", "Fric = 0",
           fs < 0 ? "friction by parts: write a /FRICTION and name it as fric_ID"
                  : "friction by a table: choose a law or a constant");
      for (const char* name : {"FD", "DC", "FSF"})
        if (real(name)) cell(Loss::undecided, name, "", "belongs to FS");
      return;
    }
    write("Fric", fs * scale, Loss::kept, "FS",
          scale == 1 ? std::string() : "times FSF = " + shown(scale));
    if (real("FSF")) cell(Loss::kept, "FSF", "", "multiplied into the friction");
    const bool decays = dc > 0 && fd != fs;
    if (!decays) {
      if (real("FD")) cell(Loss::kept, "FD", "", "without decay the friction is FS");
      if (real("DC")) cell(Loss::kept, "DC", "", "friction does not depend on velocity");
      return;
    }
    if (target_ == 11) {
      const std::string why = "TYPE11 has constant friction only";
      cell(Loss::dropped, "FD", "", why);
      cell(Loss::dropped, "DC", "", why);
      return;
    }
    flag("Ifric", 4);
    write("C1", fd * scale, Loss::kept, "FD", "exponential decay, Ifric = 4");
    write("C2", dc, Loss::kept, "DC", "exponential decay, Ifric = 4");
    if (const DynaCell* blank = c.find("FD"); blank != nullptr && blank->written.empty())
      add(Loss::kept, "FD", "", "C1 = 0", "blank is 0", blank->line);
  }

  void times() {
    const double birth = real("BT").value_or(0), death = real("DT").value_or(0);
    if (birth < 0 || death < 0) {
      for (const char* name : {"BT", "DT"})
        if (real(name))
          cell(Loss::undecided, name, "", "times by a curve or for dynamic relaxation only");
      return;
    }
    if (real("BT")) write("Tstart", birth, Loss::kept, "BT");
    constexpr double never = 1e20;
    if (death > 0 && death < never)
      write("Tstop", death, Loss::kept, "DT");
    else if (real("DT"))
      cell(Loss::kept, "DT", "", "never switched off");
  }

  void stiffness(bool single) {
    const double a = positive_or("SFS", 1), b = single ? a : positive_or("SFM", 1);
    if (a == 1 && b == 1) {
      for (const char* name : {"SFS", "SFM"})
        if (real(name)) cell(Loss::kept, name, "", "the default");
    } else {
      write("Stfac", b, Loss::approximated, single ? "SFS" : "SFM",
            "scales a stiffness that is formed in another way");
      if (!single)
        cell(a == b ? Loss::approximated : Loss::dropped, "SFS", a == b ? "Stfac" : "",
             a == b ? "as SFM" : "Stfac is that of the main side");
      else if (real("SFM"))
        cell(Loss::kept, "SFM", "", "a single surface has no second side");
    }
    const double damping = real("VDC").value_or(0);
    if (damping > 0)
      write("VISs", damping / 100, Loss::approximated, "VDC",
            "percent of critical; Radioss damps relative to its own stiffness");
    else if (real("VDC"))
      cell(Loss::approximated, "VDC", "VISs = 0.05",
           "no damping is asked for, but 0 means 0.05 in Radioss; write a small VISs if that "
           "matters");
  }

  void tied_gap() {
    const auto sst = real("SST"), mst = real("MST");
    if (sst || mst) {
      const double a = std::fabs(sst.value_or(0)), b = std::fabs(mst.value_or(0));
      const std::string note =
          "distance within which nodes are tied; LS-DYNA applies its own factor: compare the tied "
          "nodes";
      if (a + b > 0) write("Gap", (a + b) / 2, Loss::approximated, sst ? "SST" : "MST", note);
      for (const char* name : {"SST", "MST"})
        if (real(name))
          cell(a + b > 0 ? Loss::approximated : Loss::kept, name, "",
               a + b > 0 ? "in Gap" : "none");
    } else {
      add(Loss::approximated, "SST", "", "Gap = 0",
          "blank: the solver ties nodes within its default gap, LS-DYNA within its own distance: "
          "compare the tied nodes or write a Gap");
    }
    for (const char* name : {"SFST", "SFMT"})
      if (const auto value = real(name))
        cell(*value == 1 || *value == 0 ? Loss::kept : Loss::dropped, name, "",
             *value == 1 || *value == 0 ? "the default" : "the gap is not scaled");
  }

  void gap(bool single) {
    if (target_ == 10) return tied_gap();
    const double a = real("SST").value_or(0), b = single ? a : real("MST").value_or(0);
    if (single && real("MST")) cell(Loss::kept, "MST", "", "a single surface has no second side");
    const bool constant = a > 0 && b > 0;
    flag("Igap", constant ? 1000 : 1);
    if (constant) {
      write("Gapmin", (a + b) / 2, Loss::approximated, "SST",
            "constant gap of half of both thicknesses");
      if (!single) cell(Loss::approximated, "MST", "Gapmin", "with SST");
    } else if (a != 0 || b != 0) {
      for (const char* name : {"SST", "MST"})
        if (real(name))
          cell(Loss::undecided, name, "",
               a < 0 || b < 0 ? "a negative thickness has no meaning here"
                              : "one side has its own thickness: write it into /PART");
    } else {
      for (const char* name : {"SST", "MST"})
        if (real(name)) cell(Loss::kept, name, "", "true thickness");
    }
    const double s = positive_or("SFST", 1), m = single ? s : positive_or("SFMT", 1);
    if (single && real("SFMT")) cell(Loss::kept, "SFMT", "", "a single surface has no second side");
    if (constant || (s == 1 && m == 1)) {
      for (const char* name : {"SFST", "SFMT"})
        if (real(name)) cell(Loss::kept, name, "", constant ? "ignored with SST" : "the default");
      return;
    }
    if (target_ == 11) {
      for (const char* name : {"SFST", "SFMT"})
        if (real(name)) cell(Loss::dropped, name, "", "edges have no gap scale");
      return;
    }
    flag("Igap", 2);
    write("Fscalegap", (s + m) / 2, s == m ? Loss::kept : Loss::approximated, "SFST",
          s == m ? "scales both sides" : "one factor for both sides: the mean");
    if (!single) cell(s == m ? Loss::kept : Loss::approximated, "SFMT", "Fscalegap", "with SFST");
  }

  void initial_penetrations() {
    const std::int64_t card = integer("IGNORE"), mpp = integer("MPP IGNORE");
    const std::int64_t ignore = std::max(card, mpp);
    if (target_ == 10) {
      for (const char* name : {"IGNORE", "MPP IGNORE"})
        if (real(name)) cell(Loss::dropped, name, "", "a tied interface ignores them");
      return;
    }
    flag("Inacti", ignore > 0 ? 5 : 6);
    for (const char* name : {"IGNORE", "MPP IGNORE"})
      if (real(name))
        cell(Loss::approximated, name, ignore > 0 ? "Inacti = 5" : "Inacti = 6",
             ignore > 0 ? "the gap is reduced by the initial penetration"
                        : "the gap is reduced by the initial penetration and a margin; LS-DYNA "
                          "follows *CONTROL_CONTACT");
    if (!used_.contains("IGNORE") && !used_.contains("MPP IGNORE"))
      add(Loss::approximated, "IGNORE", "", "Inacti = 6",
          "blank: LS-DYNA follows *CONTROL_CONTACT; here the gap is reduced by the initial "
          "penetration and a margin");
  }

  void formulation() {
    const std::int64_t soft = integer("SOFT");
    if (real("SOFT"))
      cell(soft == 0 ? Loss::approximated : Loss::dropped, "SOFT", "Istf = 4",
           soft == 0   ? "the smaller stiffness of both sides"
           : soft == 1 ? "no soft constraint formulation: penalty stiffness"
           : soft == 2 ? "no segment based contact: nodes against segments"
                       : "no such formulation: penalty stiffness");
    const std::int64_t depth = integer("DEPTH");
    if (real("DEPTH")) {
      const bool edges = depth == 5 || depth == 13 || depth == 15 || depth == 23 || depth == 25 ||
                         depth == 33 || depth == 35 || depth == 45 || depth == 55;
      cell(edges && target_ == 7 ? Loss::dropped : Loss::approximated, "DEPTH", "",
           edges ? target_ == 7 ? "asks for edge to edge contact: choose type 19"
                                : "edge to edge contact is in"
                 : "the search is complete");
    }
  }

  void contact(const DynaContact& c) {
    contact_ = &c;
    used_.clear();
    id_ = integer("CID");
    if (c.kind == DynaKind::other) {
      add(Loss::dropped, "", c.keyword, "", "this keyword is not converted");
      return;
    }
    if (c.mandatory < 3)
      add(Loss::undecided, "", c.keyword, "",
          "only " + std::to_string(c.mandatory) +
              " of 3 mandatory cards are there; blank ones are "
              "assumed");
    ++count_;
    const std::int64_t wanted = id_;
    if (wanted <= 0 || !ids_.written.insert(wanted).second) {
      while (ids_.given.contains(ids_.free) || !ids_.written.insert(ids_.free).second) ++ids_.free;
      id_ = ids_.free;
      add(wanted > 0 ? Loss::undecided : Loss::kept, "CID",
          wanted > 0 ? std::to_string(wanted) : "", std::to_string(id_),
          wanted > 0 ? "another contact has this id" : "no id was given");
      used_.insert("CID");
    } else {
      cell(Loss::kept, "CID", std::to_string(id_), "");
    }
    target_ = choose_target(c);
    const std::string keyword = "/INTER/TYPE" + std::to_string(target_);
    CardValues values(*schemas_.find(keyword), options_.version);
    values_ = &values;
    explain_target(c);
    sides(c);
    friction(c);
    times();
    const bool single = detail::is_single(c.kind);
    stiffness(single);
    gap(single);
    initial_penetrations();
    formulation();
    if (target_ == 10) {
      flag("ITIED", 1);
    } else {
      flag("Istf", 4);
      flag("Iform", 2);
    }
    flag("Idel", 2);
    rest(c);
    text_ += values.block(keyword + "/" + std::to_string(id_), title(c));
    values_ = nullptr;
  }

  /// Every other cell that is not blank.
  void rest(const DynaContact& c) {
    for (const DynaCell& cell_of : c.cells) {
      if (cell_of.written.empty() || used_.contains(std::string(cell_of.name))) continue;
      if (cell_of.name.starts_with('(')) {
        add(Loss::dropped, std::string(cell_of.name), cell_of.written, "",
            "the card has no cell here", cell_of.line);
        continue;
      }
      const auto value = real(cell_of.name);
      if (used_.contains(std::string(cell_of.name))) continue;  // unreadable: reported
      const RealCell fallback = read_real(cell_of.fallback);
      const bool ordinary =
          value &&
          (*value == 0 || (fallback.status == NumberStatus::ok && fallback.value == *value));
      add(ordinary ? Loss::kept : Loss::dropped, std::string(cell_of.name), cell_of.written, "",
          ordinary ? "the default" : std::string(detail::why_dropped(cell_of.name)), cell_of.line);
    }
    for (std::size_t i = 0; i < c.extra.size(); ++i)
      add(Loss::undecided, "", c.extra[i], "", "a line after the last optional card",
          c.extra_line + i);
  }

  std::string title(const DynaContact& c) {
    const std::string text = detail::title_of(c.heading);
    if (text.empty()) return c.keyword.substr(1, 100);
    const bool special = text[0] == '\'' && !c.heading.starts_with('\'');
    add(special ? Loss::approximated : Loss::kept, "HEADING", c.heading, text,
        special ? "a title must not begin with this character" : "");
    return text;
  }

  std::string path_;
  const SchemaSet& schemas_;
  const LsDynaOptions& options_;
  Ids& ids_;
  Rewrite out_;
  detail::DynaFile& file_;
  detail::DynaHelpers helpers_;
  detail::DynaSides sides_;
  std::string text_;
  std::size_t count_ = 0;
  // The contact at hand.
  const DynaContact* contact_ = nullptr;
  CardValues* values_ = nullptr;
  std::set<std::string> used_;  ///< cells that are in the report
  std::int64_t id_ = 0;
  int target_ = 7;
};

}  // namespace

std::vector<Rewrite> contacts_from_lsdyna(const std::vector<LsDynaFile>& files,
                                          const SchemaSet& schemas, const LsDynaOptions& options) {
  std::vector<std::string> refusals;
  const bool known_target = options.target == 0 || options.target == 7 || options.target == 10 ||
                            options.target == 11 || options.target == 19;
  if (!known_target)
    refusals.push_back("interfaces of type " + std::to_string(options.target) +
                       " are not made; choose 7, 10, 11 or 19");
  if (!is_known_version(options.version) || options.version < 110)
    refusals.push_back("input version " + std::to_string(options.version) +
                       " is not written; choose 110 to 2026");
  const std::int64_t first = options.first_id.value_or(1);
  if (first < 1 || first > 2147000000)
    refusals.emplace_back("new ids must lie between 1 and 2147000000");
  std::vector<Rewrite> all(files.size());
  if (!refusals.empty()) {
    for (std::size_t i = 0; i < files.size(); ++i)
      for (const std::string& why : refusals)
        all[i].refusals.push_back(std::string(files[i].path) + ":1:1: " + why);
    return all;
  }
  std::vector<detail::DynaFile> read;
  Ids ids;
  if (options.first_id) ids.free = ids.helper = *options.first_id;
  for (const LsDynaFile& file : files) {
    read.push_back(detail::read_dyna(file, options));
    for (const DynaContact& c : read.back().contacts)
      if (const DynaCell* cid = c.find("CID"))
        if (const auto n = read_integer(cid->text); n.status == NumberStatus::ok)
          ids.given.insert(n.value);
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    all[i] = Converter(files[i].path, schemas, options, ids, read[i]).run();
  return all;
}

Rewrite contacts_from_lsdyna(std::string_view path, std::string_view text, const SchemaSet& schemas,
                             const LsDynaOptions& options) {
  return contacts_from_lsdyna({{path, text}}, schemas, options).front();
}

}  // namespace deck
