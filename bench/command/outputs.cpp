// SPDX-License-Identifier: Apache-2.0
#include "bench/command/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/os/files.h"
#include "core/os/output_file.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"
#include "core/text/version.h"

namespace mandelmarch::bench {

void refuse_kept_result(const std::string& path, const std::string& results, bool sources_changed)
{
    namespace fs = std::filesystem;
    if (!sources_changed) return;
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(results, error);
    const fs::path file = fs::weakly_canonical(end_of_links(path), error);
    if (error || std::ranges::mismatch(folder, file).in1 != folder.end()) return;
    throw InputError(path + ": bench was built of sources that no commit has, expected a file outside results/");
}

void Outputs::check(const std::vector<std::string>& read) const
{
    std::vector<NamedFile> written;
    std::string standard;  // the option whose output goes to standard output
    for (const auto& [option, path] : paths_) {
        if (path.empty()) continue;
        if (path == "-" && !standard.empty()) {
            throw InputError(fmt::format("{} and {}: both go to standard output, expected a file for one of them",
                                         standard, option));
        }
        if (path == "-") {
            standard = option;
            continue;
        }
        OutputFile::check(path);
        refuse_kept_result(path, MANDELMARCH_RESULTS, sources_changed());
        written.push_back({option, path});
    }
    std::vector<NamedFile> named;
    named.reserve(read.size());
    for (const std::string& path : read) named.push_back({"the result", path});
    refuse_shared_files(written, named);
}

void Outputs::declare(CLI::App& app, const std::string& option, const std::string& what)
{
    app.add_option(option, paths_[option], fmt::format("write {} to this file (-: standard output)", what));
}

int Outputs::deliver(const std::vector<std::string>& read, const std::function<Texts()>& work) const
{
    check(read);
    const Texts texts = work();
    bool written = true;
    const std::string* standard = nullptr;
    for (const auto& [option, path] : paths_) {
        const std::string& text = texts.files.at(option);
        if (path == "-") standard = &text;
        if (path.empty() || path == "-") continue;
        try {
            write_file(path, text);
        } catch (const std::exception& error) {
            say("bench: {}: {}\n", option, printable(error.what()));
            written = false;
        }
    }
    if (standard != nullptr) say(std::string_view(texts.table));
    print(std::string_view(standard != nullptr ? *standard : texts.table));
    return written && texts.passed ? exit_success : exit_failure;
}

}  // namespace mandelmarch::bench
