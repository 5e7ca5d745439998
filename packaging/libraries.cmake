# SPDX-License-Identifier: Apache-2.0
# Copies libraries into the bundle and makes their rpaths relative. Needs BUNDLE, PATCHELF, CMAKE_OBJDUMP.

# say_and_end(TEXT): stops the script with a message of one line, which packaging/bundle prints.
function(say_and_end text)
    message(NOTICE "bundle: ${text}")
    message(FATAL_ERROR "${text}")
endfunction()

function(must_run)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# note_origin(FILE ORIGIN): records for licences.cmake that the bundle's FILE is a copy of the system's file ORIGIN. The
# property ORIGINS holds entries "FILE|ORIGIN".
function(note_origin file origin)
    set_property(GLOBAL APPEND PROPERTY ORIGINS "${file}|${origin}")
endfunction()

# carry_library(FOLDER RPATH FILE): copies a library. If FILE is a link, the copy has the link's name, by which programs
# load it.
function(carry_library folder rpath file)
    get_filename_component(name ${file} NAME)
    get_filename_component(real ${file} REALPATH)
    set(copy ${BUNDLE}/${folder}/${name})
    file(MAKE_DIRECTORY ${BUNDLE}/${folder})
    file(COPY_FILE ${real} ${copy})
    file(CHMOD ${copy} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
    must_run(${PATCHELF} --set-rpath ${rpath} ${copy})
    note_origin(${folder}/${name} ${real})
endfunction()

# carry_libraries(FOLDER RPATH PROGRAM FILES): copies FILES and all libraries that PROGRAM and FILES need, except those
# already copied and those of glibc's package.
function(carry_libraries folder rpath program files)
    file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${program} LIBRARIES ${files}
        DIRECTORIES ${CMAKE_SYSROOT}/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}
            ${CMAKE_SYSROOT}/lib/${CMAKE_LIBRARY_ARCHITECTURE}
        PRE_EXCLUDE_REGEXES "^(ld-linux.*|libc|libm|libdl|libpthread|librt|libresolv|libutil|libanl)\\.so"
        RESOLVED_DEPENDENCIES_VAR found UNRESOLVED_DEPENDENCIES_VAR unknown)
    if(unknown)
        list(JOIN unknown " " unknown)
        say_and_end("not found: ${unknown}")
    endif()
    list(APPEND files ${found})
    foreach(file ${files})
        get_filename_component(name ${file} NAME)
        if(NOT EXISTS ${BUNDLE}/lib/${name} AND NOT EXISTS ${BUNDLE}/${folder}/${name})
            carry_library(${folder} ${rpath} ${file})
        endif()
    endforeach()
endfunction()

# carry_files(FOLDER PATH): copies PATH, a file, or the contents of PATH, a folder, into FOLDER of the bundle.
function(carry_files folder path)
    set(files ${path})
    set(base ${path})
    if(IS_DIRECTORY ${path})
        file(GLOB_RECURSE files ${path}/*)
    else()
        get_filename_component(base ${path} DIRECTORY)
    endif()
    foreach(file ${files})
        file(RELATIVE_PATH name ${base} ${file})
        get_filename_component(into ${BUNDLE}/${folder}/${name} DIRECTORY)
        file(MAKE_DIRECTORY ${into})
        file(COPY_FILE ${file} ${BUNDLE}/${folder}/${name})
        note_origin(${folder}/${name} ${file})
    endforeach()
endfunction()

# needed_glibc(VARIABLE): sets VARIABLE to the newest version of glibc's symbols that any file of the bundle needs.
function(needed_glibc variable)
    file(GLOB_RECURSE files ${BUNDLE}/bin/mandelmarch ${BUNDLE}/lib/*)
    execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${files} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "GLIBC_[0-9.]+" versions "${text}")
    list(TRANSFORM versions REPLACE "GLIBC_" "")
    list(REMOVE_DUPLICATES versions)
    list(SORT versions COMPARE NATURAL ORDER DESCENDING)
    list(GET versions 0 newest)
    set(${variable} ${newest} PARENT_SCOPE)
endfunction()
