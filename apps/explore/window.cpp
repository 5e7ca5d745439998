// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/window.h"

// Versions of Dear ImGui after 1.86 (Debian 12) have another name for the header of its SDL part.
#if __has_include(<backends/imgui_impl_sdl2.h>)
#include <backends/imgui_impl_sdl2.h>
#else
#include <backends/imgui_impl_sdl.h>
#endif
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/image/formats/image_file.h"

namespace mandelmarch::explore {
namespace {

constexpr int least_side = 160;    // pixels; smallest width and height of the window
constexpr double usual_rate = 60;  // Hz; assumed if the screen's rate is unknown

// Returns true if OpenGL is emulated on the CPU. The emulation would need cores that rendering could use; SDL's
// software renderer needs less.
bool emulated(SDL_Renderer* renderer)
{
    SDL_RendererInfo info{};
    if (SDL_GetRendererInfo(renderer, &info) != 0 || !std::string_view(info.name).starts_with("opengl")) return false;
    using GetString = const unsigned char* (*)(unsigned);
    constexpr unsigned gl_renderer = 0x1F01;
    const auto get = reinterpret_cast<GetString>(SDL_GL_GetProcAddress("glGetString"));
    const unsigned char* name = get != nullptr ? get(gl_renderer) : nullptr;
    if (name == nullptr) return true;
    const std::string_view text(reinterpret_cast<const char*>(name));
    for (const std::string_view known : {"llvmpipe", "softpipe", "swrast", "Software"}) {
        if (text.find(known) != std::string_view::npos) return true;
    }
    return false;
}

// Returns a pixel format of 32 bits; if possible, one that SDL need not convert.
Uint32 format_of(SDL_Renderer* renderer)
{
    SDL_RendererInfo info{};
    SDL_GetRendererInfo(renderer, &info);
    return info.num_texture_formats > 0 && info.texture_formats[0] == SDL_PIXELFORMAT_RGB888 ? SDL_PIXELFORMAT_RGB888
                                                                                             : SDL_PIXELFORMAT_ARGB8888;
}

}  // namespace

void PictureTexture::clear()
{
    if (texture_ != nullptr) SDL_DestroyTexture(texture_);
    texture_ = nullptr;
}

void PictureTexture::take(SDL_Renderer* renderer, const Pixels& pixels)
{
    if (texture_ == nullptr || width_ != pixels.width || height_ != pixels.height) {
        clear();
        texture_ =
            SDL_CreateTexture(renderer, format_of(renderer), SDL_TEXTUREACCESS_STREAMING, pixels.width, pixels.height);
        if (texture_ == nullptr) throw Error(fmt::format("no memory for a picture in the window: {}", SDL_GetError()));
        SDL_SetTextureBlendMode(texture_, SDL_BLENDMODE_NONE);
        SDL_SetTextureScaleMode(texture_, SDL_ScaleModeLinear);
        width_ = pixels.width;
        height_ = pixels.height;
    }
    SDL_UpdateTexture(texture_, nullptr, pixels.of.data(), 4 * pixels.width);
}

void PictureTexture::show(SDL_Renderer* renderer, const SDL_Rect& where) const
{
    if (texture_ != nullptr) SDL_RenderCopy(renderer, texture_, nullptr, &where);
}

Window::Window(const std::string& title, int width, int height)
{
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    // Without a display, SDL would choose a video driver that shows nothing, and the program would run invisibly.
    const auto named = [](const char* variable) {
        const char* value = std::getenv(variable);
        return value != nullptr && *value != '\0';
    };
    if (!named("DISPLAY") && !named("WAYLAND_DISPLAY") && !named("SDL_VIDEODRIVER")) {
        throw Unavailable("no display: none of DISPLAY, WAYLAND_DISPLAY and SDL_VIDEODRIVER is set");
    }
    if (SDL_Init(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER) != 0) {
        throw Unavailable(fmt::format("no display: {}", SDL_GetError()));
    }
    window_ = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, width, height,
                               SDL_WINDOW_RESIZABLE);
    if (window_ == nullptr) throw Unavailable(fmt::format("no window: {}", SDL_GetError()));
    SDL_SetWindowMinimumSize(window_, least_side, least_side);
    renderer_ = SDL_CreateRenderer(window_, -1, SDL_RENDERER_ACCELERATED | SDL_RENDERER_PRESENTVSYNC);
    waits_ = renderer_ != nullptr;
    if (renderer_ != nullptr && emulated(renderer_)) {
        SDL_DestroyRenderer(renderer_);
        renderer_ = nullptr;
    }
    if (renderer_ == nullptr) {
        waits_ = false;
        renderer_ = SDL_CreateRenderer(window_, -1, SDL_RENDERER_SOFTWARE);
    }
    if (renderer_ == nullptr) throw Unavailable(fmt::format("nothing draws in the window: {}", SDL_GetError()));
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    ImGui::StyleColorsDark();
    ImGui::GetStyle().AntiAliasedFill = false;
    ImGui::GetStyle().AntiAliasedLines = false;
    ImGui::GetStyle().WindowRounding = 0;
    ink_.make(renderer_);
    ImGui_ImplSDL2_InitForSDLRenderer(window_
#if __has_include(<backends/imgui_impl_sdl2.h>)
                                      ,
                                      renderer_
#endif
    );
}

Window::~Window()
{
    ink_.clear();
    ImGui_ImplSDL2_Shutdown();
    ImGui::DestroyContext();
    SDL_DestroyRenderer(renderer_);
    SDL_DestroyWindow(window_);
    SDL_Quit();
}

std::pair<int, int> Window::size() const
{
    int width = 0;
    int height = 0;
    SDL_GetRendererOutputSize(renderer_, &width, &height);
    return {width, height};
}

double Window::rate() const
{
    SDL_DisplayMode mode{};
    const int display = SDL_GetWindowDisplayIndex(window_);
    if (display < 0 || SDL_GetCurrentDisplayMode(display, &mode) != 0 || mode.refresh_rate <= 0) return usual_rate;
    return mode.refresh_rate;
}

void Window::take(const SDL_Event& event) { ImGui_ImplSDL2_ProcessEvent(&event); }

void Window::begin()
{
    SDL_SetRenderDrawColor(renderer_, 0, 0, 0, 255);
    SDL_RenderClear(renderer_);
    ImGui_ImplSDL2_NewFrame();
    ImGui::NewFrame();
}

void Window::draw_panels()
{
    ImGui::Render();
    ink_.draw(renderer_, *ImGui::GetDrawData());
}

void Window::present() const { SDL_RenderPresent(renderer_); }

void Window::shoot(const std::string& file) const
{
    const auto [width, height] = size();
    std::vector<std::uint32_t> pixels(Image::pixels(width, height));
    if (SDL_RenderReadPixels(renderer_, nullptr, SDL_PIXELFORMAT_ARGB8888, pixels.data(), 4 * width) != 0) {
        throw Error(fmt::format("{}: the window cannot be read: {}", file, SDL_GetError()));
    }
    Image image(width, height, Image::Layers::bytes);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t at = 3 * (static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) +
                                        static_cast<std::size_t>(x));
            const std::uint32_t pixel =
                pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
            for (std::size_t c = 0; c < 3; ++c)
                image.bytes()[at + c] = static_cast<std::uint8_t>(pixel >> (16 - 8 * c));
        }
    }
    write_image(file, ImageFormat::png, image);
}

}  // namespace mandelmarch::explore
