#include "bench/outputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/console.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/output_file.h"
#include "core/base/text.h"

namespace mandelmarch::bench {

void Outputs::add(std::string option, std::string path, std::function<std::string()> text)
{
    if (!path.empty()) outputs_.push_back({std::move(option), std::move(path), std::move(text)});
}

bool Outputs::on_stdout() const { return std::ranges::any_of(outputs_, &Output::is_stdout); }

void Outputs::check(const std::vector<std::string>& read) const
{
    std::vector<NamedFile> written;
    const Output* first = nullptr;
    for (const Output& output : outputs_) {
        if (!output.is_stdout()) {
            OutputFile::check(output.path);
            written.push_back({output.option, output.path});
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
            write_file(output.path, output.text());
        } catch (const std::exception& error) {
            say("bench: {}: {}\n", output.option, printable(error.what()));
            all = false;
        }
    }
    return all;
}

void Outputs::write_stdout() const
{
    for (const Output& output : outputs_) {
        if (output.is_stdout()) print(std::string_view(output.text()));
    }
}

}  // namespace mandelmarch::bench
