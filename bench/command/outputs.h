// SPDX-License-Identifier: Apache-2.0
// Output files of a command.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace mandelmarch::bench {

// Throws InputError if `path` lies in `results`, the project's folder of kept results, and the sources have uncommitted
// changes. A result of such sources could not be reproduced.
void refuse_kept_result(const std::string& path, const std::string& results, bool sources_changed);

// The results of a command: a table, and for each option that names an output the text to write there. `passed`: true
// if the command succeeded.
struct Texts {
    std::string table;
    bool passed = true;
    std::map<std::string, std::string> files{};
};

// Files and standard output ("-") that are checked before a command's work and written after it. A failure to write one
// of them does not affect the others.
class Outputs {
public:
    // Declares an option that names an output. `what` is written, for the help text.
    void declare(CLI::App& app, const std::string& option, const std::string& what);

    // Checks the outputs, calls work(), and writes the outputs and the table. The table goes to standard output or, if
    // an output goes there, to stderr. Throws InputError before work() if an output is one of the `read` files, if two
    // outputs are the same, or if the check finds that an output cannot be written. If writing a file fails later,
    // prints a line on stderr. Throws Error if standard output cannot be written. Returns the exit code; it is success
    // if work() passed and all outputs were written.
    int deliver(const std::vector<std::string>& read, const std::function<Texts()>& work) const;

private:
    void check(const std::vector<std::string>& read) const;

    std::map<std::string, std::string> paths_;  // by options; empty if the option is not given
};

}  // namespace mandelmarch::bench
