// The script beside the VTK files that opens them in ParaView with colours and arrows set.
#include <algorithm>

#include "report/shared/vtk.hpp"

namespace deck {
namespace {

constexpr const char* script_head =
    R"~(# Opens the files of this folder in ParaView, coloured and with arrows:
#   paraview --script=open.py     or File > Load State, or: pvpython open.py (writes open.png)
# Made for paraview.simple of ParaView 5.9 and later.
import os
import sys

import paraview.simple as pv

HERE = os.path.dirname(os.path.abspath(globals().get("__file__", "open.py")))
VIEW = pv.GetActiveViewOrCreate("RenderView")


def read(name):
    path = os.path.join(HERE, name)
    if name.endswith(".pvd"):
        return pv.PVDReader(registrationName=name, FileName=path)
    return pv.XMLPolyDataReader(registrationName=name, FileName=[path])


def surface(name, array, opacity):
    """The elements of one side, coloured by a value of each; deeper is hotter."""
    display = pv.Show(read(name), VIEW)
    display.Opacity = opacity
    pv.ColorBy(display, ("CELLS", array))
    display.RescaleTransferFunctionToDataRange(True)


def points(name, array, arrow, size, longest):
    """Points coloured by a value, with arrows; the longest is this part of the model."""
    source = read(name)
    source.UpdatePipeline()
    display = pv.Show(source, VIEW)
    display.PointSize = 5
    pv.ColorBy(display, ("POINTS", array))
    display.RescaleTransferFunctionToDataRange(True)
    if source.GetDataInformation().GetNumberOfPoints() == 0:
        return
    top = source.PointData[size].GetRange(0)[1]
    low = source.GetDataInformation().GetBounds()
    model = max(low[1] - low[0], low[3] - low[2], low[5] - low[4], 1e-30)
    glyph = pv.Glyph(registrationName="arrows of " + name, Input=source, GlyphType="Arrow")
    glyph.OrientationArray = ["POINTS", arrow]
    glyph.ScaleArray = ["POINTS", size]
    glyph.ScaleFactor = longest * model / top if top > 0 else 1.0
    glyph.GlyphMode = "All Points"
    arrows = pv.Show(glyph, VIEW)
    pv.ColorBy(arrows, ("POINTS", array))
    arrows.RescaleTransferFunctionToDataRange(True)
    arrows.SetScalarBarVisibility(VIEW, True)


)~";

constexpr const char* script_tail = R"~(
VIEW.ResetCamera()
pv.Render(VIEW)
if os.path.basename(sys.executable or "").startswith("pvpython"):
    pv.SaveScreenshot(os.path.join(HERE, "open.png"), VIEW)
)~";

}  // namespace

VtkFile paraview_script(const std::vector<VtkFile>& files) {
  // Of a series only the collections: they hold its files.
  const bool series = std::any_of(files.begin(), files.end(),
                                  [](const VtkFile& f) { return f.name.ends_with(".pvd"); });
  std::string out = script_head;
  for (const VtkFile& f : files) {
    if (series && !f.name.ends_with(".pvd")) continue;
    const std::string name = "\"" + f.name + "\"";
    if (f.name.starts_with("penetrations"))
      out += "points(" + name + ", \"depth\", \"arrow\", \"depth\", 0.05)\n";
    else if (f.name.starts_with("contact_nodes"))
      out += "points(" + name + ", \"dt\", \"force\", \"force_size\", 0.1)\n";
    else if (f.name.starts_with("contact_pairs"))
      out += "points(" + name + ", \"penetration\", \"force\", \"force_size\", 0.05)\n";
    else if (f.name.ends_with("_main.vtp"))
      out += "surface(" + name + ", \"depth\", 0.35)\n";
    else if (f.name.ends_with("_ties.vtp"))
      out += "surface(" + name + ", \"lost\", 1.0)\n";
    else
      out += "surface(" + name + ", \"depth\", 1.0)\n";
  }
  return {"open.py", out + script_tail};
}

}  // namespace deck
