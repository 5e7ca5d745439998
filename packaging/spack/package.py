# SPDX-License-Identifier: Apache-2.0
# A recipe for Spack 1.0 or newer. Run in a checkout:
#     spack repo create build/spack mandelmarch
#     install -D -t build/spack/spack_repo/mandelmarch/packages/mandelmarch packaging/spack/package.py
#     spack repo add build/spack/spack_repo/mandelmarch
#     spack dev-build mandelmarch@0.1.0
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Mandelmarch(CMakePackage):
    """One kernel source for ray-marched fractals, rendered and timed through interchangeable backends."""

    license("Apache-2.0")

    # There is no archive to download: spack dev-build builds a checkout.
    version("0.1.0")

    variant("bench", default=True, description="The measuring harness bench, and demo")
    variant("kokkos", default=False, description="The backend kokkos")
    variant("mpi", default=False, description="Films whose work the ranks of an MPI program share")
    variant("opencl", default=False, description="The backend opencl")
    variant("stdpar", default=True, description="The backend stdpar, C++ standard parallelism")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("cli11@2.1:", type="build")
    depends_on("fmt@9.1:")
    depends_on("freetype")
    depends_on("highway@1.0.3:")
    depends_on("jpeg")
    depends_on("libpng")
    depends_on("nlohmann-json@3.11:", type="build")
    depends_on("openexr@3.1:")
    depends_on("boost", when="+bench", type="build")
    depends_on("kokkos+openmp", when="+kokkos")
    depends_on("mpi", when="+mpi")
    depends_on("opencl-clhpp", when="+opencl", type="build")
    depends_on("opencl-icd-loader", when="+opencl")
    depends_on("tbb", when="+stdpar")

    def cmake_args(self):
        backends = ["openmp", *(name for name in ("stdpar", "kokkos", "opencl") if self.spec.satisfies(f"+{name}"))]
        return [
            self.define("MANDELMARCH_BACKENDS", ",".join(backends)),
            self.define("MANDELMARCH_TESTS", False),
            self.define_from_variant("MANDELMARCH_MPI", "mpi"),
            # CMake also finds the system's libraries. Only the program explore uses pkg-config; it is not built, as
            # Spack's Dear ImGui has no imgui.pc.
            self.define("CMAKE_DISABLE_FIND_PACKAGE_Boost", self.spec.satisfies("~bench")),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_PkgConfig", True),
        ]
