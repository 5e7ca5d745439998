// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/script.h"

#include <SDL.h>
#include <fmt/format.h>

#include <fstream>
#include <map>
#include <sstream>

#include "apps/explore/explorer.h"
#include "cli/option_values.h"
#include "core/base/console.h"
#include "core/base/error.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/image/image.h"

namespace mandelmarch::explore {
namespace {

constexpr int longest = 1'000'000;  // frames; largest duration of a command

// The commands. For each: the smallest and the largest number of words after it.
const std::map<std::string, std::pair<std::size_t, std::size_t>> verbs{
    {"size", {2, 2}},    {"open", {1, 1}},  {"scene", {1, 1}}, {"key", {1, 2}},  {"press", {1, 1}}, {"release", {1, 1}},
    {"drag", {3, 3}},    {"wheel", {1, 1}}, {"wait", {1, 1}},  {"rest", {0, 0}}, {"tasks", {0, 0}}, {"audited", {0, 0}},
    {"picture", {2, 2}}, {"play", {1, 1}},  {"shoot", {1, 1}}, {"tell", {0, 0}}, {"quit", {0, 0}},
};

struct Key {
    SDL_Keycode code;
    Uint16 modifiers;
};

Key key_named(std::string name)
{
    Key key{SDLK_UNKNOWN, KMOD_NONE};
    if (name.starts_with("Ctrl+")) {
        key.modifiers = KMOD_LCTRL;
        name = name.substr(5);
    }
    key.code = SDL_GetKeyFromName(name.c_str());
    return key;
}

void push_key(const Explorer& explorer, const Key& key, bool down)
{
    SDL_Event event{};
    event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.timestamp = SDL_GetTicks();
    event.key.windowID = SDL_GetWindowID(explorer.window.handle());
    event.key.state = down ? SDL_PRESSED : SDL_RELEASED;
    event.key.keysym = {SDL_GetScancodeFromKey(key.code), key.code, key.modifiers, 0};
    SDL_PushEvent(&event);
}

void push_mouse(const Explorer& explorer, Uint32 type, double dx, double dy)
{
    const auto [width, height] = explorer.window.size();
    SDL_Event event{};
    event.type = type;
    const Uint32 id = SDL_GetWindowID(explorer.window.handle());
    if (type == SDL_MOUSEMOTION) {
        event.motion.windowID = id;
        event.motion.x = width / 2;
        event.motion.y = height / 2;
        event.motion.xrel = static_cast<Sint32>(dx);
        event.motion.yrel = static_cast<Sint32>(dy);
    } else if (type == SDL_MOUSEWHEEL) {
        event.wheel.windowID = id;
        event.wheel.y = static_cast<Sint32>(dy);
    } else {
        event.button.windowID = id;
        event.button.button = SDL_BUTTON_LEFT;
        event.button.state = type == SDL_MOUSEBUTTONDOWN ? SDL_PRESSED : SDL_RELEASED;
        event.button.x = width / 2;
        event.button.y = height / 2;
    }
    SDL_PushEvent(&event);
}

}  // namespace

Script::Script(const std::string& file) : file_(file)
{
    std::ifstream in(file);
    if (!in) throw InputError(fmt::format("{}:1: cannot be opened, expected a script", file));
    int number = 0;
    for (std::string text; std::getline(in, text);) {
        Line line{++number, {}, {}};
        std::istringstream words(text.substr(0, text.find('#')));
        if (!(words >> line.verb)) continue;
        for (std::string word; words >> word;) line.words.push_back(word);
        const auto verb = verbs.find(line.verb);
        if (verb == verbs.end()) {
            std::string known;
            for (const auto& [name, count] : verbs) known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
            fail(line, fmt::format("'{}' is not a command, expected one of {}", line.verb, known));
        }
        const auto [least, most] = verb->second;
        if (line.words.size() < least || line.words.size() > most) {
            fail(line, fmt::format("{} words after {}, expected {}", line.words.size(), line.verb, least));
        }
        lines_.push_back(std::move(line));
    }
}

void Script::fail(const Line& line, const std::string& why) const
{
    throw InputError(fmt::format("{}:{}: {}", file_, line.number, why));
}

int Script::whole(const Line& line, std::size_t word, int low, int high) const
{
    try {
        return whole_option(line.verb, line.words.at(word), low, high);
    } catch (const InputError& error) {
        fail(line, error.what());
    }
}

void Script::step(Explorer& explorer)
{
    while (at_ < lines_.size()) {
        if (!carry_out(explorer, lines_[at_])) {
            ++frames_;
            return;
        }
        ++at_;
        frames_ = 0;
    }
    explorer.quit = true;
}

bool Script::carry_out(Explorer& explorer, const Line& line)
{
    const std::string& verb = line.verb;
    const auto key = [&] {
        const Key named = key_named(line.words[0]);
        if (named.code == SDLK_UNKNOWN) fail(line, fmt::format("'{}' is not the name of a key", line.words[0]));
        return named;
    };
    if (verb == "size") {
        if (frames_ == 0) {
            SDL_SetWindowSize(explorer.window.handle(), whole(line, 0, 1, max_side), whole(line, 1, 1, max_side));
        }
        return frames_ >= 3;  // leaves the window manager time to resize the window
    }
    if (verb == "open") explorer.open(line.words[0]);
    if (verb == "scene") explorer.set_scene(official_scene(fractal_named(line.words[0])));
    if (verb == "press") push_key(explorer, key(), true);
    if (verb == "release") push_key(explorer, key(), false);
    if (verb == "key") {
        const int frames = line.words.size() > 1 ? whole(line, 1, 1, longest) : 1;
        if (frames_ == 0) push_key(explorer, key(), true);
        if (frames_ < frames) return false;
        push_key(explorer, key(), false);
    }
    if (verb == "drag") {
        const int frames = whole(line, 2, 1, longest);
        if (frames_ == 0) push_mouse(explorer, SDL_MOUSEBUTTONDOWN, 0, 0);
        if (frames_ < frames) {
            push_mouse(explorer, SDL_MOUSEMOTION, whole(line, 0, -1000, 1000), whole(line, 1, -1000, 1000));
            return false;
        }
        push_mouse(explorer, SDL_MOUSEBUTTONUP, 0, 0);
    }
    if (verb == "wheel") push_mouse(explorer, SDL_MOUSEWHEEL, 0, whole(line, 0, -100, 100));
    if (verb == "wait") return frames_ >= whole(line, 0, 1, longest);
    if (verb == "rest") return frames_ > 1 && explorer.at_rest();
    if (verb == "tasks") return frames_ > 1 && !explorer.tasks_running();
    if (verb == "audited") return frames_ > 1 && !explorer.path_editor.stale();
    if (verb == "picture") {
        explorer.picture_width = whole(line, 0, 1, max_side);
        explorer.picture_height = whole(line, 1, 1, max_side);
    }
    if (verb == "play") {
        if (frames_ == 0) {
            if (!explorer.path_editor.has_path()) fail(line, "there is no path to play");
            explorer.path_editor.playing = true;
        }
        return frames_ >= whole(line, 0, 1, longest);
    }
    if (verb == "shoot") {
        if (frames_ == 0) explorer.shoot(line.words[0]);
        return frames_ >= 1;
    }
    if (verb == "tell") print("{}", explorer.told());
    if (verb == "quit") explorer.quit = true;
    return true;
}

}  // namespace mandelmarch::explore
