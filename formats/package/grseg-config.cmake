# grseg::formats, which reads runs of grseg, and the Debian packages that it needs: libhdf5-dev, libeigen3-dev,
# libfmt-dev, libxxhash-dev, libdeflate-dev. FindHDF5 wants the languages C and CXX in project().
include(CMakeFindDependencyMacro)
find_dependency(HDF5 COMPONENTS C)
find_dependency(Eigen3 NO_MODULE)
find_dependency(fmt)
include(${CMAKE_CURRENT_LIST_DIR}/grseg-targets.cmake)
