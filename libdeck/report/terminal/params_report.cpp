// Tables and JSON of `deck params`.
#include "report/shared/params_report.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "deck/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "deck/text.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

/// Mesh-dependent values of one interface by part.
std::vector<std::pair<std::string_view, double>> by_role(const ParamsInput& in,
                                                         const InterBase& inter,
                                                         std::string_view name) {
  std::vector<std::pair<std::string_view, double>> out;
  if (in.scene == nullptr) return out;
  for (const Contact& c : in.scene->contacts)
    if (c.inter == &inter && !c.dropped)
      out.emplace_back(to_string(c.role), geometry_value(c, name));
  return out;
}

std::string cell_text(std::int64_t v) { return std::to_string(v); }
std::string cell_text(double v) {
  return std::isfinite(v) ? shortest(v) : std::string(not_computed);
}
std::string cell_text(const std::string& v) { return v; }

Tone tone_of(Origin origin) {
  return origin == Origin::card            ? Tone::plain
         : origin == Origin::default_block ? Tone::cyan
         : origin == Origin::built_in      ? Tone::dim
                                           : Tone::yellow;
}

/// Interfaces of the deck that are not examined.
std::vector<const Block*> not_evaluated(const ParamsInput& in) {
  std::vector<const Block*> out;
  for (const Block& b : in.loaded.deck().blocks) {
    if (!b.header.starts_with("/INTER/")) continue;
    const bool known =
        std::any_of(in.loaded.interfaces().all.begin(), in.loaded.interfaces().all.end(),
                    [&](const InterBase* i) { return i->block == &b; });
    if (!known) out.push_back(&b);
  }
  return out;
}

/// True if model-dependent defaults have their usual value: no implicit analysis, and too few nodes
/// for a larger sorting margin.
bool ordinary(const Model* model) {
  return model != nullptr && !model->implicit && model->nodes.size() <= 1500000;
}

double as_number(std::int64_t v) { return static_cast<double>(v); }
double as_number(double v) { return v; }
double as_number(const std::string& v) { return v == "000" ? 0 : 1; }

/// True if the card has a value that a blank cell would not give.
template <class T>
bool changed_on_card(const ParamsInput& in, const InterBase& inter, std::string_view name,
                     const Effective<T>& e) {
  if (!e.has_input || as_number(e.input) == 0) return false;
  for (const DefaultInter& d : in.loaded.interfaces().defaults)
    if (const auto* given = d.type == inter.type ? d.find(name) : nullptr)
      return as_number(e.input) != static_cast<double>(given->value);
  const Schema* schema = inter.block != nullptr ? inter.block->schema : nullptr;
  const Field* field = schema != nullptr ? schema->find_field(name) : nullptr;
  if (field == nullptr || field->type == FieldType::id) return true;
  const bool known =
      field->default_varies != DefaultVaries::fields &&
      (field->default_varies != DefaultVaries::model || ordinary(&in.loaded.model()));
  return !known || field->default_value != as_number(e.input);
}

std::vector<const InterBase*> wanted_interfaces(const ParamsInput& in,
                                                const ParamsTextOptions& options) {
  std::vector<const InterBase*> out;
  for (const InterBase* inter : in.loaded.interfaces().all)
    if (options.only.empty() ||
        std::find(options.only.begin(), options.only.end(), inter->id) != options.only.end())
      out.push_back(inter);
  return out;
}

/// Calls `add` with name and value of each wanted field.
template <class Add>
void for_each_wanted_field(const ParamsInput& in, const InterBase& inter,
                           const ParamsTextOptions& options, const Add& add) {
  visit_any_interface(inter, [&](const auto& t) {
    t.for_each([&](std::string_view name, const auto& e) {
      if (options.filled_in_only && e.origin == Origin::card) return;
      if (!options.changed_only || changed_on_card(in, inter, name, e)) add(name, e);
    });
  });
}

/// Value on the card; a cell without a finite number as written.
template <class T>
std::string input_text(const Deck& deck, const Effective<T>& e) {
  if (!e.has_input) return {};
  if constexpr (std::is_same_v<T, double>)
    if (!std::isfinite(e.input)) return std::string(detail::trim(deck.sources.text(e.span)));
  return cell_text(e.input);
}

std::optional<SourcePlace> cell_place(const Deck& deck, const Span& span) {
  std::optional<SourcePlace> place = place_of(deck, span);
  if (place) place->end_column = {place->column + span.length};
  return place;
}

