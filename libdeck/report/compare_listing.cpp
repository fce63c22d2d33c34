// Compares a listing with its deck: places of messages and findings about them, contacts pair by
// pair, time steps row by row.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "base/shared/words.hpp"
#include "deck/lint.hpp"
#include "keyword/shared/place.hpp"
#include "keyword/shared/references.hpp"
#include "lint/shared/geometry.hpp"
#include "lint/shared/topics.hpp"
#include "model/shared/mesh.hpp"
#include "report/shared/inspection.hpp"

namespace deck {
namespace listing_comparison {
namespace {

/// Names of keywords in listings.
constexpr std::pair<std::string_view, std::string_view> keywords[] = {
    {"RIGID BODY", "/RBODY"}, {"RIGID WALL", "/RWALL"}, {"MONITORED VOLUME", "/MONVOL"},
    {"INTERFACE", "/INTER"},  {"PROPERTY", "/PROP"},    {"MATERIAL", "/MAT"},
    {"SURFACE", "/SURF"},     {"FUNCTION", "/FUNCT"},   {"PART", "/PART"},
    {"SENSOR", "/SENSOR"},    {"SKEW", "/SKEW"},        {"NODE GROUP", "/GRNOD"},
    {"SECTION", "/SECT"},     {"RBE2", "/RBE2"},        {"RBE3", "/RBE3"}};

/// True for "/INTER/TYPE7" below "/INTER", for "/RBODY" itself, and for "/FUNCT_SMOOTH".
bool is_below(std::string_view keyword, std::string_view above) {
  if (!keyword.starts_with(above)) return false;
  keyword.remove_prefix(above.size());
  return keyword.empty() || keyword[0] == '/' || keyword[0] == '_';
}

/// Entity of a message: the first one that it names, else its node.
std::string name_of(const ListedMessage& m) {
  if (m.ids.empty())
    return m.nodes.size() == 1 ? fmt::format("node {}", m.nodes.front()) : std::string();
  const ListedId& id = m.ids.front();
  return fmt::format("{} {}{}", in_lower_case(id.kind), id.id,
                     id.title.empty() ? "" : " '" + id.title + "'");
}

class ListingComparison {
 public:
  ListingComparison(const Listing& listing, LoadedDeck* loaded)
      : listing_(listing), loaded_(loaded) {
    if (loaded != nullptr) index_.emplace(loaded->deck());
  }

  ListingReport report() {
    if (loaded_ != nullptr) lint();
    for (const ListedMessage& m : listing_.messages) message(m);
    std::sort(out_.messages.begin(), out_.messages.end(),
              [](const MessageGroup& a, const MessageGroup& b) {
                return std::pair(a.severity, a.number) < std::pair(b.severity, b.number);
              });
    findings();
    if (loaded_ == nullptr) return std::move(out_);
    contacts();
    for (const auto& [kind, rows] : listing_.element_steps) steps(kind, rows);
    steps(std::nullopt, listing_.node_steps);
    return std::move(out_);
  }

 private:
  void lint() {
    SceneOptions options = loaded_->scene_options();
    options.candidates = false;
    options.ties = true;
    loaded_->set_scene_options(options);
    LintResult result = run_lint(
        *loaded_, {}, {[](const LintContext& c, Reporter& r) { return check_geometry(c, r); }});
    out_.findings = std::move(result.findings);
  }

  // ---- messages

  MessageGroup& group_of(const ListedMessage& m) {
    for (MessageGroup& g : out_.messages)
      if (g.number == m.number && g.severity == m.severity) return g;
    MessageSummary summary = summary_of_message(m.number);
    MessageGroup& group = out_.messages.emplace_back();
    group.number = m.number;
    group.severity = m.severity;
    group.title = std::move(summary.title);
    group.means = std::move(summary.means);
    group.action = std::move(summary.action);
    return group;
  }

