# SPDX-License-Identifier: MIT
# Debian's gcc-arm-none-eabi for a Cortex-M4 with its single-precision unit: the chip of a Crazyflie
# or a Khepera's sensor board. Double arithmetic would be emulated there, hence -Wdouble-promotion.
# Linked as one program (LTO; fat objects, so that the archive can be read too): a tenth less code.
# -fno-math-errno: a square root is one instruction, not a call that may set errno.
# -flto-partition=one: 600 bytes less, since nothing is kept apart for linking in parallel.
# -fno-move-loop-invariants: 232 bytes less; a tick of convoy takes 0.4 % more instructions.
# The six options from -fno-expensive-optimizations to -fno-tree-loop-optimize: 1,300 bytes less together; a step takes
# 2 % more instructions.
# -g1: the program stays the same, and `ninja rooms` can say where its bytes are.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_FLAGS_INIT "-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections -fdata-sections -fno-math-errno -fno-move-loop-invariants -fno-expensive-optimizations -fno-reorder-blocks -fno-tree-slsr -fno-ipa-sra -fno-if-conversion -fno-tree-loop-optimize -g1 -flto=2 -flto-partition=one -ffat-lto-objects -Wdouble-promotion")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
