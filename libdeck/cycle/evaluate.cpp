// Runs a plan over a packet of pairs: the composed kernel, then effects behind the pair loop.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/shared/parallel.hpp"
#include "cycle/kernel/effects.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace detail {

Constants make_constants(const KernelPlan& plan, const PacketView& view) {
  const ContactCard& card = plan.card;
  Constants k;
  k.card = &plan.card;
  k.reach = card.ithe > 0 && card.kind == ContactKind::node_segment ? card.drad : 0.0;
  k.dt1 = view.dt1;
  k.inverse_dt1 = view.dt1 != 0.0 ? 1.0 / view.dt1 : 0.0;
  k.dt12 = view.dt12;
  AllEffects::for_each([&]<class E>() {
    if ((plan.effects & bit(E::effect)) != 0) E::prepare(plan, view, k);
  });
  return k;
}

}  // namespace detail

namespace {

using detail::block_pairs;
using detail::GeometryBlock;

template <std::size_t N>
bool present(const std::array<const double*, N>& arrays, std::size_t from = 0, std::size_t to = N) {
  return std::all_of(arrays.begin() + static_cast<std::ptrdiff_t>(from),
                     arrays.begin() + static_cast<std::ptrdiff_t>(to),
                     [](const double* p) { return p != nullptr; });
}

bool present3(const std::array<std::array<const double*, 3>, 5>& arrays, std::size_t roles) {
  return std::all_of(arrays.begin(), arrays.begin() + static_cast<std::ptrdiff_t>(roles),
                     [](const auto& a) { return present(a); });
}

bool all_triangles(const PacketView& view, std::size_t begin, std::size_t n) {
  return view.triangle != nullptr && std::all_of(view.triangle + begin, view.triangle + begin + n,
                                                 [](std::uint8_t t) { return t != 0; });
}

/// Geometry and force of pairs [begin, end), block by block. Packets shorter than a pack are padded
/// by the caller.
void evaluate_range(const KernelPlan& plan, const PacketView& view, const PacketView& wide,
                    std::size_t begin, std::size_t end, PacketResult& out) {
  const detail::Constants k = detail::make_constants(plan, view);
  const int width = plan.table->width;
  const bool tied = plan.card.kind == ContactKind::tied;
  const bool curved =
      plan.card.icurv >= 1 && plan.card.icurv <= 3 && plan.card.kind == ContactKind::node_segment;
  const bool triangles = plan.table->geometry_triangles != nullptr;
  for (std::size_t b = begin; b < end; b += block_pairs) {
    GeometryBlock block;
    const std::size_t n = std::min(block_pairs, end - b);
    // A last pack that steps back may contain a quadrangle of the block before.
    const bool only =
        triangles && n % static_cast<std::size_t>(width) == 0 && all_triangles(view, b, n);
    (only ? plan.table->geometry_triangles : plan.table->geometry)(k, wide, b, n, block);
    if (curved) detail::apply_curvature(plan, view, b, n, width, block);
    if (tied) {
      detail::force_tied_block(plan, view, b, n, width, block, out);
    } else {
      plan.table->force(k, plan.effects, view, b, n, block, out);
    }
    if (curved) detail::mark_kept(view, b, n, width, block, out);
  }
}

/// Copies of short arrays, filled up to one pack with their last value.
class PaddedView {
 public:
  PaddedView(const PacketView& view, std::size_t width) : view_(view), width_(width) {
    const std::size_t n = view.size;
    PacketView::for_each([&](const double*& p) { pad(p, n); }, view_);
    if (view.triangle != nullptr) {
      triangle_.assign(width, view.triangle[n - 1]);
      std::copy(view.triangle, view.triangle + n, triangle_.begin());
      view_.triangle = triangle_.data();
    }
    view_.size = width;
  }
  [[nodiscard]] const PacketView& view() const { return view_; }

