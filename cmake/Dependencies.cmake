# Libraries of the system first; a pinned release otherwise.
#
# Not tried: the fall-backs below were written on a machine that cannot download. The SHA256 values are
# those published for the same archives by public package recipes (Homebrew for SUNDIALS; Homebrew and
# Spack for doctest; Bazel and CMake projects for Eigen), not computed by us. A wrong value stops the
# build with CMake's hash mismatch message; it cannot let a different archive in.
include(FetchContent)

set(SEACRANE_FETCH_TIMESTAMP "")
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.24)
  set(SEACRANE_FETCH_TIMESTAMP DOWNLOAD_EXTRACT_TIMESTAMP ON)
endif()

# Wheels take both from a folder of their own (tools/wheel/libraries.py), relative to this one where it is relative.
set(SEACRANE_LIBRARIES "" CACHE STRING "Folder with Eigen and SUNDIALS, looked into first")
if(SEACRANE_LIBRARIES)
  get_filename_component(seacrane_libraries "${SEACRANE_LIBRARIES}" ABSOLUTE BASE_DIR "${PROJECT_SOURCE_DIR}")
  list(PREPEND CMAKE_PREFIX_PATH "${seacrane_libraries}")
endif()

# Eigen 3.4 or newer; header-only, so the fall-back only needs its include folder (SOURCE_SUBDIR names a
# folder without CMakeLists.txt: Eigen's own would configure its tests and demos).
find_package(Eigen3 3.4 CONFIG QUIET)
if(Eigen3_FOUND)
  message(STATUS "Eigen ${Eigen3_VERSION}: ${Eigen3_DIR}")
else()
  message(STATUS "Eigen >= 3.4 not found (Debian: libeigen3-dev): fetching 3.4.0")
  FetchContent_Declare(eigen
    URL https://gitlab.com/libeigen/eigen/-/archive/3.4.0/eigen-3.4.0.tar.gz
    URL_HASH SHA256=8586084f71f9bde545ee7fa6d00288b264a2b7ac3607b974e54d13e7162c1c72
    SOURCE_SUBDIR headers-only ${SEACRANE_FETCH_TIMESTAMP})
  FetchContent_MakeAvailable(eigen)
  add_library(seacrane_eigen INTERFACE)
  target_include_directories(seacrane_eigen SYSTEM INTERFACE "${eigen_SOURCE_DIR}")
  add_library(Eigen3::Eigen ALIAS seacrane_eigen)
endif()

# SUNDIALS 6 or 7. Its version file accepts one major release only, so the range is checked here.
set(SEACRANE_SUNDIALS_COMPONENTS cvode ida nvecserial)
find_package(SUNDIALS CONFIG QUIET COMPONENTS ${SEACRANE_SUNDIALS_COMPONENTS})
if(SUNDIALS_FOUND AND (SUNDIALS_VERSION VERSION_LESS 6.0 OR SUNDIALS_VERSION VERSION_GREATER_EQUAL 8.0))
  message(STATUS "SUNDIALS ${SUNDIALS_VERSION} in ${SUNDIALS_DIR} is not 6.x or 7.x")
  set(SUNDIALS_FOUND FALSE)
endif()
if(SUNDIALS_FOUND)
  message(STATUS "SUNDIALS ${SUNDIALS_VERSION}: ${SUNDIALS_DIR}")
else()
  message(STATUS "SUNDIALS 6.x or 7.x not found (Debian: libsundials-dev): fetching 6.7.0")
  set(BUILD_SHARED_LIBS OFF CACHE BOOL "" FORCE)
  set(BUILD_STATIC_LIBS ON CACHE BOOL "" FORCE)
  foreach(unused ARKODE CVODES IDAS KINSOL)
    set(BUILD_${unused} OFF CACHE BOOL "" FORCE)
  endforeach()
  set(EXAMPLES_ENABLE_C OFF CACHE BOOL "" FORCE)
  set(EXAMPLES_ENABLE_CXX OFF CACHE BOOL "" FORCE)
  set(EXAMPLES_INSTALL OFF CACHE BOOL "" FORCE)
  FetchContent_Declare(sundials
    URL https://github.com/LLNL/sundials/releases/download/v6.7.0/sundials-6.7.0.tar.gz
    URL_HASH SHA256=5f113a1564a9d2d98ff95249f4871a4c815a05dbb9b8866a82b13ab158c37adb
    ${SEACRANE_FETCH_TIMESTAMP})
  FetchContent_MakeAvailable(sundials)
endif()

# Static archives make the module self-contained: a wheel then needs no library beyond the C++ run time.
# `core` exists from 7.0 on, where it must be linked by name.
add_library(seacrane_sundials INTERFACE)
foreach(component ${SEACRANE_SUNDIALS_COMPONENTS} core)
  if(TARGET SUNDIALS::${component}_static)
    target_link_libraries(seacrane_sundials INTERFACE SUNDIALS::${component}_static)
  elseif(TARGET SUNDIALS::${component} OR NOT component STREQUAL "core")
    target_link_libraries(seacrane_sundials INTERFACE SUNDIALS::${component})
  endif()
endforeach()

if(SEACRANE_PYTHON)
  set(PYBIND11_FINDPYTHON ON)
  set(CMAKE_INTERPROCEDURAL_OPTIMIZATION ${SEACRANE_LTO})  # where it is set, pybind11 does not try the linker for it
  find_package(pybind11 2.13 CONFIG REQUIRED)
endif()

if(SEACRANE_TESTS)
  find_package(doctest 2.4 CONFIG QUIET)
  if(NOT doctest_FOUND)
    message(STATUS "doctest not found (Debian: doctest-dev): fetching 2.4.11")
    FetchContent_Declare(doctest
      URL https://github.com/doctest/doctest/archive/refs/tags/v2.4.11.tar.gz
      URL_HASH SHA256=632ed2c05a7f53fa961381497bf8069093f0d6628c5f26286161fbd32a560186
      ${SEACRANE_FETCH_TIMESTAMP})
    FetchContent_MakeAvailable(doctest)
  endif()
endif()
