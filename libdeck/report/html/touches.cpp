// Parts that touch, with their interfaces, for the page (which updates it with settings under test)
// and for the drawing.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/shared/shown_text.hpp"
#include "contact/shared/node_elements.hpp"
#include "report/html/page_steps.hpp"
#include "report/shared/text_table.hpp"

namespace deck {
namespace {

using detail::Touch;

/// Longest start up to a separator that most titles share, as commonStart of the viewer; "": none
/// worth folding.
std::string common_start(const std::set<std::string>& titles) {
  std::map<std::string, std::size_t> count;
  for (const std::string& t : titles)
    for (std::size_t i = 8; i < t.size(); ++i)
      if (std::string_view(" _-.:/").find(t[i - 1]) != std::string_view::npos)
        ++count[t.substr(0, i)];
  std::string best;
  for (const auto& [start, n] : count)
    if (n >= 3 && 5 * n >= 3 * titles.size() && start.size() > best.size()) best = start;
  return best;
}

std::string part_text(const Model& model, int part) {
  if (part < 0) return "(no part)";
  const Part& p = model.parts[static_cast<std::size_t>(part)];
  return p.title.empty() ? std::to_string(p.id) : std::to_string(p.id) + " " + p.title;
}

/// Deepest first, then most neighbours, then deck order; at most 60.
template <class Side>
std::vector<int> ranked(const std::vector<Touch>& all, Side side) {
  std::map<int, std::pair<double, int>> ranks;  // depth and neighbours
  for (const Touch& t : all) {
    auto& [depth, neighbours] = ranks[side(t)];
    depth = std::max(depth, t.depth);
    ++neighbours;
  }
  std::vector<int> out;
  for (const auto& [part, rank] : ranks) out.push_back(part);
  std::stable_sort(out.begin(), out.end(), [&](int a, int b) { return ranks.at(a) > ranks.at(b); });
  if (out.size() > 60) out.resize(60);
  return out;
}

/// The drawing, for the command line and the page, which marks other cells for other settings
/// (tools/viewer/src/sections/touches.ts).
class Drawing {
 public:
  Drawing(const HtmlInput& in, const std::vector<Touch>& all) : in_(in), all_(all) {
    down_ = ranked(all, [](const Touch& t) { return t.secondary; });
    across_ = ranked(all, [](const Touch& t) { return t.main; });
    std::set<std::string> titles;
    for (const auto* const parts : {&down_, &across_})
      for (const int p : *parts)
        if (p >= 0) titles.insert(in.scene->model->parts[static_cast<std::size_t>(p)].title);
    common_ = common_start(titles);
    left_ = 14 + 8.6 * static_cast<double>(widest(down_, 12));
    top_ = 14 + 8.6 * static_cast<double>(widest(across_, 6));
  }

  std::string run() {
    const double width = left_ + size * static_cast<double>(across_.size()) + 8,
                 height = top_ + size * static_cast<double>(down_.size()) + 8;
    out_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"tw\" viewBox=\"0 0 {0} {1}\" "
        "width=\"{0}\" height=\"{1}\" role=\"img\" aria-label=\"Parts against parts\">\n<style>.tw "
        "text{{font:12px system-ui,sans-serif;fill:#5c6979}} .tw .near{{fill:#c9d6e6}} .tw "
        ".deep{{fill:#bd0026}} .tw .none{{fill:#8881}} .tw .n{{fill:#fff}} .tw "
        ".m{{fill:#17202b}}</style>\n",
        width, height);
    for (std::size_t i = 0; i < across_.size(); ++i)
      name(across_[i], fmt::format("transform=\"translate({} {}) rotate(-90)\"",
                                   left_ + size * static_cast<double>(i) + 16, top_ - 6));
    for (std::size_t j = 0; j < down_.size(); ++j) {
      name(down_[j], fmt::format("x=\"{}\" y=\"{}\" text-anchor=\"end\"", left_ - 8,
                                 top_ + size * static_cast<double>(j) + 16));
      for (std::size_t i = 0; i < across_.size(); ++i) cell(j, i);
    }
    return out_ + "</svg>\n";
  }

 private:
  static constexpr double size = 24;

