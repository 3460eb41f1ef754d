# SPDX-License-Identifier: MIT
# Our targets, and what they are compiled with: nothing of it reaches a project that adds this folder, but C++20, and
# that rounding is the same (controller/CMakeLists.txt).

if(EMSCRIPTEN)
  # A module with threads cannot be loaded everywhere, and the same objects cannot be linked without them (the linker
  # gives thread_local variables no place then), so there are two builds.
  option(BANYAN_WASM_THREADS "Build for pages that are served isolated: with threads" OFF)
endif()

if((CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 11) OR
   (CMAKE_CXX_COMPILER_ID MATCHES Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14))
  message(FATAL_ERROR "Banyan needs gcc 11 or clang 14; this is ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
endif()

# Fused multiply-add would give other results than separate instructions (docs/determinism.md).
set(options -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
set(link_options "")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  list(APPEND options -Wno-restrict)  # fires on "text" + std::string (gcc bug 105329)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # A tenth of compiling was gcc collecting its own garbage; a source takes up to 1.2 GB instead of 0.9.
  list(APPEND options "SHELL:--param ggc-min-heapsize=1000000" "SHELL:--param ggc-min-expand=300")
endif()
if(EMSCRIPTEN)
  # WebAssembly's own exceptions (browsers and Node.js of 2022 or later) instead of emscripten's older
  # way, which calls JavaScript around what may throw.
  list(APPEND options -fwasm-exceptions -Wno-shorten-64-to-32)  # there, std::size_t has 32 bits
  list(APPEND link_options -fwasm-exceptions)
  if(BANYAN_WASM_THREADS)
    list(APPEND options -pthread)
  endif()
endif()
if(BANYAN_WERROR)
  list(APPEND options -Werror)
endif()
if(BANYAN_SANITIZE)
  # vptr would need the run-time type information that the controller is built without.
  list(APPEND options -fsanitize=${BANYAN_SANITIZE} -fno-sanitize=vptr -fno-sanitize-recover=all -fno-omit-frame-pointer)
  list(APPEND link_options -fsanitize=${BANYAN_SANITIZE})
endif()
set(BANYAN_OPTIONS ${options})
set(BANYAN_LINK_OPTIONS ${link_options})
unset(options)
unset(link_options)
# Where sources are joined, names of one hide those of another, a source looks like a header, and a
# test's operator new is seen beside its uses.
set(BANYAN_JOINED_SOURCES_MAY -Wno-shadow
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage> $<$<CXX_COMPILER_ID:GNU>:-Wno-mismatched-new-delete>)

# What every target of ours is compiled with.
function(banyan_own target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE ${BANYAN_OPTIONS})
  target_link_options(${target} PRIVATE ${BANYAN_LINK_OPTIONS})
  # pagmo's cmaes holds memory that Debian's libpagmo took by Eigen, and our code gives back: both must
  # know malloc() as 16 byte aligned, also where Eigen would decide otherwise (address sanitizer, AVX).
  target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1 EIGEN_MAX_ALIGN_BYTES=16)
endfunction()
# As add_library() and add_executable().
function(banyan_library name)
  add_library(${name} ${ARGN})
  banyan_own(${name})
endfunction()
function(banyan_program name)
  add_executable(${name} ${ARGN})
  banyan_own(${name})
endfunction()

# For code that is no hot loop: reading of configurations, commands, tests. The optimiser is half of
# the time that they take to compile, and nobody waits for them afterwards.
function(banyan_compile_quickly)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:$<IF:$<CXX_COMPILER_ID:GNU>,-Og,-O1>>)
  endforeach()
endfunction()
# Targets whose sources are little beside the headers that they include, as one source where BANYAN_JOIN says so.
function(banyan_join)
  if(BANYAN_JOIN)
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    foreach(target IN LISTS ARGN)
      target_compile_options(${target} PRIVATE ${BANYAN_JOINED_SOURCES_MAY})
    endforeach()
  endif()
endfunction()
# The rooms that every robot goes through in every tick: as one source too, and there every function may be inlined. gcc
# does not inline those that position-independent code exports unless it is told that no library will replace them.
function(banyan_compile_hot)
  banyan_join(${ARGN})
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
  endforeach()
endfunction()
# Most of a test's compilation is that of headers, its own and GoogleTest's.
function(banyan_test_program name)
  banyan_compile_quickly(${name})
  banyan_join(${name})
endfunction()
