"""Builds the native part with CMake; everything else is in pyproject.toml.

LIBDECK_BUILD_DIR names a build directory of libdeck whose objects are used again (with LIBDECK_SOURCE_DIR, where that is
not two directories above); without it everything is compiled.
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent
root = Path(os.environ.get("LIBDECK_SOURCE_DIR", here.parent.parent))


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = os.environ.get("LIBDECK_BUILD_DIR")
        configure = ["-DLIBDECK_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"]
        if not build:
            build = Path(self.build_temp).resolve()
            configure += ["-DCMAKE_BUILD_TYPE=Release", "-DLIBDECK_UNITY=ON", "-DLIBDECK_BUILD_TESTS=OFF", "-DLIBDECK_WERROR=OFF"]
            if shutil.which("ninja"):
                configure += ["-G", "Ninja"]
        subprocess.run(["cmake", "-S", str(root), "-B", str(build), *configure], check=True)
        jobs = str(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", str(build), "-j", jobs, "--target", "_native"], check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        built = sorted((Path(build) / "tools" / "python" / "libdeck").glob("_native.*"))
        shutil.copy(built[0], target)
        strip = shutil.which("strip")
        if strip:
            subprocess.run([strip, "--strip-unneeded", str(target)], check=False)


setup(ext_modules=[Extension("libdeck._native", [])], cmdclass={"build_ext": CMakeBuild})
