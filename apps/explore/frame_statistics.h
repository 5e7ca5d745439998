// SPDX-License-Identifier: Apache-2.0
// Frame statistics of scripted flights, for --stats.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "apps/explore/panes.h"

namespace mandelmarch::explore {

// Timing of one frame of the window; times in seconds.
struct FrameTiming {
    double seconds;   // from its events to its presentation
    double interval;  // since the last frame's presentation
    double drawing;   // render time of its new picture; 0: no new picture
    double showing;   // uploading, scaling, panels, presentation
    double share;     // pixels of its picture, as a fraction of the window's
};

class FrameStatistics {
public:
    void begin(const std::string& name);
    void end();
    bool on() const { return on_; }

    // Records that an event in frame `frame` created a view.
    void asked(std::uint64_t view, std::uint64_t frame);
    // Records that a picture of the view was presented at the end of frame `frame`.
    void shown(std::uint64_t view, std::uint64_t frame);
    void note(const FrameTiming& frame);

    // Returns the statistics as JSON. `window`: its size; `how`: Window::how().
    std::string json(std::pair<int, int> window, const std::string& how, double rate, const Pane& pane) const;

    // The intervals of the last ten seconds' frames, seconds.
    const std::deque<float>& last() const { return last_; }

private:
    struct Section {
        std::string name;
        std::vector<FrameTiming> frames;
        std::vector<double> latencies;  // frames
    };

    bool on_ = false;
    std::vector<Section> sections_;
    std::deque<std::pair<std::uint64_t, std::uint64_t>> asked_;
    std::deque<float> last_;
    double last_seconds_ = 0;
};

}  // namespace mandelmarch::explore
