// SPDX-License-Identifier: Apache-2.0
// The window, made with SDL. Dear ImGui draws the panels over the pictures.
#pragma once

#include <SDL.h>

#include <memory>
#include <string>
#include <utility>

#include "apps/explore/view/render_thread.h"

namespace mandelmarch::explore {

using Texture = std::unique_ptr<SDL_Texture, void (*)(SDL_Texture*)>;

// Copies a picture to a texture. Creates the texture if it does not exist or has another size.
void update(Texture& texture, SDL_Renderer* renderer, const Pixels& pixels);

class Window {
public:
    // Opens the window; its size is in pixels. Throws Unavailable if there is no display.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    SDL_Renderer* renderer() const { return renderer_; }
    SDL_Window* handle() const { return window_; }
    std::pair<int, int> size() const;      // pixels
    double rate() const;                   // refresh rate of the screen, Hz
    bool waits() const { return waits_; }  // present() waits for the screen

    static void take(const SDL_Event& event);  // passes an event to the panels
    void begin();                              // begins a frame: clears the window, and begins Dear ImGui's frame
    void draw_panels();                        // ends Dear ImGui's frame, and draws the panels
    void present() const;

    void toggle_full_screen();

private:
    SDL_Window* window_ = nullptr;
    SDL_Renderer* renderer_ = nullptr;
    bool waits_ = false;
    Texture letters_{nullptr, SDL_DestroyTexture};  // Dear ImGui's font
};

}  // namespace mandelmarch::explore
