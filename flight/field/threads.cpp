// SPDX-License-Identifier: Apache-2.0
#include "flight/field/threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/os/cores.h"

namespace mandelmarch {
namespace {

thread_local bool in_loop = false;  // this thread executes a part of a parallel loop

}  // namespace

void parallel(std::size_t count, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t last)>& body)
{
    const std::size_t parts = (count + grain - 1) / grain;
    const std::size_t helpers = std::min(parts, static_cast<std::size_t>(threads > 0 ? threads : usable_threads()));
    if (helpers <= 1 || in_loop) {
        if (count > 0) body(0, count);
        return;
    }
    std::atomic<std::size_t> next = 0;
    std::exception_ptr error;
    std::mutex guard;
    const auto work = [&] {
        in_loop = true;
        try {
            for (std::size_t part = next++; part < parts; part = next++) {
                body(part * grain, std::min(count, (part + 1) * grain));
            }
        } catch (...) {
            const std::scoped_lock lock(guard);
            error = std::current_exception();
        }
        in_loop = false;
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < helpers; ++i) others.emplace_back(work);
        work();
    }
    if (error) std::rethrow_exception(error);
}

}  // namespace mandelmarch
