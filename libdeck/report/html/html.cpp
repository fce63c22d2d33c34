// The page: a static part that is readable without scripts, data blocks, style and script. Text of
// the deck is escaped, or JSON with escaped '<', so no title can open or close an element. The
// content security policy forbids all requests.
#include "deck/report.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/shared/parallel.hpp"
#include "base/shared/shown_text.hpp"
#include "contact/shared/reported.hpp"
#include "deck/loaded_deck.hpp"
#include "report/html/page_steps.hpp"
#include "report/shared/cycle.hpp"
#include "report/shared/parts.hpp"
#include "report/shared_records.hpp"

namespace deck::detail {

std::string script_safe(std::string_view json) {
  std::string out;
  out.reserve(json.size() + json.size() / 50);
  for (const char& c : json)
    out += c == '<' ? std::string_view("\\u003c") : std::string_view(&c, 1);
  return out;
}

Verdict page_verdict(const HtmlInput& in) {
  return in.effects != nullptr ? cycle_verdict(*in.effects)
                               : verdict_of(*in.deck, *in.scene, *in.view);
}

namespace {

std::string_view file_name(std::string_view path) {
  const auto slash = path.find_last_of("/\\");
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

/// For readers without scripts: the verdict and a table of the contacts.
std::string static_body(const HtmlInput& in) {
  std::string out = "<main id=\"static\"><h1>" + html_text(file_name(in.path)) + "</h1>\n";
  const Verdict verdict = page_verdict(in);
  out += fmt::format("<p data-level=\"{}\">{}</p>\n", to_string(verdict.level),
                     html_text(verdict.text));
  if (in.effects != nullptr) out += cost_html(*in.effects);
  out +=
      "<table><thead><tr><th>Interface</th><th>Title</th><th>Part of it</th>"
      "<th>Gapmin</th><th>Penetrations</th><th>Deepest</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < in.scene->contacts.size(); ++i) {
    const Contact& c = in.scene->contacts[i];
    const ContactTotals& t = in.view->contacts[i];
    out +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                    c.inter->id, html_text(c.inter->title), to_string(c.role), shortest(c.gapmin),
                    c.evaluated ? std::to_string(t.count.pairs) : "not evaluated",
                    c.evaluated ? shortest(t.max_depth) : "-");
  }
  out += "</tbody></table>\n";
  if (!in.scene->ties.empty()) {
    out += "<ul>\n";
    for (const Tie& tie : in.scene->ties)
      out += fmt::format("<li>TYPE2 {} {}: {}</li>\n", tie.inter->id, html_text(tie.inter->title),
                         html_text(tie_count_text(tie)));
    out += "</ul>\n";
  }
  return out +
         "<noscript><p>This page needs JavaScript for its lists and the "
         "picture.</p></noscript></main>\n";
}

void add_block(std::string& out, std::string_view id, std::string_view type,
               std::string_view text) {
  out += fmt::format("<script type=\"{}\" id=\"{}\">", type, id);
  out += text;
  out += "</script>\n";
}

/// All blocks in order, built in parallel. Consumes `page`.
std::vector<DataBlock> packed_blocks(const HtmlInput& in, const std::vector<MeshPart>& mesh,
                                     const std::vector<Touch>& touches, const PageNodes& nodes,
                                     PageContacts& page, std::vector<DataBlock> optional) {
  const Model& model = *in.scene->model;
  const ContactBlocks contacts = contact_blocks(in, page, nodes);
  std::vector<DataBlock> blocks{
      {"deck-touches", [&] { return packed_text(touches_drawing(in, touches)); }},
      {"deck-shared", contacts.shared},
      {"deck-contacts", contacts.contacts}};
  if (has_ties(*in.scene))
    blocks.push_back({"deck-ties", [&] { return ties_block(*in.scene, nodes); }});
  blocks.push_back({"deck-mesh", [&] { return mesh_block(model, mesh, nodes); }});
  blocks.push_back({"deck-elements", [&] { return elements_block(model, mesh); }});
  blocks.insert(blocks.end(), optional.begin(), optional.end());
  parallel_items(effective_threads(in.threads), blocks.size(),
                 [&](std::size_t i) { blocks[i].text = blocks[i].make(); });
  return blocks;
}

}  // namespace
}  // namespace deck::detail

namespace deck {

bool html_available(std::string* reason) {
  const detail::ViewerBundle& bundle = detail::viewer_bundle();
  if (reason != nullptr) *reason = bundle.missing;
  return !bundle.script.empty();
}

Result<std::string> gaps_html(const HtmlInput& in) {
  const detail::ViewerBundle& bundle = detail::viewer_bundle();
  if (bundle.script.empty())
    return Error{Error::Code::config, "this build has no viewer: " + std::string(bundle.missing)};
  const Model& model = *in.scene->model;
  detail::PageNodes nodes(model.nodes.size());
  const std::vector<detail::MeshPart> mesh = detail::collect_mesh(model, nodes);
  std::vector<NodeIndex> of_ties = detail::use_nodes(*in.scene, nodes);
  detail::PageContacts page = detail::collect_contacts(in, nodes);
  page.of_ties = std::move(of_ties);
  std::vector<detail::DataBlock> optional = detail::optional_blocks(in, nodes);
  nodes.number();

  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src 'unsafe-inline'; worker-src blob:; "
      "style-src 'unsafe-inline'; img-src data: blob:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" "
      "content=\"deck " +
      std::string(library_version()) + "\">\n<title>" + html_text(detail::file_name(in.path)) +
      " \xe2\x80\x93 " +
      (in.effects != nullptr  ? "first contact cycle"
       : in.parts != nullptr  ? "parts"
       : in.before != nullptr ? "before and after"
                              : "initial penetrations") +
      "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>";
  out += bundle.style;
  out += "</style>\n</head>\n<body>\n";
  out += detail::static_body(in);
  const std::vector<detail::Touch> touches = detail::collect_touches(in, page);
  detail::add_block(out, "deck-meta", "application/json",
                    detail::script_safe(detail::meta_json(in, page, touches)));
  std::vector<detail::DataBlock> blocks =
      detail::packed_blocks(in, mesh, touches, nodes, page, std::move(optional));
  std::size_t size = out.size() + bundle.script.size();
  for (const detail::DataBlock& block : blocks) size += block.text.size();
  out.reserve(size + size / 16);  // the rest is short
  for (detail::DataBlock& block : blocks) {
    detail::add_block(out, block.id, "application/octet-stream", block.text);
    block.text = {};
  }
  if (in.effects != nullptr)
    detail::add_block(out, "cycle-json", "application/json",
                      detail::script_safe(cycle_json(*in.effects, false)));
  if (in.parts != nullptr) {
    detail::add_block(out, "parts-json", "application/json",
                      detail::script_safe(parts_json(*in.parts, false)));
    detail::add_block(out, "deck-steps", "application/octet-stream",
                      detail::steps_block(model, in.parts->mesh(), nodes));
  }
  out += "<script>";
  out += bundle.script;
  out += "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace deck
