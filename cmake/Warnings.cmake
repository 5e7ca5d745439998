# SPDX-License-Identifier: Apache-2.0
# Warnings for the project's own targets.
add_library(mandelmarch_warnings INTERFACE)
target_compile_options(mandelmarch_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wunused
    # The kernel text passes its scene by value; every such call is inlined, so that no ABI is concerned.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>
    # Highway's regions of an instruction set may hold templates alone.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-pragma-clang-attribute>)
if(MANDELMARCH_WERROR)
    target_compile_options(mandelmarch_warnings INTERFACE -Werror)
endif()
