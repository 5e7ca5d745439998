// SPDX-License-Identifier: Apache-2.0
// A number that records its formula as text. The formulas of a fractal's descriptor are function templates. The
// programs compute them with double, and export them as text by computing them with Formula. The text is an
// expression that is valid in both JavaScript and Python, so that the report's viewer computes the same values
// (docs/report.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace mandelmarch {

class Formula {
public:
    Formula(double value = 0);  // NOLINT(google-explicit-constructor): literals are formulas

    // Returns an input of a formula, such as `shape[0]`.
    static Formula input(std::string_view name);

    // Returns the expression. It uses the functions min, max, pow, sqrt, abs, floor, sign and pick(condition, a, b),
    // and has parentheses around every operation.
    const std::string& text() const { return text_; }

    // The first argument of pick().
    struct Condition {
        std::string text;
    };

    friend Formula operator+(const Formula& a, const Formula& b) { return infix(a, "+", b); }
    friend Formula operator-(const Formula& a, const Formula& b) { return infix(a, "-", b); }
    friend Formula operator*(const Formula& a, const Formula& b) { return infix(a, "*", b); }
    friend Formula operator/(const Formula& a, const Formula& b) { return infix(a, "/", b); }
    friend Condition operator<(const Formula& a, const Formula& b) { return {infix(a, "<", b).text_}; }
    friend Condition operator==(const Formula& a, const Formula& b) { return {infix(a, "==", b).text_}; }

    static Formula call(std::string_view function, const Formula& a);
    static Formula call(std::string_view function, const Formula& a, const Formula& b);
    static Formula call(std::string_view function, const Condition& on, const Formula& a, const Formula& b);

private:
    static Formula infix(const Formula& a, std::string_view symbol, const Formula& b);

    std::string text_;
};

// Functions that the descriptors' templates use, for double and for Formula.
namespace formula {

inline double min(double a, double b) { return std::min(a, b); }
inline double max(double a, double b) { return std::max(a, b); }
inline double pow(double a, double b) { return std::pow(a, b); }
inline double sqrt(double a) { return std::sqrt(a); }
inline double abs(double a) { return std::abs(a); }
inline double floor(double a) { return std::floor(a); }
inline double sign(double a) { return std::copysign(1, a); }  // requires a != 0
inline double pick(bool on, double a, double b) { return on ? a : b; }

inline Formula min(const Formula& a, const Formula& b) { return Formula::call("min", a, b); }
inline Formula max(const Formula& a, const Formula& b) { return Formula::call("max", a, b); }
inline Formula pow(const Formula& a, const Formula& b) { return Formula::call("pow", a, b); }
inline Formula sqrt(const Formula& a) { return Formula::call("sqrt", a); }
inline Formula abs(const Formula& a) { return Formula::call("abs", a); }
inline Formula floor(const Formula& a) { return Formula::call("floor", a); }
inline Formula sign(const Formula& a) { return Formula::call("sign", a); }
inline Formula pick(const Formula::Condition& on, const Formula& a, const Formula& b)
{
    return Formula::call("pick", on, a, b);
}

}  // namespace formula
}  // namespace mandelmarch
