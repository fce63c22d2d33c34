// Builds the cards, groups and lines that replace a TYPE19, with free ids.
#include "deck/edit.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"
#include "edit/cells.hpp"
#include "keyword/shared/card_forms.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

using detail::end_of_main;
using detail::largest_id;
using detail::LineEdits;

using Texts = std::map<std::string, std::string>;

constexpr int oldest_version = 100;
constexpr std::int64_t flag_off = 1000;
using detail::trim;

std::string_view columns(std::string_view line, const Field& f) {
  return trim(detail::columns(line, f.first, f.last));
}

class FreeIds {
 public:
  explicit FreeIds(const Deck& deck) {
    for (const Block& b : deck.blocks) {
      if (!b.id.present) continue;
      const std::int64_t id = b.id.value + deck.offset_of(b, "inter");
      for (const char* family : {"/INTER/", "/GRNOD/", "/LINE/", "/SET/"})
        if (b.header.starts_with(family)) used_[family].insert(id);
    }
    // Groups, lines and sets share references, so they share ids.
    for (const char* family : {"/GRNOD/", "/LINE/"})
      used_[family].insert(used_["/SET/"].begin(), used_["/SET/"].end());
  }
  /// An id above all others of the family and above `floor`; if there is none, below.
  std::int64_t new_id(const std::string& family, std::int64_t floor) {
    std::set<std::int64_t>& used = used_[family];
    std::int64_t id = std::max(used.empty() ? 0 : *used.rbegin(), floor) + 1;
    if (id > largest_id)
      for (id = floor + 1; used.count(id) > 0;) ++id;
    used.insert(id);
    return id;
  }

 private:
  std::map<std::string, std::set<std::int64_t>> used_;
};

class Type19Expander {
 public:
  Type19Expander(const LoadedDeck& context, const InterType19& inter, FreeIds& ids,
                 LineEdits& lines, Rewrite& out, std::map<std::string, std::int64_t>& shared,
                 Span end_anchor)
      : c_(context),
        i_(inter),
        block_(*inter.block),
        decoded_(decode(context.deck(), *inter.block)),
        ids_(ids),
        lines_(lines),
        out_(out),
        shared_(shared),
        local_(block_.submodel >= 0 || block_.version != context.deck().version ||
               !end_anchor.valid() || (block_.header_span.file != 0 && has_parameters())),
        anchor_(end_anchor) {}

  void run() {
    s_ = i_.surf_IDs.value == 0 ? i_.surf_IDm.value : i_.surf_IDs.value;
    m_ = i_.surf_IDm.value == 0 ? i_.surf_IDs.value : i_.surf_IDm.value;
    if (!accepted()) return;
    const bool two_sides = s_ != m_;
    Texts primary = nodes_to_surface();
    primary["grnd_IDs"] = two_sides || is_set(s_) ? std::to_string(node_group(s_)) : "0";
    primary["surf_IDm"] = std::to_string(written(m_, "surf"));
    in_place(primary);
    std::string made = "/INTER/TYPE7/" + std::to_string(i_.id);
    if (two_sides) made += ", " + reversed();
    made += edges();
    LossText text{.old_text = "/INTER/TYPE19/" + std::to_string(i_.id), .new_text = made};
    if (i_.Iedge.has_input && i_.Iedge.input != 0 && i_.Iedge.input != i_.Iedge.value)
      text.note =
          "Iedge = " + std::to_string(i_.Iedge.input) + " on the card is not read by the solver";
    out_.losses.push_back(loss_entry(c_.deck(), Loss::kept, block_, {}, std::move(text)));
    for (const std::string& line : behind_) lines_.insert_after(local_ ? last_ : anchor_, line);
  }

 private:
  /// Other files do not know local parameters.
  bool has_parameters() const {
    for (const DecodedCard& card : decoded_.cards)
      for (const Cell& cell : card.cells)
        if (cell.parameter) return true;
    return false;
  }

