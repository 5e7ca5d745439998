// SPDX-License-Identifier: Apache-2.0
// One of the two bench processes of `bench duel`.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/contest/duel.h"
#include "bench/contest/line_socket.h"
#include "core/base/child_process.h"

namespace mandelmarch::bench {

class DuelProcess {
public:
    // State of a configuration, as reported by the process before the rounds.
    struct Ready {
        std::string fingerprint;  // hash of its picture
        std::string failure;      // why it has no speed; empty if it has one
        bool in_process = true;   // false: a driver renders in another process
    };

    // Time of a picture by the duel's clock, or the reason why there is none.
    struct Drawn {
        std::optional<double> seconds;
        std::string failure;
    };

    // Starts `program` with the arguments and `--on-demand`. Throws Error if it cannot be started.
    DuelProcess(const std::string& program, const std::vector<std::string>& arguments, DuelClock clock);
    // Closes the socket, at which the process exits; kills it if it has not ended after two seconds.
    ~DuelProcess();

    // Waits until the configurations are ready. Throws Error if the process ends first or sends an invalid message.
    void wait();

    const std::map<std::string, Ready>& rows() const { return rows_; }
    const nlohmann::ordered_json& environment() const { return environment_; }

    // Makes the process render one picture of the configuration named `row`, and returns its time. Throws Error if the
    // process ends.
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
