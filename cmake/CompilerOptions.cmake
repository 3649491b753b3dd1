# Options of our own code, as two targets: `seacrane_options` for all, `seacrane_warnings` for what we wrote.
add_library(seacrane_options INTERFACE)
target_compile_features(seacrane_options INTERFACE cxx_std_20)
# Results stay IEEE (no -ffast-math): only errno from libm is given up, which lets sqrt become one instruction.
target_compile_options(seacrane_options INTERFACE -fno-math-errno $<$<CONFIG:Release>:-O3>)
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
target_compile_options(seacrane_warnings INTERFACE -Wall -Wextra)
if(SEACRANE_WERROR)
  target_compile_options(seacrane_warnings INTERFACE -Werror)
endif()

if(SEACRANE_LTO)
  include(CheckIPOSupported)
  check_ipo_supported(LANGUAGES CXX)
  set(CMAKE_INTERPROCEDURAL_OPTIMIZATION ON)
endif()