  void undecided(std::string_view field, std::string text, const std::string& why) {
    out_.losses.push_back(loss_entry(c_.deck(), Loss::undecided, block_, {},
                                     {std::string(field), std::move(text), {}, why}));
    out_.refusals.push_back(c_.deck().sources.where(block_.header_span) + ": TYPE19 " +
                            std::to_string(i_.id) + " " + std::string(field) + ": " + why);
  }

  bool accepted() {
    if (block_.version < oldest_version) {
      undecided("", "",
                "version " + std::to_string(block_.version) +
                    " has other lines; convert the deck to a newer version first");
      return false;
    }
    if (i_.Igap.value == 2 && i_.Igap.origin == Origin::default_block) {
      undecided("Igap", "2",
                "the solver stops at the default card's Igap 2 (error 1181); write Igap on the "
                "interface");
      return false;
    }
    for (const std::int64_t id : {s_, m_})
      if (!is_set(id) && c_.model().selections != nullptr && selections().surface(id) == nullptr) {
        undecided(
            "surf_IDs", std::to_string(id),
            id == 0 ? "no surface is named" : "surface " + std::to_string(id) + " is missing");
        return false;
      }
    for (const std::int64_t id : {s_, m_})
      for (const char* kind : {"grnod", "line"})
        if (is_set(id) && selections().is_plain(kind, id)) {
          undecided("surf_IDs", std::to_string(id),
                    "set " + std::to_string(id) +
                        " cannot be named here, because a group or line has the same id; "
                        "renumber one of them first");
          return false;
        }
    return true;
  }

  Selections& selections() const { return *c_.model().selections; }
  bool is_set(std::int64_t id) const {
    return c_.model().selections != nullptr && !selections().is_plain("surf", id) &&
           selections().set(id) != nullptr;
  }

  // ---- ids ----------------------------------------------------------------------------------

  std::int64_t offset(std::string_view kind) const {
    return local_ ? c_.deck().offset_of(block_, kind) : 0;
  }
  /// Text of an id at the place of the new blocks. The TYPE19's own lines stay, in the same
  /// submodel.
  std::int64_t written(std::int64_t id, std::string_view kind) const {
    return id > 0 ? id - c_.deck().offset_of(block_, kind) : id;
  }
  std::int64_t new_id(const std::string& family, std::string_view kind) {
    return ids_.new_id(family, offset(kind)) - offset(kind);
  }

  /// Group made of one line of ids, once per surface.
  std::int64_t group(const std::string& keyword, const std::string& family, std::string_view kind,
                     std::int64_t surface, const std::string& title) {
    const std::string key =
        keyword + "/" + std::to_string(surface) + (local_ ? "/" + std::to_string(i_.id) : "");
    const auto [it, is_new] = shared_.emplace(key, 0);
    if (is_new) {
      it->second = new_id(family, kind);
      std::string line;
      CellWriter::put(line, 1, 10, std::to_string(written(surface, "surf")));
      behind_.push_back(keyword + "/" + std::to_string(it->second));
      behind_.push_back(title);
      behind_.push_back(line);
    }
    return it->second;
  }
  std::int64_t node_group(std::int64_t surface) {
    if (is_set(surface)) return written(surface, "grnod");
    return group("/GRNOD/SURF", "/GRNOD/", "grnod", surface,
                 "nodes of surface " + std::to_string(surface));
  }
  std::int64_t line_group(std::int64_t surface) {
    if (is_set(surface)) return written(surface, "line");
    const bool free_only = i_.Iedge.value == 1;
    return group(
        free_only ? "/LINE/EDGE" : "/LINE/SURF", "/LINE/", "line", surface,
        (free_only ? "free edges of surface " : "edges of surface ") + std::to_string(surface));
  }
  bool has_edges(std::int64_t surface) const {
    if (c_.model().selections == nullptr) return true;
    if (is_set(surface)) return !selections().set(surface)->edges.empty();
    const auto found = selections().outline(surface);
    return found && !selections().edges_of(found->segments, i_.Iedge.value == 1).empty();
  }

  // ---- values -------------------------------------------------------------------------------

