// Curves; entities needed by id only (sensors, skews, frictions, rigid bodies, submodels, subsets);
// options of the whole run.
#include "model/model_build.hpp"

namespace deck::detail {
namespace {

void scale_and_shift(Curve& curve, const DecodedBlock& d) {
  const double scale_x = d.real("Ascale_x") != 0 ? d.real("Ascale_x") : 1;
  const double scale_y = d.real("Ascale_y") != 0 ? d.real("Ascale_y") : 1;
  for (double& x : curve.x) x = scale_x * x + d.real("Ashift_x");
  for (double& y : curve.y) y = scale_y * y + d.real("Ashift_y");
}

void read_curve(BuildContext& c, const Block& block) {
  const DecodedBlock d = decode(c.deck, block);
  Curve curve;
  curve.id = c.own_id(block, "funct");
  curve.title = d.title;
  curve.span = block.header_span;
  for (const DecodedCard& card : d.cards) {
    if (card.cells.size() < 2 || card.cells[0].field->name != "X") continue;
    curve.x.push_back(card.cells[0].real);
    curve.y.push_back(card.cells[1].real);
  }
  if (header_starts(block, "/FUNCT_SMOOTH")) scale_and_shift(curve, d);
  c.model.curves.emplace(curve.id, std::move(curve));
}

/// /MOVE_FUNCT/id scales the curve with this id.
void move_curve(BuildContext& c, const Block& block) {
  const auto it = c.model.curves.find(c.own_id(block, "funct"));
  if (it == c.model.curves.end()) return;
  scale_and_shift(it->second, decode(c.deck, block));
}

void read_subset(BuildContext& c, const Block& block) {
  const DecodedBlock d = decode(c.deck, block);
  auto& children = c.model.subset_children[c.own_id(block, "subset")];
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.integer != 0) children.push_back(c.deck.shifted_id(block, "subset", cell.integer));
}

void check_subset_children(BuildContext& c) {
  for (const Block& block : c.deck.blocks) {
    if (!header_starts(block, "/SUBSET") && !header_starts(block, "/ASSEMBLY")) continue;
    const std::int64_t id = c.own_id(block, "subset");
    const auto it = c.model.subset_children.find(id);
    if (it == c.model.subset_children.end()) continue;
    for (const std::int64_t child : it->second)
      if (c.model.subset_children.count(child) == 0)
        report(c.findings, {RuleId::DK108,
                            block.header_span,
                            "subset " + std::to_string(id) + " lists subset " +
                                std::to_string(child) + ", which does not exist",
                            std::string(block.keyword),
                            id,
                            {.message = 0,
                             .solver = "Not known.",
                             .fix = "Define the subset or remove it from the list."}});
  }
}

}  // namespace

void read_other_entities(BuildContext& c) {
  Model& m = c.model;
  for (const Block& block : c.deck.blocks) {
    if (block.schema == nullptr) continue;
    const std::string& kind = block.schema->kind;
    const Span span = block.header_span;
    if (kind == "funct" && !block.opaque)
      read_curve(c, block);
    else if (kind == "sensor")
      m.sensors.emplace(c.own_id(block, "sensor"), span);
    else if (kind == "skew")
      m.skews.emplace(c.own_id(block, "skew"), span);
    else if (kind == "friction")
      m.frictions.emplace(c.own_id(block, "friction"), span);
    else if (kind == "subset")
      read_subset(c, block);
    else if (header_starts(block, "/RBODY"))
      m.rbodies.emplace(c.own_id(block, "rbody"), span);
  }
  for (const Block& block : c.deck.blocks)
    if (header_starts(block, "/MOVE_FUNCT")) move_curve(c, block);
  for (const Submodel& s : c.deck.submodels) m.submodels.emplace(submodel_id(c.deck, s), s.span);
  check_subset_children(c);
}

void read_run_options(BuildContext& c) {
  Model& m = c.model;
  static constexpr std::pair<std::string_view, bool ModelData::*> flags[] = {
      {"/IMPLICIT", &ModelData::implicit},        {"/MONVOL", &ModelData::has_monitored_volume},
      {"/ALE/MAT", &ModelData::has_ale},          {"/EULER/MAT", &ModelData::has_ale},
      {"/ADMESH", &ModelData::has_adaptive_mesh}, {"/CAA", &ModelData::has_acoustics}};
  const Block* thickness = nullptr;
  for (const Block& block : c.deck.blocks) {
    if (header_starts(block, "/ANALY")) {
      m.two_dimensional = decode(c.deck, block).integer("N2D3D") != 0;
    } else if (header_starts(block, "/INTTHICK/V5")) {
      if (thickness != nullptr)
        report(c.findings,
               {RuleId::DK112, block.header_span, "a second /INTTHICK/V5", "/INTTHICK/V5"});
      thickness = &block;
      m.intthick_v5 = true;
    } else if (header_starts(block, "/RANDOM")) {
      const DecodedBlock d = decode(c.deck, block);
      const double noise = c.value(d, "Noise");
      if (noise == 0) continue;
      const Cell* seed = d.find("Seed");
      const bool other_seed = seed != nullptr && seed->real != 0;
      if (other_seed || block.header.starts_with("/RANDOM/GRNOD"))
        report(c.findings,
               {RuleId::DK119, block.header_span,
                other_seed ? "/RANDOM with a seed: deck does not reproduce the noise"
                           : "/RANDOM of a node group: deck does not reproduce the noise",
                "/RANDOM"});
      else {
        m.has_random = true;
        m.random_noise = noise;
      }
    }
    for (const auto& [keyword, flag] : flags)
      if (header_starts(block, keyword)) m.*flag = true;
  }
}

}  // namespace deck::detail
