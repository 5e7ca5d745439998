// SPDX-License-Identifier: Apache-2.0
// Fuzzer: any bytes, read as a result file, give a result, or an InputError of one line. The result is unchanged if it
// is written and read again. Compared with itself it is not a regression. Its efficiencies are from 0 to 1.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "bench/result/compare.h"
#include "bench/result/portability.h"
#include "bench/result/result_file.h"
#include "bench/print/printers.h"
#include "bench/measure/runs.h"
#include "core/text/error.h"

namespace {

using namespace mandelmarch;
using namespace mandelmarch::bench;

void demand(bool held)
{
    if (!held) std::abort();
}

bool share(double value) { return value >= 0 && value <= 1; }

// Collects all values of a JSON document, including nested ones.
void collect(nlohmann::ordered_json& json, std::vector<nlohmann::ordered_json*>& values)
{
    values.push_back(&json);
    if (!json.is_structured()) return;
    for (auto& value : json) collect(value, values);
}

// Returns the unusual values with which the mutator replaces others.
const nlohmann::ordered_json& odd_values()
{
    static const auto values = nlohmann::ordered_json::parse(
        R"([null, true, 0, 1, -1, 2, 7, 0.5, 1e-320, 1e9, 1e300, 99999999, [], [1], {}, "", "float",
    "fast", "openmp", "reference", "all", 9007199254740993, 18446744073709551615])");
    return values;
}

void use(const Result& result)
{
    const std::string text = text_of(json_of(result));
    demand(text_of(json_of(parse_result(text, "x"))) == text);
    demand(to_csv(result).find('\n') != std::string::npos);
    const Result twice = merged({result, result});
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        demand(twice.rows[i].samples.size() == 2 * result.rows[i].samples.size());
    }
    const std::vector<Portability> found = portability(std::vector{result, twice});
    for (const Portability& p : found) {
        demand(share(p.application_portability) && share(p.application_interval.low));
        for (const OnPlatform& on : p.platforms) demand(share(on.application) && std::isfinite(on.seconds));
    }
    demand(!to_csv(found).empty() && !to_console(found).empty() && !text_of(json_of(found)).empty());
    const ComparedResults compared = compare_results(result, result);
    for (const Compared& row : compared.rows) demand(share(row.p));
    demand(!regression(compared.rows) && !to_console(compared).empty());
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(unsigned char* data, std::size_t size, std::size_t most);

// Changes or copies one value of a complete result. libFuzzer calls this function instead of changing bytes, because
// changed bytes are rarely valid JSON.
extern "C" std::size_t LLVMFuzzerCustomMutator(unsigned char* data, std::size_t size, std::size_t most, unsigned seed)
{
    std::minstd_rand random(seed);
    auto json = nlohmann::ordered_json::parse(data, data + size, nullptr, false);
    if (random() % 4 == 0 || json.is_discarded()) return LLVMFuzzerMutate(data, size, most);
    std::vector<nlohmann::ordered_json*> values;
    collect(json, values);
    const auto any = [&]() -> nlohmann::ordered_json& { return *values[random() % values.size()]; };
    if (random() % 4 != 0) {
        any() = odd_values()[random() % odd_values().size()];
    } else if (auto& list = any(); list.is_array() && !list.empty()) {
        const auto first = list.front();
        list.push_back(first);
    } else {
        const auto other = any();
        list = other;
    }
    const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::copy(text.begin(), text.end(), data);
    return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    try {
        use(parse_result(std::string(reinterpret_cast<const char*>(data), size), "x"));
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        demand(message.starts_with("x: ") || message.starts_with("bench compare: "));
        demand(message.find('\n') == std::string_view::npos && message.size() < 1000);
    }
    return 0;
}