  static std::int64_t flag(const EffectiveInt& e) { return e.value == flag_off ? 0 : e.value; }
  /// Text of a flag that must not be 0, which means default; a parameter of that value stays.
  std::string explicit_flag(std::string_view field, std::int64_t v) const {
    if (v == 0) v = flag_off;
    const Cell* cell = decoded_.find(field);
    return cell != nullptr && cell->parameter && cell->integer == v ? std::string(cell->text)
                                                                    : std::to_string(v);
  }

  /// Text of a cell; empty if blank.
  std::string raw(std::string_view field) const {
    const Cell* cell = decoded_.find(field);
    return cell == nullptr || cell->blank() ? std::string() : std::string(cell->text);
  }

  /// Copies cells that mean the same on TYPE7 and TYPE11.
  void copy_cells(Texts& to, std::initializer_list<const char*> fields) const {
    for (const char* field : fields)
      if (std::string text = raw(field); !text.empty()) to[field] = std::move(text);
  }

  void common(Texts& t) const {
    copy_cells(t, {"%mesh_size", "dtmin",     "Stmin",   "Stmax", "Stfac", "Fric",    "Gapmin",
                   "Tstart",     "Tstop",     "IBCX",    "IBCY",  "IBCZ",  "VISs",    "VISF",
                   "Bumult",     "sens_ID",   "fric_ID", "Ithe",  "Kthe",  "fct_IDK", "AscaleK",
                   "Tint",       "Ithe_form", "Frad",    "Drad"});
    t["Idel"] = explicit_flag("Idel", i_.Idel.value);
    t["Inacti"] = explicit_flag("Inacti", i_.Inacti.value);
    const std::int64_t iform = decoded_.integer("Iform");
    t["Iform"] = explicit_flag("Iform", iform != 0 ? iform : default_iform());
    keep_stiffness(t);
  }

  /// Iform without /FRICTION, which may give the effective value.
  std::int64_t default_iform() const {
    if (i_.Iform.origin != Origin::derived) return i_.Iform.value;
    const DefaultInter* defaults = c_.interfaces().defaults_of(19);
    const auto* given = defaults != nullptr ? defaults->find("Iform") : nullptr;
    return given != nullptr ? given->value : 1;
  }

  /// After Istf 1 is written, Stfac is a stiffness: converts it with its unit.
  void keep_stiffness(Texts& t) const {
    const Cell* cell = decoded_.find("Stfac");
    if (i_.Istf.value != 1 || decoded_.integer("Istf") == 1) return;
    const UnitSystem* units = c_.deck().units_of(block_);
    if (units == nullptr) return;
    const double factor = conversion_factor(*units, c_.deck().begin.working, {1, 0, -2, 0});
    if (factor == 1) return;
    const double value = cell == nullptr || cell->real == 0 ? 1 : cell->real;
    if (const auto text = detail::cell_text(value, factor, 20)) t["Stfac"] = text->text;
  }

  Texts nodes_to_surface() const {
    Texts t;
    common(t);
    copy_cells(t, {"Icurv", "Fscalegap", "Gapmax", "node_ID1", "node_ID2", "Ifric", "Ifiltr",
                   "Xfreq", "C1", "C2", "C3", "C4", "C5", "C6", "Fheats", "Fheatm"});
    t["Istf"] = explicit_flag("Istf", flag(i_.Istf));
    const bool curvilinear =
        i_.Igap.value == 4;  // undocumented: variable gap and removal along the mesh
    t["Igap"] = explicit_flag("Igap", curvilinear ? 2 : flag(i_.Igap));
    t["Irem_gap"] = explicit_flag("Irem_gap", curvilinear ? 2 : i_.Irem_gap.value);
    t["Irem_i2"] = explicit_flag("Irem_i2", i_.Irem_i2.value);
    // Without airbag the effective value is 0; the card's value may act later.
    const bool given = i_.Ibag.has_input && i_.Ibag.input != 0;
    t["Ibag"] = explicit_flag("Ibag", given ? i_.Ibag.input : i_.Ibag.value);
    return t;
  }

