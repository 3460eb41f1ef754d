# SPDX-License-Identifier: MIT
# A toolchain: the compiler of the PyPI package ziglang (clang), for an old glibc, with libc++ inside. hosts/python/wheels
# names BANYAN_ZIG, a folder with the programs that it wrote, BANYAN_MACHINE and BANYAN_PREFIX, where the libraries are.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${BANYAN_MACHINE})
set(CMAKE_C_COMPILER ${BANYAN_ZIG}/cc)
set(CMAKE_CXX_COMPILER ${BANYAN_ZIG}/c++)
set(CMAKE_AR ${BANYAN_ZIG}/ar)
set(CMAKE_RANLIB ${BANYAN_ZIG}/ranlib)
# Nothing of this system but its programs.
set(CMAKE_FIND_ROOT_PATH ${BANYAN_PREFIX})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind IN ITEMS LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(ENV{PKG_CONFIG_LIBDIR} ${BANYAN_PREFIX}/lib/pkgconfig)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES BANYAN_ZIG BANYAN_MACHINE BANYAN_PREFIX)
