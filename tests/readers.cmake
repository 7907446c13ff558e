# Holds that every reader of text or files is tried by a fuzz target: each function read_… or parse_… that a header of io declares is named in
# tests/fuzz, or here with the one that leads to it. Run as cmake -DSOURCE=... -P readers.cmake.

cmake_minimum_required(VERSION 3.25)  # a script knows IN_LIST only with a policy version

# By read_mesh, read_labels, read_motion_table, read_study_table, read_joint and read_model.
set(led_to read_obj read_ply read_stl read_vtp read_legacy_vtk read_coordinates read_integers read_metaimage read_nifti read_nifti_header read_nrrd
    read_nrrd_header read_block read_voxels read_csv_table read_opensim_table read_columns_csv read_vertex_marks read_study read_study_record
    parse_number)
# No format: bytes, and two files at once. read_targets() is parse_targets() of a file; a sweep's result is JSON of ours, which nlohmann-json reads.
list(APPEND led_to read_at read_pair read_targets read_sweep_result)

file(GLOB_RECURSE headers ${SOURCE}/include/condyle/io/*.hpp ${SOURCE}/src/io/*.hpp)
file(GLOB targets ${SOURCE}/tests/fuzz/*_fuzz.cpp ${SOURCE}/tests/fuzz/*_promise.cpp)
set(tried)
foreach(target ${targets})
  file(READ ${target} text)
  string(APPEND tried "${text}")
endforeach()
set(missing)
foreach(header ${headers})
  file(STRINGS ${header} lines REGEX "[^a-z_](read|parse)_[a-z_]+\\(")
  foreach(line ${lines})
    string(REGEX REPLACE ".*[^a-z_]((read|parse)_[a-z_]+)\\(.*" "\\1" name "${line}")
    if(NOT tried MATCHES "[^a-z_]${name}\\(" AND NOT name IN_LIST led_to AND NOT line MATCHES "^ *//")
      list(APPEND missing "${header}: ${name}")
    endif()
  endforeach()
endforeach()
if(missing)
  list(JOIN missing "\n" lines)
  message(FATAL_ERROR "without a fuzz target:\n${lines}")
endif()
