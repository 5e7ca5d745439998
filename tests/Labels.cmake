# SPDX-License-Identifier: Apache-2.0
# mandelmarch_label_tests(): labels every test of this directory `slow` or `quick`. Slow tests take more than about four
# seconds on two cores; they start first if several run at a time. The names of gtest's tests are known only when ctest
# runs, so a generated file, which ctest reads, labels them.
set(slow_tests
    "build\\..*" "suite\\..*" same_bits.compilers subproject install.consumer registration programs fuzz "report\\.(front|numbers|report|viewer)"
    flight "flight\\.films" "flight\\.files" "explore\\.window" drivers ".*_faults" "openacc\\.simulated" "cuda\\.simulated" "openacc\\.ptx\\.assemble"
    "programs\\.readme" "programs\\.demo" "programs\\.machine" "programs\\.survey" "flight\\.shapes" "packaging\\..*" "bench\\.program" "bench\\.schemas" "bench\\.race" "bench\\.equivalence" "bench\\.Random\\..*"
    "bench\\..*FastDrawsTheCanonicalPicture/bulb.*" "bench\\.BenchProgram\\.AblationProvesWhatIsHit"
    "bench\\.BenchProgram\\.LinesAreAtMost120Characters" "Equivalence\\.EveryBackendDrawsTheSamePicture"
    "RandomScenes\\..*" ".*Models\\.ExactHasTheBits.*" ".*SameBits\\.BytesAlone/.*" ".*Vulkan\\.DrawsTheBitsOfTheScalarText/.*" ".*Opencl\\.VectorsDrawTheBits.*"
    "Hull\\.ChangesNoBitOfRandomScenes" "ExtremeScene\\.GoesFarAndShowsSomething"
    "Neighbours\\.ChangeLittleAndSaveEstimates")
list(JOIN slow_tests "|" slow_tests)

function(mandelmarch_label_tests)
    get_property(tests DIRECTORY PROPERTY TESTS)
    foreach(test ${tests})
        if(test MATCHES "^(${slow_tests})$")
            set_tests_properties(${test} PROPERTIES LABELS slow)
            get_test_property(${test} COST cost)
            if(NOT cost)
                set_tests_properties(${test} PROPERTIES COST 1)
            endif()
        else()
            set_tests_properties(${test} PROPERTIES LABELS quick)
        endif()
    endforeach()
    # gtest_discover_tests() stores the names of a target's tests in TARGET_TESTS.
    get_property(targets DIRECTORY PROPERTY BUILDSYSTEM_TARGETS)
    set(slow "^(${slow_tests})$")
    set(file ${CMAKE_CURRENT_BINARY_DIR}/labels.cmake)
    configure_file(${PROJECT_SOURCE_DIR}/tests/label_tests.cmake.in ${file} @ONLY)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${file})
endfunction()
