// The chart of `deck accuracy`: wrong decisions or error against time per pair, with a line
// through the number types that no other type beats in both, drawn as SVG. Colours are classes, so
// that a page can give it another ground.
#include "report/accuracy_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shared/escape.hpp"

namespace deck {
namespace {

constexpr double chart_width = 920, panel_height = 440, head_height = 44, foot_height = 70;
constexpr double panel_left = 84, panel_right = 890, panel_top = 34,
                 panel_bottom = 372;  // within a panel

// The tiers of one kind, and what is drawn upwards for them.
struct Panel {
  std::string what, title, label;
  std::vector<const TierResult*> tiers;
  bool scaled = false;              // over the size of the pair
  double floor = -18, ceiling = 4;  // powers of ten; exact results stand on the floor
  double first = 0, last = 5;       // powers of ten of nanoseconds

  bool counts() const { return what == "gaps"; }
  double error(const TierResult& t) const {
    if (counts()) return static_cast<double>(t.decision_errors);
    return scaled ? t.max_scaled_error : t.max_relative_error;
  }
  double x(double ns) const {
    return panel_left +
           (std::log10(std::max(ns, 1e-3)) - first) / (last - first) * (panel_right - panel_left);
  }
  double y(double error) const {
    const double at =
        error > 0.0 ? std::clamp(std::log10(std::min(error, 1e300)), floor, ceiling) : floor;
    return panel_bottom - (at - floor) / (ceiling - floor) * (panel_bottom - panel_top);
  }
  // Another one is not slower and has no larger error on this axis, and is better in one of both.
  // Times that differ by no more than they do from run to run are equal.
  const TierResult* better_than(const TierResult& t) const {
    const TierResult* best = nullptr;
    for (const TierResult* o : tiers) {
      const double noise = 1.0 + o->spread + t.spread, a = error(*o), b = error(t);
      const bool faster = o->ns_per_pair * noise < t.ns_per_pair;
      const bool slower = o->ns_per_pair > t.ns_per_pair * noise;
      if (o == &t || slower || a > b || !(faster || a < b)) continue;
      if (best == nullptr || o->ns_per_pair < best->ns_per_pair) best = o;
    }
    return best;
  }
  bool beaten(const TierResult& t) const { return better_than(t) != nullptr; }
};

// Hard cases have exact distances of 0 and 1e-300: there the error is taken over the pair's size.
Panel panel_of(const AccuracyReport& report, const std::string& what) {
  Panel p;
  p.what = what;
  p.scaled = report.scene == "hard-cases";
  double low = 1e12, high = 1, most = 1;
  for (const TierResult& t : report.tiers) {
    if (t.what != what) continue;
    p.tiers.push_back(&t);
    low = std::min(low, t.ns_per_pair);
    high = std::max(high, t.ns_per_pair);
    most = std::max(most, static_cast<double>(t.decision_errors));
  }
  p.first = std::floor(std::log10(std::max(low, 1e-3)));
  p.last = std::max(p.first + 1, std::ceil(std::log10(high)));
  if (what == "gaps") {
    const auto pairs = p.tiers.empty() ? 0 : p.tiers[0]->samples;
    p.title = p.scaled ? "Contact decision" : "Whole deck gaps, reading included";
    p.label = fmt::format("wrong decisions of {}", pairs);
    p.floor = -0.7, p.ceiling = std::ceil(std::log10(most) + 0.1);
  } else {
    p.title = what == "force" ? "Elastic contact force" : "Distance";
    p.label = p.scaled ? "worst error of the distance / size of the pair"
                       : "worst relative error of the " + what;
    if (what == "force" && p.scaled) p.label += ", from the force";
  }
  return p;
}

std::string line(double x1, double y1, double x2, double y2, std::string_view kind) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' class='{}'/>\n", x1, y1,
                     x2, y2, kind);
}
std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view extra = "") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor,
                     extra, xml_text(content));
}

// 10 ns, 100 ns, 1 us ...
std::string time_text(double power) {
  static constexpr const char* units[] = {"ns", "\xc2\xb5s", "ms", "s"};
  if (power < 0) return fmt::format("{:g} ns", std::pow(10.0, power));
  const int unit = std::min(3, static_cast<int>(power) / 3);
  return fmt::format("{:g} {}", std::pow(10.0, power - 3 * unit), units[unit]);
}

