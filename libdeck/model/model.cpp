// build_model: nodes, submodel transforms, elements, entities that refer to them, and last the
// transforms of node groups, because groups use the coordinates before them.
#include "deck/model.hpp"

#include <algorithm>

#include "base/shared/parallel.hpp"
#include "model/bulk/bulk.hpp"
#include "model/model_build.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace detail {

Finding finding_from(FindingDraft f) {
  Finding d = make_finding(f.rule, f.span, std::move(f.message), std::move(f.overrides));
  d.keyword = std::move(f.keyword);
  d.id = f.id;
  return d;
}

void report(Findings& findings, FindingDraft f) {
  if (findings.wants(f.rule)) findings.add(finding_from(std::move(f)));
}

std::string name_of(const Block& block) {
  return std::string(block.keyword) + " " + std::to_string(block.id.value);
}

FindingDraft finding_about(const Block& block, RuleId rule, std::string message,
                           Overrides overrides) {
  return {rule,           block.header_span,   std::move(message), std::string(block.keyword),
          block.id.value, std::move(overrides)};
}

int number_of_digits(std::string_view digits) {
  if (digits.empty() || digits.size() > 4) return -1;
  int value = 0;
  for (const char ch : digits) {
    if (!is_digit(ch)) return -1;
    value = value * 10 + (ch - '0');
  }
  return value;
}

std::vector<std::string_view> header_fields(const Block& block) {
  std::vector<std::string_view> fields;
  const std::string_view header = block.header;
  std::size_t at = header.starts_with('/') ? 1 : 0;
  while (at <= header.size()) {
    const std::size_t end = std::min(header.find('/', at), header.size());
    std::string_view field = header.substr(at, end - at);
    while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    const bool number = !field.empty() &&
                        (field.front() == '&' || std::all_of(field.begin(), field.end(), is_digit));
    if (number || field.empty()) break;
    if (field != "ADDD") fields.push_back(field);
    at = end + 1;
  }
  return fields;
}

void register_id(BuildContext& c, std::map<std::int64_t, std::uint32_t>& map, std::int64_t id,
                 std::uint32_t index, const Block& block, Span first) {
  if (id > detail::largest_id)
    report(c.findings, {RuleId::DK114, block.header_span,
                        "id " + std::to_string(id) + " is above the largest id " +
                            std::to_string(detail::largest_id),
                        std::string(block.keyword), id});
  if (map.emplace(id, index).second || id == 0) return;
  if (!c.findings.wants(RuleId::DK100)) return;
  Finding d =
      finding_from({RuleId::DK100, block.header_span,
                    std::string(block.keyword) + " " + std::to_string(id) + " is defined twice",
                    std::string(block.keyword), id});
  d.notes.emplace_back(first, "first defined here");
  c.findings.add(std::move(d));
}

