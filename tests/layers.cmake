# Holds what every file of src/ and every public header uses against the layers of docs/concepts.md: a layer uses itself
# and those listed for it, nothing else, and each one listed. Run as cmake -DSOURCE=... -P layers.cmake.
#
# A use is an #include, or a name from the other layer's namespace: a name that came in with somebody else's header.

cmake_minimum_required(VERSION 3.25)  # a script knows IN_LIST only with a policy version

set(layers core simd mesh kinematics radial tangential contact motion measure plan answer sample io)
set(core_uses)
set(simd_uses core)
set(mesh_uses core simd)
set(kinematics_uses core mesh)
set(radial_uses core simd mesh)
set(tangential_uses core simd mesh)
set(contact_uses core mesh kinematics radial tangential)
set(motion_uses core mesh kinematics radial tangential contact)
set(measure_uses core mesh kinematics motion)
set(plan_uses core mesh kinematics tangential motion)
set(answer_uses core mesh kinematics contact motion measure plan)
set(sample_uses core mesh plan)
set(io_uses core mesh kinematics radial tangential contact motion measure plan answer sample)

# The layer of each public header. An AxisFrame is made in kinematics; as a plain value it is everybody's.
set(core_headers angle control error pose version)
set(simd_headers)
set(mesh_headers inspect label_surface mesh)
set(kinematics_headers fit joint joint_checks joint_coordinates make_joint zero_pose)
set(radial_headers radial)
set(tangential_headers tangential)
set(contact_headers contact contact_measures normal_depth pressure)
set(motion_headers bearing first_contact impingement_zone limit_band motion_contact motion_map
                   range_of_motion)
set(measure_headers hip_measures)
set(plan_headers brush implant resection sweep)
set(answer_headers answer)
set(sample_headers)
set(io_headers)

# Layers whose public names are directly in `condyle`; those of the others are in condyle::LAYER.
set(layers_without_namespace core mesh kinematics answer)

# Variables that the layer of a public header is looked up in.
foreach(layer ${layers})
  foreach(header ${${layer}_headers})
    set(layer_of_${header} ${layer})
  endforeach()
endforeach()

function(layer_of_public_header header result)  # header: what follows condyle/, without .hpp
  if(header MATCHES "^(answer|io|sample)/")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  elseif(DEFINED layer_of_${header})
    set(${result} ${layer_of_${header}} PARENT_SCOPE)
  else()
    message(SEND_ERROR "condyle/${header}.hpp has no layer: name it in tests/layers.cmake")
    set(${result} core PARENT_SCOPE)
  endif()
endfunction()

set(checked 0)
function(use layer used file line)
  math(EXPR more "${checked} + 1")
  set(checked ${more} PARENT_SCOPE)
  if(NOT used STREQUAL layer)
    set(${layer}_does_use_${used} TRUE PARENT_SCOPE)
    if(NOT ${used} IN_LIST ${layer}_uses)
      message(SEND_ERROR "${file}: ${layer} must not use ${used}: ${line}")
    endif()
  endif()
endfunction()

