# Finds OpenVDB's C++ library with what its headers need: TBB, Imath and the headers of Boost. The find
# module that OpenVDB brings asks for Boost's iostreams library as well, which nothing here links.
#
# Target: OpenVDB::openvdb. Variable: OpenVDBCore_VERSION.
include(FindPackageHandleStandardArgs)
find_path(OpenVDBCore_INCLUDE_DIR openvdb/openvdb.h)
find_path(OpenVDBCore_BOOST_INCLUDE_DIR boost/any.hpp)
find_library(OpenVDBCore_LIBRARY openvdb)
find_package(TBB CONFIG QUIET)
# Not by Imath's own configuration: Debian's names files of a package that does not exist.
find_path(OpenVDBCore_IMATH_INCLUDE_DIR Imath/half.h)
find_library(OpenVDBCore_IMATH_LIBRARY Imath)
set(version_file ${OpenVDBCore_INCLUDE_DIR}/openvdb/version.h)
if(OpenVDBCore_INCLUDE_DIR AND EXISTS ${version_file})
  file(STRINGS ${version_file} version_lines
       REGEX "#define OPENVDB_LIBRARY_(MAJOR|MINOR|PATCH)_VERSION_NUMBER ")
  string(REGEX MATCHALL "[0-9]+" version_numbers "${version_lines}")
  list(JOIN version_numbers "." OpenVDBCore_VERSION)
endif()
find_package_handle_standard_args(OpenVDBCore
  REQUIRED_VARS OpenVDBCore_LIBRARY OpenVDBCore_INCLUDE_DIR OpenVDBCore_BOOST_INCLUDE_DIR
                OpenVDBCore_IMATH_LIBRARY OpenVDBCore_IMATH_INCLUDE_DIR TBB_FOUND
  VERSION_VAR OpenVDBCore_VERSION
  REASON_FAILURE_MESSAGE "install libopenvdb-dev and libboost-dev")
mark_as_advanced(OpenVDBCore_INCLUDE_DIR OpenVDBCore_BOOST_INCLUDE_DIR OpenVDBCore_LIBRARY
                 OpenVDBCore_IMATH_INCLUDE_DIR OpenVDBCore_IMATH_LIBRARY)
if(OpenVDBCore_FOUND AND NOT TARGET OpenVDB::openvdb)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION ${OpenVDBCore_LIBRARY})
  target_include_directories(OpenVDB::openvdb SYSTEM INTERFACE
    ${OpenVDBCore_INCLUDE_DIR} ${OpenVDBCore_BOOST_INCLUDE_DIR} ${OpenVDBCore_IMATH_INCLUDE_DIR})
  target_link_libraries(OpenVDB::openvdb INTERFACE TBB::tbb ${OpenVDBCore_IMATH_LIBRARY})
endif()