std::string power_of_ten(double power) {
  static constexpr const char* digits[] = {
      "\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",     "\xe2\x81\xb4",
      "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7", "\xe2\x81\xb8", "\xe2\x81\xb9"};
  if (power == 0) return "1";
  std::string out = "10";
  for (const char c : fmt::format("{:.0f}", power))
    out += c == '-' ? "\xe2\x81\xbb" : digits[c - '0'];
  return out;
}

std::string frame(const Panel& panel) {
  std::string out = text(panel_left, panel_top - 14, "start", panel.title, "class='dk-title'");
  for (double p = panel.first; p <= panel.last; ++p) {
    const double x = panel.x(std::pow(10.0, p));
    out += line(x, panel_top, x, panel_bottom, "dk-grid");
    out += text(x, panel_bottom + 18, "middle", time_text(p));
    for (const double part : {2.0, 5.0})
      if (p < panel.last) {
        const double at = panel.x(part * std::pow(10.0, p));
        out += line(at, panel_bottom - 5, at, panel_bottom, "dk-grid");
      }
  }
  const auto level = [&](double y, const std::string& label) {
    out += line(panel_left, y, panel_right, y, "dk-grid");
    out += text(panel_left - 8, y + 4, "end", label);
  };
  level(panel_bottom, panel.counts() ? "none" : "exact");
  if (panel.counts()) {
    for (double p = 0; p <= panel.ceiling; ++p)
      level(panel.y(std::pow(10.0, p)), fmt::format("{:.0f}", std::pow(10.0, p)));
  } else {
    for (double p = panel.floor + 2; p <= panel.ceiling; p += 4)
      if (panel.y(std::pow(10.0, p)) > panel_top + 16)
        level(panel.y(std::pow(10.0, p)), power_of_ten(p));
    level(panel_top, "more");
    const double ulp = panel.y(0x1p-52);
    out += line(panel_left, ulp, panel_right, ulp, "dk-ulp");
    out += text(panel_right - 4, ulp - 4, "end", "1 ulp");
  }
  out += text(0.5 * (panel_left + panel_right), panel_bottom + 38, "middle", "time per pair");
  out += text(18, 0.5 * (panel_top + panel_bottom), "middle", panel.label,
              fmt::format("transform='rotate(-90 18 {:.1f})'", 0.5 * (panel_top + panel_bottom)));
  return out;
}

// The line through the tiers that no other tier beats in both time and accuracy.
std::string frontier(const Panel& panel) {
  std::vector<const TierResult*> best;
  for (const TierResult* t : panel.tiers)
    if (!panel.beaten(*t)) best.push_back(t);
  std::sort(best.begin(), best.end(), [](const TierResult* a, const TierResult* b) {
    return a->ns_per_pair < b->ns_per_pair;
  });
  std::string path;
  for (const TierResult* t : best) {
    const double x = panel.x(t->ns_per_pair), y = panel.y(panel.error(*t));
    path += path.empty() ? fmt::format("M{:.1f} {:.1f} V{:.1f}", x, panel_top, y)
                         : fmt::format(" H{:.1f} V{:.1f}", x, y);
  }
  return path.empty()
             ? path
             : fmt::format("<path d='{} H{:.1f}' class='dk-frontier'/>\n", path, panel_right);
}

struct LabelBox {
  double x, y, width, height;
  bool meets(const LabelBox& b) const {
    return x < b.x + b.width && b.x < x + width && y < b.y + b.height && b.y < y + height;
  }
  bool inside() const {
    return x >= panel_left && x + width <= panel_right && y >= panel_top - 8 &&
           y + height <= panel_bottom + 2;
  }
};

