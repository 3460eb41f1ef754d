# SPDX-License-Identifier: MIT
# banyan::version: the version of project() and the git id, for every output file. The id lives in
# one small source file that is rewritten only when the id changes, so a commit rebuilds one file.
set(version_dir ${PROJECT_BINARY_DIR}/version)
configure_file(${PROJECT_SOURCE_DIR}/cmake/version.hpp.in ${version_dir}/include/banyan/version.hpp @ONLY)
add_custom_target(banyan_git_id
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${version_dir}/version.cpp
          -P ${PROJECT_SOURCE_DIR}/cmake/git_id.cmake
  BYPRODUCTS ${version_dir}/version.cpp
  COMMENT "git id" VERBATIM)
banyan_library(banyan_version STATIC ${version_dir}/version.cpp)
add_library(banyan::version ALIAS banyan_version)
add_dependencies(banyan_version banyan_git_id)
target_include_directories(banyan_version PUBLIC
  $<BUILD_INTERFACE:${version_dir}/include> $<INSTALL_INTERFACE:include>)
