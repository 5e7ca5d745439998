// Still frames, for those who stitch by hand.
#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/image/image_file.h"
#include "flight/film/encoder.h"
#include "flight/film/film.h"
#include "flight/film/process.h"
#include "flight/film/progress.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

void write_png_still(const std::string& file, const std::vector<std::uint8_t>& rgb, const Picture& picture)
{
    Image image(picture.width, picture.height, Image::Layers::bytes);
    const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
        const auto from = rgb.begin() + static_cast<std::ptrdiff_t>(y * row);
        std::copy_n(from, row, image.bytes().end() - static_cast<std::ptrdiff_t>((y + 1) * row));
    }
    write_image(file, ImageFormat::png, image);
}

void write_jpeg_still(const std::string& file, const std::vector<std::uint8_t>& rgb, const Picture& picture)
{
    const std::string part = file + ".part";
    Process process({ffmpeg(),
                     "-hide_banner",
                     "-loglevel",
                     "error",
                     "-y",
                     "-f",
                     "rawvideo",
                     "-pix_fmt",
                     "rgb24",
                     "-video_size",
                     fmt::format("{}x{}", picture.width, picture.height),
                     "-i",
                     "-",
                     "-c:v",
                     "mjpeg",
                     "-q:v",
                     "2",
                     "-pix_fmt",
                     "yuvj444p",
                     "-fflags",
                     "+bitexact",
                     "-flags:v",
                     "+bitexact",
                     "-f",
                     "image2",
                     "-update",
                     "1",
                     part},
                    "");
    process.write(rgb.data(), rgb.size());
    const auto result = process.finish();
    std::error_code error;
    if (result.fine) fs::rename(part, file, error);
    if (result.fine && !error) return;
    const std::string why = result.fine ? error.message() : result.cause;
    fs::remove(part, error);
    throw Error(fmt::format("{}: cannot be written: {}", file, why));
}

}  // namespace

std::size_t make_stills(const Path& path, const Backend& backend, const StillOptions& options, Ranks& ranks)
{
    if (options.jpeg) check_ffmpeg();
    std::error_code error;
    fs::create_directories(options.folder, error);
    if (error) throw Error(fmt::format("{}: cannot make the folder: {}", options.folder, error.message()));
    std::vector<std::size_t> frames;
    for (std::size_t f = options.first; f < options.last; f += options.every) frames.push_back(f);
    const auto name = [&](std::size_t frame) {
        return fmt::format("{}/frame-{:06}.{}", options.folder, frame, options.jpeg ? "jpg" : "png");
    };
    FilmProgress progress(frames.size(), 0);
    std::optional<FrameMaker> maker;
    if (!frames.empty()) maker.emplace(backend, options.renderer, path, options.picture);
    ranks.each(
        frames.size(),
        [&](std::size_t i) {
            if (fs::exists(name(frames[i]))) return;
            const auto rgb = maker->draw(frames[i]);
            if (options.jpeg) {
                write_jpeg_still(name(frames[i]), rgb, options.picture);
            } else {
                write_png_still(name(frames[i]), rgb, options.picture);
            }
        },
        [&](std::size_t) { progress.add(1); });
    return frames.size();
}

}  // namespace mandelmarch
