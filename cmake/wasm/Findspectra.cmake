# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_only.cmake)
header_only_library(Spectra::Spectra Spectra/SymEigsShiftSolver.h)
set(spectra_FOUND TRUE)
