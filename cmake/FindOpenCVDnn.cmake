# Finds the parts of OpenCV that Debian packages one by one: libopencv-core-dev, libopencv-imgproc-dev,
# libopencv-dnn-dev. OpenCV's own OpenCVConfig.cmake is only in libopencv-dev, which brings all of
# OpenCV and a gigabyte with it.
#
# Targets: OpenCV::core, OpenCV::imgproc, OpenCV::dnn. Variable: OpenCVDnn_VERSION.
include(FindPackageHandleStandardArgs)
find_path(OpenCVDnn_INCLUDE_DIR opencv2/dnn.hpp PATH_SUFFIXES opencv4)
set(components core imgproc dnn)
foreach(component IN LISTS components)
  find_library(OpenCVDnn_${component}_LIBRARY opencv_${component})
endforeach()
set(version_file ${OpenCVDnn_INCLUDE_DIR}/opencv2/core/version.hpp)
if(OpenCVDnn_INCLUDE_DIR AND EXISTS ${version_file})
  file(STRINGS ${version_file} version_lines REGEX "#define CV_VERSION_(MAJOR|MINOR|REVISION) ")
  string(REGEX MATCHALL "[0-9]+" version_numbers "${version_lines}")
  list(JOIN version_numbers "." OpenCVDnn_VERSION)
endif()
find_package_handle_standard_args(OpenCVDnn
  REQUIRED_VARS OpenCVDnn_dnn_LIBRARY OpenCVDnn_imgproc_LIBRARY OpenCVDnn_core_LIBRARY OpenCVDnn_INCLUDE_DIR
  VERSION_VAR OpenCVDnn_VERSION
  REASON_FAILURE_MESSAGE "install libopencv-core-dev, libopencv-imgproc-dev and libopencv-dnn-dev")
mark_as_advanced(OpenCVDnn_INCLUDE_DIR OpenCVDnn_core_LIBRARY OpenCVDnn_imgproc_LIBRARY OpenCVDnn_dnn_LIBRARY)
if(OpenCVDnn_FOUND)
  foreach(component IN LISTS components)
    if(NOT TARGET OpenCV::${component})
      add_library(OpenCV::${component} UNKNOWN IMPORTED)
      set_target_properties(OpenCV::${component} PROPERTIES
        IMPORTED_LOCATION ${OpenCVDnn_${component}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenCVDnn_INCLUDE_DIR})
    endif()
  endforeach()
endif()
