# SPDX-License-Identifier: Apache-2.0
# Functions for the CMakeLists.txt files of backends, for the registry of backends (docs/add-a-backend.md), and for
# programs.

# The C++ compiler and the flags of all sources, as recorded in results.
set(MANDELMARCH_CXX "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE}" MANDELMARCH_CXX_FLAGS)

# mandelmarch_kernel_build(SOURCE [COMPILER WORD...] [EXACT FLAG...] [FAST FLAG...]): defines the macros
# MANDELMARCH_BUILD_COMPILER, _EXACT and _FAST in SOURCE, which sets BackendInfo::build from them. They hold the
# compiler of the kernels and its flags in each mode; by default those of the C++ sources.
function(mandelmarch_kernel_build source)
    cmake_parse_arguments(PARSE_ARGV 1 build "" "" "COMPILER;EXACT;FAST")
    set(usual_COMPILER ${MANDELMARCH_CXX})
    set(usual_EXACT ${MANDELMARCH_CXX_FLAGS} ${MANDELMARCH_FP_exact})
    set(usual_FAST ${MANDELMARCH_CXX_FLAGS} ${MANDELMARCH_FP_fast})
    foreach(fact COMPILER EXACT FAST)
        if(NOT build_${fact})
            set(build_${fact} ${usual_${fact}})
        endif()
        list(JOIN build_${fact} " " words)
        set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS "MANDELMARCH_BUILD_${fact}=\"${words}\"")
    endforeach()
    if(build_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "${source}: mandelmarch_kernel_build does not accept ${build_UNPARSED_ARGUMENTS}")
    endif()
endfunction()

# mandelmarch_find_dependency(ARGUMENT... [PKG_CONFIG WORD]): adds find_dependency(ARGUMENT...) to the installed
# package, because users of the backend need this dependency. WORD: its name in pkg-config or, if it has none, a linker
# option or the path of a library.
function(mandelmarch_find_dependency)
    cmake_parse_arguments(PARSE_ARGV 0 with "" "PKG_CONFIG" "")
    list(JOIN with_UNPARSED_ARGUMENTS " " words)
    set_property(GLOBAL APPEND PROPERTY MANDELMARCH_DEPENDENCIES "find_dependency(${words})")
    set_property(GLOBAL APPEND PROPERTY MANDELMARCH_PKG_CONFIG ${with_PKG_CONFIG})
endfunction()

# mandelmarch_registry(TARGET NAME...): adds the library TARGET. It defines all_backends() (backends/all.h), which
# returns the backends NAME... in this order. If the target mandelmarch_NAME does not exist, because tools are missing,
# the backend is listed as "not built".
function(mandelmarch_registry target)
    set(declarations "")
    set(rows "")
    add_library(${target} STATIC ${PROJECT_SOURCE_DIR}/backends/all.cpp)
    foreach(name ${ARGN})
        set(factory nullptr)
        if(TARGET mandelmarch_${name})
            set(factory make_${name}_backend)
            string(APPEND declarations "std::unique_ptr<Backend> ${factory}();\n")
            target_link_libraries(${target} PRIVATE mandelmarch_${name})
        endif()
        string(APPEND rows "    {\"${name}\", ${factory}},\n")
    endforeach()
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target})
    file(CONFIGURE OUTPUT ${folder}/registrations.h @ONLY CONTENT [[
// SPDX-License-Identifier: Apache-2.0
// Generated: the rows of the table in backends/all.cpp.
@declarations@
constexpr Registration registrations[] = {
@rows@};
]])
    target_include_directories(${target} PRIVATE ${folder})
    target_link_libraries(${target} PUBLIC mandelmarch_core PRIVATE mandelmarch_warnings)
endfunction()

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
