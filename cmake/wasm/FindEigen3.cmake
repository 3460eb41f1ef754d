# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_only.cmake)
header_only_library(Eigen3::Eigen Eigen/Core)
set(Eigen3_FOUND TRUE)
