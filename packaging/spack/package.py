import os

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Condyle(CMakePackage):
    """Where the bones of a joint run into each other: contact, depths and ranges of motion."""

    # The archive that scripts/release.sh makes, in the folder that CONDYLE_RELEASE names: spack install --no-checksum condyle. For
    # Spack the publisher writes homepage, url, maintainers and the sha256 of the published archive instead.
    url = f"file://{os.environ.get('CONDYLE_RELEASE', '/CONDYLE_RELEASE/names/no/folder')}/condyle-0.2.0.tar.gz"

    license("Apache-2.0 AND MIT AND ISC AND Zlib AND MPL-2.0 AND BSL-1.0")

    version("0.2.0")
    variant("python", default=False, description="Build the Python module")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("eigen@3.4:5")
    depends_on("intel-tbb@2021:")
    depends_on("boost@1.74:")
    depends_on("highway@1.0.3:")
    depends_on("hdf5~mpi")
    depends_on("zlib-api")
    depends_on("lz4")
    depends_on("fmt@9:")
    depends_on("nlohmann-json@3.11:")
    depends_on("cli11@2.1:")
    depends_on("tomlplusplus")
    with when("+python"):
        extends("python@3.9:")
        depends_on("py-pybind11@2.10:", type="build")
        depends_on("py-numpy@1.24:", type=("build", "run"))
        depends_on("py-numpy@:1", when="^py-pybind11@:2.11", type=("build", "run"))

    conflicts("%gcc@:11", msg="the sources are C++20")
    conflicts("%clang@:13", msg="the sources are C++20")
    requires("platform=linux", msg="built on Linux only")

    generator("ninja")

    def cmake_args(self):
        args = ["-DCONDYLE_TESTS=OFF", "-DCONDYLE_UNITY=ON", "-DCONDYLE_HDF5_INSIDE=OFF", self.define_from_variant("CONDYLE_PYTHON", "python")]
        if self.spec.satisfies("+python"):
            args += [f"-DPython_EXECUTABLE={python.path}", f"-DCONDYLE_PYTHON_INSTALL_DIR={python_platlib}"]
        return args
