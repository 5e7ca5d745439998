# SPDX-License-Identifier: Apache-2.0
# cmake -D FRACTAL=NAME -D TEXT=NAME.h -D FILE=OUT -P report/viewer/flatten.cmake: writes the viewer's shader for one
# fractal, with all included files, to the GLSL file OUT. TEXT: the fractal's kernel source.
cmake_minimum_required(VERSION 3.25)
get_filename_component(PROJECT_SOURCE_DIR "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
include(${PROJECT_SOURCE_DIR}/cmake/FlattenKernel.cmake)
set(MANDELMARCH_TEXT_${FRACTAL} ${TEXT})
mandelmarch_flatten_glsl(report/viewer/viewer.frag ${FRACTAL} ${FILE})
