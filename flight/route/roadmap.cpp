// SPDX-License-Identifier: Apache-2.0
#include "flight/route/roadmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "core/text/quantile.h"
#include "flight/path/measures.h"
#include "flight/route/random.h"

namespace mandelmarch {
namespace {

constexpr double narrow = 0.0022;  // fractal sizes; smallest clearance of the points of Balls::narrows()
constexpr Roadmap::Effort one_shape{Balls::usual_coarse, 300'000};
// For shapes that change in flight:
constexpr Roadmap::Effort first_of_many{48, 100'000};
constexpr Roadmap::Effort one_of_many{48, 20'000};  // fewer tries, because the neighbour's gates are tried, too
constexpr int roads_iterations = 30;                // limit; points that need more are too close for a camera
constexpr double moved = 0.5;    // motion of the walls from one roadmap to the next, in a roadmap's smallest clearance
constexpr int most_values = 32;  // largest number of roadmaps of a schedule

// Returns the step of the shape parameter that moves the walls by the distance `moved` in the median. The parameter
// changes between `low` and `high`. The step is at least so large that there are at most most_values values.
double step_of_values(const Shapes& shapes, double low, double high)
{
    const DistanceField& field = shapes.field();
    const double size = field.bounds().size;
    const double little = (shapes.usual() < (low + high) / 2 ? 1 : -1) * (high - low) / 1000;
    std::vector<Vector> places(20'000);
    FlightRandom random(1);
    for (Vector& place : places) {
        for (double* c : {&place.x, &place.y, &place.z}) *c = size * (2 * random.share() - 1);
    }
    std::vector<double> before(places.size());
    std::vector<double> after(places.size());
    field.distances(places, before);
    std::optional<DistanceField> room;
    shapes.at(shapes.usual() + little, room).distances(places, after);
    std::vector<double> rates;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (before[i] > 0.004 * size && before[i] < 0.1 * size)
            rates.push_back(std::abs((after[i] - before[i]) / little));
    }
    if (rates.empty()) return high - low;
    const double wanted =
        moved * flight_measures(*field.scene().fractal).roads * size / std::max(upper_median(rates), 1e-12);
    return std::clamp(wanted, (high - low) / (most_values - 1), high - low);
}

}  // namespace

Roadmap::Roadmap(const Scene& scene, const Effort& effort, const Roadmap* neighbour, int threads, const Budget* budget)
    : field(scene, threads, budget),
      balls(field, flight_measures(*scene.fractal).roads * field.bounds().size, narrow * field.bounds().size,
            effort.coarse)
{
    find(neighbour, effort.tries);
    balls.forget_narrows();
}

void Roadmap::find(const Roadmap* neighbour, int tries)
{
    std::vector<Ball> also;
    if (neighbour != nullptr) {
        for (const Gate& gate : neighbour->gates) also.push_back({gate.centre, field.distance(gate.centre)});
    }
    const FlightMeasures& measures = flight_measures(*field.scene().fractal);
    const double size = field.bounds().size;
    gates = find_gates(field, balls, {measures.gate_least * size, measures.gate_most * size, tries}, std::move(gates),
                       also);
}

RoadmapSet::RoadmapSet(const Shapes& shapes, const Schedule& schedule, const std::function<void(int, int)>& begins)
    : schedule_(schedule)
{
    if (!schedule.changes()) {
        low_ = high_ = shapes.usual();
        roads_[0] =
            std::make_unique<Roadmap>(shapes.field().scene(), one_shape, nullptr, shapes.threads(), shapes.budget());
        return;
    }
    const auto [low, high] = std::ranges::minmax(schedule.knots(), {}, &Knot::value);
    low_ = low.value;
    high_ = high.value;
    step_ = step_of_values(shapes, low_, high_);
    const Roadmap* neighbour = nullptr;
    for (int number = 0; number <= number_of(high_); ++number) {
        if (begins) begins(number + 1, number_of(high_) + 1);
        Scene scene = shapes.scene(value_of(number));
        scene.iterations = std::min(scene.iterations, roads_iterations);
        roads_[number] = std::make_unique<Roadmap>(scene, neighbour == nullptr ? first_of_many : one_of_many, neighbour,
                                                   shapes.threads(), shapes.budget());
        neighbour = roads_[number].get();
    }
    // The second pass runs backwards, so that gates found at larger values are tried at smaller ones.
    for (int number = number_of(high_); number-- > 0;) roads_[number]->find(roads_[number + 1].get(), 0);
}

int RoadmapSet::number_of(double value) const { return static_cast<int>(std::lround((value - low_) / step_)); }

double RoadmapSet::value_of(int number) const { return std::min(low_ + number * step_, high_); }

std::vector<RoadmapSpan> RoadmapSet::stretches(int frames) const
{
    std::vector<RoadmapSpan> all;
    int before = -1;
    for (int frame = 0; frame < (schedule_.changes() ? frames : 1); ++frame) {
        const int number = schedule_.changes() ? number_of(schedule_.value(frame)) : 0;
        if (number == before) continue;
        if (!all.empty()) all.back().until = frame;
        all.push_back({.roads = roads_.at(number).get(), .value = value_of(number)});
        before = number;
    }
    return all;
}

bool RoadmapSet::has_space() const
{
    return std::ranges::all_of(roads_, [](const auto& entry) {
        const Roadmap& roads = *entry.second;
        return std::ranges::any_of(roads.balls.balls(), [&](const Ball& ball) {
            return roads.field.bounds().contains(ball.centre) && roads.balls.holding(ball.centre) >= 0;
        });
    });
}

void RoadmapSet::check(const Scene& scene) const
{
    const auto fail = [&](const char* missing) {
        constexpr int few_iterations = 8;
        throw InputError(fmt::format(
            "plan: this {} has {}; another seed does not help, expected another shape{}", scene.fractal->name, missing,
            scene.iterations < few_iterations ? fmt::format(" or more iterations than {}", scene.iterations) : ""));
    };
    if (!has_space()) fail("no free space that a camera can reach (no balls)");
    // If the shape changes, tours lead through wide places, too, and gates are not needed.
    if (gates().empty() && !schedule_.changes()) fail("no narrow places to fly through (no gates)");
}

std::vector<Ball> RoadmapSet::balls() const
{
    std::vector<Ball> all;
    for (const auto& [number, roads] : roads_) {
        all.insert(all.end(), roads->balls.balls().begin(), roads->balls.balls().end());
    }
    return all;
}

std::vector<Ball> RoadmapSet::gates() const
{
    std::vector<Ball> all;
    for (const auto& [number, roads] : roads_) {
        for (const Gate& gate : roads->gates) all.push_back({gate.centre, gate.clearance});
    }
    return all;
}

}  // namespace mandelmarch