  void message(const ListedMessage& m) {
    MessageGroup& group = group_of(m);
    ++group.times;
    // A message about several entities (properties of a material) counts for each. A damaged
    // listing may name too many for all combinations with nodes.
    constexpr std::size_t most_pairs = 100'000;
    std::vector<ListedId> entities;
    for (const ListedId& id : m.ids)
      if (id.kind == m.ids.front().kind) entities.push_back(id);
    ListedMessage part = m;
    if (entities.size() <= 1) return place(group, m, name_of(m));
    if (entities.size() * m.nodes.size() > most_pairs) {
      part.ids.resize(1);
      return place(group, part, fmt::format("{} and {} more", name_of(m), entities.size() - 1));
    }
    for (const ListedId& id : entities) {
      part.ids = {id};
      place(group, part, name_of(part));
    }
  }

  void place(MessageGroup& group, const ListedMessage& m, const std::string& name) {
    const auto [known, is_new] =
        place_of_.try_emplace(std::tuple(m.severity, m.number, name), group.places.size());
    if (is_new) {
      MessagePlace& place = group.places.emplace_back();
      place.name = name;
      if (!m.ids.empty())
        place.id = m.ids.front().id;
      else if (m.nodes.size() == 1)
        place.id = m.nodes.front();
      place.span = span_of(m);
    }
    MessagePlace& place = group.places[known->second];
    ++place.times;
    if (m.count &&
        std::find(place.counted.begin(), place.counted.end(), *m.count) == place.counted.end())
      place.counted.push_back(*m.count);
    place.lines.push_back(m.line);
    for (const std::int64_t node : m.nodes)
      if (known_nodes_.emplace(&known->second, node).second) place.nodes.push_back(node);
  }

  Span span_of(const ListedMessage& m) const {
    if (loaded_ == nullptr) return {};
    if (m.ids.empty()) {
      if (m.nodes.size() != 1) return {};
      const NodeIndex node = loaded_->model().nodes.map.find(m.nodes.front());
      return node == no_index ? Span{} : loaded_->model().node_span(node);
    }
    const ListedId& id = m.ids.front();
    for (const auto& [words, keyword] : keywords)
      if (id.kind.ends_with(words))
        for (const Block& b : loaded_->deck().blocks)
          if (b.schema != nullptr && is_below(b.schema->keyword, keyword) &&
              id_of(loaded_->deck(), b) == id.id)
            return b.header_span;
    return {};
  }

  /// True if a finding concerns the block. All nodes share one block.
  bool about(const Finding& d, const Block* of_finding, const Block* of_place) const {
    if (of_place == nullptr || of_place->schema == nullptr) return false;
    if (d.id == id_of(loaded_->deck(), *of_place) && d.keyword == of_place->schema->keyword)
      return true;
    return of_finding == of_place && of_place->schema->kind != "node";
  }

  const Block* block_at(const Span& span) const {
    const std::int64_t block = span.valid() ? index_->find(span.file, span.offset) : -1;
    return block < 0 ? nullptr : &loaded_->deck().blocks[static_cast<std::size_t>(block)];
  }

  /// Findings with the number of the message at its places; there also findings of its rule with
  /// another number.
  void add_findings(MessageGroup& group) {
    std::vector<const Block*> blocks;
    for (const MessagePlace& place : group.places) blocks.push_back(block_at(place.span));
    const auto is_it = [&](const ReferenceMessage& m) { return m.number == group.number; };
    for (std::size_t f = 0; f < out_.findings.size(); ++f) {
      const Finding& d = out_.findings[f];
      const auto& messages = rule_of(d.rule).messages;
      const bool own = d.reference && is_it(*d.reference);
      if (!own && std::none_of(messages.begin(), messages.end(), is_it)) continue;
      const Block* const of_finding = block_at(d.span);
      bool placed = false;
      for (std::size_t p = 0; p < blocks.size(); ++p)
        if (about(d, of_finding, blocks[p])) {
          group.places[p].findings.push_back(f);
          placed = true;
        }
      if (own && !placed) group.findings.push_back(f);
    }
  }

