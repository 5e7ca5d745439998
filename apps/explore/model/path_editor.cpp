// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/path_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/os/output_file.h"
#include "core/text/error.h"
#include "flight/audit/motion.h"
#include "flight/field/field.h"
#include "flight/film/film.h"
#include "flight/path/measures.h"
#include "flight/ride/planner.h"

namespace mandelmarch::explore {
namespace {

Frame frame_of(const Path& path, const Scene& scene)
{
    Frame frame{scene.eye, scene.target, scene.up, scene.field_of_view, {}};
    if (scene.shape != path.scene.shape) frame.changes.shape = scene.shape;
    if (scene.iterations != path.scene.iterations) frame.changes.iterations = scene.iterations;
    if (scene.escape != path.scene.escape) frame.changes.escape = scene.escape;
    if (scene.colouring != path.scene.colouring) frame.changes.colouring = scene.colouring;
    if (scene.brightness != path.scene.brightness) frame.changes.brightness = scene.brightness;
    return frame;
}

constexpr double tremor = 9;        // frames; standard deviation of the smoothing Gaussian
constexpr double room = 0.6;        // smallest clearance of a smoothed position, as a fraction of the original one's
constexpr double most_step = 0.85;  // largest step between frames, as a fraction of the audit's limit
constexpr double most_turn = 1.0;   // degrees per frame; largest turn. The audit's limit is 1.2
constexpr int retimings = 4;        // number of passes that reduce steps and turns
constexpr int easing = 12;          // frames over which the flight slows down and speeds up

struct Look {
    Vector eye, forward, up;
};

Look look_of(const Frame& frame) { return {frame.eye, unit(frame.target - frame.eye), unit(frame.up)}; }

void set_look(Frame& frame, const Look& look)
{
    frame.eye = look.eye;
    frame.target = look.eye + unit(look.forward);
    frame.up = unit(look.up);
}

Look mean(const std::vector<Look>& looks, std::size_t at)
{
    Look sum{};
    double weights = 0;
    const auto last = static_cast<std::ptrdiff_t>(looks.size()) - 1;
    // Near the path's ends, the mean is taken over fewer cameras on both sides, so that the first and the last camera
    // do not move.
    const auto here = static_cast<std::ptrdiff_t>(at);
    const std::ptrdiff_t reach = std::min({static_cast<std::ptrdiff_t>(3 * tremor), here, last - here});
    for (std::ptrdiff_t d = -reach; d <= reach; ++d) {
        const double w = std::exp(-0.5 * static_cast<double>(d * d) / (tremor * tremor));
        const Look& look = looks[static_cast<std::size_t>(here + d)];
        sum.eye = sum.eye + w * look.eye;
        sum.forward = sum.forward + w * look.forward;
        sum.up = sum.up + w * look.up;
        weights += w;
    }
    return {(1 / weights) * sum.eye, sum.forward, sum.up};
}

void take_tremor_out(Path& path)
{
    std::vector<Look> looks;
    for (const Frame& frame : path.frames) looks.push_back(look_of(frame));
    const DistanceField field(scene_of(path, path.frames.front(), 16, 9), 1);
    for (std::size_t i = 0; i < looks.size(); ++i) {
        Look look = mean(looks, i);
        const double enough = room * field.distance(looks[i].eye);
        for (int halving = 0; halving < 6 && field.distance(look.eye) < enough; ++halving) {
            look.eye = 0.5 * (look.eye + looks[i].eye);
        }
        if (field.distance(look.eye) < enough) look.eye = looks[i].eye;
        if (length(look.forward) < 1e-3 || length(cross(look.forward, look.up)) < 1e-3) continue;
        set_look(path.frames[i], look);
    }
}

// Returns, for each frame but the last, the number of frames that the motion to the next frame should take, at least 1.
std::vector<double> needed(const Path& path)
{
    const std::vector<double> turns = turns_of(path);
    const DistanceField field(scene_of(path, path.frames.front(), 16, 9), 1);
    const double bar = most_step * flight_measures(*path.scene.fractal).step;
    std::vector<double> frames(path.frames.size() - 1, 1);
    double before = field.distance(path.frames.front().eye);
    for (std::size_t i = 1; i < path.frames.size(); ++i) {
        const double here = field.distance(path.frames[i].eye);
        const double clearance = std::max(std::min(here, before), 1e-9 * field.bounds().size);
        const double step = length(path.frames[i].eye - path.frames[i - 1].eye);
        frames[i - 1] = std::max({1.0, step / (bar * clearance), turns[i] / most_turn});
        before = here;
    }
    return frames;
}

// Smooths the numbers of frames that needed() returns, so that the flight slows down early and speeds up gradually.
// No number becomes smaller.
std::vector<double> eased(const std::vector<double>& frames)
{
    std::vector<double> most(frames.size());
    std::vector<double> soft(frames.size());
    const auto around = [&](const std::vector<double>& of, std::size_t i, const auto& take) {
        const std::size_t first = i < easing ? 0 : i - easing;
        for (std::size_t j = first; j <= std::min(i + easing, of.size() - 1); ++j) take(of[j]);
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        around(frames, i, [&](double value) { most[i] = std::max(most[i], value); });
    }
    for (std::size_t i = 0; i < frames.size(); ++i) {
        int count = 0;
        around(most, i, [&](double value) {
            soft[i] += value;
            ++count;
        });
        soft[i] = std::max(frames[i], soft[i] / count);
    }
    return soft;
}

bool slow_down(Path& path)
{
    std::vector<double> frames = needed(path);
    if (std::ranges::max(frames) <= 1.001) return false;
    frames = eased(frames);
    std::vector<Frame> flown{path.frames.front()};
    double at = 0;  // index of the last new frame
    double begin = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        while (at + 1 <= begin + frames[i]) {
            at += 1;
            flown.push_back(between(path.frames[i], path.frames[i + 1], (at - begin) / frames[i]));
        }
        begin += frames[i];
    }
    path.frames = std::move(flown);
    return true;
}

}  // namespace

