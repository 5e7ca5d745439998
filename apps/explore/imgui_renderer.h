// SPDX-License-Identifier: Apache-2.0
// Draws Dear ImGui's triangles with SDL. Works with every version of Dear ImGui that Linux distributions package.
#pragma once

#include <SDL.h>
#include <imgui.h>

namespace mandelmarch::explore {

class Ink {
public:
    // Creates the texture with the font's letters. Throws Error if that fails.
    void make(SDL_Renderer* renderer);
    void clear();
    static void draw(SDL_Renderer* renderer, const ImDrawData& data);

private:
    SDL_Texture* letters_ = nullptr;
};

}  // namespace mandelmarch::explore
