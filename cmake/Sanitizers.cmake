# SPDX-License-Identifier: Apache-2.0
# MANDELMARCH_SANITIZER=address|thread, for all targets.
if(MANDELMARCH_SANITIZER STREQUAL "address")
    add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
    # In packs, only accesses outside the stack are checked, by calls instead of inline code. With more checks, clang
    # takes minutes for a source of intrinsics. The scalar sources contain the same kernel with all checks.
    set(MANDELMARCH_SANITIZER_packs -fno-sanitize=undefined -mllvm -asan-stack=0
        -mllvm -asan-instrumentation-with-call-threshold=0)
    # If estimators are called instead of inlined, the scalar sources build in a fifth of the time.
    set(MANDELMARCH_SANITIZER_scalar -DFN_CALLED=inline)
elseif(MANDELMARCH_SANITIZER STREQUAL "thread")
    add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
    add_link_options(-fsanitize=thread)
    # The kernel needs no checks: in it, threads share only the scene, which is constant.
    set(MANDELMARCH_SANITIZER_packs -fno-sanitize=thread)
    set(MANDELMARCH_SANITIZER_scalar -fno-sanitize=thread)
    set(MANDELMARCH_SANITIZER_ray -fno-sanitize=thread)
elseif(MANDELMARCH_SANITIZER)
    message(FATAL_ERROR "MANDELMARCH_SANITIZER is '${MANDELMARCH_SANITIZER}', expected address or thread")
endif()
