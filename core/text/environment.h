// SPDX-License-Identifier: Apache-2.0
// The environment variables that the programs, backends and drivers read.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

namespace mandelmarch {

// A row of the table: variables with the same purpose.
struct Variables {
    std::array<const char*, 3> names;  // unused elements are null
    std::string_view readers;
    std::string_view meaning;
    bool recorded = false;  // bench stores the value in its results
};

inline constexpr Variables variables[] = {
    {{"MANDELMARCH_BACKENDS"}, "all programs", "backends whose drivers may be opened, with commas between them"},
    {{"MANDELMARCH_ISOLATION"}, "all programs", "off: drivers run in the program itself, as with --no-isolation"},
    {{"MANDELMARCH_DEVICE_TIMEOUT"},
     "all programs",
     "time limit in seconds for one device pass over a band (a group of picture rows)"},
    {{"MANDELMARCH_DRIVER_LOG"}, "all programs", "file to which all driver messages are appended"},
    {{"MANDELMARCH_INSTRUCTIONS"}, "all programs", "instruction set of openmp: SCALAR, SSE4, AVX2, ..."},
    {{"MANDELMARCH_FFMPEG"}, "flythrough, explore", "ffmpeg program to run"},
    {{"MANDELMARCH_FFMPEG_TIMEOUT"}, "flythrough, explore", "time limit in seconds for ffmpeg to respond"},
    {{"MANDELMARCH_FONT"}, "flythrough, explore", "font file of the title"},
    {{"MANDELMARCH_REHEARSAL"},
     "bench, gpu_check",
     "if set, any device counts as a GPU; the results are marked as a rehearsal"},
    {{"TMPDIR"}, "all programs", "folder of temporary files"},
    {{"XDG_CACHE_HOME", "HOME"}, "opencl", "folder of compiled kernels"},
    {{"XDG_CONFIG_HOME", "HOME"}, "explore", "folder of the settings"},
    {{"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"}, "explore", "the display"},
    {{"PATH"}, "all programs", "folders with ffmpeg and other programs"},
    {{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}, "flythrough", "set in each process of an MPI program"},
    {{"SLURM_NTASKS"}, "flythrough", "number of tasks that Slurm starts"},
    {{"OMP_NUM_THREADS", "OMP_THREAD_LIMIT"}, "all programs", "number of threads on the CPU, and its maximum", true},
    {{"OMP_PROC_BIND", "OMP_PLACES", "GOMP_CPU_AFFINITY"}, "openmp, bench", "cores of openmp's threads", true},
    {{"OMP_DYNAMIC", "OMP_WAIT_POLICY", "GOMP_SPINCOUNT"}, "OpenMP", "how threads are used, and how they wait", true},
    {{"OMP_STACKSIZE", "GOMP_STACKSIZE"}, "openmp", "stack of a thread"},
    {{"OMP_TARGET_OFFLOAD", "OMP_DEFAULT_DEVICE"},
     "OpenMP",
     "whether omptarget may use GPUs; --device selects its device",
     true},
    {{"KOKKOS_NUM_THREADS"}, "Kokkos", "number of threads", true},
    {{"ACC_DEVICE_TYPE", "ACC_DEVICE_NUM"},
     "OpenACC",
     "default of OpenACC's library; --device selects openacc's device",
     true},
    {{"CUDA_VISIBLE_DEVICES", "CUDA_DEVICE_ORDER"}, "CUDA", "GPUs that programs see, and their order", true},
    {{"HIP_VISIBLE_DEVICES", "ROCR_VISIBLE_DEVICES"}, "HIP", "GPUs that programs see", true},
    {{"CUDA_CACHE_DISABLE"}, "CUDA", "1: compiled kernels are not kept", true},
    {{"POCL_MAX_PTHREAD_COUNT", "LP_NUM_THREADS"}, "PoCL, lavapipe", "number of threads", true},
    {{"POCL_DEVICES", "POCL_AFFINITY"}, "PoCL", "devices to use, and whether threads are bound to cores", true},
    {{"LP_NATIVE_VECTOR_WIDTH"}, "lavapipe", "bits of a SIMD vector", true},
    {{"POCL_CACHE_DIR"}, "PoCL", "folder of compiled kernels"},
    {{"OCL_ICD_VENDORS"}, "opencl, bundle", "folder of OpenCL's driver files", true},
    {{"OPENCL_VENDOR_PATH"}, "OpenCL, bundle", "folder of OpenCL's driver files"},
    {{"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}, "Vulkan", "driver files of Vulkan", true},
    {{"VK_ADD_DRIVER_FILES"}, "Vulkan, bundle", "further driver files of Vulkan"},
};

// The name of a variable. A name that is not in the table does not compile.
struct VariableName {
    // NOLINTNEXTLINE(google-explicit-constructor): converts literals
    consteval VariableName(const char* name) : text(name)
    {
        for (const Variables& row : variables) {
            for (const char* listed : row.names) {
                if (listed != nullptr && std::string_view(listed) == name) return;
            }
        }
        throw "not in the table";
    }

    const char* text;
};

// Returns the variable's value; "" if it is not set.
std::string environment_variable(VariableName name);

// Returns the seconds that the variable gives; `usual` if it is not set or empty. Throws InputError if it is not a
// number from 0.001 to 1e6.
double environment_seconds(VariableName name, double usual);

// Returns the names and values of the set variables that bench records.
std::map<std::string, std::string> recorded_variables();

// Returns lines for the end of --help: the project's own variables that the program reads.
std::string environment_help(std::string_view program);

// Returns the seconds that one pass over a band of a picture may take: the environment variable
// MANDELMARCH_DEVICE_TIMEOUT, or 300 if it is not set or empty. Throws InputError (environment_seconds()).
double device_timeout();

}  // namespace mandelmarch