// The place nearest to the mark that is clear of all marks and labels so far.
LabelBox place_label(double x, double y, double width, const std::vector<LabelBox>& taken) {
  const LabelBox fallback{x + 10, y - 7, width, 14};
  for (double far = 10; far < 160; far += 8)
    for (int k = 0; k < 16; ++k) {
      // Right first, then left, then above and below.
      static constexpr int order[] = {0, 8, 4, 12, 2, 14, 6, 10, 1, 15, 7, 9, 3, 13, 5, 11};
      const double angle = order[k] * 0.39269908169872414;
      const double cx = x + far * std::cos(angle), cy = y - far * std::sin(angle);
      const double shift = 0.5 * width * std::cos(angle);
      const LabelBox box{cx + shift - 0.5 * width, cy - 7, width, 14};
      if (!box.inside()) continue;
      if (std::none_of(taken.begin(), taken.end(), [&](const LabelBox& b) { return b.meets(box); }))
        return box;
    }
  return fallback;
}

/// Why the default is the default though another one is better on these axes; "" if none is.
std::string reason(const Panel& panel, const TierResult& standard) {
  const TierResult* other = panel.better_than(standard);
  if (other == nullptr) return {};
  const bool proves = other->name == "exact" || other->name == "epeck" || other->name == "interval";
  return fmt::format("{} is better than robust on these pairs{}", other->name,
                     proves ? "." : ", but proves none of its answers; robust proves each.");
}

std::string marks(const Panel& panel) {
  std::string out;
  std::vector<LabelBox> taken;
  if (!panel.counts())
    taken.push_back({panel_right - 44, panel.y(0x1p-52) - 18, 44, 18});  // "1 ulp"
  for (const TierResult* t : panel.tiers)
    taken.push_back({panel.x(t->ns_per_pair) - 8, panel.y(panel.error(*t)) - 8, 16, 16});
  for (const TierResult* tier : panel.tiers) {
    const TierResult& t = *tier;
    const double x = panel.x(t.ns_per_pair), y = panel.y(panel.error(t));
    const bool standard = t.name == "robust";
    const std::string name = standard ? t.name + " (default)" : t.name;
    const LabelBox box = place_label(x, y, 7.0 * static_cast<double>(name.size()), taken);
    taken.push_back(box);
    const double near = std::clamp(x, box.x, box.x + box.width);
    if (std::hypot(near - x, box.y + 7 - y) > 22) out += line(x, y, near, box.y + 7, "dk-lead");
    if (standard)
      out += fmt::format(
          "<rect x='{:.1f}' y='{:.1f}' width='20' height='20' rx='10' class='dk-default'/>\n",
          x - 10, y - 10);
    out += fmt::format(
        "<circle cx='{:.1f}' cy='{:.1f}' r='5' class='{}'><title>{}: {:.4g} ns, "
        "{}</title></circle>\n",
        x, y, !standard && panel.beaten(t) ? "dk-mark dk-hollow" : "dk-mark", xml_text(t.name),
        t.ns_per_pair,
        panel.counts() ? fmt::format("{} wrong", t.decision_errors)
                       : fmt::format("error {:.3g}", panel.error(t)));
    out += text(box.x, box.y + 11, "start", name,
                standard ? "class='dk-label dk-strong'" : "class='dk-label'");
    if (standard)
      out += text(panel_right, panel_bottom + 58, "end", reason(panel, t), "class='dk-reason'");
  }
  return out + text(panel_right, panel_bottom + 38, "end",
                    "hollow: another tier is as fast and not worse on this axis");
}

constexpr std::string_view chart_style =
    "<style>.dk-ground{fill:#fff} .dk-grid{stroke:#dde2e8} "
    ".dk-ulp{stroke:#b3261e;stroke-dasharray:5 4} "
    ".dk-frontier{fill:none;stroke:#1f5fd0;stroke-width:2;stroke-opacity:.35} "
    ".dk-lead{stroke:#5c6979;stroke-width:.8} "
    ".dk-mark{fill:#1f5fd0;stroke:#1f5fd0;stroke-width:2} .dk-mark.dk-hollow{fill:#fff} "
    ".dk-default{fill:none;stroke:#9a5b00;stroke-width:2} .dk-svg text{fill:#5c6979} "
    ".dk-svg .dk-label{fill:#17202b;stroke:#fff;stroke-width:3px;paint-order:stroke} .dk-svg "
    ".dk-strong{font-weight:bold} "
    ".dk-line{fill:none;stroke-width:1.8} .dk-wide{stroke-width:6;stroke-opacity:.4} "
    ".dk-line.dk-reference{stroke:#b3261e} .dk-line.dk-fast{stroke:#1f5fd0} "
    ".dk-line.dk-robust{stroke:#17202b;stroke-dasharray:6 4} .dk-line.dk-exact{stroke:#0b6b3a} "
    ".dk-svg .dk-title{fill:#17202b;font-size:13px;font-weight:bold}</style>\n";

