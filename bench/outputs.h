// SPDX-License-Identifier: Apache-2.0
// Where the results of a command go.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace mandelmarch::bench {

// Throws InputError where `path` lies in the folder of the results that the project keeps and the program's sources
// have changes that no commit has: such a result could not be made again.
void refuse_kept_result(const std::string& path, const std::string& results, bool sources_changed);

// Files and standard output ("-"), checked before the work and written after it, each whatever becomes of the others.
class Outputs {
public:
    // `option` is what the user wrote; an empty path is no output. `text` is asked for when it is written.
    void add(std::string option, std::string path, std::function<std::string()> text);

    // Throws InputError where an output certainly cannot be written, is one of the files that are read, or two are one
    // file or both standard output.
    void check(const std::vector<std::string>& read = {}) const;

    bool on_stdout() const;

    // Writes the files. One that fails is a line on stderr, and makes it false.
    bool write_files() const;

    // Throws Error where standard output cannot be written.
    void write_stdout() const;

private:
    struct Output {
        std::string option, path;
        std::function<std::string()> text;
        bool is_stdout() const { return path == "-"; }
    };
    std::vector<Output> outputs_;
};

}  // namespace mandelmarch::bench
