// SPDX-License-Identifier: Apache-2.0
// bench with a slower openmp, for tests of duels. The number at the end of the program's name is the added time in
// percent: slowed_3 takes 3 % longer than bench. The pictures are bench's.
#include <algorithm>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "backends/openmp/openmp.h"
#include "backends/reference/reference.h"
#include "bench/program.h"
#include "bench/base/table.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"

namespace mandelmarch {
namespace {

double seconds_of(clockid_t clock)
{
    timespec used{};
    clock_gettime(clock, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

// Keeps every thread busy until it has used `seconds` of processor time.
void burn(double seconds)
{
#pragma omp parallel
    {
        const double start = seconds_of(CLOCK_THREAD_CPUTIME_ID);
        while (seconds_of(CLOCK_THREAD_CPUTIME_ID) - start < seconds) continue;
    }
}

class SlowedRenderer : public Renderer {
public:
    SlowedRenderer(std::unique_ptr<Renderer> inner, double share) : inner_(std::move(inner)), share_(share) {}

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        const double before = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        RenderStats report = inner_->render(scene, image, progress);
        const double used = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - before;
        const auto start = Clock::now();
        burn(share_ * used / std::max(1, report.threads));
        report.timings.kernel += seconds_since(start);
        report.timings.wall += seconds_since(start);
        return report;
    }

private:
    std::unique_ptr<Renderer> inner_;
    double share_;
};

class SlowedBackend : public Backend {
public:
    explicit SlowedBackend(double share) : share_(share) {}
    std::string_view name() const override { return inner_->name(); }
    BackendInfo info() const override { return inner_->info(); }
    std::optional<std::string> unavailable() const override { return inner_->unavailable(); }
    std::vector<Device> devices() const override { return inner_->devices(); }
    bool draws(const Scene& scene) const override { return inner_->draws(scene); }
    std::unique_ptr<Renderer> create(const RendererOptions& options) const override
    {
        return std::make_unique<SlowedRenderer>(inner_->create(options), share_);
    }

private:
    std::unique_ptr<Backend> inner_ = make_openmp_backend();
    double share_;
};

int body(int argc, char** argv)
{
    const std::string name = argv[0];
    const auto digits = name.find_last_not_of("0123456789") + 1;
    const double percent = digits < name.size() ? std::stod(name.substr(digits)) : 0;
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(std::make_unique<SlowedBackend>(percent / 100));
    return bench::bench_program(Registry(std::move(backends)), argc, argv);
}

}  // namespace
}  // namespace mandelmarch

int main(int argc, char** argv) { return mandelmarch::run_program("bench", mandelmarch::body, argc, argv); }
