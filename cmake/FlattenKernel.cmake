# The kernel text for languages whose compilers know no files: one string, every #include replaced by what it names.
file(GLOB_RECURSE kernel_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/kernel/*.h)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${kernel_files})

# mandelmarch_flatten_kernel(ROOT FRACTAL RESULT): the file ROOT (from the project's root), specialised for a fractal.
function(mandelmarch_flatten_kernel root fractal result)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${root})
    file(READ ${PROJECT_SOURCE_DIR}/${root} text)
    while(text MATCHES "#include (\"([^\"\n]+)\"|MM_FRACTAL_FILE)\n")
        set(line "${CMAKE_MATCH_0}")
        set(file "${CMAKE_MATCH_2}")
        if(file STREQUAL "")
            set(file core/kernel/fractals/${fractal}.h)
        endif()
        file(READ ${PROJECT_SOURCE_DIR}/${file} included)
        string(REPLACE "${line}" "// ---- ${file}\n${included}" text "${text}")
    endwhile()
    set(${result} "${text}" PARENT_SCOPE)
endfunction()
