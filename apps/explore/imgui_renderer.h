// SPDX-License-Identifier: Apache-2.0
// Draws Dear ImGui's triangles with SDL. Works with every packaged version of Dear ImGui.
#pragma once

#include <SDL.h>
#include <imgui.h>

namespace mandelmarch::explore {

class Ink {
public:
    // Creates the texture of the letters. Throws Error if that fails.
    void make(SDL_Renderer* renderer);
    void clear();
    static void draw(SDL_Renderer* renderer, const ImDrawData& data);

private:
    SDL_Texture* letters_ = nullptr;
};

}  // namespace mandelmarch::explore
