#!/usr/bin/env python3
"""open.py beside the VTK files, run with a paraview.simple of our own: every file it opens is read by VTK itself (Debian:
python3-vtk9), every array it colours, turns or scales by is there with the right number of components, arrows have a length
that shows in the model. ParaView itself is not needed, and its picture not looked at.

    python3 tests/robustness/paraview.py DECK"""
import os
import subprocess

from common import ROOT, run_steps, write

STUB = '''
import os
import xml.etree.ElementTree as ET
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

COUNT = {"files": 0, "arrows": 0, "colours": 0}

class Array:
    def __init__(self, data): self.data = data
    def GetRange(self, component=0): return self.data.GetRange(component)

class Source:
    def __init__(self, path):
        assert os.path.isfile(path), path
        COUNT["files"] += 1
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(path)
        reader.Update()
        self.out = reader.GetOutput()
    def arrays(self, where):
        data = {"POINTS": self.out.GetPointData(), "CELLS": self.out.GetCellData()}[where]
        return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}
    def need(self, where, name, components):
        found = self.arrays(where)
        assert name in found, (where, name, sorted(found))
        assert found[name].GetNumberOfComponents() == components, (name, components)
    @property
    def PointData(self): return {n: Array(a) for n, a in self.arrays("POINTS").items()}
    def UpdatePipeline(self): pass
    def GetDataInformation(self): return self
    def GetNumberOfPoints(self): return self.out.GetNumberOfPoints()
    def GetBounds(self): return self.out.GetBounds()

def XMLPolyDataReader(registrationName, FileName):
    return Source(FileName[0])
def PVDReader(registrationName, FileName):
    files = [d.get("file") for d in ET.parse(FileName).getroot().iter("DataSet")]
    assert files, FileName
    return [Source(os.path.join(os.path.dirname(FileName), f)) for f in files][-1]

class Display:
    def __init__(self, source): self.source = source
    def RescaleTransferFunctionToDataRange(self, extend): pass
    def SetScalarBarVisibility(self, view, on): pass
class View:
    def ResetCamera(self): pass
class Filter:
    def __init__(self, source):
        self.out, self.arrays, self.need, self.input = source.out, source.arrays, source.need, source
def Glyph(registrationName, Input, GlyphType):
    assert GlyphType == "Arrow"
    COUNT["arrows"] += 1
    return Filter(Input)
def GetActiveViewOrCreate(kind): return View()
def Show(source, view):
    if isinstance(source, Filter):
        source.need(*source.OrientationArray, 3)
        source.need(*source.ScaleArray, 1)
        top = source.arrays("POINTS")[source.ScaleArray[1]].GetRange()[1]
        b = source.out.GetBounds()
        size = max(b[1] - b[0], b[3] - b[2], b[5] - b[4])
        assert top == 0 or 0.01 * size < top * source.ScaleFactor < 0.5 * size, (top, source.ScaleFactor, size)
        assert source.GlyphMode == "All Points"
    return Display(source)
def ColorBy(display, what):
    COUNT["colours"] += 1
    display.source.need(*what, 1)
def Render(view): print(COUNT["files"], COUNT["arrows"], COUNT["colours"])
'''


def scripts(c, tmp):
    python = "/usr/bin/python3"
    if subprocess.run([python, "-c", "import vtkmodules.vtkIOXML"], capture_output=True).returncode:
        return c.skip("open.py", "no python3 with VTK (Debian: python3-vtk9)")
    write(os.path.join(tmp, "lib", "paraview", "__init__.py"), "")
    write(os.path.join(tmp, "lib", "paraview", "simple.py"), STUB)
    env = {**os.environ, "PYTHONPATH": os.path.join(tmp, "lib"), "PYTHONDONTWRITEBYTECODE": "1"}
    crash, clean = (os.path.join(ROOT, "samples", n + "_0000.rad") for n in ("crash_box", "clean_plates"))
    for name, *call in (("gaps", "gaps", crash), ("without a penetration", "gaps", clean), ("cycle", "cycle", crash), ("without a force", "cycle", clean),
                        ("steps", "cycle", crash, "--velocity", "2=0,0,-5", "--dt", "1e-3", "--steps", "3")):
        folder = os.path.join(tmp, name)
        c.no_crash(name, c.run(*call, "--quiet", "--vtk", folder), (0, 1))
        for place in (folder, "/"):  # beside its files, and from elsewhere, as ParaView would
            r = subprocess.run([python, os.path.join(folder, "open.py")], cwd=place, capture_output=True, text=True, env=env)
            if not c.check("%s: open.py runs, and what it names is there" % name, r.returncode == 0, r.stderr[-400:]):
                continue
            files, arrows, colours = map(int, r.stdout.split())
            vtp = [f for f in os.listdir(folder) if f.endswith(".vtp")]
            c.check("%s: every file is opened" % name, files == len(vtp), "%d of %d" % (files, len(vtp)))
            c.check("%s: arrows where there is something to show" % name, (arrows > 0) == ("without" not in name) and colours >= 1, "%d arrows" % arrows)


if __name__ == "__main__":
    run_steps(scripts)
