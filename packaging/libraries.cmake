# SPDX-License-Identifier: Apache-2.0
# Copies libraries into the bundle and makes their rpaths relative. Copies the licences that Debian's packages state for
# the copied files, and lists the files with their licences. Needs BUNDLE, PATCHELF, CMAKE_OBJDUMP, DPKG_QUERY,
# PROJECT_SOURCE_DIR, and CMAKE_SYSROOT if the bundle is for another processor.

# say_and_end(TEXT): stops the script with a message of one line, which packaging/bundle prints.
function(say_and_end text)
    message(NOTICE "bundle: ${text}")
    message(FATAL_ERROR "${text}")
endfunction()

function(must_run)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# note_origin(FILE ORIGIN): records for write_licences() that the bundle's FILE is a copy of the system's file ORIGIN. The
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

set(dpkg_database --admindir=${CMAKE_SYSROOT}/var/lib/dpkg)

# package_of(VARIABLE FILE): sets VARIABLE to the package that contains FILE. If FILE is under /usr/lib, also looks for
# it under /lib, where its package may still list it.
function(package_of variable file)
    cmake_path(RELATIVE_PATH file BASE_DIRECTORY "${CMAKE_SYSROOT}/")
    string(PREPEND file /)
    string(REGEX REPLACE "^/usr/lib" "/lib" old ${file})
    foreach(path ${file} ${old})
        execute_process(COMMAND ${DPKG_QUERY} ${dpkg_database} -S ${path}
            OUTPUT_VARIABLE line RESULT_VARIABLE failed ERROR_QUIET)
        if(NOT failed)
            string(REGEX REPLACE "[:,].*" "" package "${line}")
            set(${variable} ${package} PARENT_SCOPE)
            return()
        endif()
    endforeach()
    say_and_end("no Debian package has ${file}, so its licence is not known")
endfunction()

# carry_licence(PACKAGE): copies the licence to share/licences/PACKAGE.
function(carry_licence package)
    set(copy ${BUNDLE}/share/licences/${package})
    if(EXISTS ${copy})
        return()
    endif()
    get_filename_component(licence ${CMAKE_SYSROOT}/usr/share/doc/${package}/copyright REALPATH)
    if(NOT EXISTS ${licence})
        say_and_end("${package} has no copyright file")
    endif()
    file(COPY_FILE ${licence} ${copy})
    # Debian's copyright files refer to common licences by their paths. Copies these licences too.
    file(READ ${licence} text)
    string(REGEX MATCHALL "/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]" common "${text}")
    list(REMOVE_DUPLICATES common)
    foreach(file ${common})
        get_filename_component(name ${file} NAME)
        get_filename_component(real ${file} REALPATH)
        if(EXISTS ${real})
            file(COPY_FILE ${real} ${BUNDLE}/share/licences/common/${name})
        endif()
    endforeach()
endfunction()

# row(FILE BYTES PACKAGE VERSION LICENCE): appends a line to MANIFEST.tsv.
function(row)
    list(JOIN ARGN "\t" line)
    file(APPEND ${BUNDLE}/MANIFEST.tsv "${line}\n")
endfunction()

function(write_licences)
    file(COPY ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${BUNDLE})
    file(MAKE_DIRECTORY ${BUNDLE}/share/licences/common)
    row(file bytes package version licence)
    file(SIZE ${BUNDLE}/bin/mandelmarch bytes)
    row(bin/mandelmarch ${bytes} mandelmarch ${PROJECT_VERSION} LICENSE)
    get_property(origins GLOBAL PROPERTY ORIGINS)
    foreach(pair ${origins})
        string(REPLACE "|" ";" pair ${pair})
        list(GET pair 0 name)
        list(GET pair 1 origin)
        package_of(package ${origin})
        package_version(version ${package})
        carry_licence(${package})
        file(SIZE ${BUNDLE}/${name} bytes)
        row(${name} ${bytes} ${package} ${version} share/licences/${package})
    endforeach()
    # Also lists the header-only libraries, because they are compiled into the programs.
    foreach(header CLI/CLI.hpp nlohmann/json.hpp boost/version.hpp vulkan/vulkan_raii.hpp CL/opencl.hpp)
        if(EXISTS ${CMAKE_SYSROOT}/usr/include/${header})
            package_of(package ${CMAKE_SYSROOT}/usr/include/${header})
            package_version(version ${package})
            carry_licence(${package})
            row("(compiled into bin/mandelmarch)" - ${package} ${version} share/licences/${package})
        endif()
    endforeach()
    if(FFMPEG)
        file(SIZE ${BUNDLE}/libexec/ffmpeg bytes)
        row(libexec/ffmpeg ${bytes} - - "its builder's")
    endif()
endfunction()

function(package_version variable package)
    execute_process(COMMAND ${DPKG_QUERY} ${dpkg_database} -W "-f=\${Version}\\n" ${package}
        OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX REPLACE "\n.*" "" version "${version}")
    set(${variable} ${version} PARENT_SCOPE)
endfunction()
