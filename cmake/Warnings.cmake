# SPDX-License-Identifier: Apache-2.0
# Warnings for this project's targets.
add_library(mandelmarch_warnings INTERFACE)
target_compile_options(mandelmarch_warnings INTERFACE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wunused
    # Left out in unity builds, in which a source can shadow the private names of the sources before it.
    $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow>
    # The kernel passes its scene by value, but all such calls are inlined, so the ABI does not matter.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>
    # Clang warns of Highway's per-target regions that contain only templates.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-pragma-clang-attribute>)
if(MANDELMARCH_WERROR)
    target_compile_options(mandelmarch_warnings INTERFACE -Werror)
endif()
