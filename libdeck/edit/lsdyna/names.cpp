// Tables of LS-DYNA contact keywords, set types and the words for them.
#include "edit/lsdyna/names.hpp"

#include "keyword/reader.hpp"

namespace deck::detail {

std::string_view why_dropped(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> reasons[] = {
      {"SPR", "output only; ask for interface output in the Radioss deck"},
      {"MPR", "output only; ask for interface output in the Radioss deck"},
      {"VC", "no limit of the friction stress"},
      {"VSF", "no limit of the friction stress"},
      {"PENCHK", "nodes are not released by their penetration"},
      {"SOFSCL", "no soft constraint formulation"},
      {"LCIDAB", "no airbag thickness curve"},
      {"MAXPAR", "segments are not extended"},
      {"SBOPT", "no segment based contact"},
      {"BSORT", "sorting is automatic"},
      {"FRCFRQ", "forces are computed every cycle"},
      {"PENMAX", "nodes are not released by their penetration; Fpenmax acts at the start only"},
      {"THKOPT", "thickness is always considered"},
      {"SHLTHK", "thickness is always considered"},
      {"SNLOG", "no shooting node logic"},
      {"ISYM", "faces on symmetry planes stay in contact; leave them out of the surface"},
      {"I2D3D", "the carrier of a segment is chosen by fixed rules"},
      {"SLDTHK", "solids have no contact thickness; write Gapmin, or skin them with void shells"},
      {"SLDSTF", "the stiffness comes from the material; scale it by Stfac"},
      {"IGAP", "implicit analysis only"},
      {"DPRFAC", "the contact depth does not change with time"},
      {"DTSTIF", "stiffness by time step: consider dtmin"},
      {"EDGEK", "edge stiffness comes from the elements"},
      {"FLANGL", "no feature angle"},
      {"CID_RCF", "no local output axes"},
      {"SHAREC", "no shared constraints"},
      {"FTORQ", "no beam torsion from friction"}};
  for (const auto& [cell, reason] : reasons)
    if (cell == name) return reason;
  return "no counterpart";
}

std::string_view set_name(std::int64_t type) {
  constexpr std::string_view names[] = {"segment set",
                                        "shell set",
                                        "part set",
                                        "part",
                                        "node set",
                                        "all parts",
                                        "all parts but part set",
                                        "part tree branch"};
  return type >= 0 && type < 8 ? names[type] : std::string_view("set of unknown type");
}

std::string_view target_note(DynaKind kind, int type) {
  if (is_tied(kind))
    return type == 10 ? "ties nodes when they touch instead of constraining them from the start; "
                        "consider /INTER/TYPE2"
                      : "a contact that does not tie was asked for";
  if (type == 10) return "a contact that ties nodes when they touch was asked for";
  if (type == 11) return "edges only";
  if (kind == DynaKind::surface_to_surface)
    return type == 19 ? "both ways as in LS-DYNA, and edge to edge in addition"
                      : "one way only: the nodes of the first side against the second one";
  if (kind == DynaKind::general)
    return type == 19 ? "nodes and edges against each other" : "nodes only, no edges";
  return type == 7 ? "penalty contact with another stiffness and damping"
                   : "edge to edge in addition";
}

std::string title_of(const std::string& heading) {
  std::string text = heading.substr(0, 100);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  text = std::string(trim(text));
  if (!text.empty() && (text[0] == '#' || text[0] == '$' || text[0] == '/'))
    text.insert(text.begin(), '\'');
  return text.substr(0, 100);
}

}  // namespace deck::detail
