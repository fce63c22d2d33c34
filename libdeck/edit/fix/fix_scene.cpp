// Scenes for the strategies, counts of penetrations, and writing a number into its cell.
#include "edit/fix/fix_scene.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "deck/contacts.hpp"
#include "keyword/shared/line_check.hpp"

namespace deck::detail {

Result<LoadedDeck> read_again(const LoadedDeck& context, const Rewrite& rewrite) {
  const auto changed = apply_rewrite(context.deck().sources, rewrite);
  if (!changed) return changed.error();
  auto again = context.with(*changed);
  if (again && again->deck().includes.size() < context.deck().includes.size())
    return Error{Error::Code::io, context.deck().sources[0].path() +
                                      ": a file that it includes could be read before, "
                                      "but not again; nothing was fixed"};
  return again;
}

Scene fix_scene(const LoadedDeck& loaded, const FixOptions& options, bool as_written,
                std::vector<WhatIf> what_if, std::vector<std::int64_t> only) {
  // A scene costs seconds: reuse the one of the deck if its options are equal.
  const SceneOptions& known = loaded.scene_options();
  if (as_written && what_if.empty() && only.empty() && known.ties && known.penetrations &&
      known.what_if.empty() && known.only.empty())
    return loaded.scene();
  return fix_scene(loaded.model(), loaded.interfaces(), loaded.options().read.limits, options,
                   as_written, std::move(what_if), std::move(only));
}

Result<AfterRewrite> AfterRewrite::read(const LoadedDeck& context, const Rewrite& rewrite,
                                        const FixOptions& options, bool as_written,
                                        const Scene& before) {
  AfterRewrite out;
  out.before_ = &before;
  if (rewrite.edits.empty()) return out;
  auto again = read_again(context, rewrite);
  if (!again) return again.error();
  out.deck_.emplace(std::move(*again));
  out.own_.emplace(fix_scene(*out.deck_, options, as_written));
  return out;
}

Scene fix_scene(const Model& model, const Interfaces& interfaces, const Limits& limits,
                const FixOptions& options, bool as_written, std::vector<WhatIf> what_if,
                std::vector<std::int64_t> only) {
  SceneOptions scene;
  scene.threads = options.threads;
  scene.ties = only.empty();  // ties that a fix must keep
  scene.candidates = false;
  scene.limits = limits;
  scene.only = std::move(only);
  if (!as_written) {
    std::set<std::int64_t> known;
    for (const InterBase* inter : interfaces.ordered) {
      if (!known.insert(inter->id).second) continue;
      if (is_type24_or_25(inter->type)) continue;  // moves no node; Inacti is part of the search
      WhatIf still;
      still.interface_id = inter->id;
      still.Inacti = 0;
      scene.what_if.push_back(still);
    }
  }
  scene.what_if.insert(scene.what_if.end(), what_if.begin(), what_if.end());
  Findings unused;
  return build_scene(model, interfaces, unused, scene);
}

void add_refusal(PenetrationFix& fix, std::int64_t interface_id, std::string reason,
                 std::string next, double depth) {
  fix.refused.push_back({interface_id, {}, depth, std::move(reason), 0, std::move(next)});
}

std::optional<Error> unevaluated(const Scene& scene, const FixOptions& options) {
  for (const Contact& contact : scene.contacts)
    if (!contact.evaluated && is_wanted(options, contact) && !is_type24_or_25(contact.type))
      return Error{
          Error::Code::limit,
          "the penetrations of interface " + std::to_string(contact.inter->id) +
              " cannot be evaluated ('deck gaps' says why): nothing was fixed; --interface "
              "leaves it out"};
  return std::nullopt;
}

void note_unevaluated(PenetrationFix& fix, const Scene& scene, const FixOptions& options) {
  for (const Contact& contact : scene.contacts) {
    const bool points = !contact.points.empty() && !contact.penetrations.empty();
    if (contact.evaluated ? !points : !is_type24_or_25(contact.type)) continue;
    if (!asks_for(options, contact.inter->id)) continue;
    add_refusal(fix, contact.inter->id,
                points ? "points on its edges penetrate, which no node alone can cure"
                       : "not all of its contact is evaluated ('deck gaps' says what)",
                "deck gaps DECK");
    fix.complete = false;
  }
}

bool asks_for(const FixOptions& options, std::int64_t interface_id) {
  const auto& list = options.interfaces;
  return list.empty() || std::find(list.begin(), list.end(), interface_id) != list.end();
}

bool is_wanted(const FixOptions& options, const Contact& contact) {
  if ((contact.is_tied_contact() && !options.ties) || !contact.points.empty()) return false;
  return asks_for(options, contact.inter->id);
}

bool is_untreated(const PenetrationRow& row) {
  return row.action == PenetrationAction::none || row.action == PenetrationAction::ignored ||
         stops_solver(row.action);
}

std::map<std::int64_t, FixCount> count_interfaces(const Scene& scene, const FixOptions& options) {
  std::map<std::int64_t, FixCount> out;
  for (const Contact& contact : scene.contacts) {
    if (!is_wanted(options, contact) ||
        std::none_of(contact.penetrations.begin(), contact.penetrations.end(), is_penetration))
      continue;
    FixCount& count = out[contact.inter->id];
    std::set<std::uint32_t> nodes;
    for (const PenetrationRow& row : contact.penetrations) {
      if (!is_penetration(row)) continue;
      ++count.pairs;
      nodes.insert(row.secondary);
      count.untreated += is_untreated(row);
      count.on_surface += row.on_surface;
      count.deepest = std::max(count.deepest, row.depth);
    }
    count.nodes += nodes.size();
  }
  return out;
}

FixedInterface& interface_entry(PenetrationFix& fix, const InterBase& inter) {
  for (FixedInterface& entry : fix.interfaces)
    if (entry.id == inter.id) return entry;
  FixedInterface& entry = fix.interfaces.emplace_back();
  entry.id = inter.id;
  entry.type = inter.type;
  entry.title = inter.title;
  return entry;
}

void set_interfaces(PenetrationFix& fix, const Interfaces& interfaces, const FixOptions& options,
                    const Scene& before, const Scene& after) {
  const auto was = count_interfaces(before, options), is = count_interfaces(after, options);
  for (const InterBase* inter : interfaces.ordered) {
    const auto a = was.find(inter->id), b = is.find(inter->id);
    if (a == was.end() && b == is.end()) continue;
    FixedInterface& entry = interface_entry(fix, *inter);
    if (a != was.end()) entry.before = a->second;
    if (b != is.end()) entry.after = b->second;
  }
  std::sort(fix.interfaces.begin(), fix.interfaces.end(),
            [](const FixedInterface& a, const FixedInterface& b) { return a.id < b.id; });
}

std::map<std::uint32_t, const PenetrationRow*> deepest_rows(const Contact& contact) {
  std::map<std::uint32_t, const PenetrationRow*> out;
  for (const PenetrationRow& row : contact.penetrations) {
    if (!is_penetration(row)) continue;
    const PenetrationRow*& best = out[row.secondary];
    if (best == nullptr || row.depth > best->depth) best = &row;
  }
  return out;
}

std::vector<std::int64_t> node_ids(const Model& model, const Contact& contact,
                                   const PenetrationRow& row, bool main) {
  std::vector<std::int64_t> out;
  const auto add = [&](const auto& nodes) {
    for (const NodeIndex n : nodes) out.push_back(model.node_id(n));
  };
  if (contact.kind == ContactKind::edge_edge)
    add(main ? contact.main_edges[row.main].nodes : contact.secondary_edges[row.secondary].nodes);
  else if (main)
    add(contact.main[row.main].nodes);
  else
    out.push_back(model.node_id(contact.secondary[row.secondary].node));
  return out;
}

// ---- types ------------------------------------------------------------------------------------

namespace {

constexpr TypeRules table[] = {
    {7, "Fscalegap", {"Gapmax", ""}, true, 6, true},
    {10, "", {"", ""}, false, 6, false},
    {11, "", {"", ""}, false, 6, false},
    {19, "Fscalegap", {"Gapmax", ""}, true, 6, false},
    {24, "", {"Gap_max_s", "Gap_max_m"}, false, 5, false},
    {25, "Gap_scale", {"Gap_max_s", "Gap_max_m"}, false, 5, false},
};

}  // namespace

const TypeRules& rules_of(int type) {
  const auto it = std::find_if(std::begin(table), std::end(table),
                               [&](const TypeRules& r) { return r.type == type; });
  return it == std::end(table) ? table[0] : *it;
}

std::string why_not_inacti(int type, int value) {
  const std::string name = "TYPE" + std::to_string(type);
  if (is_type24_or_25(type)) {
    if (value == -1 || value == 0 || value == 5) return {};
    return name + " knows Inacti -1, 0 and 5 only: the solver would take " + std::to_string(value) +
           " as 5 (warning " + (type == 24 ? "1031" : "1559") + ")";
  }
  if (value == -1) return name + " has no Inacti -1: only TYPE24 and TYPE25 do";
  if (type == 10)
    return value == 5 ? "TYPE10 with Inacti 5 stops the solver (error 1162)"
                      : "TYPE10 runs with Inacti 0 whatever the card says; move the nodes or "
                        "reduce the gap";
  if (type == 11 && value == 3)
    return "TYPE11 does nothing for Inacti 3; use 5 or 6, or move the nodes";
  return {};
}

// ---- fields -----------------------------------------------------------------------------------

Result<FieldPlace> find_field(const Deck& deck, const Block& block, std::string_view name) {
  const DecodedBlock decoded = decode(deck, block);
  const auto fail = [&](const std::string& why) {
    return Error{Error::Code::config, deck.sources.where(block.header_span) + ": " + why};
  };
  for (const DecodedCard& card : decoded.cards) {
    if (card.schema == nullptr) continue;
    if (card.missing()) {
      for (const Field& field : card.schema->fields)
        if (field.name == name && field.in_version(block.version))
          return fail("the line that holds " + std::string(name) + " is missing");
      continue;
    }
    for (const Cell& cell : card.cells) {
      if (cell.field == nullptr || cell.field->name != name) continue;
      // Missing cells are at the end of the line.
      const auto end = std::min<std::size_t>(card.line.text.size(), line_columns);
      if (card.free_format && cell.blank() && cell.span.offset >= card.line.offset + end)
        return fail("its line with commas ends before " + std::string(name));
      const Field& f = *cell.field;
      FieldPlace place{{&block, cell.span, f.name, card.line, f.first, f.last, card.free_format},
                       cell.text};
      if (cell.field->type == FieldType::real) {
        if (deck.units_of(block) == nullptr) return fail("its unit system is not defined");
        Cell one = cell;
        one.real = 1;
        place.factor = working_value(deck, decoded, one);
      }
      return place;
    }
  }
  return fail("the card has no " + std::string(name) + " in input version " +
              std::to_string(block.version));
}

namespace {

/// value = mantissa * 10^exponent, the mantissa having `digits` digits.
struct RoundedNumber {
  std::int64_t mantissa = 0;
  int exponent = 0;
  double value() const {
    const std::string text = std::to_string(mantissa) + "e" + std::to_string(exponent);
    double out = 0;
    std::from_chars(text.data(), text.data() + text.size(), out);
    return out;
  }
  /// Next number with as many digits; `least` is the smallest mantissa: 9.9 is below 10.
  void step(int direction, std::int64_t least) {
    if (direction < 0 && mantissa == least) {
      mantissa *= 10;
      --exponent;
    }
    mantissa += direction;
  }
};

/// Nearest decimal with that many digits to `value` > 0.
RoundedNumber nearest(double value, int digits) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value,
                                 std::chars_format::scientific, digits - 1);
  const std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  RoundedNumber out;
  const auto e = text.find('e');
  for (const char c : text.substr(0, e))
    if (c != '.') out.mantissa = out.mantissa * 10 + (c - '0');
  int power = 0;
  std::string_view written = text.substr(e + 1);
  if (written.starts_with('+')) written.remove_prefix(1);
  std::from_chars(written.data(), written.data() + written.size(), power);
  out.exponent = power - digits + 1;
  return out;
}