namespace {

/// Items with duplicate ids as far as they are reported, then the first item of each id, so that
/// all lines are found together. Elements of id 0 are blank lines, which the solver accepts.
std::vector<std::uint32_t> duplicates_to_report(BuildContext& c, const IdMap& map,
                                                const std::vector<std::int64_t>& id) {
  std::vector<std::uint32_t> list;
  for (const std::uint32_t i : map.duplicates())
    if ((id[i] != 0 || &map == &c.model.nodes.map) && c.findings.wants(RuleId::DK105))
      list.push_back(i);
  const std::size_t count = list.size();
  for (std::size_t i = 0; i < count; ++i) list.push_back(map.find(id[list[i]]));
  return list;
}

void report_twice(BuildContext& c, Span span, Span first, std::string message, std::string keyword,
                  std::int64_t id, const char* fix) {
  Finding d =
      finding_from({RuleId::DK105, span, std::move(message), std::move(keyword), id, {.fix = fix}});
  d.notes.emplace_back(first, "first defined here");
  c.findings.add(std::move(d));
}

/// Duplicate ids of nodes and elements. Nodes repeated with equal coordinates are frequent in legal
/// decks, so they have their own message.
void check_duplicates(BuildContext& c) {
  const Model& m = c.model;
  const std::vector<std::uint32_t> nodes = duplicates_to_report(c, m.nodes.map, m.nodes.id);
  const std::vector<Span> lines = node_spans(m, nodes);
  for (std::size_t i = 0, count = nodes.size() / 2; i < count; ++i) {
    const NodeIndex n = nodes[i], first = nodes[count + i];
    const bool same = m.nodes.x[n] == m.nodes.x[first] && m.nodes.y[n] == m.nodes.y[first] &&
                      m.nodes.z[n] == m.nodes.z[first];
    report_twice(c, lines[i], lines[count + i],
                 "node " + std::to_string(m.nodes.id[n]) + " is defined twice" +
                     (same ? " with the same coordinates" : " with different coordinates"),
                 "/NODE", m.nodes.id[n], "remove one of the two lines");
  }
  for (const ElementKind kind : all_families) {
    const Elements& family = m.family(kind);
    const std::vector<std::uint32_t> elements = duplicates_to_report(c, family.map, family.id);
    const std::vector<Span> of = element_spans(m, kind, elements);
    for (std::size_t i = 0, count = elements.size() / 2; i < count; ++i) {
      const std::uint32_t e = elements[i];
      const std::string keyword(m.element_blocks[family.block[e]].block->keyword);
      report_twice(
          c, of[i], of[count + i],
          "element " + std::to_string(family.id[e]) + " of " + keyword + " is defined twice",
          keyword, family.id[e], "give one of them another id");
    }
  }
}

/// Blocks with an undefined unit system.
void check_units(BuildContext& c) {
  for (const Block& block : c.deck.blocks) {
    if (block.schema == nullptr || c.deck.units_of(block) != nullptr) continue;
    const std::optional<int> message = block.schema->stop("unit");
    if (!message) continue;
    const bool stops = *message != Schema::goes_on;
    FindingDraft f = finding_about(
        block, RuleId::DK109,
        std::string(block.keyword) + " names unit system " + std::to_string(block.unit_id.value) +
            ", which does not exist",
        {.severity = stops ? Severity::error : Severity::warning,
         .message = stops ? *message : 0,
         .solver = stops ? "it stops with an error; deck takes the values in working units"
                         : "it continues: it does not look up the unit system here"});
    f.span = block.unit_id.span;
    report(c.findings, std::move(f));
  }
}

}  // namespace
}  // namespace detail

const char* to_string(Origin origin) {
  constexpr const char* names[] = {"card", "default-block", "built-in", "derived", "derived"};
  return names[static_cast<std::size_t>(origin)];
}

Model::Model(Model&& other) noexcept : ModelData(std::move(other)) {
  if (selections) selections->rebind(*this);
}

Model& Model::operator=(Model&& other) noexcept {
  ModelData::operator=(std::move(other));
  if (selections) selections->rebind(*this);
  return *this;
}

Span Model::node_span(NodeIndex n) const {
  if (deck == nullptr || n >= nodes.size()) return {};
  return detail::node_spans(*this, {&n, 1})[0];
}

Span Model::element_span(ElementKind kind, std::uint32_t e) const {
  const Elements& f = family(kind);
  if (deck == nullptr || e >= f.size()) return {};
  return detail::element_spans(*this, kind, {&e, 1})[0];
}

Model build_model(const Deck& deck, const SchemaSet& schemas, Findings& findings,
                  const ModelOptions& options) {
  Model model;
  model.deck = &deck;
  detail::BuildContext context{deck, findings, model, effective_threads(options.threads)};
  detail::check_units(context);
  detail::read_run_options(context);
  detail::read_nodes(deck, detail::node_blocks(deck), model.nodes, model.node_blocks, findings,
                     options.threads);
  detail::put_nodes_in_order(model.nodes, model.node_blocks);
  detail::apply_submodel_transforms(context);
  detail::merge_connection_nodes(context);
  detail::read_parts(context);
  detail::read_properties(context);
  detail::read_materials(context);
  detail::read_other_entities(context);
  detail::read_elements(deck, detail::element_blocks(deck), model, findings, options.threads);
  detail::put_elements_in_order(model);
  detail::redirect_elements(context);
  detail::orient_solids(model);
  detail::link_parts(context);
  detail::check_duplicates(context);
  detail::check_elements(context);
  model.selections = std::make_shared<Selections>(model, schemas, options.limits);
  detail::apply_group_transforms(context);
  detail::apply_random_noise(context);
  detail::check_coordinates(context);
  return model;
}

}  // namespace deck
