// SPDX-License-Identifier: Apache-2.0
// Frame times of scripted flights, for --stats.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "apps/explore/panes.h"

namespace mandelmarch::explore {

// What one frame of the window was.
struct FrameNote {
    double seconds;   // from its events to its presentation
    double interval;  // since the last frame's presentation
    double drawing;   // of the picture that came in it; 0: none came
    double showing;   // uploading, scaling, panels, presentation
    double share;     // of the window's pixels that its picture has
};

class Measure {
public:
    void begin(const std::string& name);
    void end();
    bool on() const { return on_; }

    // A view was made by an event of frame `frame`.
    void asked(std::uint64_t view, std::uint64_t frame);
    // A picture of the view was presented at the end of frame `frame`.
    void shown(std::uint64_t view, std::uint64_t frame);
    void note(const FrameNote& frame);

    // The statistics as JSON; `window`: its size, `how` it is shown.
    std::string json(std::pair<int, int> window, const std::string& how, double rate, const Pane& pane) const;

    // The last ten seconds' frames, for the graph: seconds each.
    const std::deque<float>& last() const { return last_; }

private:
    struct Section {
        std::string name;
        std::vector<FrameNote> frames;
        std::vector<double> latencies;  // frames
    };

    bool on_ = false;
    std::vector<Section> sections_;
    std::deque<std::pair<std::uint64_t, std::uint64_t>> asked_;
    std::deque<float> last_;
    double last_seconds_ = 0;
};

}  // namespace mandelmarch::explore
