"""Builds the native part with CMake; everything else is in pyproject.toml.

Everything is compiled, unless LIBDECK_PREFIX names where a libdeck of the same version is installed.
"""
import ast
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent


def signature(member):
    """What pybind11 wrote into the docstring: the arguments, and the type of the result."""
    head = re.sub(r"\b(libdeck\.)?_native\.", "", (member.__doc__ or "").partition("\n")[0])
    try:
        ast.parse("def f%s: ..." % head[head.index("("):])
    except (SyntaxError, ValueError):  # a type that has no name in Python
        return "(*args: Any)", "Any"
    arguments, _, result = head[head.index("("):].partition(" -> ")
    return arguments, result


def write_stub(module):
    """The native part as type checkers read it, beside the module."""
    spec = importlib.util.spec_from_file_location("libdeck._native", module)
    native = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(native)
    lines = ["# The native part. Use the module libdeck; this is what it is made of.",
             "from typing import *", "import numpy", "version: str"]
    for name, member in vars(native).items():
        if isinstance(member, type):
            lines.append("class %s:" % name)
            for of, inner in vars(member).items():
                if isinstance(inner, property):
                    lines.append("    %s: %s" % (of, signature(inner.fget)[1]))
                elif callable(inner) and (of == "__len__" or not of.startswith("_")):
                    lines.append("    def %s%s -> %s: ..." % (of, *signature(inner)))
        elif callable(member):
            lines.append("def %s%s -> %s: ..." % (name, *signature(member)))
    module.with_name("_native.pyi").write_text("\n".join(lines) + "\n")


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = Path(self.build_temp).resolve()
        configure = [f"-DPython_EXECUTABLE={sys.executable}", "-DCMAKE_BUILD_TYPE=Release"]
        prefix = os.environ.get("LIBDECK_PREFIX")
        if prefix:
            source, folder = here, build / "libdeck"
            configure.append(f"-DCMAKE_PREFIX_PATH={Path(prefix).resolve()}")
        else:
            source, folder = here.parent.parent, build / "tools" / "python" / "libdeck"
            configure += ["-DLIBDECK_BUILD_PYTHON=ON", "-DLIBDECK_UNITY=ON", "-DLIBDECK_BUILD_TESTS=OFF", "-DLIBDECK_WERROR=OFF"]
        if shutil.which("ninja"):
            configure += ["-G", "Ninja"]
        subprocess.run(["cmake", "-S", str(source), "-B", str(build), *configure], check=True)
        jobs = str(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", str(build), "-j", jobs, "--target", "_native"], check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(next(iter(sorted(folder.glob("_native.*")))), target)
        strip = shutil.which("strip")
        if strip:
            subprocess.run([strip, "--strip-unneeded", str(target)], check=False)
        write_stub(target)  # last: a module that is loaded must not change


setup(ext_modules=[Extension("libdeck._native", [])], cmdclass={"build_ext": CMakeBuild})
