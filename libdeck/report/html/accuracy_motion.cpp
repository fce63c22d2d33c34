// The hard case in motion on the page of `deck accuracy`, drawn as SVG: who says that the node is
// in contact, and the force of the figures that each word prints. Colours are classes, so that a
// page can give it another ground.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/shared/motion.hpp"
#include "base/shared/escape.hpp"
#include "report/html/parts.hpp"

namespace deck::detail {
namespace {

std::string line(double x1, double y1, double x2, double y2, std::string_view kind) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' class='{}'/>\n", x1, y1,
                     x2, y2, kind);
}
std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view extra = "") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor,
                     extra, xml_text(content));
}

constexpr std::string_view chart_style =
    "<style>.dk-ground{fill:#fff} .dk-grid{stroke:#dde2e8} "
    ".dk-default{fill:none;stroke:#9a5b00;stroke-width:2} .dk-svg text{fill:#5c6979} "
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

/// A line over the steps where a word says that the pair is in contact.
template <class X>
std::string contact_band(const HardMotion::Line& l, double y, const X& x, const std::string& kind) {
  std::string out = "<path d='";
  for (std::size_t k = 0; k + 1 < l.depth.size(); ++k)
    if (l.depth[k] > 0.0 && l.depth[k + 1] > 0.0)
      out += (k > 0 && l.depth[k - 1] > 0.0 ? "" : fmt::format("M{:.1f} {:.1f}", x(k), y)) +
             fmt::format("H{:.1f}", x(k + 1));
  return out +
         fmt::format("' class='{} dk-band' data-accuracy='{}'/>\n", kind, to_string(l.accuracy));
}

std::string motion_panel(const HardMotion& motion) {
  constexpr double width = 360, height = 330, left = 30, right = 348, top = 128, bottom = 292;
  double most = 1.0;
  for (const HardMotion::Line& l : motion.lines)
    most = std::max(most, std::ceil(*std::max_element(l.force.begin(), l.force.end())));
  const std::size_t last = motion.lines.front().force.size() - 1;
  const auto x = [&](std::size_t step) {
    return left + static_cast<double>(step) / static_cast<double>(last) * (right - left);
  };
  const auto y = [&](double force) { return bottom - force / most * (bottom - top); };
  std::string out = open_svg(width, height, "Elastic force against step, a node over a sliver");
  out += text(4, 18, "start", "In contact?", "class='dk-title'");
  out += text(4, 112, "start", "Force from the figures printed, stiffness 1", "class='dk-title'");
  for (double force = 0; force <= most; ++force) {
    out += line(left, y(force), right, y(force), "dk-grid");
    out += text(left - 8, y(force) + 4, "end", fmt::format("{:.0f}", force));
  }
  for (std::size_t step = 0; step <= last; step += 25)
    out += text(x(step), bottom + 18, step == last ? "end" : "middle", std::to_string(step));
  out += text(0.5 * (left + right), bottom + 34, "middle", "step");
  std::string rings;
  double key = left, band = 52;
  // Wide lines below narrow ones: those that coincide are both seen.
  for (const Accuracy a :
       {Accuracy::exact, Accuracy::reference, Accuracy::fast, Accuracy::robust}) {
    const bool wide = a == Accuracy::exact || a == Accuracy::reference;
    const std::string kind = fmt::format("dk-line dk-{}{}", to_string(a), wide ? " dk-wide" : "");
    out += line(key, 38, key + 20, 38, kind) + text(key + 25, 42, "start", to_string(a));
    key += a == Accuracy::reference ? 98 : 76;
    band += 8;
    for (const HardMotion::Line& l : motion.lines) {
      if (l.accuracy != a) continue;
      out += contact_band(l, band, x, kind);
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

}  // namespace

std::string accuracy_motion() {
  const HardMotion motion = hard_motion();
  std::string said;
  for (const std::string& sentence : motion_sentences(motion, "code"))
    said += "<p class=\"jump\">" + sentence + "</p>\n";
  return fmt::format(
      R"~(<section id="motion"><h2>A node passes a sliver</h2>
<div><figure tabindex="0">{}<button type="button" class="save" data-name="accuracy_motion.svg">Save as SVG</button></figure>
<div>{}<p class="note">The area of the triangle is round-off: there the reference formula takes the wrong edge. <code>robust</code>
decides contact without round-off and prints the figures of the reference formula; where that formula sees no contact, the exact ones.</p>
<p class="note">A ring is a jump: the depth changes by more than the node moves ({:.3g} a step, gap {:g}), which no distance can do.</p>
</div></div></section>
)~",
      motion_panel(motion), said, motion.way, motion.gap);
}

}  // namespace deck::detail
