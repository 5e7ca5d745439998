// SPDX-License-Identifier: Apache-2.0
// The text that is drawn over the pictures, and the help.
#include <fmt/format.h>

#include <algorithm>

#include "apps/explore/commands.h"
#include "apps/explore/explorer.h"
#include "apps/explore/panels.h"
#include "apps/explore/sight.h"
#include "apps/survey.h"

namespace mandelmarch::explore {
namespace {

constexpr ImU32 letters = IM_COL32(255, 255, 255, 255);
constexpr ImU32 warning = IM_COL32(255, 190, 90, 255);
constexpr ImU32 ground = IM_COL32(0, 0, 0, 170);
constexpr ImU32 edge = IM_COL32(90, 160, 255, 255);
constexpr float margin = 4;  // pixels

// Draws text with lines of at most `width` pixels. Returns the y coordinate below it.
float line(const std::string& text, float x, float y, float width, ImU32 colour)
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float wrap = std::max(40.0F, width - 2 * margin);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    list.AddRectFilled({x, y}, {x + size.x + 2 * margin, y + size.y + 2 * margin}, ground);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x + margin, y + margin}, colour, text.c_str(), nullptr, wrap);
    return y + size.y + 2 * margin;
}

std::string of(const Pane& pane)
{
    if (pane.seconds == 0) return name_of(pane.setup) + (pane.failure.empty() ? ": drawing" : "");
    std::string text = fmt::format("{}: {:.1f} ms", name_of(pane.setup), 1e3 * pane.seconds);
    if (pane.samples == 0) {
        text += fmt::format(", {:.0f} % of the pixels", 100 * pane.share);
    } else {
        text += fmt::format(", {} sample{} per pixel", pane.samples * pane.samples, pane.samples > 1 ? "s" : "");
    }
    if (!pane.report.instruction_set.empty()) text += fmt::format(", {}", pane.report.instruction_set);
    if (pane.compared) {
        text +=
            fmt::format("; {} pixels differ, {} visibly", pane.compared->differing, pane.compared->visibly_differing);
    }
    return text;
}

std::string word_of(const Pane& pane, const Explorer& explorer)
{
    const bool at_rest = pane.whole.pixels() > 0 && pane.whole_view == pane.view;
    return word_on(explorer.scene, explorer.clearance(), pane.setup.precision, at_rest && has_one_colour(pane.whole));
}

}  // namespace

void show_statistics(Explorer& explorer)
{
    const auto& all = explorer.panes.all();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const SDL_Rect place = explorer.panes.place(i);
        const float right = static_cast<float>(place.x + place.w);
        const float x = static_cast<float>(place.x);
        float y = static_cast<float>(place.y);
        const float width = right - x;
        if (all.size() > 1 && i == explorer.panes.chosen_number()) {
            ImGui::GetBackgroundDrawList()->AddRect({static_cast<float>(place.x), y},
                                                    {right, static_cast<float>(place.y + place.h)}, edge);
        }
        if (explorer.settings.statistics) y = line(of(*all[i]), x, y, width, letters);
        if (!all[i]->failure.empty()) y = line(all[i]->failure, x, y, width, warning);
        if (const std::string word = word_of(*all[i], explorer); !word.empty()) line(word, x, y, width, warning);
    }
    const SDL_Rect area = area_beside_panels(explorer);
    const float x = static_cast<float>(area.x);
    const float width = static_cast<float>(area.w);
    float y = ImGui::GetIO().DisplaySize.y;
    const auto above = [&](const std::string& text, ImU32 colour) {
        if (text.empty()) return;
        const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, std::max(40.0F, width - 2 * margin));
        y -= size.y + 2 * margin;
        line(text, x, y, width, colour);
    };
    if (explorer.settings.statistics) {
        const float rate = ImGui::GetIO().Framerate;
        above(fmt::format("DE {:.3g} at the eye, {:.0f} frames per second, F1 help", explorer.clearance(),
                          static_cast<double>(rate)),
              letters);
    }
    above(explorer.said(), letters);
    above(explorer.panes.trouble(), warning);
    if (explorer.path_editor.recording())
        above(fmt::format("recording, {} frames", explorer.path_editor.frames()), warning);
    if (explorer.path_editor.planning()) above("planning a tour", letters);
    if (explorer.path_editor.filming()) above("filming", letters);
}

void show_help(Explorer& explorer)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(size);
    ImGui::Begin("help", &explorer.help,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextWrapped(
        "W S forward and back, A D sideways, R F up and down, Q E roll, arrow keys or drag to turn, wheel for the "
        "speed, which "
        "follows the distance to the surface. A game pad: left stick, triggers, right stick, shoulder buttons.");
    ImGui::Columns(2, nullptr, false);
    ImGui::SetColumnWidth(0, 9 * ImGui::GetFontSize());
    for (const Command& command : commands()) {
        ImGui::TextUnformatted(key_of(command).c_str());
        ImGui::NextColumn();
        ImGui::TextWrapped("%s", command.what);
        ImGui::NextColumn();
    }
    ImGui::Columns(1);
    ImGui::TextWrapped("%s", fmt::format("Files go to {}; settings are in {}.",
                                         explorer.folder.empty() ? "." : explorer.folder, settings_file())
                                 .c_str());
    ImGui::End();
}

void show_panels(Explorer& explorer)
{
    show_statistics(explorer);
    if (explorer.settings.panel) show_panel(explorer);
    if (explorer.paths) show_paths(explorer);
    if (explorer.help) show_help(explorer);
}

}  // namespace mandelmarch::explore
