// SPDX-License-Identifier: Apache-2.0
// A build tool for SPIR-V modules:
//   decorate IN OUT      decorates every floating-point operation with NoContraction, which forbids fused multiply-add
//                        and algebraic optimisation. (GLSL's `precise` would not reach operations in called functions.)
//   check IN...          returns exit code 1 if an operation lacks the decoration
//   embed OUT.cpp IN...  writes the modules as a C++ table. In the table, a module's name is the stem of its file name.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Words = std::vector<std::uint32_t>;

// Numbers from the SPIR-V specification, version 1.6: sections 2.3, 3.20 and 3.49.
constexpr std::uint32_t magic = 0x07230203;
constexpr std::size_t header_words = 5;
constexpr std::uint32_t no_contraction = 42;
constexpr std::uint32_t op_decorate = 71;

// Returns true for FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod and the products of vectors and matrices.
bool is_arithmetic(std::uint32_t opcode)
{
    static const std::set<std::uint32_t> opcodes{127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
    return opcodes.contains(opcode);
}

// Returns true for the instructions that precede a module's types. Decorations must precede the first instruction of
// any other kind.
bool is_preamble(std::uint32_t opcode)
{
    static const std::set<std::uint32_t> opcodes{2,  3,  4,  5,  6,  7,  10,  11,  14,  15,   16,
                                                 17, 71, 72, 73, 74, 75, 330, 331, 332, 5632, 5633};
    return opcodes.contains(opcode);
}

Words read_module(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    Words words(bytes.size() / 4);
    for (std::size_t at = 0; at < 4 * words.size(); ++at) {
        words[at / 4] |= std::uint32_t{static_cast<unsigned char>(bytes[at])} << (8 * (at % 4));
    }
    if (words.size() < header_words || words[0] != magic) throw std::runtime_error(path + ": no SPIR-V module");
    return words;
}

// Result of survey(): the operations of a module that may be contracted, and where to insert decorations.
struct Survey {
    std::size_t annotations_end = 0;      // index of the word before which decorations can be inserted
    std::set<std::uint32_t> undecorated;  // result identifiers of arithmetic operations without NoContraction
    std::size_t operations = 0;           // number of arithmetic operations
};

Survey survey(const Words& words)
{
    Survey found;
    std::set<std::uint32_t> decorated;
    for (std::size_t at = header_words; at < words.size();) {
        const std::uint32_t opcode = words[at] & 0xffff;
        const std::size_t length = words[at] >> 16;
        if (length == 0 || at + length > words.size()) throw std::runtime_error("a broken SPIR-V module");
        if (found.annotations_end == 0 && !is_preamble(opcode)) found.annotations_end = at;
        if (opcode == op_decorate && words[at + 2] == no_contraction) decorated.insert(words[at + 1]);
        if (is_arithmetic(opcode)) {
            ++found.operations;
            if (!decorated.contains(words[at + 2])) found.undecorated.insert(words[at + 2]);
        }
        at += length;
    }
    return found;
}

void decorate(const std::string& from, const std::string& to)
{
    Words words = read_module(from);
    const Survey found = survey(words);
    Words added;
    for (const std::uint32_t result : found.undecorated) {
        added.insert(added.end(), {(std::uint32_t{3} << 16) | op_decorate, result, no_contraction});
    }
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(found.annotations_end), added.begin(), added.end());
    std::ofstream file(to, std::ios::binary);
    for (const std::uint32_t word : words) {
        for (int shift = 0; shift < 32; shift += 8) file.put(static_cast<char>(word >> shift & 0xff));
    }
    if (!file.flush()) throw std::runtime_error(to + ": cannot be written");
}

bool check(const std::string& path)
{
    const Survey found = survey(read_module(path));
    std::printf("%s: %zu of %zu floating-point operations may be contracted\n", path.c_str(), found.undecorated.size(),
                found.operations);
    return found.undecorated.empty() && found.operations > 0;
}

void embed(const std::string& to, const std::vector<std::string>& modules)
{
    std::ofstream file(to);
    file << "#include \"backends/vulkan/program.h\"\n\nnamespace mandelmarch::vulkan {\nnamespace {\n";
    std::string rows;
    for (const std::string& path : modules) {
        const std::string name = std::filesystem::path(path).stem().string();
        file << "\nconstexpr std::uint32_t " << name << "[] = {";
        int column = 0;
        for (const std::uint32_t word : read_module(path))
            file << (column++ % 16 == 0 ? "\n    " : " ") << word << "u,";
        file << "};\n";
        rows.append("    if (name == \"").append(name).append("\") return ").append(name).append(";\n");
    }
    file << "\n}  // namespace\n\nModule module_named(std::string_view name)\n{\n"
         << rows << "    return {};\n}\n\n}  // namespace mandelmarch::vulkan\n";
    if (!file.flush()) throw std::runtime_error(to + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        const std::vector<std::string> arguments(argv + 1, argv + argc);
        const std::string task = arguments.empty() ? "" : arguments[0];
        if (task == "decorate" && arguments.size() == 3) {
            decorate(arguments[1], arguments[2]);
        } else if (task == "embed" && arguments.size() > 2) {
            embed(arguments[1], {arguments.begin() + 2, arguments.end()});
        } else if (task == "check" && arguments.size() > 1) {
            bool fine = true;
            for (std::size_t i = 1; i < arguments.size(); ++i) fine = check(arguments[i]) && fine;
            return fine ? 0 : 1;
        } else {
            throw std::runtime_error("expected decorate IN OUT, check IN... or embed OUT.cpp IN...");
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "spirv_tool: %s\n", error.what());
        return 2;
    }
    return 0;
}
