// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/view/window.h"

// Versions of Dear ImGui after 1.86 (Debian 12) have another name for the header of its SDL part.
#if __has_include(<backends/imgui_impl_sdl2.h>)
#include <backends/imgui_impl_sdl2.h>
#else
#include <backends/imgui_impl_sdl.h>
#endif
#include <fmt/format.h>

#include <imgui.h>

#include <cstddef>
#include <string_view>

#include "core/text/environment.h"
#include "core/text/error.h"

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

// Returns a new texture with Dear ImGui's font. Throws Error if SDL cannot create it.
SDL_Texture* font_texture(SDL_Renderer* renderer)
{
    ImGuiIO& io = ImGui::GetIO();
    io.BackendRendererName = "explore";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    SDL_Texture* letters =
        SDL_CreateTexture(renderer, SDL_PIXELFORMAT_ABGR8888, SDL_TEXTUREACCESS_STATIC, width, height);
    if (letters == nullptr) throw Error(fmt::format("no memory for letters: {}", SDL_GetError()));
    SDL_UpdateTexture(letters, nullptr, pixels, 4 * width);
    SDL_SetTextureBlendMode(letters, SDL_BLENDMODE_BLEND);
    io.Fonts->SetTexID(letters);
    return letters;
}

// Draws Dear ImGui's triangles. Works with every version of Dear ImGui that Linux distributions package.
void draw_triangles(SDL_Renderer* renderer, const ImDrawData& data)
{
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback != nullptr) continue;
            const SDL_Rect clip{static_cast<int>(command.ClipRect.x), static_cast<int>(command.ClipRect.y),
                                static_cast<int>(command.ClipRect.z - command.ClipRect.x),
                                static_cast<int>(command.ClipRect.w - command.ClipRect.y)};
            if (clip.w <= 0 || clip.h <= 0) continue;
            SDL_RenderSetClipRect(renderer, &clip);
            const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
            const auto* bytes = reinterpret_cast<const std::byte*>(vertices);
            SDL_RenderGeometryRaw(renderer, static_cast<SDL_Texture*>(command.GetTexID()),
                                  reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, pos)), sizeof(ImDrawVert),
                                  reinterpret_cast<const SDL_Color*>(bytes + offsetof(ImDrawVert, col)),
                                  sizeof(ImDrawVert), reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, uv)),
                                  sizeof(ImDrawVert), list.VtxBuffer.Size - static_cast<int>(command.VtxOffset),
                                  list.IdxBuffer.Data + command.IdxOffset, static_cast<int>(command.ElemCount),
                                  sizeof(ImDrawIdx));
        }
    }
    SDL_RenderSetClipRect(renderer, nullptr);
}

}  // namespace

void update(Texture& texture, SDL_Renderer* renderer, const Pixels& pixels)
{
    int width = 0;
    int height = 0;
    if (texture != nullptr) SDL_QueryTexture(texture.get(), nullptr, nullptr, &width, &height);
    if (width != pixels.width || height != pixels.height) {
        texture.reset(
            SDL_CreateTexture(renderer, format_of(renderer), SDL_TEXTUREACCESS_STREAMING, pixels.width, pixels.height));
        if (texture == nullptr) throw Error(fmt::format("no memory for a picture in the window: {}", SDL_GetError()));
        SDL_SetTextureBlendMode(texture.get(), SDL_BLENDMODE_NONE);
        SDL_SetTextureScaleMode(texture.get(), SDL_ScaleModeLinear);
    }
    SDL_UpdateTexture(texture.get(), nullptr, pixels.of.data(), 4 * pixels.width);
}

Window::Window(const std::string& title, int width, int height)
{
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    // Without a display, SDL would choose a video driver that shows nothing, and the program would run invisibly.
    if (environment_variable("DISPLAY").empty() && environment_variable("WAYLAND_DISPLAY").empty() &&
        environment_variable("SDL_VIDEODRIVER").empty()) {
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
    letters_.reset(font_texture(renderer_));
    ImGui_ImplSDL2_InitForSDLRenderer(window_
#if __has_include(<backends/imgui_impl_sdl2.h>)
                                      ,
                                      renderer_
#endif
    );
}

Window::~Window()
{
    letters_.reset();
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
    draw_triangles(renderer_, *ImGui::GetDrawData());
}

void Window::present() const { SDL_RenderPresent(renderer_); }

void Window::toggle_full_screen()
{
    const bool is = (SDL_GetWindowFlags(window_) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
    SDL_SetWindowFullscreen(window_, is ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
}

}  // namespace mandelmarch::explore
