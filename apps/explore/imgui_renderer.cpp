// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/imgui_renderer.h"

#include <fmt/format.h>

#include <cstddef>

#include "core/base/error.h"

namespace mandelmarch::explore {

void Ink::make(SDL_Renderer* renderer)
{
    ImGuiIO& io = ImGui::GetIO();
    io.BackendRendererName = "explore";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    letters_ = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_ABGR8888, SDL_TEXTUREACCESS_STATIC, width, height);
    if (letters_ == nullptr) throw Error(fmt::format("no memory for letters: {}", SDL_GetError()));
    SDL_UpdateTexture(letters_, nullptr, pixels, 4 * width);
    SDL_SetTextureBlendMode(letters_, SDL_BLENDMODE_BLEND);
    io.Fonts->SetTexID(letters_);
}

void Ink::clear()
{
    if (letters_ != nullptr) SDL_DestroyTexture(letters_);
    letters_ = nullptr;
}

void Ink::draw(SDL_Renderer* renderer, const ImDrawData& data)
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

}  // namespace mandelmarch::explore
