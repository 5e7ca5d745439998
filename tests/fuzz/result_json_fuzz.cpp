// libFuzzer: any bytes as a result file give a result that is written as it was read, is no regression of itself and
// has efficiencies from 0 to 1, or an InputError in one line.
#include <cmath>
#include <cstdlib>
#include <string>

#include "bench/compare.h"
#include "bench/launches.h"
#include "bench/portability.h"
#include "bench/report.h"
#include "core/base/error.h"

namespace {

using namespace mandelmarch;
using namespace mandelmarch::bench;

void demand(bool held)
{
    if (!held) std::abort();
}

bool share(double value) { return value >= 0 && value <= 1; }

void use(const Result& result)
{
    const std::string text = text_of(to_json(result));
    demand(text_of(to_json(parse_result(text, "x"))) == text);
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
    demand(!to_csv(found).empty() && !to_console(found).empty() && !text_of(to_json(found)).empty());
    const ComparedResults compared = compare_results(result, result);
    for (const Compared& row : compared.rows) demand(share(row.p));
    demand(!compared.regression() && !to_console(compared).empty());
}

}  // namespace

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
