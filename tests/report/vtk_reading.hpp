// Reads VTK files back through VTK itself (Debian: python3-vtk9), for tests that compare values.
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "folder.hpp"
#include "report/shared/vtk.hpp"

namespace deck::test {

namespace fs = std::filesystem;
using nlohmann::json;

inline constexpr const char* vtk_dump = R"(
import json, os, sys
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkCommonCore import vtkIdList
def arrays(data):
    out = {}
    for i in range(data.GetNumberOfArrays()):
        a = data.GetArray(i)
        out[a.GetName()] = [[a.GetComponent(t, c) for c in range(a.GetNumberOfComponents())]
                            for t in range(a.GetNumberOfTuples())]
    return out
result = {}
for name in os.listdir(sys.argv[1]):
    if not name.endswith('.vtp'): continue
    reader = vtkXMLPolyDataReader()
    if not reader.CanReadFile(os.path.join(sys.argv[1], name)): sys.exit('cannot read ' + name)
    reader.SetFileName(os.path.join(sys.argv[1], name))
    reader.Update()
    if reader.GetErrorCode() != 0: sys.exit('error in ' + name)
    p = reader.GetOutput()
    cells = []
    for i in range(p.GetNumberOfCells()):
        ids = vtkIdList()
        p.GetCellPoints(i, ids)
        cells.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
    result[name] = {'points': [list(p.GetPoint(i)) for i in range(p.GetNumberOfPoints())],
                    'types': [p.GetCellType(i) for i in range(p.GetNumberOfCells())],
                    'cells': cells, 'point': arrays(p.GetPointData()),
                    'cell': arrays(p.GetCellData())}
json.dump(result, open(sys.argv[2], 'w'))
)";

/// A python that has VTK, or nothing.
inline std::string python_with_vtk() {
  for (const std::string python : {"python3", "/usr/bin/python3"})
    if (std::system((python + " -c 'import vtkmodules.vtkIOXML' > /dev/null 2>&1").c_str()) == 0)
      return python;
  return {};
}

/// What VTK reads from the files; null where VTK is missing.
inline json read_with_vtk(const std::vector<VtkFile>& files) {
  const std::string python = python_with_vtk();
  if (python.empty()) return nullptr;
  const Folder folder;
  for (const VtkFile& f : files) folder.write(f.name, f.bytes);
  folder.write("dump.py", vtk_dump);
  const auto quoted = [&](const char* file) { return "'" + (folder / file).string() + "'"; };
  const int code = std::system(
      (python + " " + quoted("dump.py") + " '" + folder.path() + "' " + quoted("dump.json"))
          .c_str());
  EXPECT_EQ(code, 0);
  json out = json::object();
  if (code == 0) out = json::parse(std::ifstream(folder / "dump.json"));
  return out;
}

}  // namespace deck::test
