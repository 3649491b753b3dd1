# Headers of libraries, read once for all files of a target: of most files they take longer to read than our own. Ours
# are not among them, so that an edit rebuilds what includes it and nothing else.
option(SEACRANE_PRECOMPILED "Read the headers of libraries once for a target (GCC)" ${SEACRANE_UNITY})

function(seacrane_precompiled target)
  if(SEACRANE_PRECOMPILED AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_precompile_headers(${target} PRIVATE ${ARGN})
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # as ccache asks for
  endif()
endfunction()