void PathEditor::go_to(double frame)
{
    if (has_path()) at_ = std::clamp(frame, 0.0, static_cast<double>(frames() - 1));
}

void PathEditor::advance(double seconds)
{
    go_to(at_ + seconds * path_.frames_per_second);
    if (at_ >= static_cast<double>(frames()) - 1) playing = false;
}

Scene PathEditor::scene(int width, int height) const
{
    const auto first = static_cast<std::size_t>(at_);
    const std::size_t second = std::min(first + 1, frames() - 1);
    Scene scene = picture_of(
        path_, between(path_.frames[first], path_.frames[second], at_ - static_cast<double>(first)), width, height);
    scene.centred = true;
    return scene;
}

void PathEditor::save(const std::string& file) const
{
    if (!has_path()) throw Error("there is no path to save");
    write_file(file, to_text(path_));
}

void PathEditor::take(Path path)
{
    path_ = std::move(path);
    recording_ = false;
    go_to(at_);
}

void PathEditor::begin_recording(const Scene& scene)
{
    path_ = Path{};
    path_.scene = scene;
    path_.scene.conservative = true;  // the default estimate of films
    as_file(path_.scene);
    path_.frames = {frame_of(path_, scene)};
    at_ = owed_ = 0;
    playing = false;
    recording_ = true;
}

void PathEditor::record(const Scene& scene, double seconds)
{
    if (!recording_) return;
    const Frame now = frame_of(path_, scene);
    const Frame before = path_.frames.back();
    const double begin = owed_;
    owed_ += seconds * path_.frames_per_second;
    const double length = owed_ - begin;
    double done = 0;
    while (owed_ >= 1) {
        owed_ -= 1;
        done += 1;
        path_.frames.push_back(between(before, now, std::clamp((done - begin) / length, 0.0, 1.0)));
    }
    if (done == 0) return;
    at_ = static_cast<double>(frames() - 1);
}

void PathEditor::end_recording()
{
    if (!recording_) return;
    recording_ = false;
    if (has_path()) cut_digits(path_);
    at_ = 0;
}

void PathEditor::smooth()
{
    if (!has_path()) throw Error("there is no path to smooth");
    take(smoothed(path_));
}

void PathEditor::plan(const Scene& scene, std::uint64_t seed, int frame_count)
{
    if (planning_.running()) return;
    Scene shape = scene;
    shape.conservative = true;
    as_file(shape);
    planning_.start([shape, seed, frame_count] {
        return mandelmarch::plan({.scene = shape, .seed = seed, .frames = frame_count, .threads = 1}).path;
    });
}

void PathEditor::film(const Registry& registry, const Setup& setup, const std::string& file, int width, int height)
{
    if (!has_path()) throw Error("there is no path to film");
    if (filming_.running()) return;
    FilmOptions options;
    options.output = file;
    options.renderer = options_of(setup);
    options.picture.width = width;
    options.picture.height = height;
    check_film(options, frames(), path_.frames_per_second);
    filmed_ = std::make_shared<std::atomic<double>>(0);
    options.progress = [filmed = filmed_](double share) { *filmed = share; };
    filming_.start([path = path_, &backend = backend_of(registry, setup), options] {
        Ranks ranks;
        const FilmStats report = make_film(path, backend, options, ranks);
        return fmt::format("{}: {} frames in {:.0f} s", options.output, path.frames.size(), report.seconds);
    });
}

std::string PathEditor::take_news()
{
    std::string failure;
    if (auto path = planning_.take(failure)) {
        take(std::move(*path));
        at_ = 0;
        playing = true;
        return fmt::format("a tour of seed {}, {} frames", path_.seed, frames());
    }
    if (!failure.empty()) return "planning: " + failure;
    const auto done = filming_.take(failure);
    return done ? *done : failure.empty() ? "" : "film: " + failure;
}

Frame between(const Frame& a, const Frame& b, double share)
{
    const Look from = look_of(a);
    const Look to = look_of(b);
    Frame frame = share < 0.5 ? a : b;
    const auto mix = [&](Vector x, Vector y) { return x + share * (y - x); };
    const Look look{mix(from.eye, to.eye), mix(from.forward, to.forward), mix(from.up, to.up)};
    if (length(look.forward) < 1e-6 || length(cross(look.forward, look.up)) < 1e-6) return frame;
    set_look(frame, look);
    frame.field_of_view = a.field_of_view + share * (b.field_of_view - a.field_of_view);
    return frame;
}

Path smoothed(const Path& path)
{
    if (path.frames.size() < 3) return path;
    Path smooth = path;
    take_tremor_out(smooth);
    // The path is smoothed after each pass, because slowing down makes kinks.
    for (int round = 0; round < retimings && slow_down(smooth); ++round) take_tremor_out(smooth);
    slow_down(smooth);
    cut_digits(smooth);
    return smooth;
}

}  // namespace mandelmarch::explore
