// SPDX-License-Identifier: Apache-2.0
#include "core/scene/formula.h"

#include <fmt/format.h>

namespace mandelmarch {

Formula::Formula(double value) : text_(value < 0 ? fmt::format("({})", value) : fmt::format("{}", value)) {}

Formula Formula::input(std::string_view name)
{
    Formula made;
    made.text_ = name;
    return made;
}

Formula Formula::infix(const Formula& a, std::string_view symbol, const Formula& b)
{
    return input(fmt::format("({} {} {})", a.text_, symbol, b.text_));
}

Formula Formula::call(std::string_view function, const Formula& a)
{
    return input(fmt::format("{}({})", function, a.text_));
}

Formula Formula::call(std::string_view function, const Formula& a, const Formula& b)
{
    return input(fmt::format("{}({}, {})", function, a.text_, b.text_));
}

Formula Formula::call(std::string_view function, const Condition& on, const Formula& a, const Formula& b)
{
    return input(fmt::format("{}({}, {}, {})", function, on.text, a.text_, b.text_));
}

}  // namespace mandelmarch
