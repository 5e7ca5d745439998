// SPDX-License-Identifier: Apache-2.0
// The table of actions. Keys, buttons of the panels and lines of scripts perform them, and the help lists them.
#pragma once

#include <span>
#include <string_view>

#include "apps/explore/model/model.h"

namespace mandelmarch::explore {

struct Action {
    // The condition under which the key performs the action. anywhere: always. over_pictures: only while no panel has
    // the keyboard, because in a panel the key types a character or controls an item. repeated: like over_pictures, and
    // repeatedly while the key is held.
    enum class Heeded { anywhere, over_pictures, repeated };

    std::string_view name;  // in scripts; buttons show blanks in place of hyphens
    std::string_view key;   // SDL's name of the key, such as "Ctrl+S"; empty: no key
    const char* help;
    void (*act)(Model& model);
    Heeded heeded = Heeded::anywhere;

    // Performs the action. Errors are shown as messages.
    void perform(Model& model) const;
};

std::span<const Action> actions();

// Returns the action of this name, or nullptr.
const Action* action_named(std::string_view name);

}  // namespace mandelmarch::explore
