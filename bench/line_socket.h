// SPDX-License-Identifier: Apache-2.0
// Lines of text over a socket between two processes.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace mandelmarch::bench {

// Owns the descriptor.
class LineSocket {
public:
    explicit LineSocket(int descriptor) : descriptor_(descriptor) {}
    ~LineSocket();
    LineSocket(const LineSocket&) = delete;
    LineSocket& operator=(const LineSocket&) = delete;

    // Sends a line, without its end. Throws Error where the other side is gone.
    void send(const std::string& line);

    // Waits for a line. False where the other side has closed, or where `gone`, asked every now and then, says that
    // nothing will come. Throws Error for a line of more than 16 MiB.
    bool receive(
        std::string& line, const std::function<bool()>& gone = [] { return false; });

private:
    int descriptor_;
    std::string left_;  // received, of lines to come
};

// JSON in one line. Bytes that are no UTF-8 are replaced.
std::string text_of_line(const nlohmann::ordered_json& json);

}  // namespace mandelmarch::bench
