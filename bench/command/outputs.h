// SPDX-License-Identifier: Apache-2.0
// Output files of a command.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mandelmarch::bench {

// Throws InputError if `path` lies in `results`, the project's folder of kept results, and the sources have uncommitted
// changes. A result of such sources could not be reproduced.
void refuse_kept_result(const std::string& path, const std::string& results, bool sources_changed);

// Files and standard output ("-") that are checked before a command's work and written after it. A failure to write one
// of them does not affect the others.
class Outputs {
public:
    // Declares an option that names an output. `text` returns the contents; it is called when the output is written.
    void option(CLI::App& app, const std::string& name, const std::string& about, std::function<std::string()> text);

    // Checks the outputs, calls work(), and writes the outputs and work()'s table. The table goes to standard output
    // or, if an output goes there, to stderr. Throws InputError before work() if an output is one of the `read` files,
    // if two outputs are the same, or if the check finds that an output cannot be written. If writing a file fails
    // later, prints a line on stderr. Throws Error if standard output cannot be written. Returns the exit code; it is
    // success if work() passed and all outputs were written.
    struct Done {
        std::string table;
        bool passed = true;
    };
    int deliver(const std::vector<std::string>& read, const std::function<Done()>& work);

private:
    struct Output {
        std::string option;
        std::shared_ptr<std::string> path;  // empty if its option is not given
        std::function<std::string()> text;
        bool is_stdout() const { return *path == "-"; }
    };
    void check(const std::vector<std::string>& read) const;
    bool write_files() const;

    std::vector<Output> outputs_;
};

}  // namespace mandelmarch::bench
