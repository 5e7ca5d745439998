// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/options.h"

#include <array>

#include "core/os/input_file.h"
#include "core/text/console.h"
#include "core/text/number.h"

namespace mandelmarch {
namespace {

struct NamedSize {
    std::string_view name;
    int width, height;  // pixels
};
constexpr std::array named_sizes{NamedSize{"720p", 1280, 720}, NamedSize{"1080p", 1920, 1080},
                                 NamedSize{"4k", 3840, 2160}, NamedSize{"8k", 7680, 4320}};

[[noreturn]] void refuse(const std::string& name, const std::string& text, const std::string& expected)
{
    throw InputError(fmt::format("--{}: '{}' given, expected {}", name, text, expected));
}

// Throws InputError if a word is empty, as that of a shell variable without a value is.
void refuse_empty_words(const std::string& program, int argc, char** argv)
{
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const std::string before = argv[i - 1];
        if (word.starts_with("--") && word.ends_with('=')) {
            throw InputError(fmt::format("{}: '{}' given, expected a value behind =", program, word));
        }
        if (!word.empty()) continue;
        throw InputError(fmt::format("{}: {}: '' given, expected a value", program,
                                     before.starts_with('-') ? before : fmt::format("argument {}", i)));
    }
}

}  // namespace

CLI::Validator whole(std::int64_t low, std::int64_t high)
{
    return {[=](const std::string& text) {
                const auto value = parse_whole(text);
                if (value && *value >= low && *value <= high) return std::string();
                return fmt::format("'{}' given, expected a whole number from {} to {}", text, low, high);
            },
            ""};
}

CLI::Validator real(double low, double high)
{
    return {[=](const std::string& text) {
                const auto value = parse_real(text);
                if (value && *value >= low && *value <= high) return std::string();
                return fmt::format("'{}' given, expected a number from {} to {}", text, low, high);
            },
            ""};
}

int whole_option(const std::string& name, const std::string& text, int low, int high)
{
    const auto value = parse_whole(text);
    if (!value || *value < low || *value > high) {
        refuse(name, text, fmt::format("a whole number from {} to {}", low, high));
    }
    return static_cast<int>(*value);
}

std::pair<int, int> pair_option(const std::string& name, const std::string& text, char between, int low, int high,
                                const std::string& expected)
{
    const auto at = text.find(between);
    const auto first = parse_whole(text.substr(0, at));
    const auto second = parse_whole(at == std::string::npos ? "" : text.substr(at + 1));
    if (!first || !second || std::min(*first, *second) < low || std::max(*first, *second) > high) {
        refuse(name, text, expected);
    }
    return {static_cast<int>(*first), static_cast<int>(*second)};
}

std::string input_name(const std::string& name) { return name == "-" ? "/dev/stdin" : name; }

std::string output_name(const std::string& name) { return name == "-" ? "/dev/stdout" : name; }

std::pair<int, int> size_option(const std::string& text, int most_side, int panoramas)
{
    for (const NamedSize& known : named_sizes) {
        if (text != known.name) continue;
        if (panoramas > 0) return {panoramas * known.width, known.width / 2};
        return {known.width, known.height};
    }
    return pair_option("size", text, 'x', 1, most_side,
                       fmt::format("WIDTHxHEIGHT with sides from 1 to {}, 720p, 1080p, 4k or 8k", most_side));
}

Region region_option(const std::string& text, int width, int height)
{
    std::array<std::int64_t, 4> numbers{};
    std::size_t count = 0;
    for (std::size_t at = 0; at <= text.size() && count < numbers.size(); ++count) {
        const std::size_t end = std::min(text.find_first_of(count < 2 ? "," : ",x", at), text.size());
        numbers.at(count) = parse_whole(text.substr(at, end - at)).value_or(-1);
        at = end + 1;
        if (count == 3 && end != text.size()) numbers[0] = -1;
    }
    const auto [x, y, w, h] = numbers;
    const bool inside = count == 4 && x >= 0 && y >= 0 && w > 0 && h > 0 && x < width && y < height && w <= width - x &&
                        h <= height - y;
    if (!inside) {
        refuse("region", text,
               fmt::format("X,Y,WIDTH,HEIGHT of a part of {} x {} pixels, from the bottom left", width, height));
    }
    return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(w), static_cast<int>(h)};
}

