// SPDX-License-Identifier: Apache-2.0
#include "flight/route/elastic_band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/text/text.h"
#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr double spacing = 0.35;      // clearances from one point to the next
constexpr double densest = 0.0005;    // fractal sizes; the spacing is computed with at least this clearance
constexpr double freedom = 0.45;      // largest move of a point in one round, in radii of its safe ball
constexpr double pin_freedom = 0.08;  // largest move of a pinned point, in the same unit
constexpr double push = 0.15;         // move of a point away from the walls in one round, in clearances
constexpr int rounds = 7;
constexpr std::array<int, 5> strides{16, 8, 4, 2, 1};  // points from a point to its neighbours in relax()
constexpr int sweeps = 12;                             // of relax(), for each stride
// For shapes that change in flight:
constexpr double parts_a_step = 10;  // number of stages for a change of the shape by one step (see smooth())
constexpr int most_parts = 60;
constexpr int pushes = 2;             // calls of push_off() in each stage
constexpr double clock_reach = 12.0;  // clearances; the shape time is averaged over this distance on either side

// The band's points. `value`: the shape parameter at each point.
struct Band {
    std::vector<Vector> at;
    std::vector<Pin> pinned;
    std::vector<double> clock;
    std::vector<double> value;
    std::vector<double> clearance;
};

// Returns the band with new points along it, which are denser in narrow places. Pinned points are kept.
Band resampled(const Shapes& shapes, const Band& old)
{
    const double most = 1.5 * fastest_clearance(shapes.field().bounds());
    // A changing shape may have moved the band into solid; `least` limits the number of points there.
    const double least = densest * shapes.field().bounds().size;
    const auto apart = [&](double clearance) { return spacing * std::clamp(clearance, least, most); };
    Band band;
    const auto add = [&](Vector p, Pin pin, double clearance, double clock, double value) {
        band.at.push_back(p);
        band.pinned.push_back(pin);
        band.clearance.push_back(clearance);
        band.clock.push_back(clock);
        band.value.push_back(value);
    };
    const auto keep = [&](std::size_t i, Pin pin) {
        add(old.at[i], pin, old.clearance[i], old.clock[i], old.value[i]);
    };
    keep(0, old.pinned[0]);
    double left = apart(old.clearance[0]);
    for (std::size_t i = 1; i < old.at.size(); ++i) {
        const Vector from = old.at[i - 1];
        const double whole = length(old.at[i] - from);
        double done = 0;
        while (whole - done > left) {
            done += left;
            const double share = done / whole;
            // The interpolated clearance only sets the spacing. The exact clearances are computed at the end.
            const double guess = (1 - share) * old.clearance[i - 1] + share * old.clearance[i];
            add(from + share * (old.at[i] - from), Pin::none, guess, std::lerp(old.clock[i - 1], old.clock[i], share),
                std::lerp(old.value[i - 1], old.value[i], share));
            left = apart(guess);
        }
        left -= whole - done;
        if (old.pinned[i] != Pin::none) {
            keep(i, old.pinned[i]);
            left = apart(old.clearance[i]);
        }
    }
    keep(old.at.size() - 1, Pin::none);
    shapes.distances(band.at, band.value, band.clearance);
    return band;
}

Band band_of(const Shapes& shapes, const Polyline& way)
{
    Band band{mapped(way, &WayPoint::at), mapped(way, &WayPoint::pin), mapped(way, &WayPoint::clock),
              mapped(way, &WayPoint::found), std::vector<double>(way.size())};
    shapes.distances(band.at, band.value, band.clearance);
    return resampled(shapes, band);
}

