// SPDX-License-Identifier: Apache-2.0
// The fields of the files that `bench duel --json` and `bench race --json` write.
#pragma once

#include <string>

#include "bench/contest/duel.h"
#include "bench/files/document.h"
#include "bench/contest/race.h"
#include "bench/files/result_fields.h"

namespace mandelmarch::bench {

template <>
inline constexpr auto values_of<DuelClock> = std::array{DuelClock::wall, DuelClock::processor};
template <>
inline constexpr auto values_of<RaceVerdict> =
    std::array{RaceVerdict::same,       RaceVerdict::close,    RaceVerdict::wrong,    RaceVerdict::wrong_size,
               RaceVerdict::no_picture, RaceVerdict::no_image, RaceVerdict::unsteady, RaceVerdict::failed,
               RaceVerdict::crashed,    RaceVerdict::hung,     RaceVerdict::no_start};

template <>
inline constexpr auto fields_of<DuelSide> =
    Description{"side", field("program", &DuelSide::program), field("environment", &DuelSide::environment)};

template <>
inline constexpr auto fields_of<DuelPair> = Description{
    "pair", field("run", &DuelPair::run, "", rules::required), field("round", &DuelPair::round, "", rules::required),
    field("old", &DuelPair::old_seconds, "", rules::required_seconds),
    field("new", &DuelPair::new_seconds, "", rules::required_seconds)};

template <>
inline constexpr auto fields_of<DuelRow> =
    Description{"row",
                field("name", &DuelRow::name, "", rules::required),
                field("old_failure", &DuelRow::old_failure, "", rules::text_or_null),
                field("new_failure", &DuelRow::new_failure, "", rules::text_or_null),
                field("same_picture", &DuelRow::same_picture, "",
                      {.about = "The pictures of the two programs are equal byte for byte."}),
                field("pairs", &DuelRow::pairs)};

template <>
inline constexpr auto fields_of<Duel> = Description{
    "duel",
    field("old", &Duel::old_side),
    field("new", &Duel::new_side),
    field("clock", &Duel::clock, "", {.about = "wall: kernel time; processor: processor time of all threads."}),
    field("margin", &Duel::margin, "",
          {.about = "Times with a ratio from 1 / (1 + margin) to 1 + margin count as the same."}),
    field("runs", &Duel::runs, "", {.about = "Number of complete runs of each program."}),
    field("rounds", &Duel::rounds, "", {.about = "Rounds in each run."}),
    field("warnings", &Duel::warnings),
    derived_field("verdicts", &Duel::verdicts),
    field("rows", &Duel::rows, "", rules::required)};

template <>
inline constexpr auto fields_of<RacePicture> =
    Description{"picture",
                field("width", &RacePicture::width),
                field("height", &RacePicture::height),
                field("differing", &RacePicture::differing, "", {.about = "Pixels with any byte different."}),
                field("visibly_differing", &RacePicture::visibly_differing, "",
                      {.about = "Pixels with a byte off by more than 2."}),
                field("first_x", &RacePicture::first_x, "",
                      {.min = -1, .about = "Column of the first differing pixel, from the left; -1: none."}),
                field("first_y", &RacePicture::first_y, "",
                      {.min = -1, .about = "Row of the first differing pixel, from the bottom; -1: none."}),
                field("psnr_db", &RacePicture::psnr, "", rules::infinite)};

template <>
inline constexpr auto fields_of<RaceSample> = Description{
    "sample", field("round", &RaceSample::round), field("wall", &RaceSample::seconds, "", rules::required_seconds),
    field("processor", &RaceSample::processor, "", rules::seconds)};

template <>
inline constexpr auto fields_of<RacedProgram> = Description{
    "program",
    field("name", &RacedProgram::name),
    field("ours", &RacedProgram::ours),
    field("verdict", &RacedProgram::verdict, "", rules::required),
    field("why", &RacedProgram::why, "",
          {.null = Null::empty, .about = "Why the verdict is neither same nor close; else null."}),
    field("exit_code", &RacedProgram::exit_code, "",
          {.about = "Of the last run that ended by itself; null if none did."}),
    field("signal", &RacedProgram::signal, "", {.about = "Signal that ended the last run; null if none did."}),
    field("picture", &RacedProgram::picture, "",
          {.about = "Comparison with the scalar kernel's picture; null if there is no picture of the right size."}),
    field("memory", &RacedProgram::memory, "", {.about = "Peak resident bytes of the program's largest process."}),
    derived_field("wall", &RacedProgram::wall, "",
                  {.about = "Seconds from start to end; null unless all pictures are correct."}),
    derived_field("times_ours", &RacedProgram::times_ours, "",
                  {.about = "This program's wall time / the wall time of our first program."}),
    field("samples", &RacedProgram::samples)};

template <>
inline constexpr auto fields_of<Race> =
    Description{"race",
                field("environment", &Race::environment),
                field("fractal", &Race::fractal),
                field("width", &Race::width),
                field("height", &Race::height),
                field("parameters", &Race::parameters, "", {.about = "Contents of the parameter file."}),
                field("limit", &Race::limit, "", {.about = "Time limit of a program, in seconds."}),
                field("rounds", &Race::rounds),
                field("warnings", &Race::warnings),
                field("programs", &Race::racers, "", rules::required)};

template <>
inline constexpr Format format_of<Duel>{"mandelmarch-duel", 2};
template <>
inline constexpr Format format_of<Race>{"mandelmarch-race", 2};

}  // namespace mandelmarch::bench
