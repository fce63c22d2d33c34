// The chart of `deck accuracy`: worst relative error against time per pair, drawn by hand as SVG,
// and the page around it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/base/escape.hpp"
#include "deck/report/accuracy.hpp"

namespace deck {
namespace {

constexpr double kWidth = 920, kPanel = 540, kHead = 44, kFoot = 70;
constexpr double kLeft = 84, kRight = 590, kTop = 50, kBottom = 460;  // within a panel

// The tiers of one kind, and what is drawn upwards for them.
struct Panel {
  std::string what, title, label;
  std::vector<const TierResult*> tiers;
  bool scaled = false;              // over the size of the pair
  double floor = -18, ceiling = 4;  // powers of ten; exact results stand on the floor
  double first = 0, last = 5;       // powers of ten of nanoseconds

  bool counts() const { return what == "gaps"; }
  double error(const TierResult& t) const {
    if (counts())
      return 1e6 * static_cast<double>(t.decision_errors) /
             static_cast<double>(std::max<std::uint64_t>(t.samples, 1));
    return scaled ? t.max_scaled_error : t.max_relative_error;
  }
  double x(double ns) const {
    return kLeft + (std::log10(std::max(ns, 1e-3)) - first) / (last - first) * (kRight - kLeft);
  }
  double y(double error) const {
    const double at =
        error > 0.0 ? std::clamp(std::log10(std::min(error, 1e300)), floor, ceiling) : floor;
    return kBottom - (at - floor) / (ceiling - floor) * (kBottom - kTop);
  }
};

// Hard cases have exact distances of 0 and 1e-300: there the error is taken over the pair's size.
Panel panel_of(const AccuracyReport& report, const std::string& what) {
  Panel p;
  p.what = what;
  p.scaled = report.scene == "hard-cases";
  double low = 1e9, high = 1;
  for (const TierResult& t : report.tiers) {
    if (t.what != what) continue;
    p.tiers.push_back(&t);
    low = std::min(low, t.ns_per_pair);
    high = std::max(high, t.ns_per_pair);
  }
  p.first = std::floor(std::log10(std::max(low, 1e-3)));
  // Room for the label of the slowest tier.
  p.last = std::max(p.first + 1, std::ceil(std::log10(high) + 0.5));
  if (what == "gaps") {
    p.title = p.scaled ? "Contact decision" : "Whole deck gaps, reading included";
    p.label = "wrong decisions per million";
    p.floor = -1, p.ceiling = 6;
  } else {
    p.title = what == "force" ? "Elastic contact force" : "Distance";
    p.label = p.scaled ? "worst error of the distance / size of the pair"
                       : "worst relative error of the " + what;
    if (what == "force" && p.scaled) p.label += ", from the force";
  }
  return p;
}

std::string line(double x1, double y1, double x2, double y2, std::string_view color,
                 std::string_view dash = "") {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='{}'{}/>\n", x1,
                     y1, x2, y2, color,
                     dash.empty() ? std::string() : fmt::format(" stroke-dasharray='{}'", dash));
}
std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view extra = "") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' {}>{}</text>\n", x, y, anchor,
                     extra, xml_text(content));
}

std::string frame(const Panel& panel) {
  std::string out = text(kLeft, kTop - 14, "start", panel.title, "font-size='13'");
  for (double p = panel.first; p <= panel.last; ++p) {
    const double x = panel.x(std::pow(10.0, p));
    out += line(x, kTop, x, kBottom, "#ddd");
    out += text(x, kBottom + 18, "middle", fmt::format("1e{:.0f}", p));
  }
  for (double p = panel.floor; p <= panel.ceiling; p += panel.counts() ? 1 : 2) {
    const double y = panel.y(std::pow(10.0, p));
    out += line(kLeft, y, kRight, y, "#ddd");
    std::string label = fmt::format("1e{:.0f}", p);
    if (p == panel.floor) label = panel.counts() ? "none" : "exact";
    if (p == panel.ceiling) label = ">= " + label;
    out += text(kLeft - 8, y + 4, "end", label);
  }
  if (!panel.counts()) {
    const double ulp = panel.y(0x1p-52);
    out += line(kLeft, ulp, kRight, ulp, "#b55", "5 4");
    out += text(kRight - 4, ulp - 4, "end", "1 ulp", "fill='#b55'");
  }
  out += text(0.5 * (kLeft + kRight), kBottom + 38, "middle", "nanoseconds per pair");
  out += text(18, 0.5 * (kTop + kBottom), "middle", panel.label,
              fmt::format("transform='rotate(-90 18 {:.1f})'", 0.5 * (kTop + kBottom)));
  return out;
}

