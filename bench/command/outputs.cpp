// SPDX-License-Identifier: Apache-2.0
#include "bench/command/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/text/console.h"
#include "core/text/error.h"
#include "core/os/files.h"
#include "core/os/output_file.h"
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
    const Output* first = nullptr;
    for (const Output& output : outputs_) {
        if (!output.is_stdout()) {
            OutputFile::check(*output.path);
            refuse_kept_result(*output.path, MANDELMARCH_RESULTS, sources_changed());
            written.push_back({output.option, *output.path});
            continue;
        }
        if (first != nullptr) {
            throw InputError(fmt::format("{} and {}: both go to standard output, expected a file for one of them",
                                         first->option, output.option));
        }
        first = &output;
    }
    std::vector<NamedFile> named;
    named.reserve(read.size());
    for (const std::string& path : read) named.push_back({"the result", path});
    refuse_shared_files(written, named);
}

bool Outputs::write_files() const
{
    bool all = true;
    for (const Output& output : outputs_) {
        if (output.is_stdout()) continue;
        try {
            write_file(*output.path, output.text());
        } catch (const std::exception& error) {
            say("bench: {}: {}\n", output.option, printable(error.what()));
            all = false;
        }
    }
    return all;
}

void Outputs::option(CLI::App& app, const std::string& name, const std::string& about,
                     std::function<std::string()> text)
{
    outputs_.push_back({name, std::make_shared<std::string>(), std::move(text)});
    app.add_option(name, *outputs_.back().path, about);
}

int Outputs::deliver(const std::vector<std::string>& read, const std::function<Done()>& work)
{
    std::erase_if(outputs_, [](const Output& output) { return output.path->empty(); });
    check(read);
    const Done done = work();
    const bool written = write_files();
    const auto standard = std::ranges::find_if(outputs_, &Output::is_stdout);
    if (standard == outputs_.end()) {
        print(std::string_view(done.table));
    } else {
        say(std::string_view(done.table));
        print(std::string_view(standard->text()));
    }
    return written && done.passed ? exit_success : exit_failure;
}

}  // namespace mandelmarch::bench
