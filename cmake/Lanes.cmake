# Modules that step several runs side by side, one for each kind of processor; the package chooses when it is
# imported. Each is a library of its own: inline functions have one name, whatever they are compiled for, and a linker
# keeps one of them. Its copy of the core stays within it, and its code runs only where the processor has what both
# were compiled for. The alignment is that of the core, whose models it reads.
string(TOLOWER "${CMAKE_SYSTEM_PROCESSOR}" seacrane_processor)
if(seacrane_processor MATCHES "x86_64|amd64" AND NOT MSVC AND NOT SEACRANE_NATIVE)
  set(seacrane_lanes_here ON)
else()
  set(seacrane_lanes_here OFF)
endif()
option(SEACRANE_LANES "Build the modules that step runs side by side" ${seacrane_lanes_here})

include(CheckCXXCompilerFlag)

function(seacrane_lanes instructions lanes)
  if(NOT SEACRANE_LANES)
    return()
  endif()
  set(module _lanes_${instructions})
  pybind11_add_module(${module} MODULE NO_EXTRAS "${CMAKE_CURRENT_SOURCE_DIR}/lanes/lanes.cpp")
  target_compile_definitions(${module} PRIVATE
    SEACRANE_LANES=${lanes} SEACRANE_INSTRUCTIONS="${instructions}" SEACRANE_LANE_MODULE=${module}
    EIGEN_MAX_ALIGN_BYTES=16)
  # Packs live in structures, which are to be inlined, and copied in whole registers: a register that is read
  # after its halves were written waits for both.
  math(EXPR bits "64 * ${lanes}")
  check_cxx_compiler_flag("-mmove-max=${bits}" seacrane_moves_${bits})
  target_compile_definitions(${module} PRIVATE "EIGEN_STRONG_INLINE=__attribute__((always_inline)) inline")
  target_compile_options(${module} PRIVATE ${ARGN}
    $<$<BOOL:${seacrane_moves_${bits}}>:-mmove-max=${bits};-mstore-max=${bits}>)
  # Of the file: what a target takes over from seacrane_options stands after its own, and would win.
  set_source_files_properties("${CMAKE_CURRENT_SOURCE_DIR}/lanes/lanes.cpp" PROPERTIES COMPILE_OPTIONS
    "$<$<CXX_COMPILER_ID:Clang,AppleClang>:-ffp-contract=fast>")
  seacrane_kinds(${module} "${load_registry}" "${CMAKE_CURRENT_SOURCE_DIR}/lanes/load.cpp.in" 20)
  target_link_libraries(${module} PRIVATE seacrane seacrane_warnings)
  seacrane_hide_names(${module})
  add_dependencies(seacrane_modules ${module})
  install(TARGETS ${module} LIBRARY DESTINATION seacrane COMPONENT python)
endfunction()

# Symbols of a module, those of the static SUNDIALS too, must not meet others in the same Python process.
function(seacrane_hide_names target)
  if(APPLE OR MSVC)
    return()
  endif()
  set(map "${CMAKE_CURRENT_SOURCE_DIR}/bindings/shown_names.map")
  target_link_options(${target} PRIVATE "-Wl,--version-script=${map}" $<$<CONFIG:Release>:-s>)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS "${map}")
endfunction()