string(REPLACE ";" "|" any_layer "${layers}")
file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/src/*.hpp ${SOURCE}/src/*.cpp ${SOURCE}/include/condyle/*.hpp)
list(REMOVE_ITEM files include/condyle/condyle.hpp include/condyle/answer.hpp)  # umbrellas
foreach(file ${files})
  if(file MATCHES "^src/([a-z]+)/")
    set(layer ${CMAKE_MATCH_1})
    if(NOT layer IN_LIST layers)
      message(SEND_ERROR "${file}: ${layer} is no layer")
    endif()
  else()
    string(REGEX REPLACE "^include/condyle/(.*)\\.hpp$" "\\1" header ${file})
    layer_of_public_header(${header} layer)
    set(namespace condyle::${layer})
    if(layer IN_LIST layers_without_namespace)
      set(namespace condyle)
    endif()
    file(STRINGS ${SOURCE}/${file} own_namespace REGEX "^namespace ${namespace} {")
    if(NOT own_namespace)
      message(SEND_ERROR "${file}: the public names of ${layer} are in ${namespace}")
    endif()
  endif()

  file(STRINGS ${SOURCE}/${file} lines REGEX "#include|[^a-z_](${any_layer})::")
  foreach(line IN LISTS lines)
    if(line MATCHES "#include [\"<]condyle/(.*)\\.hpp[\">]")
      layer_of_public_header(${CMAKE_MATCH_1} used)
      use(${layer} ${used} ${file} "${line}")
    elseif(line MATCHES "#include \"([a-z]+)/")
      use(${layer} ${CMAKE_MATCH_1} ${file} "${line}")
      if((file MATCHES "^src/[a-z]+/exact/" AND line MATCHES "/(build|query|update)/")
         OR (file MATCHES "^src/[a-z]+/build/" AND line MATCHES "/(query|update)/"))
        message(SEND_ERROR "${file}: exact/ must not look into build/, nor build/ into query/: ${line}")
      endif()
    elseif(line MATCHES "#include <(hwy/|vtk|hdf5|fmt/|nlohmann/|CLI/|toml)")
      set(package ${CMAKE_MATCH_1})
      if(package STREQUAL "hwy/")
        # What compiles a source once for every instruction set cannot come from another file.
        if(NOT layer STREQUAL "simd" AND NOT line MATCHES "<hwy/foreach_target\\.h>")
          message(SEND_ERROR "${file}: only simd/ opens Highway: ${line}")
        endif()
      elseif(NOT layer MATCHES "^(io|sample)$")
        message(SEND_ERROR "${file}: the core uses Eigen, oneTBB, Highway and Boost headers only: ${line}")
      endif()
    elseif(line MATCHES "^[^/\"]*[^a-z_:/.\"](condyle::)?(${any_layer})::")
      use(${layer} ${CMAKE_MATCH_2} ${file} "${line}")
    endif()
  endforeach()
endforeach()

# What is read is opened by io/file/input_file.hpp, which records it for keys. Shards and rows that are kept are a study's own files.
file(GLOB_RECURSE readers RELATIVE ${SOURCE} ${SOURCE}/src/*.hpp ${SOURCE}/src/*.cpp ${SOURCE}/cli/*.cpp ${SOURCE}/cli/*.hpp
     ${SOURCE}/python/bindings/*.cpp)
list(FILTER readers EXCLUDE REGEX "^src/io/(file/|study/(answered_rows|merge_study|study_files))")
# No line of these files matches.
function(refuse why regex)
  foreach(file ${ARGN})
    file(STRINGS ${SOURCE}/${file} lines REGEX ${regex})
    foreach(line IN LISTS lines)
      message(SEND_ERROR "${file}: ${why}: ${line}")
    endforeach()
  endforeach()
endfunction()
refuse("files and the environment are read by io/file/input_file.hpp"
       "fopen\\(|fstream|opendir\\(|directory_iterator|getenv\\(|is_regular_file\\(|[^a-z_]file_size\\(|mmap\\(" ${readers})

# Sines have the bits of core/trigonometry.hpp everywhere; those of C libraries differ in their last.
file(GLOB_RECURSE computing RELATIVE ${SOURCE} ${SOURCE}/src/*.?pp ${SOURCE}/include/*.hpp ${SOURCE}/cli/*.?pp ${SOURCE}/viewer/core/*.?pp)
list(FILTER computing EXCLUDE REGEX "^src/core/trigonometry\\.|^src/tangential/exact/arctangent")
refuse("core/trigonometry.hpp has the same bits everywhere" "std::a?(sin|cos|tan)h?2?\\(|AngleAxisd" ${computing})

# So have exponentials, and what is drawn; a share below is rounded to tenths.
list(FILTER computing EXCLUDE REGEX "^src/core/exponential\\.cpp|^src/sample/cohort\\.cpp")
refuse("core/exponential.hpp has the same bits everywhere"
       "std::(exp|expm1|log|log1p|log2|log10|pow|cbrt|hypot|erfc?|[lt]gamma)\\(|<boost/math" ${computing})
refuse("libraries differ in what they draw and in the order of their parts"
       "_distribution<|std::(shuffle|sample|reduce|transform_reduce|hash)[(<]" ${computing})

# The library of emscripten's compiler for the page and the npm package has no algorithms of ranges.
refuse("clang 14's library lacks it" "std::ranges::[a-z]" ${computing})

# What is answered is decided in answer/: shells ask it, and not the kernels below. Each exception with its reason.
set(kernels "motion::(motion_map|limit_bands|contact_along|balance_along|contact_between|RangeOfMotion|ZoneFinder|DepthRange)"
            "measure::measure_(hip|bands)" "plan::(resect|place_total_hip|DesignLimits)" "contact::balance")
list(JOIN kernels "|" kernels)
set(exceptions
    cli/picture.cpp                      # marks of measures: nothing of them is said
    python/bindings/report.cpp           # likewise, of Joint.picture()
    python/bindings/joint.hpp            # keeps the tables that limits_of_poses() made between poses that a caller chooses
    python/bindings/motion_contact.cpp   # one step of a loop that a caller writes: answer_load() looks at 16 places of each triangle more
    python/bindings/depth_range.cpp      # keeps its tables between poses that a caller chooses
    python/bindings/recorded_motion.cpp  # between samples only, whose times need no frames
    viewer/core/page_core.cpp            # a slider: one limit in milliseconds, by tables that exact_limits() made
    viewer/core/page_edit.cpp            # a brushed bone: the same tables with moved vertices
    viewer/core/page_joint.hpp)          # holds them
file(GLOB_RECURSE shells RELATIVE ${SOURCE} ${SOURCE}/cli/*.?pp ${SOURCE}/python/bindings/*.?pp ${SOURCE}/viewer/core/*.?pp
     ${SOURCE}/src/io/study/*.?pp ${SOURCE}/src/io/report/*.?pp ${SOURCE}/src/io/sweep/*.?pp)
foreach(file ${shells})
  file(STRINGS ${SOURCE}/${file} lines REGEX "(${kernels})[ ({&>]")
  if(lines AND NOT file IN_LIST exceptions)
    message(SEND_ERROR "${file}: answer/ answers this: ${lines}")
  elseif(NOT lines AND file IN_LIST exceptions)
    message(SEND_ERROR "${file}: asks answer/ only: take it from the exceptions")
  endif()
endforeach()

foreach(layer ${layers})
  foreach(used ${${layer}_uses})
    if(NOT ${layer}_does_use_${used})
      message(SEND_ERROR "nothing in ${layer} uses ${used}: take it from the table")
    endif()
  endforeach()
endforeach()
if(checked LESS 500)
  message(SEND_ERROR "only ${checked} uses were found: is SOURCE right?")
endif()

# The table that people read says the same.
file(STRINGS ${SOURCE}/docs/concepts.md rows REGEX "^\\| `[a-z]+` \\|")
foreach(row IN LISTS rows)
  string(REGEX MATCH "^\\| `([a-z]+)` \\|.*\\| *([a-z, ]*)\\|$" matched "${row}")
  set(layer ${CMAKE_MATCH_1})
  string(REGEX MATCHALL "[a-z]+" written "${CMAKE_MATCH_2}")
  if(NOT layer IN_LIST layers)
    continue()  # another table
  endif()
  list(REMOVE_ITEM layers ${layer})
  if(NOT "${written}" STREQUAL "${${layer}_uses}")
    message(SEND_ERROR "docs/concepts.md lets ${layer} use '${written}', tests/layers.cmake '${${layer}_uses}'")
  endif()
endforeach()
if(layers)
  message(SEND_ERROR "docs/concepts.md has no row for ${layers}")
endif()