  /// Without the common start of the titles; the middle is cut, because names differ at the end.
  std::string short_text(int part) const {
    const std::string text = part_text(*in_.scene->model, part);
    const std::size_t start = common_.empty() ? text.npos : text.find(" " + common_);
    if (start == text.npos) return cut_middle(text, 28);
    return text.substr(0, start) + " \xe2\x80\xa6" +
           cut_middle(text.substr(start + 1 + common_.size()), 20);
  }
  std::size_t widest(const std::vector<int>& parts, std::size_t least) const {
    for (const int p : parts) least = std::max(least, display_width(short_text(p)));
    return least;
  }
  void name(int part, const std::string& where) {
    out_ += fmt::format("<text {}>{}<title>{}</title></text>\n", where, xml_text(short_text(part)),
                        xml_text(part_text(*in_.scene->model, part)));
  }
  void cell(std::size_t j, std::size_t i) {
    const auto t = std::find_if(all_.begin(), all_.end(), [&](const Touch& x) {
      return x.secondary == down_[j] && x.main == across_[i];
    });
    const double x = left_ + size * static_cast<double>(i),
                 y = top_ + size * static_cast<double>(j);
    const std::string box =
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"3\"", x + 1, y + 1,
                    size - 2, size - 2);
    if (t == all_.end()) {
      out_ += box + " class=\"none\"/>\n";
      return;
    }
    std::string said = part_text(*in_.scene->model, t->secondary) + " and " +
                       part_text(*in_.scene->model, t->main) + ": ";
    for (std::size_t k = 0; k < t->interfaces.size(); ++k) {
      const InterBase& inter = *in_.scene->interfaces->ordered[t->interfaces[k]];
      said += (k == 0 ? "" : ", ") + std::to_string(inter.id) +
              (inter.title.empty() ? "" : " " + inter.title);
    }
    if (t->pairs > 0)
      said += fmt::format("; {} penetration{}, deepest {:.4g}", t->pairs, t->pairs == 1 ? "" : "s",
                          t->depth);
    out_ += fmt::format(
        "<g class=\"touch\" data-s=\"{}\" data-m=\"{}\"><title>{}</title>{} class=\"{}\"/><text "
        "x=\"{}\" y=\"{}\" "
        "text-anchor=\"middle\" class=\"{}\">{}</text></g>\n",
        t->secondary, t->main, xml_text(said), box, t->pairs > 0 ? "deep" : "near", x + size / 2,
        y + 16, t->pairs > 0 ? "n" : "m", t->interfaces.size());
  }

  const HtmlInput& in_;
  const std::vector<Touch>& all_;
  std::vector<int> down_, across_;
  double left_ = 0, top_ = 0;
  std::string common_, out_;
};

}  // namespace

std::vector<Touch> detail::collect_touches(const HtmlInput& in, const PageContacts& page) {
  const Model& model = *in.scene->model;
  const auto part = [&](const ElementName& e) { return static_cast<int>(part_position(model, e)); };
  const auto carrier = [&](const auto& item) {
    return part(carrier_name(model, item.carrier, item.element));
  };
  std::map<std::pair<int, int>, Touch> found;
  const auto at = [&](int secondary, int main, const InterBase& inter) -> Touch& {
    Touch& t = found[{secondary, main}];
    t.secondary = secondary;
    t.main = main;
    const auto k = static_cast<std::uint32_t>(detail::interface_position(*in.scene, &inter));
    if (std::find(t.interfaces.begin(), t.interfaces.end(), k) == t.interfaces.end())
      t.interfaces.push_back(k);
    return t;
  };
  Connectivity connectivity(model);
  for (std::size_t i = 0; i < page.contacts.size(); ++i) {
    const Contact& c = in.scene->contacts[i];
    const bool edges = c.kind == ContactKind::edge_edge;
    // Parts of items, looked up once each.
    std::vector<int> of_secondary(edges ? c.secondary_edges.size() : c.secondary.size(), -2),
        of_main(edges ? c.main_edges.size() : c.main.size(), -2);
    std::set<std::pair<int, int>> seen;
    std::pair<int, int> last{-2, -2};  // neighbours mostly have equal parts
    for (const CandidatePair& p : page.contacts[i].near) {
      int& s = of_secondary[p.secondary];
      int& m = of_main[p.main];
      if (s == -2)
        s = edges ? carrier(c.secondary_edges[p.secondary])
                  : part(element_at(model, connectivity, c.secondary[p.secondary].node));
      if (m == -2) m = edges ? carrier(c.main_edges[p.main]) : carrier(c.main[p.main]);
      if (const std::pair parts{s, m}; parts != last && seen.insert(last = parts).second)
        at(s, m, *c.inter);
    }
  }
  for (std::size_t i = 0; i < in.view->penetrations.size(); ++i) {
    const auto& p = in.view->penetrations.places[i];
    const auto [s, m] = in.view->penetrations.elements(i);
    Touch& t = at(part(s), part(m), *in.scene->contacts[p.contact].inter);
    ++t.pairs;
    t.depth = std::max(t.depth, in.scene->contacts[p.contact].penetrations[p.row].depth);
  }
  std::vector<Touch> out;
  for (auto& [key, t] : found) {
    std::sort(t.interfaces.begin(), t.interfaces.end());
    out.push_back(std::move(t));
  }
  return out;
}

std::string detail::touches_drawing(const HtmlInput& in, const std::vector<Touch>& touches) {
  return Drawing(in, touches).run();
}

std::string touches_svg(const HtmlInput& in) {
  detail::PageNodes nodes(in.scene->model->nodes.size());
  return touches_drawing(in, collect_touches(in, detail::collect_contacts(in, nodes)));
}

}  // namespace deck
