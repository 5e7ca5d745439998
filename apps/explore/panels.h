// SPDX-License-Identifier: Apache-2.0
// What stands over the pictures.
#pragma once

#include <SDL.h>

namespace mandelmarch::explore {

class Explorer;

// All that are to be seen. Between Window::begin() and Window::draw_panels().
void show_panels(Explorer& explorer);

// The single ones.
void show_panel(Explorer& explorer);       // view, fractal, who draws, what is handed out
void show_paths(Explorer& explorer);       // the path, its audit, tours
void show_statistics(Explorer& explorer);  // a line in each picture
void show_help(Explorer& explorer);

// The panel's width, or 0 where it is hidden.
float panel_width(const Explorer& explorer);
// What is left of the window for pictures.
SDL_Rect area_beside_panels(const Explorer& explorer);

}  // namespace mandelmarch::explore
