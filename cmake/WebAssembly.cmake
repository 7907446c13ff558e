# Sources compiled to WebAssembly: for the page (viewer/core) and for node (npm). Included after project(), by emscripten's CMake.
if(NOT EMSCRIPTEN)
  message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR} is compiled by emscripten: emcmake cmake -S ${CMAKE_CURRENT_SOURCE_DIR}")
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH condyle_root)

include(${CMAKE_CURRENT_LIST_DIR}/HeaderPackages.cmake)

# Sources compiled with a level of optimisation, those of one layer together: condyle_wasm_objects(target level source...)
set(CONDYLE_UNITY ON)
include(${CMAKE_CURRENT_LIST_DIR}/CompilerSettings.cmake)
function(condyle_wasm_objects target level)
  add_library(${target} OBJECT ${ARGN})
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_include_directories(${target} PRIVATE ${condyle_root}/viewer/core/libcxx ${condyle_root}/include ${condyle_root}/src)
  target_include_directories(${target} SYSTEM PRIVATE ${condyle_packages})
  # Products and sums are rounded one by one, as everywhere. Highway 1.0.3 has no doubles for WebAssembly: its emulation, which
  # the compiler vectorises, is chosen at compile time. Doubles become integers by one instruction where they need not trap.
  target_compile_options(${target} PRIVATE ${level} -ffp-contract=off -msimd128 -msse2 -mnontrapping-fptoint -fwasm-exceptions -include missing.hpp
                         # The same bytes whatever the folder: sources name themselves in messages.
                         -ffile-prefix-map=${CMAKE_BINARY_DIR}/= -ffile-prefix-map=${condyle_root}/=)
  # A number that goes into a vector is loaded where the source has it (0033).
  set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER ${condyle_root}/cmake/frozen_lanes.py)
  target_compile_definitions(${target} PRIVATE CONDYLE_THREADS_NONE HWY_COMPILE_ONLY_EMU128 FMT_HEADER_ONLY NDEBUG)
  condyle_unify(${target} ${condyle_root}/src)
endfunction()

# Refuses a program that has the instruction which the compiler may misplace.
function(condyle_refuse_splat_loads target)
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
                     COMMAND ${condyle_root}/cmake/refuse_splat_loads.sh $<PATH:REPLACE_EXTENSION,$<TARGET_FILE:${target}>,wasm>)
endfunction()
