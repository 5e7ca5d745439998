// SPDX-License-Identifier: Apache-2.0
// What stands over the pictures.
#pragma once

namespace mandelmarch::explore {

class Explorer;

// All that are to be seen. Between Window::begin() and Window::draw_panels().
void show_panels(Explorer& explorer);

// The single ones.
void show_panel(Explorer& explorer);       // view, fractal, who draws, what is handed out
void show_paths(Explorer& explorer);       // the path, its audit, tours
void show_statistics(Explorer& explorer);  // a line in each picture
void show_help(Explorer& explorer);

// Where the paths and the help stand beside the panel: its width, or 0.
float panel_width(const Explorer& explorer);

}  // namespace mandelmarch::explore
