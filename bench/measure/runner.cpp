// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "bench/measure/interruption.h"
#include "bench/measure/moving_eye.h"
#include "bench/measure/telemetry.h"
#include "bench/measure/verify.h"
#include "bench/result/figures.h"
#include "core/os/stopwatch.h"
#include "core/text/error.h"

namespace mandelmarch::bench {
namespace {

// Seconds. If a picture takes less, it is rendered once without timing before it is timed. The first rendering wakes
// the threads, fills the caches and raises the clock frequency after the previous configuration.
constexpr double warmed_below = 0.1;
// Seconds. A picture that takes longer is rendered only once, for verification.
constexpr double long_picture = 4;
constexpr int least_rounds = 6;  // fewer give no 95 % interval of a median
constexpr double narrow =
    0.02;  // half width of a 95 % interval, relative to the median; below it, a configuration is done

bool narrow_enough(const Row& row)
{
    const auto reached = summary(kernel_times(row)).half_width();
    return reached && *reached < narrow;
}

// Takes one sample: one picture of the scene, or setting.frames pictures from a fresh renderer. Throws what the backend
// throws.
Sample draw_sample(TimedCase& row, const Scene& scene, Image& image, Telemetry& telemetry)
{
    const Case& one = *row.one;
    const int frames = one.row.setting.frames;
    // Not the scene of this sample, whose picture a program might keep.
    if (frames == 0 && row.expected < warmed_below) row.renderer->render(one.scene, image);
    // Overwrite the image. Otherwise, if a backend did not write its pixels, the previous configuration's picture would
    // pass for its own.
    std::ranges::fill(image.bytes(), std::uint8_t{0x55});
    Sample sample;
    const std::optional<double> before = telemetry.joules();
    if (frames == 0) {
        sample.add(row.renderer->render(scene, image).timings);
    } else {
        const auto start = Clock::now();
        const auto renderer = one.backend->create(one.options);
        for (int frame = 0; frame < frames; ++frame) sample.add(renderer->render(scene, image).timings);
        sample.wall = seconds_since(start);
        for (double Sample::*part :
             {&Sample::kernel, &Sample::trial, &Sample::host, &Sample::wall, &Sample::upload, &Sample::readback}) {
            sample.*part /= frames;
        }
    }
    if (before) sample.joules = (telemetry.joules().value_or(*before) - *before) / std::max(1, frames);
    return sample;
}

class Rounds {
public:
    Rounds(std::vector<TimedCase>& rows, const Options& options, MovingEye* eye)
        : rows_(rows),
          options_(options),
          eye_(eye),
          random_(options.seed + std::uint64_t{7919} * static_cast<std::uint64_t>(options.run))
    {
    }

    void run(const Phase& phase)
    {
        for (int round = 0; round < most(); ++round) {
            std::vector<TimedCase*> order = unfinished();
            if (order.empty() || interrupted() != 0) break;
            std::shuffle(order.begin(), order.end(), random_);
            if (eye_ != nullptr) {
                eye_->next_round();
                eye_->group(order);
            }
            draw(order, round, phase);
            for (TimedCase* row : order) row->done = row->done || finished(*row);
        }
    }

private:
    std::vector<TimedCase*> unfinished()
    {
        std::vector<TimedCase*> order;
        for (TimedCase& row : rows_) {
            if (!row.done) order.push_back(&row);
        }
        return order;
    }

    int most() const { return options_.repetitions.value_or(options_.study->most_rounds); }

    void draw(const std::vector<TimedCase*>& order, int round, const Phase& phase)
    {
        const std::string text =
            fmt::format("round {} of {}{}", round + 1, options_.repetitions ? "" : "at most ", most());
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (interrupted() != 0) return;
            if (!out_of_time() || order[i]->one->row.samples.empty()) draw(*order[i], round);
            const double of_round = static_cast<double>(i + 1) / static_cast<double>(order.size());
            phase({"timing", share((round + of_round) / most()), text});
        }
    }

    void draw(TimedCase& live, int round)
    {
        Row& row = live.one->row;
        try {
            const Scene& scene = eye_ == nullptr ? live.one->scene : eye_->view_of(*live.one).scene;
            Image& image = image_for(live);
            Sample sample = draw_sample(live, scene, image, telemetry_);
            const std::string fault = eye_ != nullptr ? eye_->fault_of(*live.one, image)
                                      : fingerprint(image) == live.fingerprint
                                          ? ""
                                          : "the timed picture differs from the verified one";
            if (!fault.empty()) throw Error(fault);
            sample.run = options_.run;
            sample.round = round;
            live.spent += sample.wall;
            row.samples.push_back(sample);
        } catch (const std::exception& error) {
            if (interrupted() != 0) return;  // the signal may have ended the device's process, too
            row.failure = error.what();
            row.samples.clear();
            live.done = true;
        }
    }

    bool out_of_time() const { return !options_.repetitions && seconds_since(start_) > options_.budget.value(); }

    bool finished(const TimedCase& live) const
    {
        if (options_.repetitions) return false;
        const Row& row = live.one->row;
        if (out_of_time() || live.spent > options_.study->row_budget) return true;
        return static_cast<int>(row.samples.size()) >= least_rounds && narrow_enough(row);
    }

    // Returns the completed fraction of the work. If the number of rounds is fixed, this is the fraction of the rounds;
    // else it is the largest of three fractions: of the rounds, of the configurations, and of the time budget.
    double share(double of_rounds) const
    {
        if (options_.repetitions) return of_rounds;
        const auto done = std::ranges::count_if(rows_, &TimedCase::done);
        const double of_rows = static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(1, rows_.size()));
        return std::min(1.0, std::max({of_rounds, of_rows, seconds_since(start_) / options_.budget.value()}));
    }

    Image& image_for(const TimedCase& live)
    {
        const Scene& scene = live.one->scene;
        if (image_.width() != scene.width || image_.height() != scene.height) {
            image_ = Image(scene.width, scene.height, Image::Layers::bytes);
        }
        return image_;
    }

    std::vector<TimedCase>& rows_;
    const Options& options_;
    MovingEye* eye_;
    std::mt19937_64 random_;
    Clock::time_point start_ = Clock::now();
    Telemetry telemetry_;
    Image image_;
};

}  // namespace

void keep_long_pictures(std::vector<TimedCase>& rows, const Options& options)
{
    if (options.repetitions) return;
    for (TimedCase& live : rows) {
        if (live.expected <= long_picture) continue;
        live.one->row.samples.push_back({.run = options.run});
        live.one->row.samples.back().add(live.first.timings);
        live.done = true;
    }
}

void run_rounds(std::vector<TimedCase>& rows, const Options& options, const Phase& phase, MovingEye* eye)
{
    Rounds(rows, options, eye).run(phase);
}

}  // namespace mandelmarch::bench