 private:
  void pad(const double*& p, std::size_t n) {
    if (p == nullptr) return;
    std::vector<double>& own = store_.emplace_back(width_, p[n - 1]);
    std::copy(p, p + n, own.begin());
    p = own.data();
  }

  PacketView view_;
  std::size_t width_;
  std::vector<std::vector<double>> store_;
  std::vector<std::uint8_t> triangle_;
};

void shrink(PacketResult& out, std::size_t n) {
  out.size = n;
  PacketResult::for_each_array(out, [n](auto& array, Field, auto) { array.resize(n); });
}

void evaluate_split(const KernelPlan& plan, const PacketView& view, const PacketView& wide,
                    PacketResult& out, unsigned threads) {
  const std::size_t n = view.size;
  const std::size_t blocks = std::max<std::size_t>(1, n / block_pairs);  // last may be longer
  const std::size_t parts = std::min<std::size_t>(std::max(1u, threads), blocks);
  const auto bound = [&](std::size_t part) {
    return part == parts ? n : part * blocks / parts * block_pairs;
  };
  const auto run = [&](std::size_t part) {
    evaluate_range(plan, view, wide, bound(part), bound(part + 1), out);
    for (const detail::LateEffect* e : plan.late) {
      e->apply(plan, view, bound(part), bound(part + 1), out);
    }
  };
  parallel_items(static_cast<int>(parts), parts, run);
}

}  // namespace

Field missing_fields(const KernelPlan& plan, const PacketView& view) {
  const std::size_t roles = plan.card.kind == ContactKind::edge_edge ? 4 : 5;
  Field missing = Field::none;
  const auto check = [&](Field field, bool there) {
    if (contains(plan.needs, field) && !there) missing |= field;
  };
  check(Field::position, present3(view.position, roles));
  check(Field::velocity, present3(view.velocity, roles));
  check(Field::mass_secondary, view.mass[0] != nullptr);
  check(Field::mass_main, present(view.mass, 0, roles));
  check(Field::stiffness, view.k0 != nullptr);
  check(Field::gap, view.gap != nullptr);
  check(Field::residual_penetration, view.p0 != nullptr);
  check(Field::friction_memory, present(view.ft_old));
  const std::size_t tie = plan.card.kind == ContactKind::tied ? 6 : 8;
  check(Field::tie_record, present(view.tie, 0, tie));
  check(Field::temperature, present(view.temperature, 0, roles));
  check(Field::contact_area, present(view.edge_width));
  const bool directions =
      present(view.ortho_direction) || (present(view.ortho_axis[0]) && present(view.ortho_axis[1]));
  check(Field::pair_friction,
        !plan.card.fric_orthotropic || (present(view.ortho_mu) && directions));
  check(Field::nodal_normals, std::all_of(view.normal.begin(), view.normal.end(),
                                          [](const auto& corner) { return present(corner); }));
  return missing;
}

void evaluate(const KernelPlan& plan, const PacketView& view, PacketResult& result,
              unsigned threads) {
  if (view.size == 0) {
    result.resize(0);
    return;
  }
  if (plan.table == nullptr || missing_fields(plan, view) != Field::none) {
    throw std::invalid_argument("evaluate: the packet lacks arrays that the plan needs");
  }
  const auto width = static_cast<std::size_t>(plan.table->width);
  if (view.size < width) {
    const PaddedView padded(view, width);
    evaluate(plan, padded.view(), result, 1);
    shrink(result, view.size);
    return;
  }
  result.prepare(view.size, plan.writes);
  if (plan.card.icurv == 3 && plan.card.kind == ContactKind::node_segment) {
    // Curved surfaces leave the facet: weights are needed beyond the gap.
    std::vector<double> reach(view.size);
    for (std::size_t i = 0; i < view.size; ++i) {
      reach[i] = view.gap[i] + (view.allowance != nullptr ? view.allowance[i]
                                                          : detail::bicubic_allowance(view, i));
    }
    PacketView wide = view;
    wide.gap = reach.data();
    evaluate_split(plan, view, wide, result, threads);
    return;
  }
  evaluate_split(plan, view, view, result, threads);
}

