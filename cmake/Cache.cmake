# ccache behind every compile, where it is installed: what was compiled once on a machine, in any folder and for any
# build of the project, is taken from its cache. A compiler launcher that the user names stays.
option(SEACRANE_CCACHE "Compile through ccache where it is installed" ON)
if(SEACRANE_CCACHE_PROGRAM AND NOT EXISTS "${SEACRANE_CCACHE_PROGRAM}")
  unset(SEACRANE_CCACHE_PROGRAM CACHE)  # it was removed since the last configuration
endif()
find_program(SEACRANE_CCACHE_PROGRAM ccache)
mark_as_advanced(SEACRANE_CCACHE_PROGRAM)
if(SEACRANE_CCACHE AND SEACRANE_CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Paths below the base folder are hashed relative to it, so that clones share objects. A compiler from a package of
  # Python has another date in each environment: its content decides. Who builds may say another of both.
  set(CCACHE_BASEDIR "${PROJECT_SOURCE_DIR}")
  set(CCACHE_COMPILERCHECK content)
  set(settings)
  foreach(name CCACHE_BASEDIR CCACHE_COMPILERCHECK)
    if(DEFINED ENV{${name}})
      set(${name} "$ENV{${name}}")
    endif()
    list(APPEND settings "${name}=${${name}}")
  endforeach()
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env ${settings} CCACHE_NOHASHDIR=1 "${SEACRANE_CCACHE_PROGRAM}")
  set(CMAKE_C_COMPILER_LAUNCHER "${CMAKE_CXX_COMPILER_LAUNCHER}")
endif()
