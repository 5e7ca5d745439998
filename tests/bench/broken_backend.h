// SPDX-License-Identifier: Apache-2.0
// The openmp backend with a defect that bench must detect.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <string_view>

#include "backends/all.h"
#include "core/text/error.h"

namespace mandelmarch::bench {

enum class Defect {
    none,
    one_byte,      // a byte and a colour are slightly wrong
    not_a_number,  // a colour is NaN
    upside_down,
    wrong_later,     // as one_byte, but in all pictures except the first
    stale,           // renders only the first picture, and leaves later images unchanged
    dies_later,      // throws Error after the first picture
    refuses,         // throws Unavailable for double
    hidden,          // has no device
    exact_when_fast  // renders in exact mode if fast mode is selected
};

class BrokenRenderer : public Renderer {
public:
    BrokenRenderer(std::unique_ptr<Renderer> inner, Defect defect) : inner_(std::move(inner)), defect_(defect) {}

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        const bool first = pictures_++ == 0;
        if (defect_ == Defect::stale && !first) return report_;
        if (defect_ == Defect::dies_later && !first) throw Error("the device is lost");
        report_ = inner_->render(scene, image, progress);
        report_.backend = "broken";
        if (defect_ == Defect::one_byte || (defect_ == Defect::wrong_later && !first)) {
            image.bytes()[100] ^= 1;
            if (image.has_values()) image.values()[33].green += 1 / 255.0;
        }
        if (defect_ == Defect::not_a_number && image.has_values()) {
            image.values()[33].green = std::numeric_limits<double>::quiet_NaN();
        }
        if (defect_ == Defect::upside_down) {
            std::ranges::reverse(image.bytes());
            std::ranges::reverse(image.values());
        }
        return report_;
    }

private:
    std::unique_ptr<Renderer> inner_;
    Defect defect_;
    RenderStats report_;
    int pictures_ = 0;
};

class BrokenBackend : public Backend {
public:
    explicit BrokenBackend(Defect defect, std::string_view name = "broken")
        : inner_(make_openmp_backend()), defect_(defect), name_(name)
    {
    }
    std::string_view name() const override { return name_; }
    std::optional<std::string> unavailable() const override
    {
        if (defect_ == Defect::hidden) return "hidden on purpose";
        return std::nullopt;
    }
    std::vector<Device> devices() const override
    {
        return defect_ == Defect::hidden ? std::vector<Device>{} : inner_->devices();
    }
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        if (defect_ == Defect::refuses && options.precision == Precision::f64) throw Unavailable("it has no double");
        RendererOptions changed = options;
        if (defect_ == Defect::exact_when_fast) changed.mode = Mode::exact;
        return std::make_unique<BrokenRenderer>(inner_->create(changed), defect_);
    }

private:
    std::unique_ptr<Backend> inner_;
    Defect defect_;
    std::string_view name_;
};

}  // namespace mandelmarch::bench
