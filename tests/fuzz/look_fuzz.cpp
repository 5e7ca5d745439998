// SPDX-License-Identifier: Apache-2.0
// Fuzzer: any bytes, read as a look file, give a look whose numbers are in their ranges, or an InputError of one line.
#include "core/scene/look.h"
#include "tests/fuzz/text.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    using namespace mandelmarch;
    return fuzz_text(data, size, "x:", [](std::string_view text) {
        const LookValues look = parse_look(text, "x");
        std::size_t at = 0;
        for (const LookEntry& entry : look_entries) {
            for (const LookRange& range : entry.ranges) {
                const double number = look.numbers.at(at++);
                const bool missing = number == 0 && entry.name != "exposure";
                if (!missing && !(number >= range.low && number <= range.high)) std::abort();
            }
        }
    });
}
