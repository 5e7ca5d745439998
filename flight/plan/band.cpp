// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/band.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr double spacing = 0.35;      // between points, in clearances
constexpr double freedom = 0.45;      // how far a point may leave its place in a round, in safe clearances
constexpr double pin_freedom = 0.08;  // the same for a pin
constexpr double push = 0.15;         // of a point away from the walls, in clearances, each round
constexpr int rounds = 7;
constexpr std::array<int, 5> strides{16, 8, 4, 2, 1};
constexpr int sweeps = 12;  // at each stride

struct Band {
    std::vector<Vector> at;
    std::vector<char> pinned;
    std::vector<double> clearance;
};

// New points along the old line, dense where it is narrow; pins stay points.
Band resampled(const Field& field, const Band& old)
{
    const double most = 1.5 * fastest_clearance(field.hull());
    Band band;
    const auto add = [&](Vector p, bool pin, double clearance) {
        band.at.push_back(p);
        band.pinned.push_back(pin ? 1 : 0);
        band.clearance.push_back(clearance);
    };
    add(old.at[0], old.pinned[0] != 0, old.clearance[0]);
    double left = spacing * std::min(old.clearance[0], most);
    for (std::size_t i = 1; i < old.at.size(); ++i) {
        const Vector from = old.at[i - 1];
        const double whole = length(old.at[i] - from);
        double done = 0;
        while (whole - done > left) {
            done += left;
            const double share = done / whole;
            // The clearance between two points is at least about that of the nearer one less the way to it.
            const double guess = (1 - share) * old.clearance[i - 1] + share * old.clearance[i];
            const Vector p = from + share * (old.at[i] - from);
            add(p, false, guess);
            left = spacing * std::min(guess, most);
        }
        left -= whole - done;
        if (old.pinned[i] != 0) {
            add(old.at[i], true, old.clearance[i]);
            left = spacing * std::min(old.clearance[i], most);
        }
    }
    add(old.at.back(), false, old.clearance.back());
    field.distances(band.at, band.clearance);
    return band;
}

// Away from the walls, across the band.
void push_off(const Field& field, Band& band)
{
    const std::vector<Vector> old = band.at;
    parallel(old.size(), 64, field.threads(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = std::max<std::size_t>(first, 1); i < std::min(last, old.size() - 1); ++i) {
            if (band.pinned[i] != 0 || band.clearance[i] > fastest_clearance(field.hull())) continue;
            const Vector tangent = unit(old[i + 1] - old[i - 1]);
            Vector up = field.uphill(old[i], 0.3 * band.clearance[i]);
            up = up - dot(up, tangent) * tangent;
            const Vector to = old[i] + push * band.clearance[i] * up;
            const double there = field.distance(to);
            if (there <= band.clearance[i]) continue;
            band.at[i] = to;
            band.clearance[i] = there;
        }
    });
}

void relax(const Field& field, Band& band)
{
    const std::vector<Vector> home = band.at;
    const auto count = static_cast<int>(home.size());
    std::vector<double> radius(home.size());
    for (std::size_t i = 0; i < home.size(); ++i) {
        const double most = 2 * fastest_clearance(field.hull());
        radius[i] = (band.pinned[i] != 0 ? pin_freedom : freedom) * field.safety() * std::min(band.clearance[i], most);
    }
    for (const int stride : strides) {
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            for (int k = 1; k < count - 1; ++k) {
                // Forwards and backwards in turn.
                const int i = sweep % 2 == 0 ? k : count - 1 - k;
                const int step = std::min({stride, i, count - 1 - i});
                const auto middle = band.at.begin() + i;
                const auto point = [&](int offset) { return middle[offset]; };
                // Straight between its neighbours; or, where there are four, on the cubic through them, which keeps
                // bends round.
                Vector aim = 0.5 * (point(-step) + point(step));
                if (i - 2 * step >= 0 && i + 2 * step < count) {
                    const Vector bent =
                        (4.0 / 6) * (point(-step) + point(step)) - (1.0 / 6) * (point(-2 * step) + point(2 * step));
                    aim = 0.4 * aim + 0.6 * bent;
                }
                const auto n = static_cast<std::size_t>(i);
                Vector to = band.at[n] + 0.8 * (aim - band.at[n]);
                const Vector away = to - home[n];
                const double far = length(away);
                if (far > radius[n]) to = home[n] + (radius[n] / far) * away;
                band.at[n] = to;
            }
        }
    }
}

// Points that came too near a surface go back to where they were.
void take_back(const Field& field, Band& band, const std::vector<Vector>& home, double least)
{
    for (int attempt = 0; attempt < 4; ++attempt) {
        field.distances(band.at, band.clearance);
        for (std::size_t i = 0; i < home.size(); ++i) {
            if (band.clearance[i] < least) band.at[i] = attempt < 3 ? 0.5 * (band.at[i] + home[i]) : home[i];
        }
    }
    field.distances(band.at, band.clearance);
}

}  // namespace

std::vector<Vector> smooth(const Field& field, const Way& way, double least)
{
    Band band{way.points, way.pinned, std::vector<double>(way.points.size())};
    field.distances(band.at, band.clearance);
    band = resampled(field, band);
    for (int round = 0; round < rounds; ++round) {
        push_off(field, band);
        const std::vector<Vector> home = band.at;
        relax(field, band);
        take_back(field, band, home, least);
        band = resampled(field, band);
    }
    return band.at;
}

}  // namespace mandelmarch
