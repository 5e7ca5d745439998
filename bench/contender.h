// SPDX-License-Identifier: Apache-2.0
// A program of `bench duel`, while it runs.
#pragma once

#include <sys/types.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/duel.h"
#include "bench/line_socket.h"

namespace mandelmarch::bench {

class Contender {
public:
    // A row as the program has it.
    struct Ready {
        std::string fingerprint;  // of its picture
        std::string failure;      // why it has no speed; empty if it has one
        bool in_process = true;   // its work is this process's
    };

    // What a picture took by the clock of the duel, or why there is none.
    struct Drawn {
        std::optional<double> seconds;
        std::string failure;
    };

    // Starts `program` with the arguments and `--on-demand`. Throws Error where it cannot be started.
    Contender(const std::string& program, const std::vector<std::string>& arguments, DuelClock clock);
    // Ends it.
    ~Contender();
    Contender(const Contender&) = delete;
    Contender& operator=(const Contender&) = delete;

    // Waits until its rows are ready. Throws Error where it ends before, or says what no bench of this version says.
    void wait();

    const std::map<std::string, Ready>& rows() const { return rows_; }
    const nlohmann::ordered_json& environment() const { return environment_; }

    // Throws Error where it ends.
    Drawn draw(const std::string& row);

private:
    nlohmann::ordered_json receive();
    bool ended();
    std::string how_it_ended();  // waits a little until it has

    DuelClock clock_;
    pid_t process_ = 0;
    std::optional<int> status_;  // as waitpid() gives it, once it has ended
    std::optional<LineSocket> socket_;
    std::map<std::string, Ready> rows_;
    nlohmann::ordered_json environment_;
};

}  // namespace mandelmarch::bench
