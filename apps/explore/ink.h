// SPDX-License-Identifier: Apache-2.0
// Draws Dear ImGui's triangles through SDL, whichever version of it is installed.
#pragma once

#include <SDL.h>
#include <imgui.h>

namespace mandelmarch::explore {

class Ink {
public:
    // The letters. Throws Error where there is no memory for them.
    void make(SDL_Renderer* renderer);
    void clear();
    static void draw(SDL_Renderer* renderer, const ImDrawData& data);

private:
    SDL_Texture* letters_ = nullptr;
};

}  // namespace mandelmarch::explore
