// SPDX-License-Identifier: Apache-2.0
// One of the two bench processes of `bench duel`.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/duel.h"
#include "bench/line_socket.h"
#include "core/base/child_process.h"

namespace mandelmarch::bench {

class DuelProcess {
public:
    // A configuration as the process reports it.
    struct Ready {
        std::string fingerprint;  // of its picture
        std::string failure;      // why it has no speed; empty if it has one
        bool in_process = true;   // false: work runs outside this process
    };

    // Time of a picture by the duel's clock, or why there is none.
    struct Drawn {
        std::optional<double> seconds;
        std::string failure;
    };

    // Starts `program` with the arguments and `--on-demand`. Throws Error if it cannot be started.
    DuelProcess(const std::string& program, const std::vector<std::string>& arguments, DuelClock clock);
    // Ends the process.
    ~DuelProcess();

    // Waits until the configurations are ready. Throws Error if the process ends first or sends an invalid message.
    void wait();

    const std::map<std::string, Ready>& rows() const { return rows_; }
    const nlohmann::ordered_json& environment() const { return environment_; }

    // Has the process draw one picture. Throws Error if the process ends.
    Drawn draw(const std::string& row);

private:
    nlohmann::ordered_json receive();
    std::string how_it_ended();  // waits up to two seconds for the end

    DuelClock clock_;
    std::optional<ChildProcess> process_;
    std::optional<LineSocket> socket_;
    std::map<std::string, Ready> rows_;
    nlohmann::ordered_json environment_;
};

}  // namespace mandelmarch::bench
