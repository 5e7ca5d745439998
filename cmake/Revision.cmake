# SPDX-License-Identifier: Apache-2.0
# Run at every build (cmake -P): the git revision and whether tracked files differ from it, into OUTPUT, touched only when
# it changes. Result files (report/results) are no part of the program: measuring again does not make it dirty. Wants
# SOURCE and OUTPUT.
set(revision unknown)
set(dirty false)
execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD OUTPUT_VARIABLE found RESULT_VARIABLE failed ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT failed)
    set(revision ${found})
    execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
        -- . ":(exclude)report/results" OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
        set(dirty true)
    endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT}
    CONTENT "#define MANDELMARCH_REVISION \"${revision}\"\n#define MANDELMARCH_DIRTY ${dirty}\n")
