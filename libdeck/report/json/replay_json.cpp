// `deck replay`: how well the force kernel reproduces recorded states, as JSON and as text.
#include <fmt/format.h>

#include "base/shared/escape.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/json.hpp"

namespace deck {
namespace {

void write_vector(JsonWriter& j, const std::vector<double>& v) {
  j.begin_array(true);
  for (const double x : v) j.value(x);
  j.end_array();
}

const char* name_of(cycle::Model model) {
  return model == cycle::Model::reference ? "reference" : "robust";
}

std::string vector_text(const std::vector<double>& v) {
  std::string text;
  for (const double x : v) text += fmt::format("{}{:.10g}", text.empty() ? "" : " ", x);
  return text;
}

}  // namespace

std::string replay_json(const ReplayInput& input, const cycle::ReplayReport& r) {
  std::string out;
  JsonWriter j(out);
  j.begin_object();
  write_json_head(j, "deck/replay", 1);
  write_json_deck(j, input.path, *input.deck, nullptr, nullptr);
  j.field("states", input.states).field("interface", input.inter->id);
  j.field("type", input.inter->type).field("kind", r.kind).field("model", name_of(input.model));
  j.field("records", r.records).field("compared", r.compared);
  j.key("relative_error").begin_object(true);
  j.field("median", r.median).field("p99", r.p99).field("max", r.max).end_object();
  j.key("zero_rows").begin_object(true).field("count", r.zero_rows);
  j.field("max_over_k0_gap", r.zero_max_over_k0_gap).end_object();
  j.field("acting", r.acting);
  j.key("columns").begin_array();
  for (const cycle::ReplayColumn& c : r.columns) {
    j.begin_object(true).field("name", c.name).field("rows", c.rows).field("acting", c.acting);
    j.field("median", c.median).field("p99", c.p99).field("max", c.max);
    j.field("zero_max", c.zero_max).end_object();
  }
  j.end_array();
  j.key("worst").begin_array();
  for (const cycle::ReplayWorst& w : r.worst) {
    j.begin_object(true).field("row", w.row).field("relative_error", w.relative_error);
    j.key("reference");
    write_vector(j, w.reference);
    j.key("computed");
    write_vector(j, w.computed);
    j.end_object();
  }
  j.end_array().end_object();
  return out;
}

std::string replay_text(const ReplayInput& input, const cycle::ReplayReport& r) {
  std::string out = fmt::format("{}: {} states ({}) of interface {}, {} compared, model {}\n",
                                terminal_text(input.states), r.records, r.kind, input.inter->id,
                                r.compared, name_of(input.model));
  out += fmt::format("  relative error of the {}: median {:.1e}, 99 % {:.1e}, worst {:.1e}\n",
                     r.kind.starts_with("heat") ? "heat" : "pair force", r.median, r.p99, r.max);
  if (r.zero_rows > 0)
    out += fmt::format("  {} states without {}: at most {:.1e} of {}\n", r.zero_rows,
                       r.kind.starts_with("heat") ? "heat" : "force", r.zero_max_over_k0_gap,
                       r.kind.starts_with("heat") ? "the largest heat" : "K0 gap");
  if (10 * r.acting < 3 * r.records)
    out += fmt::format("  only {} of {} states record any action: this proves little\n", r.acting,
                       r.records);
  for (const cycle::ReplayColumn& c : r.columns)
    out += fmt::format("  {:<12} median {:.1e}, worst {:.1e}, where zero {:.1e}\n", c.name,
                       c.median, c.max, c.zero_max);
  std::size_t shown = 0;
  for (const cycle::ReplayWorst& w : r.worst) {
    if (shown++ == 3) break;
    out += fmt::format("  row {}: recorded ({}), computed ({}), relative {:.1e}\n", w.row,
                       vector_text(w.reference), vector_text(w.computed), w.relative_error);
  }
  return out;
}

}  // namespace deck
