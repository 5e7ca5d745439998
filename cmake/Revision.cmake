# SPDX-License-Identifier: Apache-2.0
# Runs at every build (cmake -P). Writes to OUTPUT the git revision of SOURCE and whether tracked files differ from this
# revision; leaves OUTPUT untouched if its content stays the same. Sources of an unknown revision count as changed.
# Result files (results/) are ignored, so that measurements, which write them, do not mark the sources as changed.
set(revision unknown)
set(dirty true)
# The option allows sources that belong to another user, as in shared folders of clusters. Git compares real paths.
file(REAL_PATH ${SOURCE} SOURCE)
set(git git -c safe.directory=${SOURCE} -C ${SOURCE})
# Sources that belong to no repository can be inside another one.
execute_process(COMMAND ${git} ls-files OUTPUT_VARIABLE own ERROR_QUIET)
execute_process(COMMAND ${git} rev-parse HEAD OUTPUT_VARIABLE found RESULT_VARIABLE failed ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT failed AND own)
    set(revision ${found})
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no
        -- . ":(exclude)results" OUTPUT_VARIABLE changes RESULT_VARIABLE failed ERROR_QUIET)
    if(NOT failed AND NOT changes)
        set(dirty false)
    endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT}
    CONTENT "#define MANDELMARCH_REVISION \"${revision}\"\n#define MANDELMARCH_DIRTY ${dirty}\n")
