// SPDX-License-Identifier: Apache-2.0
// Still frames as picture files.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/image/formats/image_file.h"
#include "core/os/files.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "flight/film/description.h"
#include "flight/film/film.h"
#include "flight/film/progress.h"
#include "flight/film/segment_store.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

void write_still(const std::string& file, FrameMaker& maker, std::size_t frame, const Picture& picture)
{
    if (picture.format == ImageFormat::exr) {
        return write_image(file, picture.format, maker.draw_layers(frame), NamedBy::program);
    }
    const std::vector<std::uint8_t> rgb = maker.draw(frame);
    Image image(picture.width, picture.height, Image::Layers::bytes);
    const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
        const auto from = rgb.begin() + static_cast<std::ptrdiff_t>(y * row);
        std::copy_n(from, row, image.bytes().end() - static_cast<std::ptrdiff_t>((y + 1) * row));
    }
    write_image(file, picture.format, image, NamedBy::program);
}

std::vector<std::size_t> frames_of(const FilmOptions& options, std::size_t all)
{
    const auto [begin, end] = chosen_frames(options.frames, all);
    const auto [first, after] = chosen_segments(options.segments, end - begin + 1);
    std::vector<std::size_t> frames;
    const std::size_t behind = std::min(end + 1, begin + after * segment_frames);
    for (std::size_t f = begin + first * segment_frames; f < behind; f += options.every) frames.push_back(f);
    return frames;
}

// Prints a message if the folder has stills of which the stamps do not begin with `pictures`.
void name_others(const std::string& folder, const std::string& pictures)
{
    const auto others = std::ranges::count_if(files_in(folder), [&](const std::string& file) {
        const std::string name = fs::path(file).filename().string();
        return name.starts_with("frame-") && name.ends_with(".made") && !first_line(file).starts_with(pictures);
    });
    if (others == 0) return;
    say("stills: {} has {} pictures of another film, look, size, format or program, which are kept\n", folder, others);
}

}  // namespace

Range chosen_frames(const std::optional<Range>& frames, std::size_t all)
{
    const Range chosen = frames.value_or(Range{0, all - 1});
    if (chosen.first <= chosen.second && chosen.second < all) return chosen;
    throw InputError(fmt::format("--frames: {}-{} given, expected some of 0-{}", chosen.first, chosen.second, all - 1));
}

Range chosen_segments(const std::optional<Range>& segments, std::size_t frames)
{
    const std::size_t all = (frames - 1) / segment_frames + 1;
    const auto [first, last] = segments.value_or(Range{0, all - 1});
    return {std::min(first, all), std::min(last + 1, all)};
}

void check_stills(const FilmOptions& options, std::size_t frames)
{
    check_picture(options.picture);
    static_cast<void>(frames_of(options, frames));
    // The folder, or its nearest existing parent, must be a folder in which this user can create files.
    std::error_code error;
    fs::path folder = fs::absolute(options.stills);
    while (!fs::exists(fs::symlink_status(folder, error)) && folder.has_relative_path()) folder = folder.parent_path();
    if (!fs::is_directory(folder, error)) {
        throw InputError(fmt::format("--stills: {} is not a folder, expected a folder for pictures", folder.string()));
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw InputError(fmt::format("--stills: folder {}: {}", folder.string(), std::strerror(errno)));
    }
}

std::size_t make_stills(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks)
{
    if (ranks.rank() == 0) check_stills(options, path.frames.size());
    std::error_code error;
    fs::create_directories(options.stills, error);
    if (error) throw Error(fmt::format("{}: cannot make the folder: {}", options.stills, error.message()));
    const std::vector<std::size_t> frames = frames_of(options, path.frames.size());
    const ImageFormat format = options.picture.format;
    const std::string ending = format == ImageFormat::jpeg ? "jpg" : format == ImageFormat::exr ? "exr" : "png";
    const auto name = [&](std::size_t frame) {
        return fmt::format("{}/frame-{:06}.{}", options.stills, frame, ending);
    };
    const std::string pictures =
        digest(description_of(path, backend, options.picture, options.renderer, {{"encoder", ending}}));
    const auto made_of = [&](std::size_t frame) { return fmt::format("{} frame {}", pictures, frame); };
    FilmProgress progress(frames.size(), 0);
    FrameMaker maker(backend, options.renderer, path, options.picture);
    ranks.each(
        frames.size(),
        [&](std::size_t i) {
            const std::string file = name(frames[i]);
            if (state_of(file, made_of(frames[i])) == FileState::whole) return;
            write_still(file, maker, frames[i], options.picture);
            write_note(file, made_of(frames[i]), digest_of_file(file));
        },
        [&](std::size_t) { progress.add(1); });
    if (ranks.rank() == 0) name_others(options.stills, pictures);
    return frames.size();
}

}  // namespace mandelmarch
