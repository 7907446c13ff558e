# What every Condyle target is compiled with: condyle_settings_for(target).

# A project that Condyle is part of decides these for itself.
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(NOT CMAKE_BUILD_TYPE AND NOT multi_config)
    set(CMAKE_BUILD_TYPE Release)
  endif()

  find_program(CONDYLE_CCACHE ccache)
  if(CONDYLE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CONDYLE_CCACHE})
  endif()
endif()

function(condyle_settings_for target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                           $<$<BOOL:${CONDYLE_WERROR}>:-Werror>)
  # GCC 12 sees overlapping copies in "text" + std::string where there are none (its bug 105651).
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  # Predicates rely on a*b - c*d being rounded product by product: a fused multiply-add would break the sign symmetry of
  # a x b and b x a, and make results depend on the instruction set. Public, for whoever uses the library too: of an
  # inline function or template that both compile (ours, Eigen's) the linker keeps one copy, and it may be theirs.
  target_compile_options(${target} PUBLIC -ffp-contract=off)
  if(CONDYLE_SANITIZE)
    condyle_sanitize(${target})
  endif()
endfunction()
