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
// changes: such a result could not be reproduced.
void refuse_kept_result(const std::string& path, const std::string& results, bool sources_changed);

// Files and standard output ("-") that are checked before a command's work and written after it. A failure to write one
// of them does not affect the others.
class Outputs {
public:
    // Adds an output; an empty path adds nothing. `option`: name of the option, for messages. `text` returns the
    // contents; it is called when the output is written.
    void add(std::string option, std::string path, std::function<std::string()> text);

    // Declares an option that names an output, with `text` as in add().
    void option(CLI::App& app, const std::string& name, const std::string& about, std::function<std::string()> text);

    // Checks the outputs, calls work() and writes them. The text that work() returns, the table for the user, goes to
    // stderr if an output is standard output. If a file cannot be written, prints a line on stderr. Returns the exit
    // code: success, if work() and all writing succeeded. Throws InputError if an output cannot be written or is one of
    // the `read` files, or if two outputs are the same; Error if standard output cannot be written.
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
