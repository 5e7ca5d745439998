// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <limits>

#include "apps/explore/view/panels.h"
#include "core/image/image.h"

namespace mandelmarch::explore {
namespace {

// Shows a field for an integer, with buttons that change it.
void number_field(const char* name, int& value, int low, int high)
{
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    ImGui::InputInt(name, &value);
    value = std::clamp(value, low, high);
}

}  // namespace

void show_paths(Model& model, Desktop& desktop, float left)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float wanted = 26 * ImGui::GetFontSize();
    left = std::max({0.0F, left, size.x - wanted});
    const float width = size.x - left;
    // This panel covers the other one if there is not enough room next to it.
    const bool beside = width > 12 * ImGui::GetFontSize();
    ImGui::SetNextWindowPos({beside ? left : 0, 0.0F});
    const float used = beside ? width : size.x;
    ImGui::SetNextWindowSize({used, 0});  // as high as its items
    ImGui::SetNextWindowSizeConstraints({used, 0}, {used, size.y * 0.7F});
    ImGui::Begin("paths", &model.paths,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    PathEditor& path_editor = model.path_editor;
    show_buttons(model, desktop, {{"record", path_editor.recording() ? "end recording" : "record"}});
    ImGui::SameLine();
    ImGui::Text("%zu frames, %.1f s", path_editor.frames(),
                static_cast<double>(path_editor.frames()) / path_editor.path().frames_per_second);
    if (path_editor.has_path() && !path_editor.recording()) {
        float at = static_cast<float>(path_editor.at());
        ImGui::SetNextItemWidth(-1);
        if (ImGui::SliderFloat("##at", &at, 0, static_cast<float>(path_editor.frames() - 1), "frame %.0f")) {
            path_editor.go_to(static_cast<double>(at));
            model.show_path();
        }
        show_buttons(model, desktop, {{"play-or-stop", path_editor.playing ? "stop" : "play"}, {"smooth"}});
        number_field("width", model.film_width, 16, max_side);
        ImGui::SameLine();
        number_field("height", model.film_height, 16, max_side);
        show_buttons(model, desktop, {{"save-path"}, {"film"}});
    }
    number_field("seed", model.tour_seed, 0, std::numeric_limits<int>::max());
    ImGui::SameLine();
    number_field("frames", model.tour_frames, 60, 100'000);
    if (!path_editor.planning()) show_buttons(model, desktop, {{"plan-a-tour"}});
    ImGui::End();
}

}  // namespace mandelmarch::explore
