// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "apps/explore/explorer.h"
#include "apps/explore/panels.h"

namespace mandelmarch::explore {
namespace {

const ImVec4 broken{1, 0.45F, 0.35F, 1};
const ImVec4 missed{1, 0.8F, 0.4F, 1};

void rows(Explorer& explorer)
{
    const PathEditor& path_editor = explorer.path_editor;
    for (const Row& row : path_editor.rows()) {
        const std::string text = fmt::format("{} {}: {:.3g}{} {} {:.3g} {}{}", row.promise ? "!" : " ", row.name,
                                             row.value, row.unit.empty() ? std::string() : fmt::format(" {}", row.unit),
                                             row.at_most ? "<=" : ">=", row.bar,
                                             row.kept()    ? "kept"
                                             : row.promise ? "BROKEN"
                                                           : "missed",
                                             row.worst.empty() ? std::string() : fmt::format(", {}", row.worst));
        const ImVec4 colour = row.kept() ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : row.promise ? broken : missed;
        ImGui::PushStyleColor(ImGuiCol_Text, colour);
        ImGui::TextWrapped("%s", text.c_str());
        ImGui::PopStyleColor();
    }
    if (path_editor.stale() && path_editor.frames() > 1) ImGui::TextDisabled("auditing");
}

void go_to(Explorer& explorer, double frame)
{
    explorer.path_editor.go_to(frame);
    explorer.show_path();
}

void play(Explorer& explorer)
{
    PathEditor& path_editor = explorer.path_editor;
    float at = static_cast<float>(path_editor.at());
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##at", &at, 0, static_cast<float>(path_editor.frames() - 1), "frame %.0f"))
        go_to(explorer, static_cast<double>(at));
    if (ImGui::Button(path_editor.playing ? "stop" : "play")) path_editor.playing = !path_editor.playing;
    ImGui::SameLine();
    if (ImGui::Button("next broken")) explorer.go_to_broken();
    ImGui::SameLine();
    if (ImGui::Button("audit all")) path_editor.audit_all();
    ImGui::SameLine();
    if (ImGui::Button("smooth")) explorer.guarded([&] { path_editor.smooth(); });
    if (ImGui::Button("cut before")) path_editor.cut_before();
    ImGui::SameLine();
    if (ImGui::Button("cut after")) path_editor.cut_after();
    ImGui::SameLine();
    if (ImGui::Button("camera here")) explorer.guarded([&] { path_editor.put_camera(explorer.scene); });
    if (ImGui::Button("save path")) explorer.save_path();
    ImGui::SameLine();
    if (ImGui::Button("film")) explorer.film_path();
}

}  // namespace

void show_paths(Explorer& explorer)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float wanted = 26 * ImGui::GetFontSize();
    const float left = std::max(0.0F, std::max(panel_width(explorer), size.x - wanted));
    const float width = size.x - left;
    // This panel covers the other one if there is not enough room next to it.
    const bool beside = width > 12 * ImGui::GetFontSize();
    ImGui::SetNextWindowPos({beside ? left : 0, 0.0F});
    ImGui::SetNextWindowSize({beside ? width : size.x, size.y * 0.7F});
    ImGui::Begin("paths", &explorer.paths,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    PathEditor& path_editor = explorer.path_editor;
    if (ImGui::Button(path_editor.recording() ? "end recording" : "record")) explorer.toggle_recording();
    ImGui::SameLine();
    ImGui::Text("%zu frames, %.1f s", path_editor.frames(),
                static_cast<double>(path_editor.frames()) / path_editor.path().frames_per_second);
    if (path_editor.has_path() && !path_editor.recording()) play(explorer);
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    ImGui::InputInt("seed", &explorer.tour_seed);
    explorer.tour_seed = std::max(explorer.tour_seed, 0);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    ImGui::InputInt("frames", &explorer.tour_frames);
    explorer.tour_frames = std::clamp(explorer.tour_frames, 60, 100'000);
    if (!path_editor.planning() && ImGui::Button("plan a tour")) {
        path_editor.plan(explorer.scene, static_cast<std::uint64_t>(explorer.tour_seed), explorer.tour_frames);
    }
    rows(explorer);
    ImGui::End();
}

}  // namespace mandelmarch::explore
