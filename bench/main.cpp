// SPDX-License-Identifier: Apache-2.0
// bench: verifies that all backends render the same picture, then times them.
#include "backends/all.h"
#include "bench/program.h"
#include "core/os/program.h"
#include "core/text/error.h"

namespace {

int body(int argc, char** argv)
{
    return mandelmarch::bench::bench_program(mandelmarch::program_backends(argc, argv), argc, argv);
}

}  // namespace

int bench_main(int argc, char** argv) { return mandelmarch::run_program("bench", body, argc, argv); }
