# SPDX-License-Identifier: Apache-2.0
# Functions that add tests. Each test has one label:
#   quick  takes at most about four seconds on two cores
#   slow   takes longer; slow tests start before the quick ones
#   wide   depends on instruction sets, models or compilers; `make test-all` runs these tests
include(GoogleTest)
set(bin ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
set(source ${PROJECT_SOURCE_DIR})

# mandelmarch_test(NAME [QUICK | SLOW | WIDE] COMMAND WORD...): adds a test. The test is skipped if the command exits
# with 77.
function(mandelmarch_test name)
    cmake_parse_arguments(PARSE_ARGV 1 with "QUICK;SLOW;WIDE" "" "COMMAND")
    add_test(NAME ${name} COMMAND ${with_COMMAND} COMMAND_EXPAND_LISTS)
    set_tests_properties(${name} PROPERTIES LABELS quick SKIP_RETURN_CODE 77 TIMEOUT 900)
    if(with_WIDE)
        set_tests_properties(${name} PROPERTIES LABELS wide COST 1)
    elseif(with_SLOW)
        set_tests_properties(${name} PROPERTIES LABELS slow COST 1)
    endif()
endfunction()

# mandelmarch_cases(NAME FILE [QUICK CASE...] [SLOW CASE...] [WIDE CASE...] [ARGUMENTS WORD...]): adds a test NAME.CASE
# for each CASE. The test runs the function test_CASE of the shell script FILE, by tests/cases.sh. All functions test_*
# of the script must be listed. FILE is relative to this folder. Without ARGUMENTS, the script gets the programs' folder
# and the source folder.
function(mandelmarch_cases name file)
    cmake_parse_arguments(PARSE_ARGV 2 with "" "" "QUICK;SLOW;WIDE;ARGUMENTS")
    if(NOT DEFINED with_ARGUMENTS)
        set(with_ARGUMENTS ${bin} ${source})
    endif()
    set(all ${with_QUICK} ${with_SLOW} ${with_WIDE})
    list(JOIN all " " all)
    foreach(label QUICK SLOW WIDE)
        foreach(one ${with_${label}})
            mandelmarch_test(${name}.${one} ${label} COMMAND bash ${source}/tests/cases.sh
                ${CMAKE_CURRENT_SOURCE_DIR}/${file} ${one} ${with_ARGUMENTS})
            set_tests_properties(${name}.${one} PROPERTIES ENVIRONMENT "CASES=${all}")
        endforeach()
    endforeach()
endfunction()

# mandelmarch_script(NAME FILE [SLOW | WIDE] [ARGUMENTS WORD...]): adds a test that runs FILE, a .sh or .py file,
# relative to this folder. Without ARGUMENTS, the script gets the programs' folder and the source folder.
function(mandelmarch_script name file)
    cmake_parse_arguments(PARSE_ARGV 2 with "" "" "ARGUMENTS")
    if(NOT DEFINED with_ARGUMENTS)
        set(with_ARGUMENTS ${bin} ${source})
    endif()
    set(interpreter bash)
    if(file MATCHES "[.]py$")
        set(interpreter Python3::Interpreter)
    endif()
    mandelmarch_test(${name} ${with_UNPARSED_ARGUMENTS}
        COMMAND ${interpreter} ${CMAKE_CURRENT_SOURCE_DIR}/${file} ${with_ARGUMENTS})
endfunction()

# mandelmarch_gtest(TARGET [WIDE] [PREFIX TEXT] [SLOW NAME...] SOURCES FILE... [LIBRARIES TARGET...]): adds a GoogleTest
# program and its tests. PREFIX: text put before the tests' names; SLOW: GoogleTest filters that match the names of the
# slow tests.
function(mandelmarch_gtest target)
    cmake_parse_arguments(PARSE_ARGV 1 with "WIDE" "PREFIX" "SLOW;SOURCES;LIBRARIES")
    add_executable(${target} ${with_SOURCES})
    target_link_libraries(${target} PRIVATE ${with_LIBRARIES} mandelmarch_test_scenes mandelmarch_warnings fmt::fmt
        GTest::gtest_main)
    # Without NO_PRETTY_VALUES, the names of tests contain the bytes of their parameters.
    set(discover ${target} TEST_PREFIX "${with_PREFIX}" NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60)
    list(JOIN with_SLOW ":" slow)
    if(with_WIDE)
        gtest_discover_tests(${discover} PROPERTIES TIMEOUT 900 LABELS wide COST 1)
    elseif(slow)
        gtest_discover_tests(${discover} TEST_FILTER ${slow} TEST_LIST ${target}_slow
            PROPERTIES TIMEOUT 900 LABELS slow COST 1)
        gtest_discover_tests(${discover} TEST_FILTER -${slow} PROPERTIES TIMEOUT 900 LABELS quick)
    else()
        gtest_discover_tests(${discover} PROPERTIES TIMEOUT 900 LABELS quick)
    endif()
endfunction()