  void findings() {
    std::set<int> listed;
    for (MessageGroup& group : out_.messages) {
      add_findings(group);
      listed.insert(group.number);
    }
    for (std::size_t f = 0; f < out_.findings.size(); ++f) {
      const auto& reference = out_.findings[f].reference;
      // Only official programs print messages of the reader.
      if (reference && reference->severity != Severity::info && reference->number < 100000 &&
          !listed.contains(reference->number))
        out_.not_listed.push_back(f);
    }
  }

  // ---- contacts

  void contacts() {
    const Scene& scene = loaded_->scene();
    view_ = make_view(scene);
    const std::vector<const ListedContact*> listed = listed_contacts(scene);
    for (std::uint32_t c = 0; c < scene.contacts.size(); ++c)
      if (!scene.contacts[c].dropped && scene.contacts[c].points.empty()) contact(c, listed[c]);
  }

  /// Contacts with a header belong to the first part of their interface, those without to its other
  /// parts, in the order of work.
  std::vector<const ListedContact*> listed_contacts(const Scene& scene) {
    std::vector<const ListedContact*> of(scene.contacts.size(), nullptr);
    // Others are no contacts of the scene; 0: without header.
    static const std::set<int> compared{0, 7, 10, 11, 19, 24, 25};
    for (const ListedContact& listed : listing_.contacts) {
      if (!compared.contains(listed.type)) continue;
      const auto fits = [&](const Contact& contact) {
        const bool later_part = contact.inter->type == 19 && contact.role != ContactRole::primary;
        return !contact.dropped && later_part == (listed.type == 0 && contact.inter->type == 19) &&
               (listed.interface == 0 || contact.inter->id == listed.interface);
      };
      std::size_t c = 0;
      while (c < of.size() && (of[c] != nullptr || !fits(scene.contacts[c]))) ++c;
      if (c == of.size())
        ++out_.unnamed_contacts;
      else
        of[c] = &listed;
    }
    // Edges of a TYPE25 follow its nodes in one contact of the listing.
    for (std::size_t c = 1; c < of.size(); ++c)
      if (const Contact& k = scene.contacts[c]; k.type == 25 && k.role == ContactRole::edges)
        of[c] = of[c - 1];
    return of;
  }

  /// Pairs that a listing shows as penetrations; from level 6 on it shows others, too.
  std::vector<ListedPair> penetrations_of(const ListedContact& listed, bool edges) const {
    std::vector<ListedPair> out;
    for (const ListedPair& pair : listed.pairs)
      if (pair.main[0] != 0 && edges == (pair.secondary[1] != 0) &&
          (listing_.printout < 6 || pair.depth || pair.on_segment))
        out.push_back(pair);
    return out;
  }

  /// A pair regardless of the order of its nodes.
  using PairKey = std::pair<std::set<std::int64_t>, std::set<std::int64_t>>;
  template <class Pair>
  static PairKey key(const Pair& pair) {
    PairKey out{{pair.secondary.begin(), pair.secondary.end()},
                {pair.main.begin(), pair.main.end()}};
    out.first.erase(0);
    out.second.erase(0);
    return out;
  }

  void contact(std::uint32_t c, const ListedContact* listed) {
    const Contact& contact = loaded_->scene().contacts[c];
    ComparedContact out;
    out.contact = c;
    out.listed = listed;
    // Points on edges of a TYPE24 count among its nodes but are not in their table.
    const auto is_point = [&](std::uint32_t in) {
      const Contact& of = loaded_->scene().contacts[in];
      return !of.points.empty() && of.inter == contact.inter;
    };
    for (const auto* list : {&view_.penetrations, &view_.ties})
      for (std::size_t i = 0; i < list->size(); ++i)
        if (const std::uint32_t in = list->places[i].contact; in == c || is_point(in))
          out.pairs.push_back({(*list)[i], false, std::nullopt});
    if (listed != nullptr) {
      const bool edges = contact.kind == ContactKind::edge_edge,
                 edges25 = edges && contact.type == 25;
      std::vector<ListedPair> pairs = penetrations_of(*listed, edges);
      out.listed_count = (edges25 ? listed->edges : listed->total).value_or(pairs.size());
      out.by_pair = listing_.printout >= 1 && (!pairs.empty() || out.listed_count == 0);
      // Equal pairs are listed once.
      if (edges25) out.by_pair = out.by_pair && pairs.size() == out.listed_count;
      if (out.by_pair) match(contact, pairs, out);
      for (ComparedPair& p : out.pairs)
        if (is_point(p.pair.contact)) p.listed = out.listed_count == out.pairs.size();
    }
    out_.contacts.push_back(std::move(out));
  }

