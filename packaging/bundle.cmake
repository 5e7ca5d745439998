# SPDX-License-Identifier: Apache-2.0
# cmake -D SETTINGS=build/release/packaging/settings.cmake -D BUNDLE=FOLDER [-D DRIVERS=OFF] [-D FFMPEG=FILE] -P
# bundle.cmake: makes a new bundle folder from the programs of a build and libraries installed here. `make bundle` also
# makes its archive.
cmake_minimum_required(VERSION 3.25)
include(${SETTINGS})
include(${CMAKE_CURRENT_LIST_DIR}/libraries.cmake)
if(NOT DEFINED DRIVERS)
    set(DRIVERS ON)
endif()

# Reports missing packages in one line, before any file is made.
find_program(PATCHELF patchelf)
find_program(DPKG_QUERY dpkg-query)
set(font ${CMAKE_SYSROOT}/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf)
set(wanted patchelf:PATCHELF dpkg:DPKG_QUERY fonts-dejavu-core:font)
if(DEFINED BUNDLE_GOMP_NVPTX)
    list(APPEND wanted libgomp-plugin-nvptx1:BUNDLE_GOMP_NVPTX)
endif()
if(DEFINED BUNDLE_VULKAN_LOADER)
    list(APPEND wanted libvulkan1:BUNDLE_VULKAN_LOADER libx11-6:BUNDLE_X11 libxext6:BUNDLE_XEXT
        libglx0:BUNDLE_GLX libegl1:BUNDLE_EGL)
endif()
if(DRIVERS)
    list(APPEND wanted pocl-opencl-icd:BUNDLE_POCL mesa-vulkan-drivers:BUNDLE_LAVAPIPE binutils:BUNDLE_LINKER)
endif()
set(missing "")
foreach(want ${wanted})
    string(REPLACE ":" ";" want ${want})
    list(GET want 0 package)
    list(GET want 1 variable)
    if(NOT ${variable} OR NOT EXISTS ${${variable}})
        list(APPEND missing ${package})
    endif()
endforeach()
if(missing)
    list(JOIN missing " " missing)
    say_and_end("missing: ${missing}; on Debian apt-get install ${missing}")
endif()
if(FFMPEG AND NOT EXISTS ${FFMPEG})
    say_and_end("no file ${FFMPEG}, expected a static ffmpeg")
endif()

file(REMOVE_RECURSE ${BUNDLE})
file(MAKE_DIRECTORY ${BUNDLE}/bin ${BUNDLE}/lib ${BUNDLE}/share)

set(program ${BUNDLE}/bin/mandelmarch)
file(COPY_FILE ${FOLDER}/mandelmarch ${program})
must_run(${CMAKE_STRIP} ${program})
foreach(name ${programs})
    file(CREATE_LINK mandelmarch ${BUNDLE}/bin/${name} SYMBOLIC)
endforeach()

# Copies the libraries that the programs link, and those in `roots`, which the programs load by name. A library's rpath
# must lead to the libraries that it loads itself: libgomp loads its plugin, and OpenCL's loader loads PoCL.
set(roots ${BUNDLE_VULKAN_LOADER} ${BUNDLE_GOMP_NVPTX})
carry_libraries(lib "$ORIGIN:$ORIGIN/drivers" "${program}" "${roots}")
# The libraries of NVIDIA's Vulkan driver are in a separate folder, which gpu_steps adds to LD_LIBRARY_PATH on machines
# without them.
if(DEFINED BUNDLE_X11)
    carry_libraries(lib/x11 "$ORIGIN:$ORIGIN/.." "${program}" "${BUNDLE_X11};${BUNDLE_XEXT};${BUNDLE_GLX};${BUNDLE_EGL}")
endif()
if(DRIVERS)
    get_filename_component(pocl_folder ${BUNDLE_POCL} DIRECTORY)
    file(GLOB pocl_devices ${pocl_folder}/pocl/libpocl-devices-*.so)
    carry_libraries(lib/drivers "$ORIGIN:$ORIGIN/.." "" "${BUNDLE_POCL};${BUNDLE_LAVAPIPE}")
    foreach(device ${pocl_devices})
        carry_library(lib/drivers/pocl "$ORIGIN:$ORIGIN/..:$ORIGIN/../.." ${device})
    endforeach()
    # PoCL links its kernels with the first ld on PATH; main.cpp puts libexec/pocl first.
    carry_libraries(lib/drivers "$ORIGIN:$ORIGIN/.." ${BUNDLE_LINKER} "")
    carry_library(libexec/pocl "$ORIGIN/../../lib/drivers:$ORIGIN/../../lib" ${BUNDLE_LINKER})
    file(COPY ${CMAKE_CURRENT_LIST_DIR}/ld DESTINATION ${BUNDLE}/libexec/pocl)
    # PoCL looks for its own source files in ../../share/pocl, relative to the folder of its library.
    carry_files(share/pocl /usr/share/pocl)
    file(WRITE ${BUNDLE}/share/OpenCL/vendors/pocl.icd "libpocl.so.2\n")
    file(WRITE ${BUNDLE}/share/vulkan/icd.d/lvp_icd.json [[
{
    "file_format_version": "1.0.0",
    "ICD": {"library_path": "../../../lib/drivers/libvulkan_lvp.so", "api_version": "1.1.230"}
}
]])
endif()
carry_files(share/fonts ${font})
if(FFMPEG)
    file(MAKE_DIRECTORY ${BUNDLE}/libexec)
    file(COPY_FILE ${FFMPEG} ${BUNDLE}/libexec/ffmpeg)
    file(CHMOD ${BUNDLE}/libexec/ffmpeg PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
        WORLD_EXECUTE)
endif()

file(GLOB scenes ${PROJECT_SOURCE_DIR}/params*.dat)
file(COPY ${scenes} DESTINATION ${BUNDLE})
file(GLOB looks ${PROJECT_SOURCE_DIR}/scenes/*.look)
file(COPY ${looks} DESTINATION ${BUNDLE}/looks)
file(COPY ${PROJECT_SOURCE_DIR}/flight/slurm/array.sbatch DESTINATION ${BUNDLE}/slurm)
foreach(file gpu_check gpu_check.sha256 gpu_steps)
    file(COPY ${CMAKE_CURRENT_LIST_DIR}/${file} DESTINATION ${BUNDLE}/gpu-check)
endforeach()

write_licences()
needed_glibc(glibc)
# Names the oldest Debian that has the glibc which the bundle needs.
set(debian bookworm)
if(glibc VERSION_GREATER 2.36)
    set(debian trixie)
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/Containerfile.in ${BUNDLE}/container/Containerfile @ONLY)
execute_process(COMMAND ${CMAKE_CROSSCOMPILING_EMULATOR} ${program} render --version
    OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(drivers_carried "The bundle has no drivers for CPUs, so `opencl` and `vulkan` run only if the system
has a driver")
if(DRIVERS)
    set(drivers_carried "The bundle contains PoCL (`opencl`) and lavapipe (`vulkan`), so every backend
except `cuda` and `hip` runs on any CPU")
endif()
set(ffmpeg_carried "The bundle does not contain ffmpeg")
if(FFMPEG)
    set(ffmpeg_carried "The bundle contains ffmpeg as libexec/ffmpeg; its licence is that of this build of ffmpeg")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/README.md.in ${BUNDLE}/README.md @ONLY)
message(STATUS "${BUNDLE}: ${version}, glibc ${glibc}")