template <class T>
ParameterRow parameter(const ParamsInput& in, const InterBase& inter, std::string_view name,
                       const Effective<T>& e) {
  const Deck& deck = in.loaded.deck();
  ParameterRow row;
  if (e.has_input)
    row.input = std::isfinite(as_number(e.input)) ? Scalar(e.input) : input_text(deck, e);
  const bool geometric = e.origin == Origin::geometry;
  if (!geometric || inter.resolved) row.value = e.value;
  row.origin = e.origin;
  if (auto values = by_role(in, inter, name); geometric && values.size() > 1)
    row.by_role.value = Named<double>{[values = std::move(values)](const auto& add) {
                                        for (const auto& [role, v] : values) add(role, v);
                                      },
                                      true};
  row.source = cell_place(deck, e.span);
  return row;
}

}  // namespace

template <class T>
std::string effective_text(const ParamsInput& in, const InterBase& inter, std::string_view name,
                           const Effective<T>& e) {
  if (e.origin != Origin::geometry) return cell_text(e.value);
  std::string value = inter.resolved ? cell_text(e.value) : "from geometry";
  const auto values = by_role(in, inter, name);
  for (std::size_t i = 1; i < values.size(); ++i)
    value += fmt::format(", {} {}", values[i].first, cell_text(values[i].second));
  return value;
}
template std::string effective_text(const ParamsInput&, const InterBase&, std::string_view,
                                    const EffectiveInt&);
template std::string effective_text(const ParamsInput&, const InterBase&, std::string_view,
                                    const EffectiveReal&);
template std::string effective_text(const ParamsInput&, const InterBase&, std::string_view,
                                    const EffectiveText&);

TextTable params_table(const ParamsInput& in, const InterBase& inter,
                       const ParamsTextOptions& options) {
  const Deck& deck = in.loaded.deck();
  TextTable table({"field", ">card", ">value", "origin", "=place"});
  for_each_wanted_field(in, inter, options, [&](std::string_view name, const auto& e) {
    table.row(
        {name,
         e.has_input ? input_text(deck, e) : "-",
         {effective_text(in, inter, name, e), e.origin == Origin::card ? Tone::bold : Tone::plain},
         {to_string(e.origin), tone_of(e.origin)},
         {e.span.valid() ? deck.sources.where(e.span) : "", Tone::dim}});
  });
  return table;
}

namespace {

/// First columns of the matrix; notable further fields follow.
constexpr std::string_view first_columns[] = {"Istf",   "Igap",     "Gapmin", "Gap",
                                              "Inacti", "Stfac",    "Fric",   "Idel",
                                              "Iform",  "Irem_gap", "VISs",   "Fscalegap"};

/// One cell of an interface; `present` is false if the type lacks the field.
struct MatrixCell {
  bool present = false, on_card = false, changed = false;
  std::string text;
};
using MatrixRow = std::vector<std::pair<std::string, MatrixCell>>;

MatrixRow matrix_row(const ParamsInput& in, const InterBase& inter) {
  MatrixRow row;
  for_each_wanted_field(in, inter, {}, [&](std::string_view name, const auto& e) {
    const bool changed = changed_on_card(in, inter, name, e) || e.origin == Origin::default_block;
    row.emplace_back(name, MatrixCell{true, e.origin == Origin::card, changed,
                                      effective_text(in, inter, name, e)});
  });
  return row;
}

const MatrixCell& cell_of(const MatrixRow& row, std::string_view name) {
  static const MatrixCell none;
  for (const auto& [field, cell] : row)
    if (field == name) return cell;
  return none;
}

struct Matrix {
  std::vector<const InterBase*> interfaces;
  std::vector<MatrixRow> rows;
  std::vector<std::string> names;  ///< every field of some interface, in the manual's order
};

Matrix matrix_of(const ParamsInput& in, const ParamsTextOptions& options) {
  Matrix m;
  m.interfaces = wanted_interfaces(in, options);
  for (const InterBase* inter : m.interfaces) {
    m.rows.push_back(matrix_row(in, *inter));
    for (const auto& [name, cell] : m.rows.back())
      if (std::find(m.names.begin(), m.names.end(), name) == m.names.end()) m.names.push_back(name);
  }
  return m;
}

}  // namespace