  Texts edge_to_edge() const {
    Texts t;
    common(t);
    const std::int64_t istf = flag(i_.Istf), igap = flag(i_.Igap);
    t["Istf"] = explicit_flag("Istf", istf == 0 ? 5 : istf);
    t["Igap"] = explicit_flag("Igap", igap == 2 ? 1 : igap == 4 ? 0 : igap);
    t["Irem_gap"] = explicit_flag("Irem_gap", i_.Irem_gap.value);
    if (igap == 3) t.try_emplace("%mesh_size", "0.4");  // a TYPE11 has single precision here
    if (const double scale = i_.Edge_scale_gap.value; scale != 0 && scale != 1)
      if (const Cell* gap = decoded_.find("Gapmin"); gap != nullptr && gap->real > 0)
        if (const UnitSystem* units = c_.deck().units_of(block_)) {
          const double factor = conversion_factor(*units, c_.deck().begin.working, {0, 1, 0, 0});
          if (const auto text = detail::cell_text(i_.Gapmin.value * scale, factor, 20))
            t["Gapmin"] = text->text;
        }
    return t;
  }

  /// Value that the solver uses for a flag without a cell.
  std::int64_t fallback(const Schema& schema, int type, const std::string& field) const {
    const DefaultInter* defaults = c_.interfaces().defaults_of(type);
    if (const auto* given = defaults != nullptr ? defaults->find(field) : nullptr)
      return given->value;
    if (field == "Irem_i2" && c_.model().implicit) return 1;
    const Field* f = schema.find_field(field);
    return f == nullptr ? 0 : static_cast<std::int64_t>(f->default_value.value_or(0));
  }

  /// Removes texts without a cell in this version of the type.
  void fit(const Schema& schema, int type, Texts& texts) {
    for (auto it = texts.begin(); it != texts.end();) {
      const Field* cell = nullptr;
      for (const CardSchema& card : schema.cards)
        if (card.in_version(block_.version))
          for (const Field& f : card.fields)
            if (f.in_version(block_.version) && f.name == it->first) cell = &f;
      if (cell != nullptr) {
        if (it->second.size() > static_cast<std::size_t>(cell->last - cell->first + 1))
          undecided(it->first, it->second, "does not fit its columns; shorten it");
        ++it;
        continue;
      }
      static const std::set<std::string> flags = {"Irem_gap", "Irem_i2", "Iform"};
      if (schema.find_field(it->first) != nullptr && flags.count(it->first) > 0 &&
          std::to_string(fallback(schema, type, it->first)) != it->second)
        undecided(it->first, it->second,
                  "version " + std::to_string(block_.version) + " of TYPE" + std::to_string(type) +
                      " has no cell for it; convert the deck to a newer version first");
      it = texts.erase(it);
    }
  }

  // ---- blocks -------------------------------------------------------------------------------

  const Schema& schema_of(const char* keyword) const { return *c_.schemas().find(keyword); }

  std::string header(const char* keyword, std::int64_t id) const {
    std::string text = keyword + ("/" + std::to_string(id));
    if (block_.unit_id.present) text += "/" + std::to_string(block_.unit_id.value);
    return text;
  }

  std::string reversed() {
    Texts t = nodes_to_surface();
    t["grnd_IDs"] = std::to_string(node_group(m_));
    t["surf_IDm"] = std::to_string(written(s_, "surf"));
    return add("/INTER/TYPE7", 7, std::move(t), " (reversed)");
  }

  std::string edges() {
    if (!has_edges(s_) || !has_edges(m_)) {
      out_.losses.push_back(loss_entry(
          c_.deck(), Loss::kept, block_, {},
          {.note = "no TYPE11: a side has no edges, and the solver drops this part too (1577)"}));
      return "";
    }
    Texts t = edge_to_edge();
    t["line_IDs"] = std::to_string(line_group(s_));
    t["line_IDm"] = std::to_string(line_group(m_));
    return ", " + add("/INTER/TYPE11", 11, std::move(t), " (edges)");
  }