std::string open_svg(double width, double height, const std::string& name) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' class='dk-svg' viewBox='0 0 {0} {1}' width='{0}' "
      "height='{1}' "
      "font-family='system-ui, sans-serif' font-size='12' role='img' aria-label='{3}'>\n{2}<rect "
      "width='{0}' "
      "height='{1}' class='dk-ground'/>\n",
      width, height, chart_style, xml_text(name));
}

}  // namespace

std::string accuracy_title(const AccuracyReport& report, const AccuracyContext& context) {
  const std::uint64_t n = report.tiers.empty() ? 0 : report.tiers[0].samples;
  return fmt::format("Accuracy against time: {} pairs of {}", n,
                     context.path.empty() ? "the hard cases" : terminal_text(context.path));
}

std::string accuracy_panel(const AccuracyReport& report, const std::string& what) {
  const Panel panel = panel_of(report, what);
  if (panel.tiers.empty()) return {};
  return open_svg(chart_width, panel_height, panel.title + ": " + panel.label + " against time") +
         frame(panel) + frontier(panel) + marks(panel) + "</svg>\n";
}

std::string motion_panel(const HardMotion& motion) {
  constexpr double width = 360, height = 264, left = 30, right = 348, top = 62, bottom = 226;
  double most = 1.0;
  for (const HardMotion::Line& l : motion.lines)
    most = std::max(most, std::ceil(*std::max_element(l.force.begin(), l.force.end())));
  const std::size_t last = motion.lines.front().force.size() - 1;
  const auto x = [&](std::size_t step) {
    return left + static_cast<double>(step) / static_cast<double>(last) * (right - left);
  };
  const auto y = [&](double force) { return bottom - force / most * (bottom - top); };
  std::string out = open_svg(width, height, "Elastic force against step, a node over a sliver");
  out += text(4, 18, "start", "Elastic force, stiffness 1", "class='dk-title'");
  for (double force = 0; force <= most; ++force) {
    out += line(left, y(force), right, y(force), "dk-grid");
    out += text(left - 8, y(force) + 4, "end", fmt::format("{:.0f}", force));
  }
  for (std::size_t step = 0; step <= last; step += 25)
    out += text(x(step), bottom + 18, step == last ? "end" : "middle", std::to_string(step));
  out += text(0.5 * (left + right), bottom + 34, "middle", "step");
  std::string rings;
  double key = left;
  // Wide lines below narrow ones: those that coincide are both seen.
  for (const Accuracy a :
       {Accuracy::exact, Accuracy::reference, Accuracy::fast, Accuracy::robust}) {
    const bool wide = a == Accuracy::exact || a == Accuracy::reference;
    const std::string kind = fmt::format("dk-line dk-{}{}", to_string(a), wide ? " dk-wide" : "");
    out += line(key, 38, key + 20, 38, kind) + text(key + 25, 42, "start", to_string(a));
    key += a == Accuracy::reference ? 98 : 76;
    for (const HardMotion::Line& l : motion.lines) {
      if (l.accuracy != a) continue;
      std::string points;
      for (std::size_t k = 0; k < l.force.size(); ++k)
        points += fmt::format("{:.1f},{:.1f} ", x(k), y(l.force[k]));
      out += "<polyline points='" + points + "' class='" + kind + "'/>\n";
      for (const std::size_t k : l.jumps) {
        rings += fmt::format(
            "<rect x='{:.1f}' y='{:.1f}' width='14' height='14' rx='7' class='dk-default' "
            "data-accuracy='{}' data-step='{}'/>\n",
            x(k) - 7, y(l.force[k]) - 7, to_string(a), k);
        if (a == Accuracy::robust)
          rings += text(x(k) + 8, y(l.force[k]) - 9, "start", fmt::format("step {}", k));
      }
    }
  }
  return out + rings + "</svg>\n";
}

}  // namespace deck
