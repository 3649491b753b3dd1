# Options of our own code, as two targets: `seacrane_options` for all, `seacrane_warnings` for what we wrote.
add_library(seacrane_options INTERFACE)
target_compile_features(seacrane_options INTERFACE cxx_std_20)
# Results stay IEEE (no -ffast-math): only errno from libm is given up, which lets sqrt become one instruction.
# -ffp-contract=off is what GCC does by itself here: a product and a sum are rounded each, on any processor.
# Eigen would load 3-vectors two numbers at a time: after single stores a processor waits for these.
target_compile_definitions(seacrane_options INTERFACE EIGEN_UNALIGNED_VECTORIZE=0)
if(MSVC)  # clang-cl; not run by us
  target_compile_options(seacrane_options INTERFACE /bigobj /utf-8)
  target_compile_definitions(seacrane_options INTERFACE NOMINMAX)
else()
  target_compile_options(seacrane_options INTERFACE
    -fno-math-errno $<$<CXX_COMPILER_ID:Clang,AppleClang>:-ffp-contract=off> $<$<CONFIG:Release>:-O3>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT SEACRANE_SANITIZE)
  # Less collecting of garbage within the compiler: a tenth of its time, for a few hundred MB of the dearest objects.
  target_compile_options(seacrane_options INTERFACE
    "SHELL:--param ggc-min-heapsize=600000" "SHELL:--param ggc-min-expand=100")
endif()
if(SEACRANE_NATIVE)
  target_compile_options(seacrane_options INTERFACE -march=native)
endif()
if(SEACRANE_SANITIZE)
  target_compile_options(seacrane_options INTERFACE
    -fsanitize=${SEACRANE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(SEACRANE_SANITIZE_NOT)
    target_compile_options(seacrane_options INTERFACE -fno-sanitize=${SEACRANE_SANITIZE_NOT})
  endif()
  target_link_options(seacrane_options INTERFACE -fsanitize=${SEACRANE_SANITIZE})
endif()

add_library(seacrane_warnings INTERFACE)
if(MSVC)
  target_compile_options(seacrane_warnings INTERFACE /W3)
else()
  target_compile_options(seacrane_warnings INTERFACE -Wall -Wextra)
endif()
if(SEACRANE_WERROR)
  target_compile_options(seacrane_warnings INTERFACE $<IF:$<BOOL:${MSVC}>,/WX,-Werror>)
endif()

if(SEACRANE_LTO)
  include(CheckIPOSupported)
  check_ipo_supported(LANGUAGES CXX)
  set(CMAKE_INTERPROCEDURAL_OPTIMIZATION ON)
endif()