void RunningTotals::add(const PacketView& view, const PacketResult& r) {
  constexpr std::size_t pairs_of_a_block = 4096;
  const ContactCard& card = plan_->card;
  const bool edges = card.kind == ContactKind::edge_edge;
  for (std::size_t i = 0; i < r.size; ++i) {
    Totals& t = block_;
    const detail::Vec n{r.normal[0][i], r.normal[1][i], r.normal[2][i]};
    const detail::Vec f{r.force[0][i], r.force[1][i], r.force[2][i]};
    const detail::Vec fn = r.normal_force[i] * n;
    const detail::Vec ft = f - fn;
    const detail::Vec s = edges ? r.weights[0][i] * detail::at(view.position[0], i) +
                                      r.weights[1][i] * detail::at(view.position[1], i)
                                : detail::at(view.position[0], i);
    // The solver takes the moment at x_s + pi n.
    const detail::Vec m = cross(s + r.penetration[i] * n, f);
    t.normal = {t.normal[0] + fn.x, t.normal[1] + fn.y, t.normal[2] + fn.z};
    t.tangential = {t.tangential[0] + ft.x, t.tangential[1] + ft.y, t.tangential[2] + ft.z};
    t.moment = {t.moment[0] + m.x, t.moment[1] + m.y, t.moment[2] + m.z};
    t.normal_abs += std::abs(r.normal_force[i]);
    t.total_abs += norm(f);
    t.elastic_energy += r.elastic_energy[i];
    t.friction_energy += r.friction_energy[i];
    t.damping_energy += r.damping_energy[i];
    // Booked in full with the main side's share, although Ithe_form 0 loses that share.
    if (card.ithe > 0) t.friction_heat += (card.fheats + card.fheatm) * r.friction_heat[i];
    if (r.dt_kinematic[i] < t.dt_kinematic) {
      t.dt_kinematic = r.dt_kinematic[i];
      t.dt_kinematic_pair = pairs_;
    }
    if ((r.status[i] & status_contact) != 0) ++t.contacts;
    if (++pairs_ % pairs_of_a_block != 0) continue;
    all_.add(block_);
    block_ = {};
  }
}

Totals RunningTotals::all() const {
  Totals sum = all_;
  sum.add(block_);
  return sum;
}

Totals totals(const KernelPlan& plan, const PacketView& view, const PacketResult& r) {
  RunningTotals sum(plan);
  sum.add(view, r);
  return sum.all();
}

double pair_stiffness(const ContactCard& card, double k_main, double k_secondary, Model model) {
  if (card.kind == ContactKind::tied) return k_main;
  const bool edges = card.kind == ContactKind::edge_edge;
  const auto clamp = [&](double z) { return std::max(card.stmin, std::min(z, card.stmax)); };
  const double floor = edges ? 1e-20 : 1e-30;
  const double sum = k_main + k_secondary;
  const double guard = model == Model::reference ? floor : 0.0;
  const double series =
      std::max(guard, sum) > 0.0 ? k_main * k_secondary / std::max(guard, sum) : 0.0;
  switch (card.istf) {
    case 2:
      return clamp(0.5 * sum);
    case 3:
      return clamp(std::max(k_main, k_secondary));
    case 4:
      return clamp(std::min(k_main, k_secondary));
    case 5:
      return clamp(series);
    case 1:
      return edges ? 0.5 * std::abs(card.stfac) : k_main * std::abs(k_secondary);
    default:
      return edges ? clamp(series) : k_main * std::abs(k_secondary);
  }
}

double edge_residual(const ContactCard& card, double penetration, double gap) {
  if (card.inacti == 5) return 0.5 * penetration;
  if (card.inacti == 6) return 0.5 * (penetration + 0.05 * (gap - penetration));
  return 0.0;
}

}  // namespace deck::cycle
