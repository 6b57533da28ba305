# Defines grseg::formats, which reads runs of grseg. It needs the Debian packages libhdf5-dev, libeigen3-dev,
# libfmt-dev, libxxhash-dev and libdeflate-dev. FindHDF5 needs the languages C and CXX in project().
include(CMakeFindDependencyMacro)
find_dependency(HDF5 COMPONENTS C)
find_dependency(Eigen3 NO_MODULE)
find_dependency(fmt)
include(${CMAKE_CURRENT_LIST_DIR}/grseg-targets.cmake)
