// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/view/script.h"

#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>
#include <vector>

#include "cli/option_values.h"
#include "core/base/console.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/image/image.h"
#include "core/scene/fractal.h"

namespace mandelmarch::explore {
namespace {

constexpr int longest = 1'000'000;  // frames; largest duration of a command

struct ScriptLine {
    std::string place;               // "file:line"
    std::vector<std::string> words;  // the command and its arguments
    int frame = 0;                   // number of frames since the line began

    [[noreturn]] void fail(const std::string& why) const { throw InputError(fmt::format("{}: {}", place, why)); }

    // Returns argument number `word`. Throws InputError if it is not a whole number from `low` to `high`.
    int integer(std::size_t word, int low, int high) const
    {
        try {
            return whole_option(words[0], words.at(word), low, high);
        } catch (const InputError& error) {
            fail(error.what());
        }
    }
};

void push_key(const ScriptLine& line, const Window& window, bool down)
{
    std::string name = line.words[1];
    Uint16 modifiers = KMOD_NONE;
    if (name.starts_with("Ctrl+")) {
        modifiers = KMOD_LCTRL;
        name = name.substr(5);
    }
    const SDL_Keycode code = SDL_GetKeyFromName(name.c_str());
    if (code == SDLK_UNKNOWN) line.fail(fmt::format("'{}' is not the name of a key", line.words[1]));
    SDL_Event event{};
    event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.timestamp = SDL_GetTicks();
    event.key.windowID = SDL_GetWindowID(window.handle());
    event.key.state = down ? SDL_PRESSED : SDL_RELEASED;
    event.key.keysym = {SDL_GetScancodeFromKey(code), code, modifiers, 0};
    SDL_PushEvent(&event);
}

void push_mouse(const Window& window, Uint32 type, int dx, int dy)
{
    const auto [width, height] = window.size();
    SDL_Event event{};
    event.type = type;
    const Uint32 id = SDL_GetWindowID(window.handle());
    if (type == SDL_MOUSEMOTION) {
        event.motion.windowID = id;
        event.motion.x = width / 2;
        event.motion.y = height / 2;
        event.motion.xrel = dx;
        event.motion.yrel = dy;
    } else if (type == SDL_MOUSEWHEEL) {
        event.wheel.windowID = id;
        event.wheel.y = dy;
    } else {
        event.button.windowID = id;
        event.button.button = SDL_BUTTON_LEFT;
        event.button.state = type == SDL_MOUSEBUTTONDOWN ? SDL_PRESSED : SDL_RELEASED;
        event.button.x = width / 2;
        event.button.y = height / 2;
    }
    SDL_PushEvent(&event);
}

// The objects that a script's commands change.
struct Stage {
    Model& model;
    Window& window;
    Explorer& explorer;
};

void begin_play(const ScriptLine& line, const Stage& on)
{
    if (!on.model.path_editor.has_path()) line.fail("there is no path to play");
    on.model.path_editor.playing = true;
}

bool dragged(const ScriptLine& line, const Stage& on)
{
    const bool done = line.frame >= line.integer(3, 1, longest);
    push_mouse(on.window, done ? SDL_MOUSEBUTTONUP : SDL_MOUSEMOTION, line.integer(1, -1000, 1000),
               line.integer(2, -1000, 1000));
    return done;
}

bool key_released(const ScriptLine& line, const Stage& on)
{
    const bool done = line.frame >= (line.words.size() > 2 ? line.integer(2, 1, longest) : 1);
    if (done) push_key(line, on.window, false);
    return done;
}

template <int frames>
bool after(const ScriptLine& line, const Stage& /*on*/)
{
    return line.frame >= frames;
}

bool after_given(const ScriptLine& line, const Stage& /*on*/) { return line.frame >= line.integer(1, 1, longest); }

void nothing(const ScriptLine& /*line*/, const Stage& /*on*/) {}

// A command that is not an action. It has from `least` to `most` arguments. begin() is called once; done() is called in
// each frame until it returns true. The script's next line then begins in the same frame.
struct Command {
    std::string_view name;
    std::size_t least, most;
    void (*begin)(const ScriptLine& line, const Stage& on);
    bool (*done)(const ScriptLine& line, const Stage& on) = after<0>;
};

constexpr std::array commands{
    Command{"size", 2, 2,
            [](auto& line, auto& on) {
                SDL_SetWindowSize(on.window.handle(), line.integer(1, 1, max_side), line.integer(2, 1, max_side));
            },
            after<3>},  // leaves the window manager time to resize the window
    Command{"open", 1, 1, [](auto& line, auto& on) { on.model.open(line.words[1]); }},
    Command{"scene", 1, 1,
            [](auto& line, auto& on) { on.model.show(on.model.official(fractal_named(line.words[1]))); }},
    Command{"key", 1, 2, [](auto& line, auto& on) { push_key(line, on.window, true); }, key_released},
    Command{"press", 1, 1, [](auto& line, auto& on) { push_key(line, on.window, true); }},
    Command{"release", 1, 1, [](auto& line, auto& on) { push_key(line, on.window, false); }},
    Command{"drag", 3, 3, [](auto&, auto& on) { push_mouse(on.window, SDL_MOUSEBUTTONDOWN, 0, 0); }, dragged},
    Command{"wheel", 1, 1,
            [](auto& line, auto& on) { push_mouse(on.window, SDL_MOUSEWHEEL, 0, line.integer(1, -100, 100)); }},
    Command{"wait", 1, 1, nothing, after_given},
    Command{"rest", 0, 0, nothing, [](auto& line, auto& on) { return line.frame > 1 && on.explorer.at_rest(); }},
    Command{"tasks", 0, 0, nothing, [](auto& line, auto& on) { return line.frame > 1 && !on.model.tasks_running(); }},
    Command{"audited", 0, 0, nothing,
            [](auto& line, auto& on) { return line.frame > 1 && !on.model.path_editor.stale(); }},
    Command{"picture", 2, 2,
            [](auto& line, auto& on) {
                on.model.picture_width = line.integer(1, 1, max_side);
                on.model.picture_height = line.integer(2, 1, max_side);
            }},
    Command{"play", 1, 1, begin_play, after_given},
    Command{"shoot", 1, 1, [](auto& line, auto& on) { on.explorer.shoot(line.words[1]); }, after<1>},
    Command{"tell", 0, 0, [](auto&, auto& on) { print("{}", on.explorer.state()); }},
};

const Command* command_named(std::string_view name)
{
    const auto* found = std::ranges::find(commands, name, &Command::name);
    return found != commands.end() ? found : nullptr;
}

bool carry_out(const ScriptLine& line, const Stage& on)
{
    const Command* command = command_named(line.words[0]);
    if (command == nullptr) {
        action_named(line.words[0])->perform(on.model, on.window);
        return true;
    }
    if (line.frame == 0) command->begin(line, on);
    return command->done(line, on);
}

void check(const ScriptLine& line)
{
    const std::string& verb = line.words[0];
    const Command* command = command_named(verb);
    if (command == nullptr && action_named(verb) == nullptr) {
        std::string known;
        for (const Command& of : commands) known += fmt::format("{}, ", of.name);
        line.fail(fmt::format("'{}' is not a command, expected one of {}or the name of an action", verb, known));
    }
    const std::size_t least = command != nullptr ? command->least : 0;
    const std::size_t count = line.words.size() - 1;
    if (count < least || count > (command != nullptr ? command->most : 0)) {
        line.fail(fmt::format("{} words after {}, expected {}", count, verb, least));
    }
}

}  // namespace

Script read_script(const std::string& file)
{
    std::istringstream in(text_of_file(file, "script"));
    std::vector<ScriptLine> lines;
    int number = 0;
    for (std::string text; std::getline(in, text);) {
        std::istringstream words(text.substr(0, text.find('#')));
        const ScriptLine line{fmt::format("{}:{}", file, ++number), {std::istream_iterator<std::string>(words), {}}};
        if (line.words.empty()) continue;
        check(line);
        lines.push_back(line);
    }
    return [lines, at = std::size_t{0}](Model& model, Window& window, Explorer& explorer) mutable {
        for (; at < lines.size(); ++at) {
            if (!carry_out(lines[at], {model, window, explorer})) {
                ++lines[at].frame;
                return;
            }
        }
        model.quit = true;
    };
}

}  // namespace mandelmarch::explore
