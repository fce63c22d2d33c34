// Maps columns of recorded states to inputs of the kernel.
#include "replay/states.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "cycle/adapter/effect_inputs.hpp"

namespace deck::cycle::detail {
namespace {

std::vector<std::string> needed_columns(const std::string& kind) {
  std::vector<std::string> names{"dt1"};
  const auto triples = [&](std::initializer_list<const char*> stems) {
    for (const char* stem : stems)
      for (const char* axis : {"_x", "_y", "_z"}) names.push_back(std::string(stem) + axis);
  };
  const auto more = [&](std::initializer_list<const char*> list) {
    names.insert(names.end(), list.begin(), list.end());
  };
  if (kind == "edge_edge" || kind == "heat_edges") triples({"xs1", "xs2", "xm1", "xm2"});
  if (kind == "edge_edge") {
    triples({"vs1", "vs2", "vm1", "vm2", "f3", "f4"});
    more({"dt12", "K0", "gap", "pen_s_used", "pen_m_used", "mass_s1"});
    return names;
  }
  if (kind == "heat_edges") {
    for (const char* r : {"s1", "s2", "m1", "m2"}) {
      names.push_back(std::string("h") + r);
      names.push_back(std::string("T") + r);
      names.push_back(std::string("Q_") + r);
    }
    more({"area", "Fn", "gap", "gap_eff", "r"});
    return names;
  }
  triples({"xs", "x1", "x2", "x3", "x4"});
  if (kind == "heat") {
    for (const char* r : {"s", "1", "2", "3", "4"}) {
      names.push_back(std::string("T") + r);
      names.push_back(std::string("Q_") + r);
    }
    more({"H1", "H2", "H3", "H4", "area_s", "Fn", "E_fric", "gap"});
    return names;
  }
  triples({"vs", "v1", "v2", "v3", "v4", "F"});
  more({"dt12", "K0", "gap", "ms"});
  return names;
}

template <std::size_t N>
bool all_there(const std::array<const double*, N>& columns) {
  return std::all_of(columns.begin(), columns.end(), [](const double* p) { return p != nullptr; });
}

}  // namespace

std::string kind_of(const Table& t) {
  if (t.has("Q_s1")) return "heat_edges";
  if (t.has("E_fric")) return "heat";
  if (t.has("hs1")) return "edge_edge";
  if (t.has("Fn_in")) return "tied";
  return "node_segment";
}

std::string check_columns(const Table& t, const std::string& kind, const ContactCard& card) {
  for (const std::string& name : needed_columns(kind)) {
    if (!t.has(name)) return "column " + name + " is missing";
  }
  const ContactKind expected = kind == "edge_edge" || kind == "heat_edges" ? ContactKind::edge_edge
                               : kind == "tied"                            ? ContactKind::tied
                                                : ContactKind::node_segment;
  if (card.kind != expected) return "the states (" + kind + ") do not fit the interface's type";
  return {};
}

RecordedDeck::RecordedDeck(const Scene* scene, const Table& table) : scene_(scene) {
  interface_ = table.column("interface");
  id_ = {table.column("node"), table.column("n1"), table.column("n2"), table.column("n3"),
         table.column("n4")};
  if (scene_ == nullptr) return;
  if (!all_there(id_)) scene_ = nullptr;
  for (std::size_t i = 0; scene_ != nullptr && i < scene_->contacts.size(); ++i) {
    const deck::Contact& c = scene_->contacts[i];
    if (!c.dropped && c.kind != deck::ContactKind::edge_edge) add(c);
  }
}

void RecordedDeck::add(const deck::Contact& contact) {
  const auto& id = scene_->model->nodes.id;
  Lists lists;
  lists.contact = &contact;
  for (std::uint32_t i = 0; i < contact.secondary.size(); ++i)
    lists.secondary.emplace(id[contact.secondary[i].node], i);
  for (std::uint32_t i = 0; i < contact.main.size(); ++i) {
    const auto& n = contact.main[i].nodes;
    lists.main.emplace(std::array{id[n[0]], id[n[1]], id[n[2]], id[n[3]]}, i);
  }
  std::vector<std::uint32_t> order(contact.main.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto element = [&](std::uint32_t i) {
    const MainSegment& m = contact.main[i];
    const bool shell4 = m.carrier == Carrier::shell4, shell3 = m.carrier == Carrier::shell3;
    if (m.element == no_index || !(shell4 || shell3 || m.carrier == Carrier::solid))
      return std::int64_t{0};
    const ElementKind kind =
        shell4 ? ElementKind::shell4 : (shell3 ? ElementKind::shell3 : ElementKind::solid8);
    return scene_->model->family(kind).id[m.element];
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return element(a) < element(b); });
  lists.rank.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) lists.rank[order[k]] = k;
  lists_.push_back(std::move(lists));
}

