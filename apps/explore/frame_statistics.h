// SPDX-License-Identifier: Apache-2.0
// Frame statistics: the times of the window's frames, measured in sections of a script for --stats.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "apps/explore/panes.h"

namespace mandelmarch::explore {

// Timing of one frame of the window. Times are in seconds.
struct FrameTiming {
    double seconds;   // from the beginning of the frame to the end of its presentation
    double interval;  // from the end of the last frame's presentation to the end of this one's
    double drawing;   // render time of a new picture; 0: the frame shows no new picture
    double showing;   // uploading, scaling, panels, presentation
    double share;     // number of the picture's pixels divided by that of the pane
};

class FrameStatistics {
public:
    void begin(const std::string& name);
    void end();
    bool on() const { return on_; }

    // Records that a new view was requested in frame `frame`. `view`: its version, which grows with every change.
    void asked(std::uint64_t view, std::uint64_t frame);
    // Records that a picture of this view was presented at the end of frame `frame`.
    void shown(std::uint64_t view, std::uint64_t frame);
    void note(const FrameTiming& frame);

    // Returns the statistics as JSON. `window`: the window's size in pixels; `how`: Window::how(); `rate`: the screen's
    // rate in Hz.
    std::string json(std::pair<int, int> window, const std::string& how, double rate, const Pane& pane) const;

    // Returns the intervals between the frames of the last ten seconds, in seconds.
    const std::deque<float>& last() const { return last_; }

private:
    struct Section {
        std::string name;
        std::vector<FrameTiming> frames;
        std::vector<double> latencies;  // frames from the request of a view to its presentation
    };

    bool on_ = false;
    std::vector<Section> sections_;
    std::deque<std::pair<std::uint64_t, std::uint64_t>> asked_;
    std::deque<float> last_;
    double last_seconds_ = 0;
};

}  // namespace mandelmarch::explore
