// SPDX-License-Identifier: Apache-2.0
// Places files: tables of places that a flight visits, written by hand, by bin/explore or by tools/blender_path.py.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

struct Place {
    Vector eye, target;            // the camera's position, and a point in the middle of the picture
    std::optional<double> second;  // time at which the camera arrives; nullopt: the planner chooses it
    double stay = 0;               // seconds during which the camera remains close to the place and looks at the target
    double lens = 1;               // field of view during the stay, as in a parameter file
    double roll = 0;               // degrees by which the camera is rolled during the stay, see Tilt; 0: level
    bool tour = false;             // true: the flight tours on its way to this place
    int line = 0;                  // number of the line in the file, from 1
};

struct Places {
    std::string file;  // the name in messages
    std::vector<Place> all;
    bool tour_after = false;  // true: a tour follows the last place
};

inline constexpr std::string_view places_header =
    "location_x,location_y,location_z,look_at_x,look_at_y,look_at_z,second,stay,field_of_view,roll";
inline constexpr double usual_stay = 2;  // seconds; of a place whose field "stay" is empty
inline constexpr double most_stay = 4;   // seconds; the audit limits the time for which a camera stands still

// Throws InputError with the first three messages, in one line, unless there are none.
void refuse_faults(std::vector<std::string> faults);

// Returns a line of a places file, without the end of the line. Its field "second" is empty.
std::string place_line(const Place& place);

// Parses a places file. `name`: the file's name, with which messages begin. Throws InputError with a message of one
// line, which names the line and the column of each fault.
Places places_from_text(const std::string& text, const std::string& name);
Places read_places(const std::string& file);

}  // namespace mandelmarch
