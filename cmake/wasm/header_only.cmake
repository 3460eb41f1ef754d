# SPDX-License-Identifier: MIT
# header_only_library(TARGET header): an imported TARGET whose include path is a directory in the
# build that holds a link to the one folder `header` begins with, and nothing else of the host's.
function(header_only_library target header)
  if(TARGET ${target})
    return()
  endif()
  string(REGEX REPLACE "/.*" "" folder ${header})
  string(MAKE_C_IDENTIFIER "BANYAN_${folder}_INCLUDE" variable)
  find_path(${variable} ${header} PATH_SUFFIXES eigen3 NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include /usr/local/include
            NO_DEFAULT_PATH REQUIRED)
  mark_as_advanced(${variable})
  set(only ${PROJECT_BINARY_DIR}/host/${folder})
  file(MAKE_DIRECTORY ${only})
  file(CREATE_LINK ${${variable}}/${folder} ${only}/${folder} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${only})
endfunction()
