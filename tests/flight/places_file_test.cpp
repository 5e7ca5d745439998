// SPDX-License-Identifier: Apache-2.0
// Tests the reader of places files.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "flight/path/places.h"
#include "tests/refusal.h"

namespace mandelmarch {
namespace {

const std::string head = std::string(places_header) + "\n";

TEST(PlacesFile, HasPlacesAndToursInOrder)
{
    const Places places = places_from_text(
        "# views\n" + head + "1,2,3,0,0,0,,\n\n1, 2, 4 ,0,0,0,20,0\ntour\n1,2,5,0,0,0.5,60.5,3\ntour,,,,,,,,,\n",
        "a.csv");
    ASSERT_EQ(places.all.size(), 3U);
    const auto& [first, second, third] = std::tie(places.all[0], places.all[1], places.all[2]);
    EXPECT_EQ(first.eye, (Vector{1, 2, 3}));
    EXPECT_EQ(third.target, (Vector{0, 0, 0.5}));
    EXPECT_FALSE(first.second.has_value());
    EXPECT_EQ(second.second, 20);
    EXPECT_EQ(third.second, 60.5);
    EXPECT_EQ(first.stay, usual_stay);
    EXPECT_EQ(second.stay, 0);
    EXPECT_EQ(third.stay, 3);
    EXPECT_EQ(std::vector({first.tour, second.tour, third.tour}), std::vector({false, false, true}));
    EXPECT_EQ(std::vector({first.line, second.line, third.line}), std::vector({3, 5, 7}));
    EXPECT_TRUE(places.tour_after);
    EXPECT_FALSE(places_from_text(head + "1,2,3,0,0,0\n", "a.csv").tour_after);
}

TEST(PlacesFile, IsReadAsSpreadsheetsWriteIt)
{
    const std::string text = head + "1.5,2,3,0,0,0,20.5,2\ntour\n";
    std::string other = "\xef\xbb\xbf" + text;
    std::ranges::replace(other, ',', ';');
    std::ranges::replace(other, '.', ',');
    for (std::size_t at = 0; (at = other.find('\n', at)) != std::string::npos; at += 2) other.insert(at, "\r");
    const Place expected = places_from_text(text, "a.csv").all.front();
    const Place got = places_from_text(other, "a.csv").all.front();
    EXPECT_EQ(expected.eye, got.eye);
    EXPECT_EQ(expected.second, got.second);
    EXPECT_EQ(got.eye.x, 1.5);
}

TEST(PlacesFile, ColumnsAreFoundByTheirNames)
{
    const Place expected = places_from_text(head + "1,2,3,0,0,0.5,20,1\n", "a.csv").all.front();
    for (const char* text : {
             "\"location_x\",\"location_y\",location_z,look_at_x,look_at_y,look_at_z,second,stay\n\"1\",2,3,0,0,0.5,20,"
             "1\n",
             ",location_x,location_y,location_z,look_at_x,look_at_y,look_at_z,second,stay\n0,1,2,3,0,0,0.5,20,1\n",
             "Stay,Second,look_at_z,look_at_y,look_at_x,location_z,location_y,Location_X\r1,20,0.5,0,0,3,2,1\r,tour\r",
             "location_x;location_y;location_z;look_at_x;look_at_y;look_at_z;second;stay\n1;2;3;0;0;\"0,5\";20;1\n",
         }) {
        const Place got = places_from_text(text, "a.csv").all.front();
        EXPECT_EQ(std::tie(got.eye, got.target, got.second, got.stay, got.line),
                  std::tie(expected.eye, expected.target, expected.second, expected.stay, expected.line))
            << text;
    }
}

TEST(PlacesFile, LineOfAPlaceIsReadAsThatPlace)
{
    Place view;
    view.eye = {0.123456789, -2, 3e-7};
    view.target = {0, 0, 1};
    view.lens = 0.5;
    view.roll = -20;
    const Place place = places_from_text(head + place_line(view) + "\n", "a.csv").all.front();
    EXPECT_EQ(std::tie(place.eye, place.target, place.second, place.lens, place.roll),
              std::tie(view.eye, view.target, view.second, view.lens, view.roll));
}

struct Bad {
    const char* lines;
    const char* message;
};

TEST(PlacesFile, ErrorNamesTheLineAndTheColumn)
{
    const std::string good = "1,2,3,0,0,0,20,2\n";
    ASSERT_NO_THROW(places_from_text(head + good, "a.csv"));
    for (const auto& [lines, message] : {
             Bad{"x,2,3,0,0,0", "a.csv:2: location_x is 'x', expected a number"},
             {"1,2,nan,0,0,0", "a.csv:2: location_z is 'nan'"},
             {"1,2,3,0,0", "a.csv:2: look_at_z is ''"},
             {"1,2,3,0,1e300,0", "a.csv:2: look_at_y is '1e300'"},
             {"1,2,3,1,2,3", "a.csv:2: look_at is the location"},
             {"1,2,3,0,0,0,-1", "a.csv:2: second is '-1'"},
             {"1,2,3,0,0,0,5,99", "a.csv:2: stay is '99', expected a number from 0 to 4"},
             {"1,2,3,0,0,0,5,1,1,0,7", "a.csv:2: 11 fields given, expected 10 or the word tour"},
             {"1,2,3,0,0,0,5,1,9", "a.csv:2: field_of_view is '9', expected a number from 0.1 to 2"},
             {"1,2,3,0,0,0,20\n\n1,2,3,0,0,0,21", "a.csv:4: second is 21, expected more than 22"},
             {"1,2,3,0,0,0,20\n1,2,3,0,0,0\n1,2,3,0,0,0,23", "a.csv:4: second is 23, expected more than 24"},
             {"tour\ntour\n1,2,3,0,0,0", "a.csv:3: this is the second tour on end"},
             {"tour\n1,2,3,0,0,0,0", "a.csv:3: second is 0, expected a later one after a tour"},
             {"\"1,2,3,0,0,0", "a.csv:2: a quotation mark is open"},
             {"\"1,5\",2,3,0,0,0", "a.csv:2: location_x is '1,5'"},
             {"tuor", "a.csv:2: location_x is 'tuor'"},
             {"tour", "a.csv: no places"},
         }) {
        const std::string refusal = refusal_of([&] { places_from_text(head + lines + "\n", "a.csv"); });
        EXPECT_TRUE(refusal.starts_with(message)) << refusal;
        EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
    }
    const char* three = "x,2,3,0,0,0\ntour\n1,2,3,0,0,0,-1\ntour\n1,2,3,0,0,0,5,99\n";
    EXPECT_EQ(refusal_of([&] { places_from_text(head + three, "a.csv"); }),
              "a.csv:2: location_x is 'x', expected a number from -1000000000 to 1000000000; "
              "a.csv:4: second is '-1', expected a number from 0 to 1000000; "
              "a.csv:6: stay is '99', expected a number from 0 to 4");
    for (const auto& [text, message] : {
             std::pair<std::string, const char*>{"", "a.csv:1: the table is empty, expected the header location_x,"},
             {good, "a.csv:1: '1,2,3,0,0,0,20,2' given, expected the header location_x,"},
             {"Frame," + head, "a.csv:1: unknown column 'frame', expected the header location_x,"},
             {"stay," + head, "a.csv:1: column stay given 2 times"},
             {"location_x,location_y,look_at_x", "a.csv:1: column location_z is missing"},
             {"\xff\xfe" + head, "a.csv: UTF-16 or no text"},
             {std::string("l\0o\0", 4), "a.csv: UTF-16 or no text"},
         }) {
        const std::string refusal = refusal_of([&] { places_from_text(text, "a.csv"); });
        EXPECT_TRUE(refusal.starts_with(message)) << refusal;
    }
}

TEST(PlacesFile, EmptyFileHasNoHeaderAndAFolderCannotBeRead)
{
    const std::string empty = refusal_of([] { read_places("/dev/null"); });
    EXPECT_TRUE(empty.starts_with("/dev/null:1: the table is empty")) << empty;
    EXPECT_EQ(refusal_of([] { read_places("/"); }), "/: Is a directory, expected a places file");
}

}  // namespace
}  // namespace mandelmarch
