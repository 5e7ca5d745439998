// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/view/script.h"

#include <SDL.h>
#include <fmt/format.h>

#include <sstream>
#include <vector>

#include "apps/cli/option_values.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/os/input_file.h"

namespace mandelmarch::explore {
namespace {

constexpr int longest = 1'000'000;  // frames that a key is held, at most

struct ScriptLine {
    std::string name;     // an action or a command
    SDL_Keycode key = 0;  // the key that `hold` holds
    int frames = 0;       // the frames for which it does
    int frame = 0;        // number of frames since the line began
};

void push_key(SDL_Keycode key, const Window& window, bool down)
{
    SDL_Event event{};
    event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.windowID = SDL_GetWindowID(window.handle());
    event.key.keysym.sym = key;
    SDL_PushEvent(&event);
}

// Performs a line, and is called in each frame until it returns true.
bool carry_out(const ScriptLine& line, Model& model, Window& window, Explorer& explorer)
{
    if (line.name == "hold") {
        const bool done = line.frame == line.frames;
        if (line.frame == 0 || done) push_key(line.key, window, !done);
        return done;
    }
    if (line.name == "rest") {
        return line.frame > 1 && explorer.at_rest() && !model.tasks_running();
    }
    if (line.name == "tell") {
        print("{}", explorer.state());
    } else {
        action_named(line.name)->perform(model, window);
    }
    return true;
}

ScriptLine parsed(const std::string& text)
{
    std::istringstream words(text);
    ScriptLine line;
    std::string key;
    std::string frames;
    words >> line.name >> key >> frames >> std::ws;
    if (line.name == "hold") {
        line.key = SDL_GetKeyFromName(key.c_str());
        if (line.key == SDLK_UNKNOWN) throw InputError(fmt::format("'{}' is not the name of a key", key));
        line.frames = whole_option("hold", frames, 1, longest);
    } else if (!key.empty() || (line.name != "rest" && line.name != "tell" && action_named(line.name) == nullptr)) {
        throw InputError(fmt::format("'{}', expected hold KEY FRAMES, rest, tell or the name of an action", text));
    }
    return line;
}

}  // namespace

Script read_script(const std::string& file)
{
    std::istringstream in(text_of_file(file, "script"));
    std::vector<ScriptLine> lines;
    for (std::string text; std::getline(in, text);) {
        try {
            lines.push_back(parsed(text));
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:{}: {}", file, lines.size() + 1, error.what()));
        }
    }
    return [lines, at = std::size_t{0}](Model& model, Window& window, Explorer& explorer) mutable {
        for (; at < lines.size(); ++at) {
            if (!carry_out(lines[at], model, window, explorer)) {
                ++lines[at].frame;
                return;
            }
        }
        model.quit = true;
    };
}

}  // namespace mandelmarch::explore