template <class Accept>
std::optional<RoundedText> search(double bound, int digits, int width, int direction,
                                  const Accept& accept) {
  if (!(bound > 0)) return std::nullopt;
  for (int d = std::min(digits, 17); d >= 1; --d) {
    RoundedNumber number = nearest(bound, d);
    std::int64_t least = 1;
    for (int k = 1; k < d; ++k) least *= 10;
    // The nearest decimal is off by at most one step; `below` costs a few more.
    for (int tries = 0; tries < 4; ++tries, number.step(direction, least)) {
      const double value = number.value();
      if (!accept(value)) continue;
      const auto text = format_real(value, width);
      if (!text) break;
      const double back = read_real(text->text).value;
      if (back > 0 && accept(back)) return RoundedText{text->text, back};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<RoundedText> round_down(double bound, int digits, int width,
                                      std::optional<double> below) {
  return search(bound, digits, width, -1,
                [&](double v) { return v <= bound && (!below || v < *below); });
}

std::optional<RoundedText> round_up(double bound, int digits, int width) {
  return search(bound, digits, width, +1, [&](double v) { return v >= bound; });
}

std::string name_of(const InterBase& inter) {
  return "/INTER/TYPE" + std::to_string(inter.type) + "/" + std::to_string(inter.id);
}

}  // namespace deck::detail
