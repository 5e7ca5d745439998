// SPDX-License-Identifier: Apache-2.0
// Fuzzer: any bytes, read as a parameter file, give a scene whose values are in their ranges, or an InputError of one
// line.
#include <cmath>
#include <cstdlib>

#include "core/text/error.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    using namespace mandelmarch;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (const Fractal& fractal : fractals()) {
        try {
            const Scene scene = parse_parameters(text, "x", fractal).scene;
            if (scene.width < 1 || scene.height < 1 || scene.iterations < 1 || scene.image_file.empty()) std::abort();
            const auto kernel = kernel_scene<layout_f32::Scene>(scene, Mode::exact);
            if (!std::isfinite(kernel.across.x) || !(kernel.tolerance > 0)) std::abort();
        } catch (const InputError& error) {
            const std::string_view message = error.what();
            if (!message.starts_with("x:") || message.find('\n') != std::string_view::npos) std::abort();
        }
    }
    return 0;
}
