# What every Condyle target is compiled with: condyle_settings_for(target).

# A project that Condyle is part of decides these for itself.
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(NOT CMAKE_BUILD_TYPE AND NOT multi_config)
    set(CMAKE_BUILD_TYPE Release)
  endif()
endif()

function(condyle_settings_for target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                           $<$<BOOL:${CONDYLE_WERROR}>:-Werror>)
  # GCC 12 sees overlapping copies in "text" + std::string where there are none (its bug 105651).
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  # GCC 13 and 14 take a span of static storage that a function returns for a temporary.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-dangling-reference>)
  # Predicates rely on a*b - c*d being rounded product by product: a fused multiply-add would break the sign symmetry of
  # a x b and b x a, and make results depend on the instruction set. Public, for whoever uses the library too: of an
  # inline function or template that both compile (ours, Eigen's) the linker keeps one copy, and it may be theirs.
  target_compile_options(${target} PUBLIC -ffp-contract=off)
  if(CONDYLE_SANITIZE)
    condyle_sanitize(${target})
  endif()
endfunction()

# What a release has against faults that tests did not find, in all that meets a stranger's bytes: files, arguments, arrays of other
# languages. A stack that is written over ends the process, calls of the C library with a size that the compiler knows are checked,
# and jumps go where functions begin. The kernels between have neither buffers of bytes nor sizes from outside, and are measured
# without. docs/reliability.md
include(CheckCXXCompilerFlag)
function(condyle_harden target)
  if(CONDYLE_SANITIZE OR EMSCRIPTEN)
    return()
  endif()
  foreach(flag -fstack-protector-strong -fstack-clash-protection -fcf-protection)
    string(MAKE_C_IDENTIFIER ${flag} known)
    check_cxx_compiler_flag(${flag} CONDYLE_HAS${known})
    if(CONDYLE_HAS${known})
      target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${flag}>)
    endif()
  endforeach()
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=2>)
endfunction()

# Of programs and shared libraries: addresses of functions are found before the first instruction, and cannot be written afterwards.
function(condyle_bind_at_start target)
  if(NOT CONDYLE_SANITIZE AND NOT EMSCRIPTEN)
    target_link_options(${target} PRIVATE LINKER:-z,relro LINKER:-z,now)
  endif()
endfunction()

# Of programs and shared libraries: what the core calls of Highway's library is in them. That library measures its clock whenever a process
# loads it, which took 40 % of what a command takes to start: docs/decisions/0032-static-command.md.
function(condyle_do_without_highway_library target)
  if(condyle_highway)  # The core has it otherwise.
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src/simd/highway_targets.cpp)
    target_link_options(${target} PRIVATE LINKER:--as-needed)
  endif()
endfunction()

# Has the headers that most files of a target include compiled once for all of them: condyle_precompile(target [FEW_UNITS]
# header...). With FEW_UNITS not where sources compile several at a time: to precompile then takes longer than it spares.
# What keeps forgotten includes from passing unseen: docs/decisions/0006-faster-builds.md.
function(condyle_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 precompile "FEW_UNITS" "" "")
  if(CONDYLE_PRECOMPILED_HEADERS AND NOT (precompile_FEW_UNITS AND CONDYLE_UNITY))
    target_precompile_headers(${target} PRIVATE ${precompile_UNPARSED_ARGUMENTS})
    condyle_settings_for_precompiled(${target})
  endif()
endfunction()

# The same with the headers of another target that is compiled as this one is.
function(condyle_precompile_as target other)
  if(CONDYLE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${other})
    condyle_settings_for_precompiled(${target})
  endif()
endfunction()

function(condyle_settings_for_precompiled target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 forgets which of these headers are the system's, and says of std::string what it else keeps to itself.
    target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
    # It would look for garbage among what it has just read: up to a seventh of the time of the command's files.
    target_compile_options(${target} PRIVATE --param=ggc-min-expand=1000)
  endif()
endfunction()

# Compiles the sources of a target several at a time, so that the headers that they share are read once for all of them, and the
# templates that they share compiled once: most of their time. Those of one layer (the first folder below the target's) go
# together, in units of about equal size: private names have to differ within a layer. Sources that Highway compiles once for every
# instruction set stay out. Layers are folders below the target's, or below another: condyle_unify(target [folder]).
function(condyle_unify target)
  if(NOT CONDYLE_UNITY)
    return()
  endif()
  set(largest_unit 250000)  # bytes of source: half a minute and less than 2 GB of memory
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A source that is included looks to GCC like a header, whose private types no class should hold; and where it inlines more, GCC 12
  # sees members of empty optionals moved. A local name may be a private one of another file.
  target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage -Wno-maybe-uninitialized>)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder_of_target ${target} SOURCE_DIR)
  set(folder_of_layers ${folder_of_target})
  if(ARGC GREATER 1)
    set(folder_of_layers ${ARGV1})
  endif()
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder_of_target} OUTPUT_VARIABLE path)
    file(STRINGS ${path} own_translation_unit REGEX "foreach_target\\.h" LIMIT_COUNT 1)
    if(own_translation_unit)
      continue()
    endif()
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${folder_of_layers})
    string(REGEX MATCH "^[^/]+" layer "${folder}")
    string(MAKE_C_IDENTIFIER "${layer}" layer)
    file(SIZE ${path} bytes)
    if(NOT DEFINED unit_of_${layer})
      set(unit_of_${layer} 0)
      set(bytes_of_${layer} ${bytes})
    else()
      math(EXPR bytes_of_${layer} "${bytes_of_${layer}} + ${bytes}")
      if(bytes_of_${layer} GREATER largest_unit)
        math(EXPR unit_of_${layer} "${unit_of_${layer}} + 1")
        set(bytes_of_${layer} ${bytes})
      endif()
    endif()
    set_source_files_properties(${path} PROPERTIES UNITY_GROUP ${layer}_${unit_of_${layer}})
  endforeach()
endfunction()
