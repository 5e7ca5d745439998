# SPDX-License-Identifier: Apache-2.0
# Each static library must name all libraries that it needs. The test links a program from all objects of the library
# and from the libraries that it names.
file(CONFIGURE OUTPUT alone.cpp CONTENT "int main() {}\n")
function(mandelmarch_alone library)
    add_executable(alone_${library} EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/alone.cpp)
    target_link_libraries(alone_${library} PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,${library}>)
    mandelmarch_test(libraries.${library} WIDE
        COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target alone_${library})
    set_tests_properties(libraries.${library} PROPERTIES RESOURCE_LOCK build)
endfunction()

function(mandelmarch_alone_in folder)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target ${targets})
        get_target_property(type ${target} TYPE)
        if(type STREQUAL "STATIC_LIBRARY")
            mandelmarch_alone(${target})
        endif()
    endforeach()
    get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
    foreach(inner ${folders})
        mandelmarch_alone_in(${inner})
    endforeach()
endfunction()
mandelmarch_alone_in(${PROJECT_SOURCE_DIR})

# Negative control: a library that uses core without naming it must fail the test.
file(CONFIGURE OUTPUT undeclared.cpp CONTENT [[
#include "core/text/number.h"

namespace mandelmarch {
bool is_whole(std::string_view text);
bool is_whole(std::string_view text) { return parse_whole(text).has_value(); }
}  // namespace mandelmarch
]])
add_library(mandelmarch_undeclared STATIC EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/undeclared.cpp)
target_include_directories(mandelmarch_undeclared PRIVATE ${PROJECT_SOURCE_DIR})
mandelmarch_alone(mandelmarch_undeclared)
set_tests_properties(libraries.mandelmarch_undeclared PROPERTIES WILL_FAIL ON)