std::optional<RecordedDeck::RowPlace> RecordedDeck::place(std::size_t row) const {
  if (!known()) return std::nullopt;
  const auto id = [&](std::size_t role) { return static_cast<std::int64_t>(id_[role][row]); };
  for (const Lists& lists : lists_) {
    if (interface_ != nullptr && interface_[row] != static_cast<double>(lists.contact->inter->id))
      continue;
    const auto s = lists.secondary.find(id(0));
    const auto m = lists.main.find({id(1), id(2), id(3), id(4)});
    if (s != lists.secondary.end() && m != lists.main.end())
      return RowPlace{lists.contact,
                      {s->second, m->second},
                      s->second * lists.rank.size() + lists.rank[m->second]};
  }
  return std::nullopt;
}

States::States(const Table& table, const std::string& kind, const RecordedDeck& deck, bool as_used,
               ContactCard card, std::string& error)
    : card_(std::move(card)) {
  const bool edges = kind == "edge_edge";
  read_geometry(table, edges);
  read_ties(table, kind == "tied");
  if (const double* dtmin = table.column("dtmin"); dtmin != nullptr && table.rows() > 0) {
    card_.dtmin = dtmin[0];
    if (!std::all_of(dtmin, dtmin + table.rows(), [&](double v) { return v == dtmin[0]; }))
      error = "column dtmin changes, but all states of one card must have the same value";
  }
  if (card_.iadm == 0 && table.has("R_seg")) {
    // Recorded criteria mean adaptive meshing, which is not in the deck.
    card_.iadm = table.has("P_s") || table.has("A_s") ? 2 : 1;
    if (card_.iadm == 1) card_.nradm = card_.padm = 1.0;
    if (card_.iadm == 1) card_.angladm = 0.0;
  }
  if (!edges && kind != "tied") read_friction(table, deck, as_used, error);
}

void States::read_geometry(const Table& t, bool edges) {
  const std::array<std::string, 5> role =
      edges ? std::array<std::string, 5>{"s1", "s2", "m1", "m2", ""}
            : std::array<std::string, 5>{"s", "1", "2", "3", "4"};
  for (std::size_t r = 0; r < (edges ? 4u : 5u); ++r) {
    view_.position[r] = t.triple("x" + role[r]);
    view_.velocity[r] = t.triple("v" + role[r]);
    view_.mass[r] = t.column((edges ? "mass_" : "m") + role[r]);
    view_.temperature[r] = t.column("T" + role[r]);
  }
  view_.k0 = t.column("K0");
  view_.gap = t.column("gap");
  view_.p0 = t.column("P0_in");
  view_.ft_old = t.triple("ft_in");
  for (std::size_t k = 0; k < 4; ++k) view_.normal[k] = t.triple("N" + std::to_string(k + 1));
  if (edges) {
    const double* s = t.column("pen_s_used");
    const double* m = t.column("pen_m_used");
    for (std::size_t i = 0; s && m && i < t.rows(); ++i) residual_.push_back(s[i] + m[i]);
    view_.p0 = residual_.data();
    return;
  }
  const double* n3 = t.column("n3");
  const double* n4 = t.column("n4");
  for (std::size_t i = 0; n3 && n4 && i < t.rows(); ++i) triangle_.push_back(n3[i] == n4[i]);
}