std::optional<int> parse_arguments(CLI::App& app, const std::string& program, int argc, char** argv)
{
    app.name(program);  // for the line "Usage" of the help text
    refuse_empty_words(program, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answer) {  // --help, --version
        return app.exit(answer);
    } catch (const CLI::ParseError& error) {
        const auto commands = app.get_subcommands();
        const std::string command = commands.empty() ? program : program + " " + commands.front()->get_name();
        std::string what = error.what();
        // An unknown option is named rather than the words behind it, which CLI11 does not take for its value.
        if (const std::vector<std::string> unknown = app.remaining(true); !unknown.empty()) {
            const auto option = std::ranges::find_if(unknown, [](auto& word) { return word.starts_with('-'); });
            what = "not expected: " + (option != unknown.end() ? *option : unknown.front());
        }
        throw InputError(fmt::format("{}: {} ({} --help lists the options)", command, what, command));
    }
    return std::nullopt;
}

void refuse_others(const CLI::App& app, const std::string& mode, const std::vector<std::string>& taken)
{
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || name == "--no-isolation" || std::ranges::find(taken, name) != taken.end()) continue;
        throw InputError(fmt::format("{}: not expected with {}", name, mode));
    }
}

void add_backend_option(CLI::App& app, std::string& name, const Registry& registry)
{
    std::vector<std::string> names = registry.names();
    names.insert(names.begin(), "auto");
    app.add_option("--backend", name, "rendering backend; auto: one for GPUs if a GPU is present, else openmp")
        ->check(CLI::IsMember(names))
        ->capture_default_str();
    add_isolation_option(app);
}

void add_isolation_option(CLI::App& app)
{
    app.add_flag("--no-isolation")
        ->description("run device drivers in this process instead of their own, for profilers and debuggers");
}

std::string unheeded(const Backend& backend, const RendererOptions& options)
{
    const BackendInfo info = backend.info();
    if (options.threads > 0 && !info.threads) return "--threads";
    if (options.simd_width > 0 && !info.simd_width) return "--simd-width";
    return {};
}

void refuse_unheeded(const Registry& registry, const Backend& backend, const RendererOptions& options)
{
    const std::string option = unheeded(backend, options);
    if (option.empty()) return;
    std::vector<std::string_view> heeding;
    for (const auto& other : registry.backends()) {
        if (unheeded(*other, option == "--threads" ? RendererOptions{.threads = 1} : RendererOptions{.simd_width = 1})
                .empty())
            heeding.push_back(other->name());
    }
    throw InputError(fmt::format("{}: not supported by backend {}, expected one of {}", option, backend.name(),
                                 fmt::join(heeding, ", ")));
}

void add_look_option(CLI::App& app, std::optional<ChosenLook>& look, std::string& file, const std::string& usual)
{
    const auto set = [&](const std::string& text) {
        if (parse_whole(text)) {
            look = {.colouring = whole_option("look", text, 0, colouring_types - 1)};
            return;
        }
        for (int type = 2; type < colouring_types; ++type) {
            if (text != colouring_names.at(static_cast<std::size_t>(type))) continue;
            look = {.colouring = type};
            return;
        }
        file = text;
        look = {.colouring = 2, .values = parse_look(text_of_file(text, "look file"), text)};
    };
    app.add_option_function<std::string>("--look", set, "look: number, name or file (default: " + usual + ")");
}

const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells,
                              const RendererOptions& options)
{
    if (name != "auto") return *registry.find(name);
    AutomaticChoice choice = registry.automatic();
    if (const std::string option = unheeded(*choice.backend, options); !option.empty()) {
        choice = {&registry.with(Role::host), fmt::format("{} is given", option)};
    }
    if (tells) say("drawing with {} ({})\n", choice.backend->name(), choice.reason);
    return *choice.backend;
}

}  // namespace mandelmarch
