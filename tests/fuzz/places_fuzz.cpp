// SPDX-License-Identifier: Apache-2.0
// Fuzzer: any bytes, read as a places file, give places, or an InputError of one line. A place is unchanged if it is
// written and read again.
#include <cmath>

#include "flight/path/places.h"
#include "tests/fuzz/text.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    using namespace mandelmarch;
    return fuzz_text(data, size, "x:", [](std::string_view text) {
        for (const Place& place : places_from_text(std::string(text), "x").all) {
            if (!(place.stay >= 0 && place.stay <= most_stay) || (place.second && !std::isfinite(*place.second)))
                std::abort();
            const std::string line = place_line(place);
            const Places again = places_from_text(std::string(places_header) + "\n" + line + "\n", "y");
            if (again.all.size() != 1 || place_line(again.all[0]) != line) std::abort();
        }
    });
}