std::string params_matrix(const ParamsInput& in, const ParamsTextOptions& options) {
  const Matrix m = matrix_of(in, options);
  std::vector<std::string> columns;
  const auto show = [&](std::string_view name, bool always) {
    const auto any = [&](auto&& test) {
      return std::any_of(m.rows.begin(), m.rows.end(),
                         [&](const MatrixRow& row) { return test(cell_of(row, name)); });
    };
    if (std::find(columns.begin(), columns.end(), name) != columns.end()) return;
    if (always && !options.changed_only ? any([](const MatrixCell& c) { return c.present; })
                                        : any([](const MatrixCell& c) { return c.changed; }))
      columns.emplace_back(name);
  };
  for (const std::string_view name : first_columns) show(name, true);
  for (const std::string& name : m.names) show(name, false);
  std::vector<TextTable::Column> titles = {
      {"interface", Align::right}, {"type"}, {"title", Align::left, false, options.one_table}};
  for (const std::string& name : columns) titles.push_back({name, Align::right});
  TextTable table(titles);
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const InterBase& inter = *m.interfaces[i];
    std::vector<TextTable::Cell> cells = {{inter.id, Tone::bold}, type_name(inter), inter.title};
    for (const std::string& name : columns) {
      const MatrixCell& c = cell_of(m.rows[i], name);
      const bool hidden = options.changed_only && !c.changed;
      const bool cut = options.one_table && c.text.size() > 9 && c.text.find('.') != c.text.npos;
      const std::string text = cut ? fmt::format("{:.6g}", std::atof(c.text.c_str())) : c.text;
      if (!c.present || hidden)
        cells.emplace_back(c.present ? "." : "-", Tone::dim);
      else
        cells.emplace_back(c.on_card ? text : "(" + text + ")",
                           c.on_card ? Tone::plain : Tone::dim);
    }
    table.row(std::move(cells));
  }
  std::vector<std::string> left;
  std::string out =
      table.fitted(options.width, options.color, 0, 1, options.one_table ? &left : nullptr);
  out +=
      fmt::format("\n{}: {}; (value): not on the card; -: no such field; 1000: off or simplest{}\n",
                  terminal_text(in.loaded.path()), count(m.rows.size(), "interface", "interfaces"),
                  options.changed_only ? "; .: the default" : "");
  const Coverage coverage =
      coverage_of(in.loaded.deck(), in.loaded.interfaces(), Examined::contacts_and_ties);
  if (!coverage.not_examined.empty())
    out += "not examined: " + terminal_text(not_examined_text(coverage)) + "\n";
  if (options.one_table)
    out += fmt::format(
        "{}{}; --interface ID: every field of an interface with its place; --matrix: all\n",
        left.empty() ? "no column without room" : "columns without room: ", fmt::join(left, ", "));
  return out;
}

std::string params_csv(const ParamsInput& in, const ParamsTextOptions& options) {
  std::string out = "deck,interface,type,title,field,card,value,origin,file,line,column\r\n";
  const SourceSet& sources = in.loaded.deck().sources;
  for (const InterBase* inter : wanted_interfaces(in, options))
    for_each_wanted_field(in, *inter, options, [&](std::string_view name, const auto& e) {
      const bool known = e.span.valid();
      const Position p = known ? sources.position(e.span) : Position{};
      out += fmt::format(
          "{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_text(in.loaded.path()), inter->id,
          inter->type, csv_text(inter->title), name, csv_text(input_text(in.loaded.deck(), e)),
          csv_text(effective_text(in, *inter, name, e)), to_string(e.origin),
          known ? csv_text(sources[e.span.file].path()) : "", known ? std::to_string(p.line) : "",
          known ? std::to_string(p.column) : "");
    });
  return out;
}

std::string params_matrix_csv(const ParamsInput& in, const ParamsTextOptions& options) {
  const Matrix m = matrix_of(in, options);
  std::string out = "deck,interface,type,title";
  for (const std::string& name : m.names) out += "," + csv_text(name);
  out += "\r\n";
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const InterBase& inter = *m.interfaces[i];
    out += fmt::format("{},{},{},{}", csv_text(in.loaded.path()), inter.id, inter.type,
                       csv_text(inter.title));
    for (const std::string& name : m.names) out += "," + csv_text(cell_of(m.rows[i], name).text);
    out += "\r\n";
  }
  return out;
}

COMMON_LINE_RECORD(
    ParameterRow, "parameter", "",
    COLUMN("input",
           "What the card says; a cell without a finite number as it is written "
           "(\"NaN\"); null: blank cell, or no such cell in this version",
           r.input),
    COLUMN("value",
           "What the solver uses; 1000: off or simplest; null: not derived from the mesh, or no "
           "finite number",
           r.value),
    COLUMN("origin", "", r.origin),
    COLUMN("by_role", "Derived gaps of the parts of a TYPE19", r.by_role),
    COLUMN("source", "The columns of the value, also where they are blank", r.source));

