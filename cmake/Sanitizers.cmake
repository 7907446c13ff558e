# What CONDYLE_SANITIZE adds to every Condyle target: condyle_sanitize(target). With clang only: of inlined Eigen code GCC 12
# says under its sanitizers that values may be used uninitialised which are not.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  message(FATAL_ERROR "CONDYLE_SANITIZE needs clang: -DCMAKE_CXX_COMPILER=clang++")
endif()

set(condyle_sanitizer_flags -fsanitize=${CONDYLE_SANITIZE})
# Left out: whether each reference is null or unaligned and each pointer stays in its object, which makes Eigen's small functions
# many times slower. The address sanitizer sees what would come of most of them.
set(condyle_unchecked -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow)
if(CONDYLE_PYTHON)
  # The module's address sanitizer comes before Python's own code, as a shared library that is preloaded, and the command
  # that Python's tests start must have the same one.
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.so
                  OUTPUT_VARIABLE CONDYLE_SANITIZER_LIBRARY OUTPUT_STRIP_TRAILING_WHITESPACE)
  get_filename_component(sanitizer_folder ${CONDYLE_SANITIZER_LIBRARY} DIRECTORY)
  list(APPEND condyle_sanitizer_flags -shared-libasan -Wl,-rpath,${sanitizer_folder})
endif()

function(condyle_sanitize target)
  # Checked containers beside: what runs past a vector's end within its capacity is no error of memory.
  target_compile_options(${target} PRIVATE -fsanitize=${CONDYLE_SANITIZE} ${condyle_unchecked} -fno-sanitize-recover=all
                                           -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS)
  target_link_options(${target} PUBLIC ${condyle_sanitizer_flags})
  if(CONDYLE_SANITIZE STREQUAL "thread")
    target_compile_options(${target} PRIVATE -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/thread_sanitizer/not_instrumented.txt)
  endif()
  if(CONDYLE_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()