std::string marks(const Panel& panel) {
  std::string out;
  struct Box {
    double x, y, width;
  };
  std::vector<Box> labels;  // placed ones, and the marks themselves
  for (const TierResult* t : panel.tiers)
    labels.push_back({panel.x(t->ns_per_pair) - 6, panel.y(panel.error(*t)) + 4, 12});
  for (const TierResult* tier : panel.tiers) {
    const TierResult& t = *tier;
    const double x = panel.x(t.ns_per_pair), y = panel.y(panel.error(t));
    const std::string& name = t.name;
    Box box{x + 9, y + 4, 6.6 * static_cast<double>(name.size())};
    // Move a label up until it is clear of the others.
    for (std::size_t k = 0; k < labels.size();) {
      const Box& b = labels[k];
      const bool clear =
          std::abs(b.y - box.y) >= 13 || box.x > b.x + b.width || b.x > box.x + box.width;
      if (clear) {
        ++k;
      } else {
        box.y = b.y - 13;
        k = 0;
      }
    }
    labels.push_back(box);
    out += fmt::format(
        "<circle cx='{:.1f}' cy='{:.1f}' r='5' stroke='{}' stroke-width='2' fill='{}'/>\n", x, y,
        "#1f5fa8", t.dominated ? "#fff" : "#1f5fa8");
    out += text(box.x, box.y, "start", name);
  }
  return out;
}

// Decision errors and fallbacks beside the chart.
std::string side_panel(const Panel& panel) {
  const double x = kRight + 24;
  std::string out =
      text(x, kTop, "start", "wrong decisions / million; fallback share", "font-weight='bold'");
  double y = kTop + 26;
  for (const TierResult* tier : panel.tiers) {
    const TierResult& t = *tier;
    const double per_million = 1e6 * static_cast<double>(t.decision_errors) /
                               static_cast<double>(std::max<std::uint64_t>(t.samples, 1));
    out += text(x, y, "start", t.name);
    const double bar = per_million > 0 ? 22 * (1 + std::log10(1 + per_million) / 2) : 2;
    out += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='9' fill='{}'/>\n",
                       x + 132, y - 9, bar, per_million > 0 ? "#b55" : "#3a8");
    out += text(x + 138 + bar, y, "start",
                t.fallback_share > 0
                    ? fmt::format("{:.4g}; {:.3g} %", per_million, 100 * t.fallback_share)
                    : fmt::format("{:.4g}", per_million));
    y += 24;
  }
  return out + text(x, y + 6, "start", "hollow mark: dominated (slower and less accurate)",
                    "font-size='10' fill='#555'");
}

std::string title_of(const AccuracyReport& report, const AccuracyContext& context) {
  const std::uint64_t n = report.tiers.empty() ? 0 : report.tiers[0].samples;
  return fmt::format("Accuracy against time: {} pairs of {}", n,
                     context.path.empty() ? "the hard cases" : context.path);
}

}  // namespace

std::string accuracy_svg(const AccuracyReport& report, const AccuracyContext& context) {
  std::string panels;
  double top = kHead;
  for (const char* what : {"distance", "gaps", "force"}) {
    const Panel panel = panel_of(report, what);
    if (panel.tiers.empty()) continue;
    panels += fmt::format("<g transform='translate(0 {:.0f})'>\n", top) + frame(panel) +
              marks(panel) + side_panel(panel) + "</g>\n";
    top += kPanel;
  }
  const double height = top + kFoot;
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "font-family='sans-serif' font-size='11'>\n<rect width='{0}' height='{1}' fill='#fff'/>\n",
      kWidth, height);
  out += text(kLeft, 28, "start", title_of(report, context), "font-size='16'") + panels;
  out += text(kLeft, height - 52, "start", context.processor, "fill='#555'");
  out += text(kLeft, height - 36, "start", accuracy_compiler(), "fill='#555'");
  out += text(kLeft, height - 20, "start", context.command, "fill='#555'");
  return out + "</svg>\n";
}

std::string accuracy_html(const AccuracyReport& report, const AccuracyContext& context) {
  std::string out = "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'>\n<title>" +
                    xml_text(title_of(report, context)) +
                    "</title>\n<style>body{font-family:sans-serif;margin:2em;max-width:70em}"
                    "svg{max-width:100%;height:auto}pre{overflow-x:auto}</style></head><body>\n";
  out += accuracy_svg(report, context);
  out += "<pre>" + html_text(accuracy_text(report, context)) + "\n" +
         html_text(accuracy_examples(report)) + "</pre>\n";
  return out + "</body></html>\n";
}

}  // namespace deck