  std::string add(const char* keyword, int type, Texts texts, const std::string& suffix) {
    const Schema& schema = schema_of(keyword);
    fit(schema, type, texts);
    const std::int64_t id = new_id("/INTER/", "inter");
    std::string rendered =
        render_card(schema, header(keyword, id), block_.version, {texts.begin(), texts.end()});
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < rendered.size();) {
      const std::size_t nl = std::min(rendered.find('\n', at), rendered.size());
      lines.push_back(rendered.substr(at, nl - at));
      at = nl + 1;
    }
    if (lines.size() > 1)
      lines[1] = decoded_.title.substr(0, detail::title_columns - suffix.size()) + suffix;
    // Texts of missing cards, such as friction coefficients without friction law.
    std::erase_if(lines, [](const std::string& l) { return l.starts_with("# unused: "); });
    behind_.insert(behind_.end(), lines.begin(), lines.end());
    return std::string(keyword) + "/" + std::to_string(id + offset("inter"));
  }

  /// Turns the TYPE19 into the first TYPE7 in place: keyword, then cell by cell.
  void in_place(Texts& texts) {
    const Schema& schema = schema_of("/INTER/TYPE7");
    fit(schema, 7, texts);
    const auto at = block_.header.find("TYPE19");
    out_.edits.push_back(
        {Span{block_.header_span.file, 6, block_.header_span.offset + at}, "TYPE7"});
    last_ = decoded_.title_line.valid() ? decoded_.title_line.whole() : block_.header_span;
    std::vector<std::string> missing;
    std::size_t needed = 0;
    for (const DecodedCard& card : decoded_.cards) {
      const CardSchema* target = nullptr;
      for (const CardSchema& c : schema.cards)
        if (c.in_version(block_.version) && c.name == card.schema->name) target = &c;
      if (target == nullptr) continue;
      if (card.missing()) {
        missing.push_back(compose(card, *target, texts));
        if (!missing.back().empty()) needed = missing.size();
        continue;
      }
      last_ = card.line.whole();
      lines_.change(card.line, compose(card, *target, texts), out_.edits);
    }
    missing.resize(needed);
    if (needed > 0 && detail::lacks_title(decoded_)) lines_.insert_after(last_, "");
    for (const std::string& line : missing) lines_.insert_after(last_, line);
  }

  std::string compose(const DecodedCard& card, const CardSchema& target, const Texts& texts) const {
    std::string line =
        card.missing() || card.free_format ? std::string() : std::string(card.line.text);
    for (const Field& f : card.schema->fields)
      if (f.in_version(block_.version) && texts.count(f.name) == 0 && !columns(line, f).empty())
        CellWriter::put(line, f.first, f.last, "");
    for (const Field& f : target.fields) {
      if (!f.in_version(block_.version)) continue;
      const auto it = texts.find(f.name);
      const std::string want = it == texts.end() ? std::string() : it->second;
      if (columns(line, f) != want) CellWriter::put(line, f.first, f.last, want);
    }
    return line;
  }

  const LoadedDeck& c_;
  const InterType19& i_;
  const Block& block_;
  DecodedBlock decoded_;
  FreeIds& ids_;
  LineEdits& lines_;
  Rewrite& out_;
  std::map<std::string, std::int64_t>& shared_;
  const bool local_;   ///< new blocks follow this one
  const Span anchor_;  ///< last line in front of /END of the main file
  Span last_;          ///< last line of the block
  std::int64_t s_ = 0, m_ = 0;
  std::vector<std::string> behind_;  ///< lines of the new blocks
};

}  // namespace

Rewrite expand_type19(const LoadedDeck& context) {
  Rewrite out;
  LineEdits lines(context.deck().sources);
  FreeIds ids(context.deck());
  std::map<std::string, std::int64_t> shared;
  const Span end = end_of_main(context.deck());
  for (const InterType19& inter : context.interfaces().type19)
    Type19Expander(context, inter, ids, lines, out, shared, end).run();
  lines.append_to(out.edits);
  if (!context.interfaces().type19.empty())
    out.notes.push_back(
        "time histories (/TH/INTER) that name a TYPE19 now record its first TYPE7 only");
  return out;
}

}  // namespace deck
