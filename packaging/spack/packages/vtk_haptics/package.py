# Copyright the VTK Haptics authors. SPDX-License-Identifier: BSD-3-Clause
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class VtkHaptics(CMakePackage):
    """Touch the surface of any vtkPolyData with a haptic device: a god-object follows the hand and
    never passes the surface, and a servo thread renders forces at 1 kHz."""

    # A release has a url and a checksum here; until then the sources are those around this file,
    # by `spack develop --path . vtk-haptics@1.0.0`.
    license("BSD-3-Clause", checked_by="the authors")

    version("1.0.0")

    variant("paraview", default=False, description="Build the ParaView plugin, for ParaView's VTK")
    variant("python", default=True, description="Build the Python package vtkhaptics")
    variant("haply", default=True, description="Build the driver of the Haply Inverse3")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")

    depends_on("vtk@9.1: +opengl2", when="~paraview")
    depends_on("vtk +python", when="~paraview +python")
    depends_on("paraview@5.11: +qt", when="+paraview")
    depends_on("paraview +python", when="+paraview +python")
    depends_on("glm")
    depends_on("embree@3:4")
    depends_on("cgal@5.5:")
    depends_on("libusb")
    depends_on("boost@1.74:", when="+haply")
    depends_on("nlohmann-json", when="+haply")
    extends("python", when="+python")
    depends_on("py-numpy", when="+python", type=("build", "run"))

    requires("platform=linux", msg="what keeps it from others is in packaging/PORTING.md")

    generator("ninja")

    def cmake_args(self):
        args = [
            self.define_from_variant("HAPTICS_BUILD_PARAVIEW_PLUGIN", "paraview"),
            self.define_from_variant("HAPTICS_WRAP_PYTHON", "python"),
            self.define_from_variant("HAPTICS_DEVICE_HAPLY", "haply"),
            self.define("BUILD_TESTING", False),
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("Python3_EXECUTABLE", self.spec["python"].command.path))
        return args
