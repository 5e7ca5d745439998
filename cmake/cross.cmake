# SPDX-License-Identifier: Apache-2.0
# Toolchain file for another processor, MANDELMARCH_CROSS: arm64, riscv64 or s390x, which are Debian's names. The
# libraries are those of tools/cross_root. Programs run by emulation.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MANDELMARCH_CROSS)
string(REPLACE arm64 aarch64 processor "${MANDELMARCH_CROSS}")
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${processor})
set(CMAKE_CXX_COMPILER ${processor}-linux-gnu-g++)
cmake_path(SET CMAKE_SYSROOT NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../build/cross/${MANDELMARCH_CROSS}/root)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# The libraries can be of a newer release of Debian than the compiler's own.
set(CMAKE_EXE_LINKER_FLAGS_INIT -Wl,--unresolved-symbols=ignore-in-shared-libs)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${processor}-static;-L;${CMAKE_SYSROOT})
