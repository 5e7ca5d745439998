// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/path_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/explore/model/files.h"
#include "core/text/error.h"
#include "core/os/output_file.h"
#include "flight/film/film.h"
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
    filming_.start([path = path_, &backend = backend_of(registry, setup), options] {
        const auto ranks = one_rank();
        const FilmStats report = make_film(path, backend, options, *ranks);
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

}  // namespace mandelmarch::explore
