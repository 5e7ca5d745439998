// SPDX-License-Identifier: Apache-2.0
#include "bench/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kernel_folder = "core/kernel/";
constexpr std::string_view job_folder = "core/job/";

int count(const Coverage& coverage, std::string_view folder)
{
    int lines = 0;
    for (const auto& [file, used] : coverage) lines += file.starts_with(folder) ? static_cast<int>(used.size()) : 0;
    return lines;
}

// Returns the number of lines that are in both sets.
std::size_t shared_lines(const Coverage& one, const Coverage& other)
{
    std::size_t shared = 0;
    for (const auto& [file, used] : one) shared += other.contains(file) ? used.size() : 0;
    return shared;
}

std::size_t all_lines(const Coverage& coverage)
{
    std::size_t lines = 0;
    for (const auto& [file, used] : coverage) lines += used.size();
    return lines;
}

class Tree {
public:
    explicit Tree(const std::string& folder) : root_(folder)
    {
        if (!fs::is_regular_file(root_ / "core/kernel/text.h") || !fs::is_directory(root_ / "backends")) {
            throw InputError(fmt::format("{}: expected the folder of the program's sources", folder));
        }
    }

    // Returns the names of the backends, as listed in backends/CMakeLists.txt.
    std::vector<std::string> backends() const
    {
        const std::string list = text("backends/CMakeLists.txt");
        std::smatch found;
        if (!std::regex_search(list, found, std::regex(R"(set\(backends\s([^)]*)\))"))) {
            throw InputError(fmt::format("{}: expected a list of backends", (root_ / "backends").string()));
        }
        std::vector<std::string> names;
        const std::string words = found[1];
        const std::regex word(R"(\w+)");
        for (std::sregex_iterator at(words.begin(), words.end(), word), end; at != end; ++at)
            names.push_back(at->str());
        return names;
    }

    // Returns the lines of the files that the backend's sources name, directly or indirectly.
    Coverage coverage(const std::string& backend) const
    {
        const std::string own = "backends/" + backend + "/";
        Coverage found;
        for (const auto& entry : fs::directory_iterator(root_ / own))
            visit(own + entry.path().filename().string(), own, found);
        if (count(found, job_folder) == 0) return found;
        // A backend that uses core/job needs all of it, except templates that are replaced by its own.
        for (const auto& entry : fs::directory_iterator(root_ / job_folder)) {
            const std::string name = entry.path().filename().string();
            const bool replaced = name.ends_with(".in") && fs::exists(root_ / own / name);
            if (!replaced) visit(std::string(job_folder) + name, own, found);
        }
        return found;
    }

private:
    std::string text(const std::string& file) const
    {
        std::ifstream in(root_ / file, std::ios::binary);
        std::string all{std::istreambuf_iterator<char>(in), {}};
        if (!in) throw InputError(fmt::format("{}: cannot be read", (root_ / file).string()));
        return all;
    }

    void visit(const std::string& file, const std::string& own, Coverage& found) const
    {
        const bool inside = file.starts_with(own) || file.starts_with(kernel_folder) || file.starts_with(job_folder);
        if (!inside || found.contains(file) || !fs::is_regular_file(root_ / file)) return;
        const std::string source = text(file);
        // CMakeLists.txt is read for the names of sources, but its own lines do not count.
        if (!file.ends_with("CMakeLists.txt")) found[file] = lines_of_code(source);
        static const std::regex path(R"([A-Za-z0-9_./-]+\.(?:h|cpp|cl|comp|cu|in)\b)");
        for (std::sregex_iterator at(source.begin(), source.end(), path), end; at != end; ++at) {
            visit(at->str(), own, found);
            visit((fs::path(file).parent_path() / at->str()).lexically_normal().string(), own, found);
        }
        if (source.find("MM_FRACTAL_FILE") == std::string::npos) return;
        for (const auto& entry : fs::directory_iterator(root_ / "core/kernel/fractals")) {
            visit("core/kernel/fractals/" + entry.path().filename().string(), own, found);
        }
    }

    fs::path root_;
};

}  // namespace

std::vector<int> lines_of_code(std::string_view text)
{
    std::vector<int> lines;
    int line = 1;
    bool comment = false;
    char quote = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const std::string_view two = text.substr(i, 2);
        if (c == '\n') {
            ++line;
            quote = 0;
        } else if (comment) {
            if (two == "*/") {
                comment = false;
                ++i;
            }
        } else if (quote == 0 && two == "/*") {
            comment = true;
            ++i;
        } else if (quote == 0 && two == "//") {
            i = std::min(text.find('\n', i), text.size()) - 1;
        } else if (c != ' ' && c != '\t' && c != '\r') {
            if (lines.empty() || lines.back() != line) lines.push_back(line);
            if (quote != 0 && c == '\\') {
                ++i;
            } else if (c == quote) {
                quote = 0;
            } else if (quote == 0 && c == '"') {
                quote = c;
            }
        }
    }
    return lines;
}

double distance(const Coverage& one, const Coverage& other)
{
    const std::size_t shared = shared_lines(one, other);
    const std::size_t together = all_lines(one) + all_lines(other) - shared;
    return together == 0 ? 0 : 1 - static_cast<double>(shared) / static_cast<double>(together);
}

double mean_distance(const std::vector<Coverage>& all)
{
    double sum = 0;
    int pairs = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k, ++pairs) sum += distance(all[i], all[k]);
    }
    return pairs == 0 ? 0 : sum / pairs;
}

Divergence divergence_of(const std::string& folder)
{
    const Tree tree(folder);
    Divergence found;
    std::vector<Coverage> together;
    std::vector<Coverage> apart;
    for (const std::string& backend : tree.backends()) {
        ModelLines model{.backend = backend, .coverage = tree.coverage(backend)};
        if (!model.coverage.contains("core/kernel/text.h")) continue;
        model.own = count(model.coverage, "backends/");
        model.job = count(model.coverage, job_folder);
        model.kernel = count(model.coverage, kernel_folder);
        together.push_back(model.coverage);
        Coverage copied;
        for (const auto& [file, used] : model.coverage) {
            copied[file.starts_with(kernel_folder) ? fmt::format("{}:{}", backend, file) : file] = used;
        }
        apart.push_back(std::move(copied));
        found.models.push_back(std::move(model));
    }
    found.divergence = mean_distance(together);
    found.without_one_text = mean_distance(apart);
    return found;
}

}  // namespace mandelmarch::bench
