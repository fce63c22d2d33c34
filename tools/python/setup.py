"""Builds the native part with CMake; everything else is in pyproject.toml.

Everything is compiled, unless LIBDECK_PREFIX names where a libdeck of the same version is installed.
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent


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


setup(ext_modules=[Extension("libdeck._native", [])], cmdclass={"build_ext": CMakeBuild})
