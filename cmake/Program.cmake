# SPDX-License-Identifier: Apache-2.0
# mandelmarch_program(NAME SOURCE... LIBRARIES TARGET...): adds the program NAME. The SOURCEs must define
# NAME_main(argc, argv). They become the object library program_NAME, from which the bundle (packaging/) links all
# programs into one file.
function(mandelmarch_program name)
    cmake_parse_arguments(PARSE_ARGV 1 program "" "" "LIBRARIES")
    add_library(program_${name} OBJECT ${program_UNPARSED_ARGUMENTS})
    target_link_libraries(program_${name} PUBLIC ${program_LIBRARIES} PRIVATE mandelmarch_warnings)
    set(main ${CMAKE_CURRENT_BINARY_DIR}/${name}_main.cpp)
    file(CONFIGURE OUTPUT ${main} CONTENT [[
int @name@_main(int argc, char** argv);
int main(int argc, char** argv) { return @name@_main(argc, argv); }
]] @ONLY)
    add_executable(${name} ${main})
    target_link_libraries(${name} PRIVATE program_${name})
endfunction()