void States::read_ties(const Table& t, bool tied) {
  if (tied) {
    view_.tie = {t.column("Fn_in"), t.column("Ft1_in"), t.column("Ft2_in"),
                 t.column("H1_in"), t.column("H2_in"),  t.column("H3_in")};
    return;
  }
  const char* const part[] = {"Fn", "Ft1", "Ft2", "H1", "H2", "H3", "pen", "side"};
  for (std::size_t k = 0; k < 8; ++k) view_.tie[k] = t.column(std::string("tie_in_") + part[k]);
}

void States::read_friction(const Table& t, const RecordedDeck& deck, bool as_used,
                           std::string& error) {
  // As used: the solver's value can be of another pair.
  if (as_used && card_.icurv == 3) view_.allowance = t.column("cmaj");
  const double* mu = t.column("mu0");
  if (!as_used || mu == nullptr) {
    if (card_.fric_id) read_own_friction(t, deck, error);
    return;
  }
  const double own_visf = card_.visf != 0.0 ? card_.visf : 1.0;
  card_.fct_idf.reset();
  card_.fric_id = true;
  view_.fric = mu;
  view_.c = t.numbered<6>("c");
  view_.visf2 = t.column("visf");
  if (view_.visf2 == nullptr) {  // the card's value is squared, that of /FRICTION is not
    visf2_.assign(t.rows(), own_visf * own_visf);
    view_.visf2 = visf2_.data();
  }
  const double* across = t.column("mu0_2");
  card_.fric_orthotropic = across != nullptr;
  if (across == nullptr) return;
  for (std::size_t i = 0; i < t.rows(); ++i) directed_.push_back(across[i] != 0.0 ? 1.0 : 0.0);
  view_.directed = directed_.data();
  view_.ortho_mu = {mu, across};
  view_.c2 = t.numbered<6>("c", "_2");
  view_.ortho_axis = {t.triple("d1"), t.triple("d2")};
}

void States::read_own_friction(const Table& t, const RecordedDeck& deck, std::string& error) {
  std::map<const deck::Contact*, std::vector<std::size_t>> rows;
  const double* interface = t.column("interface");
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const auto place = deck.place(i);
    if (place) {
      rows[place->contact].push_back(i);
    } else if (interface == nullptr || !deck.known() ||
               interface[i] == static_cast<double>(deck.scene().contacts.front().inter->id)) {
      error =
          "row " + std::to_string(i + 1) +
          " has no friction values of its own (mu0, visf, c1 ...), and the deck has no such pair";
      return;
    }
  }
  const auto spread = [&](const std::vector<double>& from, const std::vector<std::size_t>& to,
                          std::vector<double>& all) {
    if (from.empty()) return;
    all.resize(t.rows(), 0.0);
    for (std::size_t k = 0; k < to.size(); ++k) all[to[k]] = from[k];
  };
  for (const auto& [contact, list] : rows) {
    ContactPairs some;
    for (const std::size_t i : list) some.at.push_back(deck.place(i)->pair);
    pair_friction(deck.scene(), *contact, some);
    ContactPairs::for_each(
        [&, &list = list](const auto& from, auto& all) { spread(from, list, all); },
        std::as_const(some), own_);
  }
  view_.point_at(own_);
}

PacketView States::rows(std::size_t first, std::size_t n) const {
  PacketView v = view_;
  v.size = n;
  const auto shift = [first](const double*& p) {
    if (p != nullptr) p += first;
  };
  PacketView::for_each(shift, v);
  v.triangle = triangle_.empty() ? nullptr : triangle_.data() + first;
  return v;
}

}  // namespace deck::cycle::detail
