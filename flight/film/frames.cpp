#include "flight/film/frames.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace mandelmarch {

FrameMaker::FrameMaker(const Backend& backend, const RendererOptions& options, const Path& path, const Picture& picture)
    : path_(path), picture_(picture), renderer_(backend.create(options))
{
    const int width = picture.width * picture.samples;
    const int height = picture.height * picture.samples;
    constexpr std::uint64_t beside = 300ULL << 20;  // bytes: the program, the encoder and frames in flight
    const std::uint64_t needed = 3ULL * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) + beside;
    if (width > max_side || height > max_side || needed > available_memory()) {
        throw InputError(
            fmt::format("{} x {} pixels of {} x {} samples need {} MiB of memory and sides up to {}, expected "
                        "a smaller size",
                        picture.width, picture.height, picture.samples, picture.samples, needed >> 20, max_side));
    }
    image_ = Image(width, height, Image::Layers::bytes);
}

std::vector<std::uint8_t> FrameMaker::draw(std::size_t frame)
{
    // The detail level follows the picture's pixels, not its samples: finer surfaces would flicker more, not less.
    Scene scene = picture_of(path_, path_.frames[frame], picture_.width, picture_.height);
    scene.width = image_.width();
    scene.height = image_.height();
    if (picture_.look) scene.colouring = *picture_.look;
    renderer_->render(scene, image_);
    const auto side = static_cast<std::size_t>(picture_.samples);
    const auto width = static_cast<std::size_t>(picture_.width);
    const auto height = static_cast<std::size_t>(picture_.height);
    const auto count = static_cast<unsigned>(side * side);
    std::vector<std::uint8_t> rgb(3 * width * height);
    std::vector<unsigned> sums(3 * width);
    for (std::size_t y = 0; y < height; ++y) {
        sums.assign(sums.size(), count / 2);
        for (std::size_t sy = 0; sy < side; ++sy) {
            // Row 0 of an image is its bottom row.
            const std::uint8_t* from = image_.bytes().data() + ((height - 1 - y) * side + sy) * 3 * width * side;
            for (std::size_t x = 0; x < width; ++x) {
                for (std::size_t sx = 0; sx < side; ++sx, from += 3) {
                    for (std::size_t c = 0; c < 3; ++c) sums[3 * x + c] += from[c];
                }
            }
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            rgb[3 * width * y + i] = static_cast<std::uint8_t>(sums[i] / count);
    }
    return rgb;
}

}  // namespace mandelmarch
