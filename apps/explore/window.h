// SPDX-License-Identifier: Apache-2.0
// The window: SDL's, with Dear ImGui over the pictures.
#pragma once

#include <SDL.h>
#include <imgui.h>

#include <string>

#include "apps/explore/ink.h"
#include "apps/explore/painter.h"

namespace mandelmarch::explore {

// A picture in the window.
class Sheet {
public:
    Sheet() = default;
    ~Sheet() { clear(); }
    Sheet(const Sheet&) = delete;
    Sheet& operator=(const Sheet&) = delete;

    void take(SDL_Renderer* renderer, const Pixels& pixels);
    void show(SDL_Renderer* renderer, const SDL_Rect& where) const;
    void clear();
    bool empty() const { return texture_ == nullptr; }

private:
    SDL_Texture* texture_ = nullptr;
    int width_ = 0, height_ = 0;
};

class Window {
public:
    // Throws Unavailable where there is no display.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    SDL_Renderer* renderer() const { return renderer_; }
    SDL_Window* handle() const { return window_; }
    std::pair<int, int> size() const;      // pixels
    double rate() const;                   // pictures a second that the screen shows
    bool waits() const { return waits_; }  // present() waits for the screen
    std::string how() const;               // "x11, software", say

    static void take(const SDL_Event& event);  // for the panels
    void begin();                              // a frame: clears the window, and ImGui begins
    void draw_panels();                        // what ImGui has
    void present() const;
    // What draw_panels() has completed, as a PNG file. Throws Error.
    void shoot(const std::string& file) const;

private:
    SDL_Window* window_ = nullptr;
    SDL_Renderer* renderer_ = nullptr;
    bool waits_ = false;
    Ink ink_;
};

}  // namespace mandelmarch::explore