  static void match(const Contact& contact, const std::vector<ListedPair>& pairs,
                    ComparedContact& out) {
    std::map<PairKey, std::vector<std::size_t>> of_deck;
    for (std::size_t i = out.pairs.size(); i-- > 0;) of_deck[key(out.pairs[i].pair)].push_back(i);
    for (const ListedPair& pair : pairs) {
      const auto it = of_deck.find(key(pair));
      if (it == of_deck.end() || it->second.empty()) {
        out.only_listed.push_back(pair);
        continue;
      }
      ComparedPair& found = out.pairs[it->second.back()];
      it->second.pop_back();
      found.listed = true;
      found.listed_depth = pair.depth;
      const PenetrationRow& row = contact.penetrations[found.pair.row];
      if (pair.depth && row.gap > 0)
        out.largest_difference =
            std::max(out.largest_difference, std::abs(*pair.depth - row.depth) / row.gap);
    }
  }

  // ---- time steps

  void steps(std::optional<ElementKind> kind, const std::vector<ListedStep>& rows) {
    if (rows.empty()) return;
    const Model& model = loaded_->model();
    const Mesh& mesh = loaded_->mesh();
    const IdMap& map = kind ? model.family(*kind).map : model.nodes.map;
    const std::vector<double>& computed = kind ? mesh.of(*kind).dt : mesh.nodes.dt;
    ComparedSteps out;
    out.kind = kind;
    out.listed = rows.size();
    const auto smallest =
        std::min_element(rows.begin(), rows.end(),
                         [](const ListedStep& a, const ListedStep& b) { return a.dt < b.dt; });
    out.smallest = smallest->dt;
    out.smallest_id = smallest->id;
    for (const ListedStep& row : rows) {
      const std::uint32_t at = map.find(row.id);
      const double dt = at == no_index ? std::nan("") : computed[at];
      if (at != no_index && std::isnan(dt)) {
        ++out.not_computed;
        continue;
      }
      const double difference = std::abs(dt - row.dt) / std::max(std::abs(row.dt), 1e-300);
      if (difference <= step_tolerance) {
        ++out.equal;
        out.largest_difference = std::max(out.largest_difference, difference);
      } else {
        out.different.push_back({row.id, row.dt, dt});
      }
    }
    out_.steps.push_back(std::move(out));
  }

  const Listing& listing_;
  LoadedDeck* loaded_;
  std::optional<BlockIndex> index_;  ///< of the deck
  ListingReport out_;
  /// Positions in MessageGroup::places.
  std::map<std::tuple<Severity, int, std::string>, std::size_t> place_of_;
  std::set<std::pair<const std::size_t*, std::int64_t>> known_nodes_;  ///< by entry of place_of_
  SceneView view_;
};

}  // namespace
}  // namespace listing_comparison

bool ComparedContact::agrees() const {
  if (listed == nullptr) return pairs.empty();
  if (listed_count != pairs.size() || !only_listed.empty()) return false;
  return !by_pair ||
         std::all_of(pairs.begin(), pairs.end(), [](const ComparedPair& p) { return p.listed; });
}

bool ListingReport::agrees() const {
  return unnamed_contacts == 0 &&
         std::all_of(contacts.begin(), contacts.end(),
                     [](const ComparedContact& c) { return c.agrees(); }) &&
         std::all_of(steps.begin(), steps.end(),
                     [](const ComparedSteps& s) { return s.different.empty(); });
}

ListingReport explain_listing(const Listing& listing) {
  return listing_comparison::ListingComparison(listing, nullptr).report();
}

ListingReport compare_listing(const Listing& listing, LoadedDeck& loaded) {
  return listing_comparison::ListingComparison(listing, &loaded).report();
}

}  // namespace deck