Named<ParameterRow> parameters_of(const ParamsInput& in, const InterBase& inter) {
  return {[&in, &inter](const auto& add) {
    for_each_wanted_field(in, inter, {}, [&](std::string_view name, const auto& e) {
      add(name, parameter(in, inter, name, e));
    });
    // The card lacks the cell, but the node-to-surface parts have the field.
    if (inter.type == 19) add("Fpenmax", parameter(in, inter, "Fpenmax", EffectiveReal{}));
  }};
}

std::string params_text(const ParamsInput& in, const ParamsTextOptions& options) {
  const Coverage coverage =
      coverage_of(in.loaded.deck(), in.loaded.interfaces(), Examined::contacts_and_ties);
  std::string out;
  if (const std::string lead = coverage_lead(coverage); !lead.empty())
    out += toned(terminal_text(lead), Tone::bold, options.color) + "\n";
  for (const InterBase* inter : wanted_interfaces(in, options)) {
    out +=
        toned(fmt::format("/INTER/TYPE{}/{}", inter->type, inter->id), Tone::bold, options.color);
    if (!inter->title.empty()) out += "  " + terminal_text(inter->title);
    out += "  " +
           toned(terminal_text(in.loaded.deck().sources.where(inter->span)), Tone::dim,
                 options.color) +
           "\n";
    out += params_table(in, *inter, options).fitted(options.width, options.color, 2) + "\n";
  }
  const auto& all = in.loaded.interfaces();
  out += fmt::format("{}: {} (", terminal_text(in.loaded.path()),
                     count(all.all.size(), "interface", "interfaces"));
  const char* separator = "";
  if (!all.type2.empty())
    out += fmt::format("{}TYPE2 {}", std::exchange(separator, ", "), all.type2.size());
  all.for_each_list([&]<class Inter>(const std::vector<Inter>& list) {
    if (list.empty() && is_type24_or_25(Inter::traits.type)) return;
    out +=
        fmt::format("{}TYPE{} {}", std::exchange(separator, ", "), Inter::traits.type, list.size());
  });
  out += ")";
  if (!coverage.not_examined.empty())
    out += "; not examined: " + terminal_text(not_examined_text(coverage));
  return out + "\n-: blank; no place: no such cell; 1000: off or simplest; 0 on a card: default\n";
}

namespace {

struct ParamsInterfaceRow {
  const ParamsInput& in;
  const InterBase* inter;
};
RECORD(ParamsInterfaceRow, "interface", "", COLUMN("id", "", r.inter->id),
       COLUMN("type", "2, 7, 10, 11, 19, 24 or 25", r.inter->type),
       COLUMN("title", "", r.inter->title),
       COLUMN("source", "", place_of(r.in.loaded.deck(), r.inter->span)),
       COLUMN("parameters", "By the names of the manual", parameters_of(r.in, *r.inter)));

struct OtherRow {
  const Deck& deck;
  const Block* block;
};
LINE_RECORD(OtherRow, "other_interface", "",
            COLUMN("keyword", "",
                   r.block->schema != nullptr ? r.block->schema->keyword : r.block->keyword),
            COLUMN("id", "", r.block->id.value),
            COLUMN("source", "", place_of(r.deck, r.block->header_span)));

struct ParamsDocument {
  const ParamsInput& in;
  const ParamsTextOptions options;
  const Coverage coverage;
};

RECORD(ParamsDocument, "document", "", COLUMN("deck", "", deck_row(r.in.loaded)), coverage_columns,
       COLUMN("interfaces", "", rows<ParamsInterfaceRow>(wanted_interfaces(r.in, r.options), r.in)),
       COLUMN("not_evaluated", "Interfaces of other types, which are not in 'interfaces'",
              rows<OtherRow>(not_evaluated(r.in), r.in.loaded.deck())));

constexpr DocumentHead params_head{
    "deck/params", 1,
    "Written by deck params --json: effective values of every interface of TYPE2, 7, 10, 11, 19, "
    "24 and 25, in working units."};

}  // namespace

DocumentSchema params_schema() { return document_schema<ParamsDocument>(params_head); }

std::string params_json(const ParamsInput& in, const std::vector<std::int64_t>& only) {
  ParamsTextOptions options;
  options.only = only;
  return write_document(params_head,
                        ParamsDocument{in, options,
                                       coverage_of(in.loaded.deck(), in.loaded.interfaces(),
                                                   Examined::contacts_and_ties)});
}

}  // namespace deck