// Moves points away from the walls, perpendicular to the band. Pinned points are moved only if `pins` is true.
void push_off(const Shapes& shapes, Band& band, bool pins)
{
    const std::vector<Vector> old = band.at;
    const double open = fastest_clearance(shapes.field().bounds());
    parallel(old.size(), 64, shapes.threads(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = std::max<std::size_t>(first, 1); i < std::min(last, old.size() - 1); ++i) {
            if ((band.pinned[i] != Pin::none && !pins) || band.clearance[i] > open) continue;
            std::optional<DistanceField> room;
            const DistanceField& field = shapes.at(band.value[i], room);
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

// Straightens the band. Each point stays in a ball around the position from which it starts.
void relax(const Shapes& shapes, Band& band)
{
    const std::vector<Vector> home = band.at;
    const auto count = static_cast<int>(home.size());
    std::vector<double> radius(home.size());
    for (std::size_t i = 0; i < home.size(); ++i) {
        const double most = 2 * fastest_clearance(shapes.field().bounds());
        const double share = band.pinned[i] == Pin::none ? freedom : band.pinned[i] == Pin::gate ? pin_freedom : 0;
        radius[i] = share * shapes.field().safety() * std::min(band.clearance[i], most);
    }
    for (const int stride : strides) {
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            for (int k = 1; k < count - 1; ++k) {
                // Sweeps alternate between forwards and backwards.
                const int i = sweep % 2 == 0 ? k : count - 1 - k;
                const int step = std::min({stride, i, count - 1 - i});
                const auto middle = band.at.begin() + i;
                const auto point = [&](int offset) { return middle[offset]; };
                // The point is moved towards the midpoint of its two neighbours, `step` points before and after it. If
                // there are also two neighbours at twice that distance, the midpoint is blended with the cubic through
                // all four neighbours, which keeps bends round.
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

// Moves points whose clearance is below `least` back towards their positions in `home`: three times by half the
// distance, then entirely.
void take_back(const Shapes& shapes, Band& band, const std::vector<Vector>& home, double least)
{
    for (int attempt = 0; attempt < 4; ++attempt) {
        shapes.distances(band.at, band.value, band.clearance);
        for (std::size_t i = 0; i < home.size(); ++i) {
            if (band.clearance[i] < least) band.at[i] = attempt < 3 ? 0.5 * (band.at[i] + home[i]) : home[i];
        }
    }
    shapes.distances(band.at, band.value, band.clearance);
}

// Moves the band, including pinned points, with the walls. Each point was found in one shape (band.value); in small
// stages, that shape is changed to the shape at the point's shape time, and the point is pushed off the walls.
void follow(const Shapes& shapes, Band& band, const Schedule& schedule, double step)
{
    const std::vector<double> found = band.value;
    std::vector<double> there(found.size());
    double most = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        there[i] = schedule.value(band.clock[i]);
        most = std::max(most, std::abs(there[i] - found[i]));
    }
    const int parts = std::clamp(static_cast<int>(std::ceil(parts_a_step * most / step)), 1, most_parts);
    for (int part = 1; part <= parts; ++part) {
        // In each stage, the values of all points change by the same amount. Points that need a small change therefore
        // need fewer stages.
        const double gone = most * part / parts;
        for (std::size_t i = 0; i < found.size(); ++i)
            band.value[i] = found[i] + std::clamp(there[i] - found[i], -gone, gone);
        shapes.distances(band.at, band.value, band.clearance);
        for (int round = 0; round < pushes; ++round) push_off(shapes, band, true);
    }
}

// Smooths the shape time (the schedule's frame that sets the shape) along the band, so that the shape does not jump.
// Each point gets the average of the time over the part of the band that is within clock_reach of the point.
void set_clock(const Shapes& shapes, Band& band, const Schedule& schedule)
{
    const double cap = fastest_clearance(shapes.field().bounds());
    std::vector<double> way(band.at.size(), 0);  // distance from the beginning, in clearances
    for (std::size_t i = 1; i < way.size(); ++i) {
        const double clearance = 0.5 * (std::min(band.clearance[i], cap) + std::min(band.clearance[i - 1], cap));
        way[i] = way[i - 1] + length(band.at[i] - band.at[i - 1]) / std::max(clearance, 0.01 * cap);
    }
    for (int pass = 0; pass < 2; ++pass) {
        const std::vector<double> old = band.clock;
        std::vector<double> sum(way.size(), 0);  // integral of the shape time over the distance
        for (std::size_t i = 1; i < way.size(); ++i)
            sum[i] = sum[i - 1] + 0.5 * (old[i] + old[i - 1]) * (way[i] - way[i - 1]);
        const auto integral = [&](double to) {
            const auto after = std::ranges::upper_bound(way, to) - way.begin();
            const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, std::ssize(way) - 1)) - 1;
            const double rest = to - way[k];
            const double rise = (old[k + 1] - old[k]) / std::max(way[k + 1] - way[k], 1e-12);
            return sum[k] + rest * (old[k] + 0.5 * rest * rise);
        };
        for (std::size_t i = 0; i < way.size(); ++i) {
            // The window is symmetric and becomes shorter towards the ends of the band. Therefore the values at the
            // ends do not change, and a time that grows at a constant rate does not change either.
            const double reach = std::min({clock_reach, way[i] - way.front(), way.back() - way[i]});
            if (reach > 1e-9) band.clock[i] = (integral(way[i] + reach) - integral(way[i] - reach)) / (2 * reach);
        }
    }
    for (std::size_t i = 1; i < way.size(); ++i) band.clock[i] = std::max(band.clock[i], band.clock[i - 1]);
    for (std::size_t i = 0; i < way.size(); ++i) band.value[i] = schedule.value(band.clock[i]);
    shapes.distances(band.at, band.value, band.clearance);
}

}  // namespace

double least_on(const Shapes& shapes, const Polyline& way, const Schedule& schedule, double step)
{
    Band band = band_of(shapes, way);
    follow(shapes, band, schedule, step);
    return *std::ranges::min_element(band.clearance);
}

ControlPoints smooth(const Shapes& shapes, const Polyline& way, const Schedule& schedule, double step, double least)
{
    const bool changes = schedule.changes();
    Band band = band_of(shapes, way);
    if (changes) follow(shapes, band, schedule, step);
    for (int round = 0; round < rounds; ++round) {
        if (changes) set_clock(shapes, band, schedule);
        push_off(shapes, band, false);
        const std::vector<Vector> home = band.at;
        relax(shapes, band);
        take_back(shapes, band, home, least);
        band = resampled(shapes, band);
    }
    ControlPoints line{std::move(band.at), std::move(band.clock), {}};
    for (std::size_t i = 0; i < band.pinned.size(); ++i) {
        if (band.pinned[i] == Pin::place) line.places.push_back(i);
    }
    return line;
}

}  // namespace mandelmarch
